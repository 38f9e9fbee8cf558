"""Scores of the blind test: verdicts against truths."""
