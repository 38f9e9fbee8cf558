"""The rule table, the test vectors, the judge, and the ways in for other implementations."""
