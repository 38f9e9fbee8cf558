"""From a measured run to a named missing effect: compare, screen, confirm, verdict."""
