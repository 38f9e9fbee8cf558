"""Questions to the pieces of a backend, and the bodies and scenes that they are about."""
