"""Plain tables of texts, and numbers as texts: for the terminal, pages and files alike."""
