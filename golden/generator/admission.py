"""Which mistakes a vector catches, and by how many bars: what decides on its admission."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from rockref.conformance.backends.call import as_mapping
from rockref.conformance.faults.mistakes import BY_ID, MISTAKES
from rockref.conformance.judge.findings import answered
from rockref.conformance.vectors import Vector
from rockref.model.problem import Problem

#: A mistake counts as caught from here on [bars].
RESOLVED = 100.0
#: And in the vectors of the profile "scheme", which are outside from two bars on.
RESOLVED_BY_SCHEMES = 10.0
#: Deviations are written with two digits, and never above this.
LARGEST = 1e99


class WithoutForces:
    """Runs that do not show their forces, in the stead of which the next rows are looked at."""

    def __init__(self, backend: Any):
        self.backend = backend

    def simulate(self, problem: Problem) -> dict[str, Any]:
        """Return a run."""
        return as_mapping(self.backend.simulate(problem), "simulate") | {"F": None}


def moves(vector: Vector, rules: set[str]) -> dict[str, float]:
    """Return by how many bars each mistake of some rules moves the vector; only those that do move it."""
    found, of_schemes = {}, vector.layer == "LS"
    for mistake in [m for m in MISTAKES if m.rule in rules]:
        backend = WithoutForces(mistake.of_another_scheme()) if of_schemes else mistake.backend()
        checks = answered(backend, vector, "scheme" if of_schemes else "float64")
        worst = max(0.0 if c.grade == "negligible" else c.worst for c in checks)
        if worst > 1:
            found[mistake.id] = float(f"{min(worst, LARGEST):.2g}")
    return found


def hunted(vector: Vector) -> Vector | None:
    """Return the vector with the mistakes that it hunts; None where it may not be admitted.

    It hunts the mistakes of the rules that it shows, if they move it by a hundred bars and by more than a negligible
    difference; there must be one. A vector of a single piece (L0 to L3, L7) is also refused where such a mistake moves
    it by less than that: it would be neither seen nor unseen.
    """
    rules = {vector.rule} | {e.rule for e in vector.expect.values()}
    own = moves(vector, rules)
    hunts = {k: v for k, v in own.items() if v >= (RESOLVED_BY_SCHEMES if vector.layer == "LS" else RESOLVED)}
    whole = vector.piece in ("step", "simulate")
    unclear = [k for k in own if k not in hunts and not BY_ID[k].digits]
    if not hunts or (unclear and not whole):
        return None
    return replace(vector, hunts=tuple(sorted(hunts)), resolving=hunts)
