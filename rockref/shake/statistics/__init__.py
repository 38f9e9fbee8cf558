"""Statistics of outcomes that do not repeat: bands, fragility, scores, distances, ceilings, sizes of campaigns."""
