"""Identification: genes, cost, evolutionary search, least squares, what the result is sure of."""
