"""Work in many processes that may end at any moment: an executor, checkpoints, a lock on a folder."""
