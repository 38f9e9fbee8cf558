"""Likely causes of what is wrong: slips, lost digits, faults of the zoo with similar traces, effects left out."""
