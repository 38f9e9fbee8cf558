"""LB: who moves the plate rightly passes, and each mistake of the list is outside in every vector, under its name."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance.backends.json_lines import answer, plain
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import shaken
from rockref.conformance.judge.causes.wrong_base_motion import OF_BASE, planted
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.shaken import judge_shaken, judge_vector, shaken_vectors
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.reports.terminal import text
from rockref.conformance.vectors import flat
from rockref.engines import run


class Mistaken:
    """A backend whose plate moves with a mistake."""

    def __init__(self, load):
        self.load = load

    def simulate(self, problem):
        return run(problem, engine="numpy")

    def shaken(self, problem):
        with np.errstate(all="ignore"):
            return run(planted(problem, self.load), engine="numpy")


def test_the_law_is_inside_alone_and_over_lines_of_json():
    found = judge_shaken(NumpyEngine())
    assert [c.grade for c in found] == ["inside"] * 3 and max(c.worst for c in found) < 1
    vector = shaken_vectors()[0]
    said = answer(NumpyEngine(), {"cmd": "run", "id": "q", "piece": "shaken", "in": plain(flat(vector.problem))})
    assert shaken.compare("base motion", vector.expect, said["out"]).grade == "inside"


def test_the_compiled_engine_is_inside():
    pytest.importorskip("numba")
    from rockref.conformance.backends.law import NumbaEngine

    assert [c.grade for c in judge_shaken(NumbaEngine())] == ["inside"] * 3


@pytest.mark.parametrize("mistake", OF_BASE, ids=lambda m: m.id)
def test_every_mistake_is_outside_and_named(mistake):
    for vector in shaken_vectors():
        check = shaken.compare("base motion", vector.expect, vars(Mistaken(mistake.load).shaken(vector.problem)))
        # as far off as the file says; bars are rounded up to two digits, and so is that
        assert check.failed and abs(check.worst / vector.resolving[mistake.id] - 1) < 0.15
    named = judge_vector(Mistaken(mistake.load), shaken_vectors()[1])
    assert named.failed and named.note.endswith(f"as if: {mistake.says}")


def test_records_are_what_the_mistakes_need():
    for vector in shaken_vectors():
        base, problem = vector.problem.base, vector.problem
        assert len(base.a) % 2 == 1 and np.all(base.a[-1] != 0) and np.all(base.a[:, 0] != base.a[:, 1])
        assert base.end < problem.start.t + problem.duration  # it ends within the run
        assert np.min(np.abs((base.t_0 - problem.start.t) / problem.step - np.arange(-40, 40))) > 0.01
        assert np.all(np.abs(problem.points.P[:, :2].mean(axis=0)) > 0.005)


def test_the_judge_says_it_and_who_does_not_claim_it_is_not_asked():
    right = verdict(judge(NumpyEngine(), ["LB"]))
    assert right.passed and "Base motion (LB): 3 of 3 vectors inside" in text(right)
    wrong = verdict(judge(Mistaken(OF_BASE[2].load), ["LB"]))
    assert not wrong.passed and "as if: the sign" in text(wrong) and "0 of 3" in text(wrong)
    silent = replace(OF_BASE[2], load=None)
    backend = Mistaken(silent.load)
    backend.shaken = lambda problem: None
    assert [c.grade for c in judge_shaken(backend)] == ["not shown"] * 3
