"""Walks along the valley: where descents stop at dents, strides do not."""

import numpy as np
import pytest

from rockref.identify.descent import CHANGES, NEARLY, Descent
from rockref.identify.valley import PATIENCE, REFITS, STRIDE, along, walk
from tests.unit.identify.analytic import alone

TRUTH = 0.2


def bent(diagonal):
    """The line along which the two trade off."""
    return diagonal + 0.05 * np.sin(15.0 * (diagonal - TRUTH))


class Ground(Descent):
    """Two unknowns that trade off along a bent line, as far as the record without its end goes; its end, where it is
    seen, grows away from the truth and has a dent every fiftieth of the range."""

    def __init__(self, end: bool, names=("delta_diag", "x"), mark=0.0):
        super().__init__(alone(*names))
        self.end, self.mark = end, mark

    def with_step(self, zs, step):
        noise = np.tile([1.0, -1.0], 50)
        alike = 2000.0 * (zs[:, 1:] - bent(zs[:, :1]))
        off = zs[:, :1] - TRUTH
        ended, dents = (10.0 * off, 3.0 * (1.0 - np.cos(100.0 * np.pi * off))) if self.end else (0.0 * off,) * 2
        ended = ended + self.mark * step / self.step
        return np.concatenate([noise[:80] + alike, noise[80:90] + ended, noise[90:] + dents], axis=1)


@pytest.fixture
def grounds():
    return Ground(False), Ground(True)


START = np.array([0.6, bent(0.6)])


def test_a_descent_stops_in_a_dent_and_the_walk_does_not(grounds):
    short, whole = grounds
    at = whole.place(START)
    for change in CHANGES:
        at = whole.descend(at, change)
    assert at.chi2 > 1.5 and abs(at.z[0] - TRUTH) > 0.1
    end = along(short, whole, START, 3)
    assert end.chi2 < NEARLY and np.abs(end.z - TRUTH).max() < STRIDE


def test_a_walk_ends_where_nothing_is_gained_or_the_range_ends(grounds):
    short, whole = grounds
    assert len(walk(short, whole, START, STRIDE)) <= PATIENCE + 2
    assert max(p.z[0] for p in walk(short, whole, START, STRIDE)) > 0.6
    assert len(walk(short, short, np.array([0.975, bent(0.975)]), STRIDE)) == 2


def test_a_stride_that_refits_cannot_mend_is_given_up():
    """Behind a wall the record is ten times the noise whatever is refitted: the second refit gains nothing."""

    class Walled(Ground):
        asked = 0

        def with_step(self, zs, step):
            behind = np.where(zs[:, :1] > START[0] + 2.5 * STRIDE, 10.0, 1.0)
            return behind * super().with_step(zs, step)

        def jacobian(self, at, h):
            self.asked += 1
            return super().jacobian(at, h)

    short = Walled(False)
    assert len(walk(short, Ground(True), START, STRIDE)) == 2
    # Of the start over two step sizes, and at each of three strides.
    assert short.asked == 2 + 3 * REFITS


def test_a_model_without_the_diagonal_is_left_as_it_is():
    short, whole = (Ground(end, ("mu", "x")) for end in (False, True))
    assert walk(short, whole, START, -STRIDE) == []


@pytest.mark.parametrize("mark, left", [(0.9, 0.0), (3.6, 3.6)], ids=["small", "too large"])
def test_what_the_step_does_is_taken_off_where_it_is_small(mark, left):
    """A tenth of the record is shifted, in proportion to the step: at the truth nothing of it is left."""
    whole = Ground(True, mark=mark)
    assert whole.correct(START) is (left == 0.0)
    shift = whole.residuals(np.array([[TRUTH, bent(TRUTH)]]))[0, 80:90] - np.tile([1.0, -1.0], 5)
    # Sums and differences of numbers of order one.
    np.testing.assert_allclose(shift, left, atol=1e-13)


def test_the_step_does_not_move_the_end():
    short, whole, plain = Ground(False), Ground(True, mark=0.9), Ground(True, mark=0.9)
    plain.correct = lambda z: True
    off = [abs(along(short, ground, START, 3).z[0] - TRUTH) for ground in (whole, plain)]
    assert off[0] < STRIDE / 10 and off[0] < 0.5 * off[1]
