"""Candidates for runs that the baseline is far from: begun at a size, and fitted from the nominal parameters."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from rockref.discover.approach import approached_beside
from rockref.discover.families import Family, mean_loss
from rockref.discover.fit import Fit
from rockref.discover.search import FIRST_STAGE, FRESH, SHORT, Setup, Trial, baseline, early, nominal, windows

#: Candidates of the screen, and of the first looks, that are fitted to the short windows, with so many iterations; and
#: how many are then fitted in full.
LOOKED_AT, LOOKS, FITTED = 4, 3, 3
#: Share of the way from the best loss to the middle one within which a candidate is fitted in full (decided: in the
#: runs of a spinning foot, of 28 candidates only the right one was there).
AHEAD = 0.4


def from_far(setup: Setup, trials: list[Trial], kept: Family, say: Callable[[str], None]) -> list[Family]:
    """The candidates of a screen (best first) fitted anew from nominal parameters; those that come nearest, in full.

    Where most windows are out of step, a small step along an effect changes little, and the parameters of the family
    `kept` have bent so far that an effect added to them cannot unbend them.
    """
    n = len(kept.point.z)
    begun = {f.effects: f for f in sorted(first_looks(setup, trials, kept), key=lambda f: f.point.objective)}
    chosen = dict.fromkeys([*(t.effects for t in trials[:LOOKED_AT]), *list(begun)[:LOOKED_AT]])
    looked = []
    for effects in chosen:
        z = np.concatenate([nominal(kept.fit.parameters, kept.point.z), begun[effects].point.z[n:]])
        looked.append(Family(effects, *early(setup, effects, z, LOOKS)))
        say(f"  from far: {effects[-1]} {mean_loss(looked[-1]):.2f}")
    looked.sort(key=mean_loss)
    best, middle = mean_loss(looked[0]), mean_loss(looked[len(looked) // 2])
    ahead = [f for f in looked if mean_loss(f) <= best + AHEAD * (middle - best)][:FITTED]
    rest = (FRESH[0] - LOOKS, FRESH[1])
    return [Family(f.effects, *baseline(setup, f.effects, f.point.z, iterations=rest)) for f in ahead]


def first_looks(setup: Setup, trials: list[Trial], kept: Family) -> list[Family]:
    """Each candidate beside the family `kept` on the short windows: moved along its own parameters, nothing fitted."""
    short = windows(replace(setup, end=min(setup.end, FIRST_STAGE)), SHORT, kept.fit.models(kept.point.z)[0][0])
    found = []
    for trial in trials:
        fit = Fit(short, setup.base, setup.parameters(trial.effects), log=setup.log)
        n = len(kept.point.z)
        z = np.concatenate([kept.point.z, np.zeros(len(fit.parameters) - n)])
        found.append(Family(trial.effects, fit, approached_beside(fit, z, n)))
    return found
