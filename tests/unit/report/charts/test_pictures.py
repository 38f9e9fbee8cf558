"""Pictures of what `import rockref` gives."""

import numpy as np
import pytest

import rockref
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.shake.ensemble import Draws, Ensemble
from rockref.shake.experiment import ShakenExperiment
from tests.shipped import two_runs

MODEL = rockref.Model.four_points()
MOTION = BaseMotion(0.0, 0.5, np.array([[0.0, 0, 0], [2.0, 1.0, 0], [0.0, 0, 0]]), "made")


def shaken_tests(ratios):
    sizes = np.column_stack([np.linspace(1.0, 2.0, 8), np.linspace(1.0, 2.0, 8) * ratios])
    fell = np.array([0, 0, 0, 1, 0, 1, 1, 1.0])
    return ShakenExperiment("made", np.arange(8).astype(str), fell, {}, sizes, None, {}, Draws(), "")


def lines(figure):
    return sum(len(ax.lines) + len(ax.collections) for ax in figure.axes)


@pytest.mark.parametrize(
    "thing",
    [
        MODEL,
        MODEL.problem(),
        *MODEL.body(),
        Ensemble(MODEL, (MOTION,)),
        shaken_tests(0.1),
        shaken_tests(np.linspace(1, 2, 8)),
    ],
    ids=lambda thing: type(thing).__name__,
)
def test_a_thing_draws_itself(thing):
    assert lines(thing.plot()) > 0


def test_a_response_draws_its_rates_and_its_contacts():
    response = rockref.simulate(MODEL, duration=0.02, step=2e-5, output_rate=1000.0, engine="numpy", theta_0=0.01)
    axes = response.plot().axes
    assert np.array_equal(axes[0].lines[0].get_ydata(), response.crv[:, 0]) and len(axes) == 4


def test_an_experiment_draws_its_runs_and_dashes_those_held_out(tmp_path):
    ax = rockref.load(two_runs(tmp_path)).plot().axes[0]
    assert [line.is_dashed() for line in ax.lines] == [False, True]


def test_what_no_cuboid_is_draws_nothing():
    with pytest.raises(InputError, match="no cuboid"):
        rockref.Block(np.array(1.0), np.diag([1.0, 1.0, 3.0]), np.array(9.81)).plot()
