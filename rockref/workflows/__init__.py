"""Commands that go through several results: the demonstration, and the reproductions."""
