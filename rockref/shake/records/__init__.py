"""Recorded ground motion as engineers have it: a file a format, and one door."""
