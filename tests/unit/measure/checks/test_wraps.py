"""A ramp that wraps: what is told, of which column."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.measure.checks.wraps import check_wraps
from tests.records import DEGREE
from tests.refusal import refusal


def wrapped(axis, x, end=0.0):
    """A record of rates x (N,) deg/s that wrap beyond 200 deg/s about one axis; X ends with a burst of `end` deg/s."""
    degrees = np.zeros((len(x), 3))
    degrees[:, axis] = np.mod(x + 200.0, 400.0) - 200.0
    degrees[-2:, 0] += end
    t = 0.001 * np.arange(len(x))
    return SimpleNamespace(t=t, crv=degrees * DEGREE, rate=500.0 * DEGREE, column=lambda axis: f"column {axis}")


@pytest.mark.parametrize(("axis", "end"), [(0, 0.0), (1, 0.0), (2, 600.0)])
@pytest.mark.parametrize(("last", "more"), [(450.0, ""), (850.0, ", and 2 times in all")])
def test_a_wrap_is_told_by_its_place_and_the_whole_range(axis, end, last, more):
    code, where, what, cure = refusal(check_wraps, wrapped(axis, np.arange(-149.5, last), end))
    assert (code, where) == ("E-WRAP", f"column {axis}")
    assert what == "leaps from 199.5 to -199.5 deg/s at 0.35 s" + more
    # The leap is of 399 deg/s: the motion goes on by 1 deg/s meanwhile.
    assert cure == "The numbers wrap around: where they do, add the whole range of the sensor, about 400 deg/s."


AT_THE_EDGE = np.concatenate((np.arange(-149.5, 201.0), np.arange(199.5, 450.0)))


@pytest.mark.parametrize("x", [np.arange(199.5, 800.0), np.arange(-149.5, 601.0), AT_THE_EDGE])
def test_the_motion_beside_a_wrap_is_that_of_the_steps_that_do_not_wrap(x):
    """Where it is the first step, or the last, there is one of them; between two wraps there is none."""
    assert refusal(check_wraps, wrapped(0, x))[3].endswith("about 400 deg/s.")
