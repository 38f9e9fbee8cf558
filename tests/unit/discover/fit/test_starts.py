"""Starts over the whole prior, from releases that the first swing shows, on the runs that differ most."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.few_runs import FewRuns, unlike
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import fit_problem
from rockref.discover.fit.stages import S1
from rockref.discover.fit.starts import ALIKE, draws, released
from rockref.discover.hypotheses.law import is_height
from tests.unit.discover.synthetic import experiment

#: Tilts as they are stated, and by how much they are wrong [rad].
TILTS, WRONG = (0.117, 0.118, 0.1), (1e-3, -1.2e-3, 0.5e-3)


@pytest.fixture(scope="module")
def fitter() -> Fitter:
    """Three releases of the block of Table 3.1 from tilts that are not quite the stated ones."""
    runs = [{"tilt": tilt, "true_tilt": tilt + off} for tilt, off in zip(TILTS, WRONG, strict=True)]
    made = experiment(Model.table_3_1(), runs, duration=0.8, noisy=True)
    return Fitter(fit_problem(made, made.fit_runs(), Model.table_3_1(), workers=1))


def test_the_first_swing_shows_the_releases_and_leaves_the_law(fitter):
    # A law with other feet: nothing depends on them before the first impact.
    start = FittedModel((), fitter.problem.nominal())
    law = [k for k, p in enumerate(fitter.parameters(start)) if p.run is None]
    start.z[law] += 0.5
    found = released(fitter, start)
    assert np.array_equal(found.z[law], start.z[law])
    off = [p.value(z) for p, z in zip(fitter.parameters(found), found.z, strict=True) if p.kind == "tilt_offset"]
    # Half of the uncertainty that is stated: feet of another height turn the block as it stands.
    assert off == pytest.approx(WRONG, abs=0.7e-3)


def test_feet_of_one_draw_are_alike(fitter):
    parameters = fitter.problem.parameters()
    heights = [k for k, p in enumerate(parameters) if is_height(p)]
    assert len(heights) == 4
    field = draws(fitter, (), np.zeros(len(parameters)), 256)
    assert len(field) == 257 and not field[0].z.any()
    drawn = np.array([[parameters[k].value(h.z[k]) for k in heights] for h in field[1:]])
    low, high = parameters[heights[0]].low, parameters[heights[0]].high
    share = (drawn.max(axis=1) - low) / (high - low)
    # Were heights drawn one by one, the highest of four would be below half of the range once in sixteen draws.
    assert 0.5 < (share < 0.5).mean() < 0.95 and share.min() < 2 * ALIKE and share.max() > 0.8


def test_runs_that_differ_most_and_the_way_back(fitter):
    few = FewRuns(fitter.problem)
    assert few.chosen == (0, 2) and few.problem.runs == (fitter.problem.runs[0], fitter.problem.runs[2])
    z = np.arange(len(fitter.problem.parameters()), dtype=float)
    own = few.taken((), z)
    assert np.array_equal(few.put((), own, z), z)
    changed = few.put((), own + 100, z)
    moved = {p.name for p, a, b in zip(fitter.problem.parameters(), changed, z, strict=True) if a != b}
    assert "tilt_offset[2]" in moved and "K_N" in moved and "tilt_offset[1]" not in moved
    # What is predicted of its runs is what the whole problem predicts of them.
    at = FittedModel((), z := fitter.problem.nominal())
    part = FittedModel((), few.taken((), z))
    fitter.evaluate(at, S1)
    Fitter(few.problem).evaluate(part, S1)
    assert np.array_equal(part.r, at.r[[0, 2]])


def test_a_turned_run_differs_most():
    runs = [{"tilt": 0.117}, {"tilt": 0.09}, {"tilt": 0.116, "turned": True}]
    made = experiment(Model.table_3_1(), runs, duration=0.05)
    assert unlike(made.fit_runs()) == (0, 2) and unlike(made.fit_runs()[:1]) == (0,)
