"""Values that are kept too long: constants of the first run, and what one step hands to the next."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance.backends.law import NumpyEngine, RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import HANDED_ON, verdict


class Keeps(NumpyEngine):
    """The law, with one constant of the block that it met first."""

    def __init__(self, name):
        super().__init__()
        self.constant, self.first = name, None

    def simulate(self, problem):
        if self.first is None:
            self.first = getattr(problem.block, self.constant)
        return super().simulate(replace(problem, block=replace(problem.block, **{self.constant: self.first})))


@pytest.mark.parametrize(("name", "rule"), [("inertia", "I2"), ("g", "A1")])
@pytest.mark.parametrize("profile", ["float64", "scheme"])
def test_a_constant_of_the_first_run_that_is_kept_is_told(name, rule, profile):
    found = verdict(judge(BlackBox(Keeps(name)), ["L4", "L5s", "LS"], profile))
    assert found.rule == rule and f"the {name} of" in found.says, (
        found.rule,
        found.says,
        found.check,
    )


class Late(RulesBackend):
    """The law by its pieces; runs whose normal forces are those of the row before, from the second row on."""

    def simulate(self, problem):
        out = vars(super().simulate(problem))
        F = np.array(out["F"])
        F[1:, :, 2] = F[:-1, :, 2]
        return out | {"F": F}


def test_what_steps_hand_on_is_told_by_the_forces_of_later_rows():
    found = verdict(judge(Late(), ["L0", "L1", "L2", "L3", "L4", "L5s", "L7"]))
    assert found.rule in ("N1", "N2", "S1", "T5") and found.says.startswith(HANDED_ON), (found.rule, found.says)


def test_a_moment_that_is_missing_is_no_inertia_of_another_run():
    """A block that hardly turns is as one that nothing turns."""
    found = verdict(judge(BlackBox(RulesBackend(law().replace(moment=lambda r, F: 0.0 * r[..., 0, :]))), ["L5s"]))
    assert found.rule == "A2", (found.rule, found.says)
