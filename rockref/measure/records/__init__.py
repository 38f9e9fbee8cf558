"""Plain data: an experiment and its runs, tosses, remarks."""
