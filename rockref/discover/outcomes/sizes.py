"""The sizes at which a candidate is run: a few for all, more about the best one where outcomes ask strongly for it."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from rockref.discover.outcomes.candidates import Candidate
from rockref.discover.outcomes.curves import FAR, Curves, Profile
from rockref.discover.outcomes.likelihood import Likelihood
from rockref.model.errors import InputError

#: Sizes at which a candidate is run [typical sizes]; decided: from what matters little to twice what is often found.
SIZES = (0.5, 1.0, 2.0)
#: The largest size that is tried [typical sizes]; decided: four deviations of the prior.
LARGEST = 4.0
#: Sizes that a local curve should go through; decided: two more than determine it, so that luck is averaged.
ENOUGH = 5
#: Times that sizes are added; decided: each halves the spacing, and six reach a sixteenth of what the first sizes have.
ROUNDS = 6


def profile(candidate: Candidate, null: Likelihood, fitted: np.ndarray, at: Callable[[float], Likelihood]) -> Profile:
    """Return a candidate at its sizes; left out is one at which no block stands or the step is too large.

    at : runs a size in the candidate's unit;  fitted : (n,) the tests that say where sizes are added
    """
    failed: set[float] = set()
    made = added(Profile(candidate, np.array([]), ()), starting(candidate), at, failed)
    for _ in range(ROUNDS):
        wanted = [z for z in further(Curves(null, (made,), fitted)) if z not in failed]
        if not wanted:
            break
        made = added(made, wanted, at, failed)
    return made


def starting(candidate: Candidate) -> tuple[float, ...]:
    """Return the sizes [typical sizes] at which a candidate is run first."""
    return (*(-s for s in SIZES if candidate.signed), *SIZES)


def further(curves: Curves) -> list[float]:
    """Return the sizes to add for the only candidate: none unless it is strong.

    Where the sizes that are near reach the last one, twice that is added. Else the spacing about the best size is
    halved until enough sizes are near.
    """
    if not curves.strong:
        return []
    z, _, level = tried = curves.tried(0)
    near, best = tried.near(), tried.best
    outer = [2.0 * z[i] for i in (0, len(z) - 1) if level[i] > level[best] - FAR and 0.0 < 2.0 * abs(z[i]) <= LARGEST]
    if outer:
        return outer
    if near.stop - near.start >= ENOUGH:
        return []
    return [0.5 * (z[best] + z[i]) for i in (best - 1, best + 1) if 0 <= i < len(z)]


def added(profile: Profile, sizes: Iterable[float], at: Callable[[float], Likelihood], failed: set[float]) -> Profile:
    """Return a profile with more sizes; `failed` takes those that cannot be run."""
    found = dict(zip(profile.z.tolist(), profile.at, strict=True))
    for z in sizes:
        try:
            found[z] = at(z * profile.candidate.typical)
        except InputError as e:
            if e.code not in ("E-STAND", "E-STEP"):
                raise
            failed.add(z)
    order = sorted(found)
    return Profile(profile.candidate, np.array(order), tuple(found[z] for z in order))
