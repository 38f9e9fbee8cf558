"""What else pulls and pushes: loads."""
