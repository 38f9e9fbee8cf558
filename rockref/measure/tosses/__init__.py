"""Tosses of a rigid block: reading, free flight, balances over the first impact."""
