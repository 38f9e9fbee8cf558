"""What a verdict may see: a plain value that is stored."""
