"""Least squares over windows: what may move, where a fit begins, how it ends, how sure it is."""
