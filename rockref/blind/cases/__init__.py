"""Cases of the blind test: what is drawn, made and sealed."""
