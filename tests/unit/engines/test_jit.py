"""Variants of one compiled text have files of their own on disk."""

import pytest

pytest.importorskip("numba")

from rockref.engines.compiled import kernel, slots


def test_variants_do_not_share_a_file():
    """numba names the files after the qualified name and the line; the line is the same for all."""
    texts = [loop.py_func for loop in kernel.LOOPS.values()]
    assert len({text.__code__.co_firstlineno for text in texts}) == 1
    assert len({text.__qualname__ for text in texts}) == len(texts) == len(slots.VARIANTS)


def test_each_variant_calls_functions_of_its_own():
    called = [loop.py_func.__globals__["evaluate"] for loop in kernel.LOOPS.values()]
    assert len(set(map(id, called))) == len(called)
    assert kernel.evaluate is None, "the text of the loop itself belongs to no variant"
