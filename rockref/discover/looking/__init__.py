"""Looking for what is missing: every effect tried, the best raced, the winner held against its rivals."""
