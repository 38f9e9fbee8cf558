"""What may be added to the law: a folder per physical question, a file per answer, none always among them."""
