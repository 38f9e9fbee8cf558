"""How the plate pushes back: normal contact."""
