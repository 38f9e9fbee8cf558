"""What makes the files that ship: vectors with error bars, the response of Table 3.1, the law in any arithmetic."""
