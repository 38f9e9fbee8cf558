"""The run that listens to the gyroscope, what it listens to, and its innovations."""
