"""What a mistake is, and the backend that makes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.backends.other_scheme import kick_and_drift
from rockref.conformance.backends.rule_set import Rows, Rules
from rockref.model.problem import Problem, stack

Plant = Callable[[Rules], Rules]


@dataclass(frozen=True)
class Mistake:
    """One planted mistake.

    id, says : name and one line;  rule : the rule that is wrong.
    plant : replaces rules;  read : how a whole run misreads its problem, where a mistake in what is derived from the
    parameters shows in a run only so;  report : what a run makes of its rows;  late : rows that many steps old;
    recorded : the numbers of the steps that a run writes down, where they are not the nearest ones.
    digits : it loses digits, and may move a vector by anything.
    """

    id: str
    rule: str
    says: str
    plant: Plant | None = None
    read: Callable[[Problem], Problem] | None = None
    report: Callable[[Rows], Rows] | None = None
    late: int = 0
    recorded: Callable[[Problem], np.ndarray] = rule_set.output_steps
    digits: bool = False

    def backend(self) -> Mistaken:
        """Return a backend that makes this mistake and shows all its pieces."""
        return Mistaken(self, rule_set.law())

    def of_another_scheme(self) -> Mistaken:
        """Return a backend that makes this mistake and has another integrator."""
        return Mistaken(self, rule_set.law().replace(step=kick_and_drift))


class Mistaken(RulesBackend):
    """The law with one mistake."""

    def __init__(self, mistake: Mistake, rules: Rules):
        super().__init__(mistake.plant(rules) if mistake.plant else rules, name=mistake.id)
        self.mistake = mistake

    def simulate(self, problem: Problem) -> Any:
        """Return a run with the mistake in it."""
        m = self.mistake
        read = m.read(problem) if m.read else problem
        rows = rule_set.simulate(self.rules, read, self.dtype, m.late, m.recorded)
        return m.report(rows) if m.report else rows

    def simulate_many(self, problems: list[Problem]) -> list[Any]:
        """Return runs side by side."""
        m = self.mistake
        read = stack([m.read(p) if m.read else p for p in problems])
        batch = rule_set.simulate(self.rules, read, self.dtype, m.late, m.recorded)
        rows = [batch.pick(i) for i in range(len(problems))]
        return [m.report(r) for r in rows] if m.report else rows
