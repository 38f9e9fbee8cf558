"""How the block starts: release."""
