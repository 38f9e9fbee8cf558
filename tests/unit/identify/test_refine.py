"""The last descent: what the step of the simulation does to a response no longer decides where it ends."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.identify.candidates import STEP
from rockref.identify.descent import CHANGES, Descent, Place
from rockref.identify.refine import covariance, refine, slopes

TRUTH = np.array([0.2, 0.3, 0.5])


class Rough(Descent):
    """Two shared unknowns of which the residual sees the difference a hundred times better than the sum, and the
    release angle of one run; what the step does to the residual changes from place to place within a thousandth."""

    def __init__(self, mark: float, bend: float = 0.0):
        unknowns = SimpleNamespace(
            names=("a", "b", "theta_0"),
            reach=np.full(3, 0.01),
            moves=[[(0, slice(None))], [(1, slice(None))], [(2, slice(None))]],
        )
        super().__init__(unknowns, STEP, 1)
        self.mark, self.bend = mark, bend

    def with_step(self, zs, step):
        a, b, angle = (zs - TRUTH).T[:, :, None]
        along = a + b
        sees = np.concatenate([2000.0 * (a - b + self.bend * along**2), 20.0 * along, 300.0 * angle], axis=1)
        phases = 2e4 * (zs @ np.array([0.3, 1.1, 0.7]))[:, None] + np.arange(3.0)
        sees = sees + self.mark * step / STEP * np.sin(phases)
        return np.repeat(sees, 400, axis=1) + np.tile([1.0, -1.0], 600)


def bottom(rough: Rough):
    """The end of the descents with the step of the search, and of the last descent from there."""
    at = rough.place(TRUTH + np.array([0.05, 0.05, -0.01]))
    for change in CHANGES:
        at = rough.descend(at, change)
    return at, refine(rough, at, rough.slopes(at, 1.0)[0])


def errors(end):
    return np.sqrt(np.diag(covariance(end.jacobian, end.doubt)) + np.square(end.remainder))


@pytest.mark.parametrize("bend", [0.0, 0.5], ids=["straight", "bent"])
def test_where_the_step_makes_dents_the_last_descent_leads_out_of_them(bend):
    at, end = bottom(Rough(0.3, bend))
    assert np.all(np.abs(at.z - TRUTH)[:2] > 5 * errors(end)[:2])
    assert np.all(np.abs(end.place.z - TRUTH) < 5 * errors(end))


def test_without_a_mark_it_ends_at_the_bottom_of_a_bent_valley():
    _, end = bottom(Rough(0.0, bend=0.5))
    # 1200 numbers of unit variance: a hundredth of a standard error.
    assert np.all(np.abs(end.place.z - TRUTH) < 0.01 * errors(end))
    assert np.all(np.abs(end.remainder) < 0.01 * errors(end))


@pytest.mark.parametrize("corner", [0.0, 1.0])
def test_slopes_along_axes_are_those_of_the_unknowns_in_a_corner_too(corner):
    rough, z = Rough(0.0), np.full(3, corner)
    along = 1e-3 * np.array([[1.0, 1.0, 0.2], [1.0, -1.0, 0.1], [0.0, 0.0, 1.0]])
    exact = np.repeat([[2000.0, -2000.0, 0.0], [20.0, 20.0, 0.0], [0.0, 0.0, 300.0]], 400, axis=0)
    # Differences of numbers of order 1000 over lengths of 1e-3.
    np.testing.assert_allclose(slopes(rough, z, along), exact, atol=1e-6)


def test_slopes_that_err_do_not_promise_more_than_there_is():
    """Errors of slopes add information that is not there; what they add is taken off the errors again."""
    rng = np.random.default_rng(0)
    exact, noise = np.repeat(np.diag([1.0, 0.1]), 1000, axis=0), 0.05
    found = exact + noise * rng.standard_normal(exact.shape)
    sd = [
        np.sqrt(np.diag(covariance(J, d)))
        for J, d in ((exact, np.zeros((2, 2))), (found, np.zeros((2, 2))), (found, len(found) * noise**2 * np.eye(2)))
    ]
    assert sd[1][1] < 0.9 * sd[0][1] < 0.9 * sd[2][1] / 0.9
    assert sd[2][0] == pytest.approx(sd[0][0], rel=0.02)


def test_a_descent_reports_what_it_gains():
    gains: list[float] = []
    rough = Rough(0.0)
    rough.report = gains.append
    start = rough.place(TRUTH + np.array([0.02, 0.02, 0.0]))
    refine(rough, Place(start.z, start.r, start.chi2), rough.slopes(start, 1.0)[0])
    assert gains == sorted(gains, reverse=True) and gains
