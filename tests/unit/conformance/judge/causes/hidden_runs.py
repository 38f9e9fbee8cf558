"""Runs by some rules, without their forces: what a backend shows at least."""

from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict


class Hidden:
    """Runs by the law with some rules replaced, without forces."""

    precision, name = "float64", "runs without forces"

    def __init__(self, **planted):
        self.backend = RulesBackend(law().replace(**planted))

    def simulate(self, problem):
        """Return the rows of a run."""
        rows = vars(self.backend.simulate(problem))
        return {k: rows[k] for k in ("t", "W", "x", "Lambda")}


def verdict_on_hidden(**planted):
    """Return what the judge says of the short runs."""
    return verdict(judge(Hidden(**planted), ["L5s"]))
