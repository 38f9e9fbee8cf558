"""The same problem, solved faster: the law itself in NumPy, and compiled."""
