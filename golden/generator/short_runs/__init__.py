"""Questions to who shows `simulate` only: short runs, each laid out so that one rule decides."""
