"""What the plate stands on: support."""
