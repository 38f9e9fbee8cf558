"""Adapters: a file an engine, each with one function `run`. They are examples to copy, too."""
