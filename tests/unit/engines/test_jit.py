"""Variants of one compiled text have files of their own on disk."""

import pytest

pytest.importorskip("numba")


def test_law_and_effects_do_not_share_a_file():
    from rockref.engines.compiled import batch, kernel

    pairs = [
        (batch._loop_law, batch._loop_with_effects),
        (kernel.law, kernel.with_effects),
        (kernel.begin_law, kernel.begin_with_effects),
    ]
    for law, other in pairs:
        # numba names the files after the qualified name and the line; the line is the same for both.
        assert law.py_func.__code__.co_firstlineno == other.py_func.__code__.co_firstlineno
        assert law.py_func.__qualname__ != other.py_func.__qualname__
