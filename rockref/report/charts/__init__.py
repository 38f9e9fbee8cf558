"""Pictures: SVG text drawn here, and Matplotlib figures."""
