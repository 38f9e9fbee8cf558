"""What the commands print: words and tables, one file a result, and the command to type next."""
