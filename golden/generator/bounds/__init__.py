"""Exact answers to the questions, and the error bar of every expected number."""
