"""Pieces of padded arrays cover every window once, and every sample that counts."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rockref.discover.windows.pieces import pieces


def test_a_long_row_stands_alone_and_its_neighbours_are_cut_where_the_longest_of_them_ends():
    length, long = np.array([570, 40, 51, 459, 30, 30]), np.array([1, 0, 0, 1, 0, 0], bool)
    found = pieces(length, long, 570)
    assert found == [(slice(0, 1), 570), (slice(1, 3), 51), (slice(3, 4), 459), (slice(4, 6), 30)]


@pytest.mark.parametrize("long", [True, False])
def test_rows_that_are_alike_are_one_piece_and_no_rows_none(long):
    assert pieces(np.array([7, 9]), np.full(2, long), 8) == [(slice(0, 2), 8)]
    assert pieces(np.zeros(0, int), np.zeros(0, bool), 8) == []


@given(st.lists(st.tuples(st.integers(1, 40), st.booleans()), min_size=1, max_size=20))
def test_nothing_that_counts_is_left_out(rows):
    length, long = (np.array(column) for column in zip(*rows, strict=True))
    covered = np.zeros((len(rows), length.max()), int)
    for own, n in pieces(length, long.astype(bool), int(length.max())):
        covered[own, :n] += 1
    assert covered.max() == 1
    assert np.all(covered[np.arange(length.max()) < length[:, None]] == 1)
