"""What the factors of all four feet have in common is the baseline's: no run tells it, so the priors do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.hypotheses.counted import Parameter

#: What one factor of all four feet is, looked at from the other side: numbers of the baseline, which no run tells from
#: it. Decided on ten blind cases, whose factors were right but for a common one of up to 1.34.
COMMON = {
    "uneven_foot_stiffness": ("K_N",),
    "uneven_foot_damping": ("beta_int", "beta_ext"),
    "uneven_foot_friction": ("mu_int", "mu_ext"),
}
#: Effects whose common factor these make up for exactly. Not stiffness: the dampers follow K_N (3.8) and not a foot's
#: share of it, so runs tell a little (decided: with the root of it given to the damping ratios, a practice experiment
#: ended 35 units higher, and its factors 17 % too small together, where they had been 4 %).
EXACTLY = ("uneven_foot_damping", "uneven_foot_friction")


def directions(parameters: Sequence[Parameter]) -> list[np.ndarray]:
    """Changes of z, each (G,), that divide the factors of the feet by e and multiply what makes up for it by e."""
    known = {p.name for p in parameters}
    effects = [e for e in EXACTLY if f"{e}.foot1" in known and known & set(COMMON[e])]
    return [direction(parameters, e) for e in effects]


def direction(parameters: Sequence[Parameter], effect: str) -> np.ndarray:
    """The change of z, (G,), for the factors of one effect."""
    power = dict.fromkeys(COMMON[effect], 1.0) | dict.fromkeys((f"{effect}.foot{i}" for i in (1, 2, 3, 4)), -1.0)
    return np.array([power.get(p.name, 0.0) / p.spread for p in parameters])


def shared_out(fit: Fit, point: Point) -> Point:
    """The point with what all feet have in common shared out between them and the baseline as the priors have it.

    A damped step hardly moves along what the windows do not see: factors of friction stayed 1.66 times too large, all
    four, with the baseline's friction four prior deviations below its centre, though nothing but the priors tells them
    apart. Kept where the whole is lower.
    """
    for way in directions(fit.parameters):
        stiff = way / fit.prior**2
        trial, _ = fit.point(point.z - float(stiff @ point.z) / float(stiff @ way) * way, point.corrections)
        point = trial if trial.objective < point.objective else point
    return point
