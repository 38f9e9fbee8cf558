"""Which mistakes a vector catches, and by how many bars: what decides on its admission."""

from __future__ import annotations

from dataclasses import replace

from rockref.conformance.judge import answered
from rockref.conformance.vectors import Vector
from rockref.conformance.zoo.mistakes import BY_ID, MISTAKES

#: A mistake counts as caught from here on [bars].
RESOLVED = 100.0
#: Deviations are written with two digits, and never above this.
LARGEST = 1e99


def moves(vector: Vector) -> dict[str, float]:
    """By how many bars each mistake moves the vector; only those that do move it."""
    found = {}
    for mistake in MISTAKES:
        checks = answered(mistake.backend(), vector, "float64")
        worst = max(c.worst for c in checks)
        if worst > 1:
            found[mistake.id] = float(f"{min(worst, LARGEST):.2g}")
    return found


def hunted(vector: Vector) -> Vector | None:
    """The vector with the mistakes that it hunts; None where it may not be admitted.

    It hunts the mistakes of the rules that it shows, if they move it by a hundred bars; there must be one. A vector of
    a
    single piece (L0 to L3, L7) is also refused where such a mistake moves it by less: it would be neither seen nor
    unseen.
    """
    rules = {vector.rule} | {e.rule for e in vector.expect.values()}
    own = {k: v for k, v in moves(vector).items() if BY_ID[k].rule in rules}
    hunts = {k: v for k, v in own.items() if v >= RESOLVED}
    whole = vector.piece in ("step", "simulate")
    if not hunts or (len(hunts) < len(own) and not whole):
        return None
    return replace(vector, hunts=tuple(sorted(hunts)), resolving=hunts)
