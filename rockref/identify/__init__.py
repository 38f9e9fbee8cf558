"""Cost, evolutionary search, least squares, sensitivities, and the reduction from 54 parameters to 12."""
