"""What lies outside of one release: another start of time, a hand that catches the block or sets it up again."""

from __future__ import annotations

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from tests.records import written

RATE = 1000


def notices(folder, code):
    return [str(n) for n in load_experiment(folder).notices if n.code == code]


def rest(count):
    return 0.05 * np.random.default_rng(1).standard_normal((count, 3))


def test_time_that_begins_before_the_release_is_told(tmp_path, made):
    """A twentieth of a second of standing: too short to be refused, and a sixth of the first swing of this block."""
    degrees = np.concatenate((rest(50), made.degrees))
    (said,) = notices(written(tmp_path, made, np.arange(len(degrees)) / RATE, degrees), "W-RELEASE")
    late = float(said.split("let go ")[1].split(" ms after")[0])
    assert late == pytest.approx(50.0, abs=4.0)  # the linear arc is good to a hundredth of the swing


def test_time_that_begins_after_the_release_is_told(tmp_path, made):
    degrees = made.degrees[40:]
    (said,) = notices(written(tmp_path, made, np.arange(len(degrees)) / RATE, degrees), "W-RELEASE")
    assert "ms before time zero" in said


def test_a_second_release_in_the_file_is_left_out(tmp_path, made):
    """The block is caught and set up again; the second release is no part of the run."""
    turned = np.cumsum(made.degrees[:, 0]) / RATE
    caught = 1900
    back = int(0.6 * RATE)
    # A hand turns it back to where it was let go, and it rests there against the wire.
    hand = np.zeros((back, 3))
    hand[:, 0] = -turned[caught - 1] * 2.0 / 0.6 * np.sin(np.pi * np.arange(back) / back) ** 2
    degrees = np.concatenate((made.degrees[:caught], hand + rest(back), rest(500), made.degrees + 0.01))
    folder = written(tmp_path, made, np.arange(len(degrees)) / RATE, degrees)
    (said,) = notices(folder, "W-SET-UP")
    assert float(said.split("tilted at ")[1].split(" s:")[0]) == pytest.approx((caught + back) / RATE, abs=0.06)
    assert load_experiment(folder).runs[0].t[-1] <= caught / RATE
