"""The zoo: planted mistakes that the judge must find and name, and controls that it must leave alone."""
