"""The simulator of the blind test: a second text of the physics. NumPy, numba and this folder only."""
