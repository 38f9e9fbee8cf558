"""A failure speaks of another rule where rows show that forces move the block wrongly and turn it rightly."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.other_runs import cause_of
from rockref.conformance.judge.compare_answer import compare


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
