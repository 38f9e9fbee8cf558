"""One search for all hypotheses under one budget."""
