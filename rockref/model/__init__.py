"""The law: the eight-point rocking block, rule by rule, in plain NumPy."""
