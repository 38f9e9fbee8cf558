"""The zoo: seeded faults that the judge must find and name, and controls that it must leave alone."""
