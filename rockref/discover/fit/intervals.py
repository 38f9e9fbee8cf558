"""How sure a fit is of its numbers: 90 % intervals, statistical and systematic."""

from __future__ import annotations

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.common_factor import COMMON
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.hypotheses.candidates import SELDOM, SHAPES
from rockref.discover.hypotheses.counted import Parameter

#: Half width of a 90 % interval in standard deviations of a normal law.
NINETY = 1.645
#: Half widths, in typical sizes, of numbers that trade with what no window of 50 to 90 ms sees: a common size of the
#: block, a common height of the feet with the distance and the friction of the inner points, the height of the centre
#: of mass with the tilt. Decided on the blind cases that had them: the centre 0.45 to 0.58 mm off in height (four of
#: four), sides 0.2 to 0.8 % (two of two), heights of feet a tenth to one typical size (two of three), friction and
#: damping of the inner points 0.1 to 1.7. About 1.6 times their root mean square.
UNSEEN = {("mass_eccentricity", "z"): 0.8}
UNSEEN |= {("dimension_deviation", side): 1.5 for side in ("width", "depth", "height")}
UNSEEN |= {("foot_defects", key): 0.6 for key in (*(f"delta_long{i}" for i in (1, 2, 3, 4)), "mu_int", "beta_int")}


def half_widths(fit: Fit, point: Point, covariance: np.ndarray) -> np.ndarray:
    """Half widths of the 90 % intervals of all parameters, (G,), in z; covariance (G, G) of z.

    The numbers of effects have systematic parts beside the statistical one, which is widened as calibrated (`verdict`).
    """
    half = NINETY * rules.INTERVAL * np.sqrt(np.maximum(np.diag(covariance), 0.0))
    for k, p in enumerate(fit.parameters):
        # A vibration's frequency is counted over seconds: no parameter of the law shifts it.
        if "." in p.name and p.name != "base_vibration.frequency":
            part = 1 / p.spread if p.log else whole(fit, point, p, point.z[k])
            beside = rules.LEAKS * largest_beside(fit, point, p), rules.SYSTEMATIC * traded(fit, point, covariance, k)
            effect, key = p.name.split(".")
            unseen = common_factor(fit, p), UNSEEN.get((effect, key), 0.0)
            half[k] = np.linalg.norm([half[k], rules.SYSTEMATIC * part, *beside, *unseen])
    return half


def common_factor(fit: Fit, parameter: Parameter) -> float:
    """Half width, in z, of a foot's factor for the common one: that of the priors of the baseline's numbers.

    The covariance does not show it, since derivatives by differences make twins look different.
    """
    effect = parameter.name.split(".")[0]
    own = [q.spread * q.prior for q in fit.parameters if q.name in COMMON.get(effect, ())]
    if not own or not parameter.log:
        return 0.0
    return NINETY / float(np.sqrt(np.sum(1 / np.square(own)))) / parameter.spread


def whole(fit: Fit, point: Point, parameter: Parameter, z: float) -> float:
    """The size of the effect that a parameter belongs to, in typical sizes: its own, z, or what all of its unit have.

    All by their root mean square. A law that is a little wrong turns an eccentricity as well as it stretches it: what
    is small along one axis is not known better for it.
    """
    effect, key = parameter.name.split(".")
    if (effect, key) in SHAPES | SELDOM:
        return abs(z)
    like = [
        zi
        for p, zi in zip(fit.parameters, point.z, strict=True)
        if p.name.startswith(effect + ".") and (p.unit, p.run, p.log) == (parameter.unit, parameter.run, False)
        and tuple(p.name.split(".")) not in SHAPES | SELDOM
    ]  # fmt: skip
    return max(abs(z), float(np.sqrt(np.mean(np.square(like)))))


def largest_beside(fit: Fit, point: Point, parameter: Parameter) -> float:
    """For what is typically none the largest number of the same effect and unit, as a z of `parameter`; else 0."""
    effect, key = parameter.name.split(".")
    if (effect, key) not in SELDOM:
        return 0.0
    return max(
        abs(z) * p.spread / parameter.spread
        for p, z in zip(fit.parameters, point.z, strict=True)
        if p.name.startswith(effect + ".") and p.unit == parameter.unit
    )


def traded(fit: Fit, point: Point, covariance: np.ndarray, k: int) -> float:
    """How far parameter k, if it is typically none, follows a number of its effect in another unit that is all wrong.

    A force of drag follows its moment: the runs know their sum best. In z of parameter k; 0 for all others.
    """
    own = fit.parameters[k]
    effect, key = own.name.split(".")
    if (effect, key) not in SELDOM:
        return 0.0
    return max(
        (
            abs(covariance[k, j] / covariance[j, j] * point.z[j])
            for j, p in enumerate(fit.parameters)
            if p.name.startswith(effect + ".") and p.unit != own.unit
        ),
        default=0.0,
    )
