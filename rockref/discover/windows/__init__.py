"""A run cut into short windows, each restarted from the state that the gyroscope implies."""
