"""Candidates for runs that the baseline is far from: begun at a size and from the nominal parameters."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rockref.discover.candidates import SHAPES
from rockref.discover.families import Family, afresh, mean_loss
from rockref.discover.fit import Parameter
from rockref.discover.search import Setup, Trial, early

#: Size, in typical ones, at which a candidate begins.
BEGUN_AT = 0.7
#: Compliances of a plate that are begun at, in that of the typical frequency: 120, 80, 60 and 40 Hz. A plate that
#: rings at another frequency is no small step away.
RINGING = (0.25, 0.56, 1.0, 2.25)
#: Iterations on the short windows after which the field is narrowed, and how many are then fitted in full.
LOOKS, FITTED = 2, 3
#: Share of the way from the best loss to the middle one within which a candidate is fitted in full (decided: in the
#: runs of a spinning foot, of 28 candidates only the right one was there).
AHEAD = 0.4


def from_far(setup: Setup, trials: list[Trial], kept: Family, say: Callable[[str], None]) -> list[Family]:
    """The candidates of a screen fitted anew from nominal parameters; the few that come nearest, in full.

    Where most windows are out of step, a small step along an effect changes little, and the parameters of the family
    `kept` have bent so far that an effect added to them cannot unbend them.
    """
    n = len(kept.fit.parameters)
    nominal = np.array([zi if "." in p.name else 0.0 for p, zi in zip(kept.fit.parameters, kept.point.z, strict=True)])
    begun = []
    for trial in trials:
        for own in sizes(trial, n):
            fit, point = early(setup, trial.effects, np.concatenate([nominal, own]), LOOKS)
            begun.append(Family(trial.effects, fit, point))
            say(f"  from far: {trial.effects[-1]} {mean_loss(begun[-1]):.2f}")
    begun.sort(key=mean_loss)
    best, middle = mean_loss(begun[0]), mean_loss(begun[len(begun) // 2])
    chosen: dict[tuple[str, ...], Family] = {}
    for family in begun:
        if len(chosen) < FITTED and mean_loss(family) <= best + AHEAD * (middle - best):
            chosen.setdefault(family.effects, family)
    return [afresh(setup, family) for family in chosen.values()]


def sizes(trial: Trial, n: int) -> list[np.ndarray]:
    """Where a trial's last effect begins, the parameters after the first n: along its first step, at a size."""
    parameters = trial.fit.parameters[n:]
    shapes = np.array([tuple(p.name.split(".")) in SHAPES for p in parameters])
    if trial.effects[-1] == "compliant_support":
        return [np.where(shapes, 0.0, z) for z in RINGING]
    step = trial.point.z[n:] if len(trial.point.z) > n else np.ones(len(parameters))
    step = np.where(shapes, 0.0, step)
    if np.abs(step).max() < 1e-2:
        step = np.where(shapes, 0.0, 1.0)
    one_sided = np.array([on_its_bound(p) for p in parameters])
    step = np.where(one_sided, np.abs(step), step)
    return [BEGUN_AT * step / np.abs(step).max()]


def on_its_bound(p: Parameter) -> bool:
    """Whether an effect's absence is the least value that its parameter takes."""
    return not p.log and p.value(0.0) <= p.low
