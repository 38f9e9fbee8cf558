"""Ways in: an engine by name, a Python class, a program that speaks JSON lines; and how a question is put to it."""
