"""A failure speaks of another rule where rows show that forces move the block wrongly and turn it rightly."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine, RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.causes.other_runs import cause_of, pushed_sideways
from rockref.conformance.judge.compare_answer import compare
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from tests.unit.conformance.judge.causes.hidden_runs import Hidden


@pytest.mark.parametrize(("turned", "rule"), [(0.0, "A1"), (1e-6, "N1")])
def test_normal_forces_that_move_the_block_wrongly_and_turn_it_rightly_are_summed_wrongly(turned, rule):
    """Rows stand in for forces that are not shown."""
    answers = []
    for vector in [v for v in vectors.layer("L5s") if v.expect.keys() >= {"F_N@0", "x@1", "Lambda@1"}][:3]:
        out = {k: np.array(ask(NumpyEngine(), vector)[k]) for k in ("x", "Lambda", "W")}
        out["x"][1, 2] += 1e-9
        out["Lambda"][1] += turned
        answers.append((vector, out))
    checks = [c for vector, out in answers for c in compare(vector, out)]
    told = next(c for c in checks if c.failed and c.rule == "N1" and c.name == "x@1")
    assert cause_of(answers, checks, told, "float64")[0] == rule


def along_the_height():
    """Contact and the sum of forces: normal forces push along the height of the block."""
    seen = []

    def contact(rules, problem, state, x, Lambda, v, W):
        seen[:] = [Lambda]
        return law().contact(rules, problem, state, x, Lambda, v, W)

    def force(F, mass, g):
        push = F[..., 2].sum(axis=-1)[..., None]
        return law().force(F, mass, g) + push * (seen[0][..., :, 2] - [0, 0, 1])

    return {"contact": contact, "force": force}


def shown(**planted):
    return BlackBox(RulesBackend(law().replace(**planted)))


@pytest.mark.parametrize("backend", [Hidden, shown])
def test_a_push_that_goes_sideways_without_friction_is_summed_wrongly(backend):
    """Forces that are shown are right, and all failures follow from where they move the block."""
    found = verdict(judge(backend(**along_the_height()), ["L5s"]))
    assert found.rule == "A1", (found.rule, found.says, found.check)


class Limited(Hidden):
    """Runs without forces; the block gains a micrometre less in each step after the first in which a foot touches."""

    def simulate(self, problem):
        rows = super().simulate(problem)
        down = np.min((rows["x"][0] + problem.points.P @ rows["Lambda"][0].T)[:, 2]) < 0
        late = np.maximum(np.arange(len(rows["x"])) - 1, 0)[:, None] * [0, 0, 1e-6]
        return rows | {"x": rows["x"] - late * down}


def test_where_falls_are_right_what_pushes_after_a_step_is_no_velocity():
    found = verdict(judge(Limited(), ["L5s"]))
    assert found.rule == "S1" and "Falls of two steps" in found.says, (found.rule, found.says, found.check)


@pytest.mark.parametrize(("id_", "is_told"), [("L5s-N1-0019", True), ("L5s-T2-0129", False)])
def test_stretched_feet_that_go_sideways_on_ice_may_be_held(id_, is_told):
    """Friction that ice should not have is no wrong sum."""
    vector = next(v for v in vectors.layer("L5s") if v.id == id_)
    out = {"x": np.array(ask(NumpyEngine(), vector)["x"])}
    assert not pushed_sideways([(vector, out)], "L5s")
    out["x"][1, 0] += 1e-7
    assert pushed_sideways([(vector, out)], "L5s") is is_told
