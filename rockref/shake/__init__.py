"""Blocks on a shaken plate: records of its motion, ensembles of runs, and the statistics of their outcomes."""
