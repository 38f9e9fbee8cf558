"""Windows restarted from a record of the model itself: at its own parameters nothing may be left but noise."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.least_squares import Fit
from rockref.discover.fit.search import MIDDLE, Setup, windows
from rockref.discover.windows.series import STATES
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment

#: Mean loss of a window above which it counts as out of step; noise alone gives 0.93 with a spread of 0.1.
OUT_OF_STEP = 1.5


def at_truth(effect: str = "", runs=({},), end: float = 2.0):
    """A fit of noisy runs at the parameters that made them, and the point without corrections."""
    model = Model.table_3_1().replace(effects=(parse(effect),) if effect else ())
    e = experiment(model, list(runs), duration=end, noisy=True)
    setup = Setup(e, e.runs, model, end=end, workers=1)
    fit = setup.fit(windows(setup, MIDDLE, model))
    return fit, fit.point(np.zeros(len(fit.parameters)), np.zeros((fit.series.B, STATES)))[0]


def out_of_step(fit: Fit, point) -> float:
    return float(np.mean(2 * point.loss / fit.series.count > OUT_OF_STEP))


def rough(fit: Fit, point) -> np.ndarray:
    return np.flatnonzero(2 * point.loss / fit.series.count > 1.3)


def test_law_alone_is_noise_after_relaxation():
    fit, point = at_truth()
    assert out_of_step(fit, point) > 0.5  # before it: the reconstructed starts are not good enough by themselves
    point = fit.relax_states(point, 4)
    point = fit.grow(point, rough(fit, point))
    assert out_of_step(fit, point) == 0
    # Cauchy loss of white noise is 0.96; five corrections of some 200 values take 0.03.
    assert np.mean(2 * point.loss / fit.series.count) == pytest.approx(0.93, abs=0.04)


def test_growing_finds_what_relaxing_does_not():
    # The block that was turned lands on its other feet, and later swings hold more corner impacts.
    runs = ({"tilt": 0.098}, {"turned": True})
    fit, point = at_truth("uneven_foot_damping:foot1=0.6,foot2=1.6,foot3=0.8,foot4=1.2", runs, end=3.0)
    relaxed = fit.relax_states(point, 4)
    grown = fit.grow(relaxed, rough(fit, relaxed))
    assert out_of_step(fit, relaxed) > 0.05
    assert out_of_step(fit, grown) < 0.5 * out_of_step(fit, relaxed)
    assert np.all(grown.loss <= relaxed.loss)


def test_growing_never_moves_a_release():
    fit, point = at_truth()
    grown = fit.grow(point, np.arange(fit.series.B))
    assert np.all(grown.corrections[fit.series.first] == 0)


def test_spin_friction_is_restarted_with_its_turn():
    fit, point = at_truth("spin_friction:radius=2e-3")
    point = fit.relax_states(point, 4)
    point = fit.grow(point, rough(fit, point))
    # Started with a slack spring, six windows of ten are out of step.
    assert out_of_step(fit, point) < 0.08


def settled(fit: Fit, point, times: int):
    """The point after each of so many rounds; between them what lives on is handed on."""
    for _ in range(times):
        point = fit.relax_states(point, 2)
        point = fit.grow(point, rough(fit, point))
        yield point
        point = fit.carried(point)


@pytest.mark.parametrize("pitch", [0.0, 0.5])
def test_plate_under_the_block_is_handed_on_from_window_to_window(pitch):
    fit, point = at_truth(f"compliant_support:frequency=60,pitch={pitch}")
    shares = [out_of_step(fit, p) for p in settled(fit, point, 6)]
    assert shares[0] > 0.3 and shares[-1] < 0.1


def test_dents_under_the_block_are_handed_on_from_window_to_window():
    fit, point = at_truth("hysteretic_contact:kappa=1")
    medians = [np.median(2 * p.loss / fit.series.count) for p in settled(fit, point, 5)]
    # Begun on fresh feet the windows hold 1.05 of the noise, in their dents 0.98; noise alone is 0.93 to 0.95.
    assert medians[0] > 1.02 and medians[-1] < 1.0


def test_without_plate_or_dents_nothing_is_handed_on():
    fit, point = at_truth()
    assert fit.carried(point) is point


def test_roll_of_the_release_is_found():
    model = Model.table_3_1()
    e = experiment(model, [{}], duration=2.0, noisy=True)
    setup = Setup(e, e.runs, model, end=2.0, workers=1)
    names = [p.name for p in setup.parameters()]
    at = names.index("roll_offset[0]")
    fit = setup.fit(windows(setup, MIDDLE, model))
    z = np.zeros(len(names))
    z[at] = 0.5
    shown = fit.series.simulate(*fit.models(z), np.zeros((fit.series.B, STATES)))
    moved = replace(e.runs[0], crv=e.runs[0].crv.copy())
    first = fit.series.first
    n = int(fit.series.length[first][0])
    moved.crv[:n] = shown[first][0, :n]
    other = Setup(e, (moved,), model, end=2.0, workers=1)
    series = other.fit(windows(other, MIDDLE, model))
    point = series.begin()
    for _ in range(3):
        point, _ = series.step(point, 1e-3)
    # The release alone holds the roll; its records are without noise.
    assert point.z[at] == pytest.approx(0.5, abs=0.1)
