"""The law compiled with numba: the same operations in the same order, so that the bits are those of the law."""
