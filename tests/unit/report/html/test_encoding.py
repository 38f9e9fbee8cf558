"""Packed columns: two bytes a number, gaps kept."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rockref.report.html.encoding import packed, unpacked


@given(arrays(np.float64, st.integers(1, 200), elements=st.floats(-1e3, 1e3)))
def test_numbers_come_back_to_half_a_unit(values):
    column = packed(values)
    # Half a unit of rounding, and the rounding of the product.
    assert np.abs(unpacked(column) - values).max() <= 0.5 * column["unit"] * (1.0 + 1e-9) + 1e-300
    assert column["n"] == len(values)


def test_unit_is_a_32000th_of_the_largest():
    assert packed(np.array([-160.0, 20.0]))["unit"] == pytest.approx(0.005)


def test_whole_numbers_with_unit_one_are_exact():
    values = np.array([0.0, 255.0, 17.0])
    assert unpacked(packed(values, 1.0)).tolist() == values.tolist()


def test_gaps_stay_gaps():
    assert np.isnan(unpacked(packed(np.array([1.0, np.nan, np.inf])))).tolist() == [False, True, True]


def test_nothing_but_zeros():
    assert unpacked(packed(np.zeros(3))).tolist() == [0.0, 0.0, 0.0]
