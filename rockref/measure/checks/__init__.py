"""Whether a record can be that of the experiment it is said to be, and whether its sensor was in order."""
