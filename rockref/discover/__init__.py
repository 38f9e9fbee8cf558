"""From a measured run to a named missing effect: listening, fit, search, evidence, verdict."""
