"""What may be missing: the numbers of the law and of effects, each with its prior."""
