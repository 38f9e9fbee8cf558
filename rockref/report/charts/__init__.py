"""Pictures: panels and other figures, by Matplotlib, as files and inside pages."""
