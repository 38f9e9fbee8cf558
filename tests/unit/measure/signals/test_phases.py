"""Phases: planar, repeatable, erratic, quasi-two-dimensional, in that order and without overlap.

Then phases of runs whose arcs are given: the limits at which one ends and the next begins.
"""

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.activity import Leakage
from rockref.measure.signals.phases import ERRATIC, PLANAR, QUASI_2D, REPEATABLE, phases
from tests.unit.measure.struck import struck


@pytest.fixture
def clattering(rocking, sensed):
    """A record that clatters from 15 ms before its first impact until `stop`."""
    motion = rocking()

    def make(stop):
        t, crv = sensed(motion)
        since = t - motion.times[0] + 0.015
        clatter = np.where((since > 0.0) & (t < stop), 0.05 * np.sin(2.0 * np.pi * 20.0 * since), 0.0)
        return motion, t, crv + np.stack((0 * t, clatter, clatter), axis=-1)

    return make


def test_phases_of_a_made_record(clattering):
    motion, t, crv = clattering(2.0)
    found = phases(t, crv)
    assert [name for name, *_ in found.intervals] == [PLANAR, REPEATABLE, ERRATIC, QUASI_2D]
    assert found.onset == pytest.approx(motion.times[0] - 0.015, abs=5e-3)
    assert found.repeatable_until == pytest.approx(motion.times[1], abs=3e-3)
    assert not found.repeatable_from_runs
    assert found.quasi_2d_from == pytest.approx(motion.times[2], abs=3e-3)
    assert len(found.shares) == 5


def test_planar_record_is_planar_throughout(rocking, sensed):
    t, crv = sensed(rocking())
    found = phases(t, crv)
    assert found.intervals == ((QUASI_2D, t[0], t[-1]),)
    assert np.isnan(found.onset)


@pytest.mark.parametrize("number", range(1, 12))
def test_intervals_tile_every_shipped_run(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    for run in experiment.fit_runs():
        marks = phases(run.t, run.crv).intervals
        assert (marks[0][1], marks[-1][2]) == (run.t[0], run.t[-1])
        assert all(a[2] == b[1] for a, b in zip(marks[:-1], marks[1:], strict=True))
        assert all(end > start for _, start, end in marks)


def test_uneven_feet_stop_the_clatter(shipped):
    """In mystery-07 the feet are so uneven that the block hardly leaves its plane; the control clatters for 3 s."""
    uneven = load_experiment(shipped / "mystery-07", uses=("fit",)).runs[0]
    control = load_experiment(shipped / "mystery-08", uses=("fit",)).runs[0]
    assert phases(uneven.t, uneven.crv).quasi_2d_from == 0.0
    assert phases(control.t, control.crv).quasi_2d_from > 3.0


NONE = Leakage(np.zeros(2), np.zeros(2), np.zeros(2))
T = 1.0 + np.arange(3000) / 1000.0


def with_shares(*shares, times):
    """A main rate of one, and rates about Z of these shares of it in each arc: the rate about Y shows no onset."""
    z = np.array(shares)[np.searchsorted(times, T, side="right")]
    return np.stack([np.ones_like(T), np.zeros_like(T), z], axis=-1)


def found(*shares, times=(1.5, 2.0, 2.5, 3.0, 3.5), **how):
    return phases(T, with_shares(*shares, times=times), impacts=struck(*times), leak=NONE, **how)


def test_without_an_onset_it_is_planar_until_it_is_erratic():
    got = found(0.5, 0.5, 0.5, 0.5, 0.01, 0.01)
    assert np.isnan(got.onset) and got.shares == pytest.approx([0.5, 0.5, 0.5, 0.5, 0.01, 0.01], rel=1e-9)
    assert (got.repeatable_until, got.repeatable_from_runs, got.quasi_2d_from) == (2.0, False, 3.0)
    assert got.intervals == ((PLANAR, 1.0, 2.0), (ERRATIC, 2.0, 3.0), (QUASI_2D, 3.0, T[-1]))


@pytest.mark.parametrize(("share", "start"), [(0.0599, 2.0), (0.0601, 3.0)])
def test_planar_arcs_have_less_than_six_hundredths_out_of_the_plane(share, start):
    assert found(0.5, 0.5, 0.01, share, 0.01, 0.01).quasi_2d_from == start


@pytest.mark.parametrize(("last", "start"), [((0.5, 0.5, 0.01), np.inf), ((0.5, 0.01, 0.01), 3.0)])
def test_two_planar_arcs_are_the_fewest(last, start):
    assert found(0.5, 0.5, 0.5, *last).quasi_2d_from == start


def test_planar_arcs_before_the_last_clatter_do_not_count():
    assert found(0.01, 0.01, 0.01, 0.5, 0.01, 0.01).quasi_2d_from == 3.0
    assert found(0.01, 0.01, 0.01, 0.01, 0.01, 0.5).quasi_2d_from == np.inf
    assert found(0.01, 0.01, 0.01, 0.01, 0.01, 0.01).intervals == ((QUASI_2D, 1.0, T[-1]),)


@pytest.mark.parametrize(("end", "start"), [(3.8985, np.inf), (3.9, 3.0)])
def test_pieces_of_less_than_a_tenth_of_a_second_are_not_asked(end, start):
    """The last piece, which clatters, lasts 0.1005 s, and counts; or 0.099 s, and does not."""
    assert found(0.5, 0.5, 0.5, 0.01, 0.01, 0.5, times=(1.5, 2.0, 3.0, 3.5, end)).quasi_2d_from == start


def test_a_piece_of_exactly_a_tenth_of_a_second_is_asked():
    """In time that counts from zero by eighths of a tenth: 0.1 s is the last impact's time exactly."""
    t = np.arange(2400) / 8000.0
    times = (0.1,)
    crv = np.stack([np.ones_like(t), 0 * t, np.where(t < 0.1, 0.01, 0.5)], axis=-1)
    assert phases(t, crv[:, :], impacts=struck(*times), leak=NONE).quasi_2d_from == np.inf
    crv[:, 2] = 0.01
    assert phases(t, crv, impacts=struck(*times), leak=NONE).quasi_2d_from == 0.0


def test_repeated_runs_end_the_repeatable_phase_but_not_beyond_the_record():
    got = found(0.5, 0.5, 0.5, 0.5, 0.5, 0.5, agree_until=2.7)
    assert (got.repeatable_until, got.repeatable_from_runs) == (2.7, True)
    assert got.intervals == ((PLANAR, 1.0, 2.7), (ERRATIC, 2.7, T[-1]))
    assert found(0.5, 0.5, 0.5, 0.5, 0.5, 0.5, agree_until=9.0).repeatable_until == T[-1]


@pytest.mark.parametrize(("times", "until"), [((1.5, 2.0), 2.0), ((1.5,), T[-1]), ((), T[-1])])
def test_else_it_is_the_second_impact_or_the_end(times, until):
    assert found(*[0.5] * (len(times) + 1), times=times).repeatable_until == until


def with_onset(begin):
    """Rates about Y of the share 0.5 from an instant on."""
    crv = with_shares(*[0.0] * 6, times=(1.5, 2.0, 2.5, 3.0, 3.5))
    crv[begin <= T, 1] = 0.5
    return crv


def test_between_onset_and_second_impact_it_is_repeatable():
    got = phases(T, with_onset(1.48), impacts=struck(1.5, 2.0, 2.5, 3.0, 3.5), leak=NONE)
    # The mean over five samples sees the step up to two samples early.
    assert got.onset == pytest.approx(1.48, abs=2.1e-3)
    assert got.intervals == (
        (PLANAR, 1.0, got.onset), (REPEATABLE, got.onset, 2.0), (ERRATIC, 2.0, T[-1]),
    )  # fmt: skip


def test_runs_that_agree_up_to_less_than_the_onset_have_no_repeatable_phase():
    got = phases(T, with_onset(1.48), impacts=struck(1.5, 2.0, 2.5, 3.0, 3.5), leak=NONE, agree_until=1.2)
    assert got.intervals == ((PLANAR, 1.0, got.onset), (ERRATIC, got.onset, T[-1]))


def test_leakage_that_is_given_is_taken_out():
    """Half of the main rate shows about Z, by a gyroscope that is turned so far."""
    times = (1.5, 2.0, 2.5)
    turned = Leakage(np.array([0.0, 0.5]), np.zeros(2), np.zeros(2))
    got = phases(T, with_shares(0.5, 0.5, 0.5, 0.5, times=times), impacts=struck(*times), leak=turned)
    assert got.shares == pytest.approx(np.zeros(4), abs=1e-12) and got.quasi_2d_from == T[0]
