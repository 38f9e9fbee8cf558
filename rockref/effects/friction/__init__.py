"""How the plate holds the feet: friction."""
