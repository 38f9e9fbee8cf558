"""A ramp that wraps: what is told, of which column."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.checks.wraps import check_wraps
from tests.records import DEGREE
from tests.refusal import refusal


def ramp(axis, last, end=0.0, first=-149.5):
    """A record of 1 deg/s a sample, which wraps beyond 200 deg/s; X ends with a burst of `end` deg/s."""
    x = np.arange(first, last)
    degrees = np.zeros((len(x), 3))
    degrees[:, axis] = np.mod(x + 200.0, 400.0) - 200.0
    degrees[-2:, 0] += end
    t = 0.001 * np.arange(len(x))
    return SimpleNamespace(t=t, crv=degrees * DEGREE, rate=500.0 * DEGREE, column=lambda axis: f"column {axis}")


@pytest.mark.parametrize(("axis", "end"), [(0, 0.0), (1, 0.0), (2, 600.0)])
@pytest.mark.parametrize(("last", "more"), [(450.0, ""), (850.0, ", and 2 times in all")])
def test_a_wrap_is_told_by_its_place_and_the_whole_range(axis, end, last, more):
    code, where, what, cure = refusal(check_wraps, ramp(axis, last, end))
    assert (code, where) == ("E-WRAP", f"column {axis}")
    assert what == "leaps from 199.5 to -199.5 deg/s at 0.35 s" + more
    # The leap is of 399 deg/s: the motion goes on by 1 deg/s meanwhile.
    assert cure == "The numbers wrap around: where they do, add the whole range of the sensor, about 400 deg/s."


@pytest.mark.parametrize(("first", "last"), [(199.5, 800.0), (-149.5, 601.0)])
def test_the_motion_beside_a_wrap_at_an_end_is_that_of_one_side(first, last):
    """At the first step, or at the last."""
    assert refusal(check_wraps, ramp(0, last, first=first))[3].endswith("about 400 deg/s.")
