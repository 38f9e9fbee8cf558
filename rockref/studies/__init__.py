"""Studies of the source: sensitivity, predictability, twins, four-point models, the reduction to twelve genes."""
