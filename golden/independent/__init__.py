"""The law a second time, in any arithmetic: the route by which the expected values are computed."""
