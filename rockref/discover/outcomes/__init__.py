"""Which effect is missing, from outcomes on a shake table: candidates, their likelihood, evidence and verdict."""
