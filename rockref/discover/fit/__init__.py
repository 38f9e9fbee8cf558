"""The fit: objective, wide differences, Gauss-Newton, stages, starts."""
