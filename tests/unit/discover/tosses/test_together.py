"""The way down from all effects together, on a fit whose objective is a known parabola."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses import together
from rockref.discover.tosses.descent import Slopes
from rockref.discover.tosses.together import LUCK, Stair, luck, needed, taken_away, way_down, way_up
from rockref.measure.tosses.flight import Poses

#: Columns: one number of the law and those of three effects; b is nearly a copy of a, c explains nothing.
COLUMNS = {
    "law": [1.0, 0.2, 0.0, 0.0], "a.x": [0.0, 1.0, 0.0, 0.0], "b.x": [0.0, 1.0, 0.05, 0.0], "c.x": [0.0, 0.0, 0.0, 1.0],
}  # fmt: skip
MEASURED = np.array([0.5, 1.0, 0.1, 0.0])


@dataclass
class Parabola:
    """What the way down asks of a fit; the residual is linear in z, the objective its square and a constant."""

    effects: tuple[str, ...]
    poses: Poses

    def __post_init__(self):
        names = ["law", *(f"{id}.x" for id in self.effects)]
        self.parameters = tuple(Parameter(name, None, 0.0, 1.0, prior=1e3) for name in names)
        self.columns = np.array([COLUMNS[name] for name in names]).T

    def residual(self, z, poses):
        return self.columns @ z - MEASURED

    def objective(self, z, r, weight):
        return 1.0 + float(r @ r) / 2

    def frame_weights(self, z, poses):
        return np.ones(1)

    def slopes(self, z, poses, weight):
        r, J = np.zeros((2, 2, 3)), np.zeros((2, 2, 3, len(z)))
        r.reshape(-1)[:4], J.reshape(-1, len(z))[:4] = self.residual(z, poses), self.columns
        return Slopes(r, J, np.ones((2, 2)), np.full(len(z), 1e3), 1)

    def descend(self, z, poses, weight, slopes):
        z = np.linalg.lstsq(self.columns, MEASURED, rcond=None)[0]
        return z, self.objective(z, self.residual(z, poses), weight)


@pytest.fixture
def full():
    nothing = np.zeros((1, 1, 3))
    poses = Poses(np.zeros(1), nothing, np.zeros((1, 1, 3, 3)), np.ones(222, int), nothing[0], nothing[0])
    fit = Parabola(("a", "b", "c"), poses)
    z, objective = fit.descend(np.zeros(4), poses, None, None)
    return Stair(fit, z, objective)


def test_what_is_not_needed_leaves_first(full):
    stairs = way_down(full, (), lambda line: None)
    # c explains nothing: without it nothing is lost, and the way begins below it.
    assert [s.fit.effects for s in stairs][::2] == [("a", "b"), ()] and len(stairs) == 3
    assert stairs[0].costs["c"] == pytest.approx(0, abs=1e-9)
    # b can stand for a in part: beside b, a costs less than alone.
    assert 0 < stairs[0].costs["a"] < stairs[2].objective - stairs[1].objective
    objectives = [s.objective for s in stairs]
    assert objectives == sorted(objectives)


def test_a_model_that_got_stuck_is_fitted_from_the_one_below(full):
    down = way_down(full, (), lambda line: None)
    stuck = replace(down[0], z=down[0].z + 3.0, objective=50.0)
    up = way_up([stuck, *down[1:]], full.fit.poses, np.ones(1))
    assert [s.fit.effects for s in up] == [s.fit.effects for s in down]
    assert up[0].objective == pytest.approx(down[0].objective)


def test_effects_that_are_kept_stay(full):
    assert all("c" in s.fit.effects for s in way_down(full, ("c",), lambda line: None))


def test_the_others_make_up_for_what_is_taken_away(full):
    slopes = full.fit.slopes(full.z, full.fit.poses, None)
    found = taken_away(full, "a", slopes, full.fit.poses, np.ones(1))
    _, best = found.fit.descend(found.z, None, None, None)
    # The moves are damped by a thousandth: they come as near as that to the best place of the others.
    assert found.objective == pytest.approx(best, rel=1e-3)
    still = full.fit.objective(None, replace(found.fit).residual(np.delete(full.z, 1), None), None)
    assert found.objective < still


def test_what_ended_absent_leaves_at_once(full):
    z = full.z.copy()
    z[2] = 0.0
    found = together.absent_left_out(replace(full, z=z), ("a", "b", "c"))
    # c explains nothing either, and ended exactly at zero.
    assert found.fit.effects == ("a",) and list(found.z) == list(z[:2])


def test_a_number_must_pay_for_its_luck(full):
    def stair(numbers, objective):
        return Stair(full.fit, np.zeros(numbers), objective)

    share = luck(stair(6, 1.0))
    assert share == pytest.approx(1e-3)
    assert needed([stair(6, 1.0), stair(5, 1.0 + share / 2), stair(4, 1.0 + 4 * share)]) == 1
    # Of a fifth of the tosses chance gives five times as much.
    few = replace(full.fit, poses=full.fit.poses._replace(frames=np.ones(44, int)))
    assert luck(replace(full, fit=few)) == LUCK / 44
    assert needed([replace(s, fit=few) for s in (stair(6, 1.0), stair(4, 1.0 + 4 * share))]) == 1
    assert together.STAGES[-1][0] == max(frames for frames, _ in together.STAGES)


def test_two_effects_that_do_the_same_are_said_to_be_alike(full):
    found = together.alike(full, full.fit.slopes(full.z, full.fit.poses, None))
    assert list(found) == ["a", "b", "c"] and found["a"]["a"] == 1.0
    # b is a but for a twentieth; c shares nothing with either.
    assert 0.99 < found["a"]["b"] == found["b"]["a"] <= 1.0
    assert found["a"]["c"] == pytest.approx(0.0, abs=1e-3)
    first = way_down(full, (), lambda line: None)[0]
    # The confusion is that of all effects, also where the way begins lower.
    assert "c" not in first.fit.effects and first.confusion == found


def test_settling_goes_on_while_it_gains_and_no_longer_than_it_may(full, monkeypatch):
    steps = []

    def descend(self, z, poses, weight, slopes):
        steps.append(z)
        return z, 10.0 - share * len(steps)

    monkeypatch.setattr(Parabola, "descend", descend)
    for share, wanted in ((1.0, together.AFTER), (0.0, 1)):
        steps.clear()
        found = together.settled(replace(full, objective=10.0), full.fit.poses, np.ones(1))
        assert len(steps) == wanted and found.objective == pytest.approx(10.0 - share * wanted)
