"""Errors by stretch: what there is none of has no number."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit import errors as erring
from rockref.discover.fit.errors import Errors, errors_of, holdout_errors, spread_of
from rockref.discover.fit.information import eliminated
from tests.unit.discover.synthetic import DEGREE, experiment


def fit_of(first, residual):
    """A fit of four windows of 10 rows of one run without a main impact; the first are from the release."""
    t = np.arange(40) * 1e-3
    run = SimpleNamespace(t=t, crv=np.zeros((40, 3)))
    s = SimpleNamespace(
        sigma=0.05 * DEGREE, count=np.full(4, 30.0), first=np.arange(4) < first, runs=(run,), run_of=np.zeros(4, int),
        start=10 * np.arange(4), stop=10 * np.arange(1, 5), rate=1000.0,
    )  # fmt: skip
    r = residual * np.ones((4, 10, 3))
    return SimpleNamespace(series=s, residual=lambda z, corrections: r), SimpleNamespace(z=None, corrections=None)


@pytest.mark.parametrize("first, known", [(1, ["release", "arc"]), (0, ["arc"]), (4, ["release"])])
def test_a_stretch_without_a_window_has_no_error(first, known):
    found = errors_of(*fit_of(first, 2.0))
    assert found.total == pytest.approx(0.1) and found.noise == pytest.approx(0.05)
    for row, name in zip(found.table, erring.STRETCHES, strict=True):
        assert np.isnan(row).all() if name not in known else row == pytest.approx([0.1] * 3)
    assert (found.to_dict()["by_stretch_and_axis"]["impact"]["main"]) is None


def test_without_held_out_runs_there_is_no_error_of_them(monkeypatch):
    made = SimpleNamespace(holdout_runs=lambda: ())
    monkeypatch.setattr(erring, "load_experiment", lambda path, uses: made)
    monkeypatch.setattr(erring, "on_time", lambda experiment: experiment)
    monkeypatch.setattr(erring, "on_held_out", lambda *a: pytest.fail("fitted"))
    setup = SimpleNamespace(experiment=SimpleNamespace(path="folder"))
    assert holdout_errors(setup, Model.table_3_1(), ()) is None
    made.holdout_runs = lambda: ("03",)
    monkeypatch.setattr(erring, "on_held_out", lambda *a: fit_of(1, 2.0))
    assert isinstance(holdout_errors(setup, Model.table_3_1(), ()), Errors)


def test_repeated_runs_differ_by_their_noise_and_single_ones_by_nothing_known():
    assert spread_of(experiment(Model.table_3_1(), [{}, {"tilt": 0.105}], duration=0.8, noisy=True), 0.8) is None
    twice = experiment(Model.table_3_1(), [{}, {}], duration=0.8, noisy=True)
    # The same release twice: the noise of both, 0.05 deg/s each, and half a resolution.
    assert spread_of(twice, 0.8) == pytest.approx(np.full(3, np.sqrt(2) * 0.05), rel=0.15)


def test_eliminating_nothing_changes_nothing():
    H, g = np.array([[2.0, 1.0], [1.0, 3.0]]), np.array([1.0, 2.0])
    same = eliminated(H, g, np.zeros(2, bool), np.ones(2))
    np.testing.assert_array_equal(same[0], H)
    np.testing.assert_array_equal(same[1], g)
    # One number eliminated: what is left is known less well, by what the two share.
    less, _ = eliminated(H, g, np.array([True, False]), np.full(2, 1e9))
    assert less.shape == (1, 1) and less[0, 0] == pytest.approx(3.0 - 1.0 / 2.0)
