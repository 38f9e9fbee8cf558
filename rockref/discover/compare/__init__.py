"""Models beside measured runs: errors, bands, features, and what they say in sentences."""
