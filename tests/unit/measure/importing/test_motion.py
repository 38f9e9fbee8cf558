"""The release in a recording, whatever a hand did to the block before it."""

import numpy as np
import pytest

from rockref.measure import load_experiment
from rockref.measure.importing.motion import find_motion
from rockref.measure.importing.recording import Recording
from tests import foreign
from tests.shipped import ROOT

EXPERIMENT = ROOT / "data/experiments/mystery-05"


@pytest.fixture(scope="module")
def measured():
    return load_experiment(EXPERIMENT)


def found(measured, run, hand=lambda before: 0.0):
    """The motion in a log in which a hand turns the block, by `hand` of the seconds before the release [deg/s]."""
    t, chip = foreign.chip_record(measured.run(run), seed=3)
    before = np.maximum(foreign.STANDING - t, 0.0)
    push = np.where(before > 0, hand(before), 0.0)[:, None] * np.array([0.3, -0.5, 1.0])
    recording = Recording("log", t, chip + push, None, 1000.0, None, None)
    return find_motion(recording, measured.width, measured.height)


HANDS = {
    "trembles until the release": lambda before: 0.5 * np.sin(2 * np.pi * 3 * before) * (before < 0.4),
    "creeps towards it": lambda before: 0.6 * np.maximum(0.3 - before, 0.0) / 0.3,
    "jolts": lambda before: 3.0 * np.sin(20 * np.pi * before) * ((before > 0.05) & (before < 0.15)),
    "jolts twice": lambda before: 3.0 * np.sin(20 * np.pi * before) * (((before * 5) % 1 < 0.5) & (before < 0.4)),
}


@pytest.mark.parametrize("hand", HANDS)
@pytest.mark.parametrize("run", ["01", "04", "06"])
def test_what_a_hand_does_before_the_release_does_not_move_it(measured, run, hand):
    still, moved = found(measured, run), found(measured, run, HANDS[hand])
    # A sample of these records is 1 ms. A hand that creeps moves the zero: by 0.05 deg/s, which a block gains in 1.5 ms
    # of its first 33 deg/s2.
    assert moved.release == pytest.approx(still.release, abs=1.5e-3 if "creeps" in hand else 0.7e-3)
    assert moved.impact == pytest.approx(still.impact, abs=1e-6)
    assert abs(moved.angle) == pytest.approx(abs(still.angle), rel=0.01)
    assert still.release == pytest.approx(foreign.STANDING, abs=1.5e-3)


def test_a_record_that_begins_at_the_release_is_said_to(measured):
    t, chip = foreign.chip_record(measured.run("01"))
    rows = t >= foreign.STANDING
    cut = Recording("log", t[rows] - t[rows][0], chip[rows] - foreign.ZERO, None, 1000.0, None, None)
    motion = find_motion(cut, measured.width, measured.height)
    assert motion.release == 0.0 and motion.standing == 0.0
