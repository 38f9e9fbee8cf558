"""The page of each result, one file each, and the card at its head."""
