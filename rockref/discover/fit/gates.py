"""What must hold before a fit is believed: another start, the step, bounds, run against run."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.information import Information, covariance, eliminated, own_parameters
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.hypotheses.candidates import FORMS
from rockref.discover.hypotheses.counted import Parameter

#: Two fits agree while they differ by less than this many widened standard deviations in every shared parameter
#: (decided: two draws from the same law differ by more than three widths once in thirty numbers at root two a width).
AGREE = 3.0
#: Spread of the other start, in priors; decided: half of what is expected, so that it begins in the same valley region.
OTHER_START = 0.5
#: What one more Gauss-Newton step promises, in units of the log-likelihood per shared parameter; decided: a parameter
#: that could still move by two standard deviations promises two.
PROMISED = 2.0
#: Change of the residual at half the step, in noise widths: median and ninth decile over the windows. From the study
#: behind the method: a tenth in free motion, half where corners strike.
STEP_MEDIAN, STEP_DECILE = 0.1, 0.5
#: Priors from the centre beyond which a number counts as at its bound.
BOUND = 3.0
#: Disagreement of a run with all others, per shared parameter, in widened variances; decided: its expectation is 1 at
#: most, and its scatter over eleven numbers 0.4.
CONTRADICT = 3.0


@dataclass(frozen=True)
class Gate:
    """One check: `name` (stable), whether it `passed`, the `value` found, the `limit`, and a sentence."""

    name: str
    passed: bool
    value: float
    limit: float
    sentence: str

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        return {
            "name": self.name, "passed": bool(self.passed), "value": round(float(self.value), 4), "limit": self.limit,
            "sentence": self.sentence,
        }  # fmt: skip


def gates(fit: Fit, point: Point, found: Information, other: Point) -> list[Gate]:
    """All gates of a fit; `found` is its information, `other` where the same fit ends that began elsewhere."""
    return [
        starts_agree(fit, point, other, found),
        gradient_small(fit, point, found),
        step_small(fit, point),
        off_bounds(fit, point),
        runs_agree(fit, point, found),
    ]


def other_start(parameters: tuple[Parameter, ...], z: np.ndarray, seed: int) -> np.ndarray:
    """Another place to begin, z (G,): shared parameters drawn about their priors, effects by a tenth, tilts at rest.

    An effect on the wrong side of its absence would not be the same model.
    """
    rng = np.random.default_rng(seed)
    draw = rng.normal(size=len(z))
    prior = np.array([p.prior for p in parameters])
    of_effects = np.array(["." in p.name for p in parameters])
    drawn = np.where(of_effects, z * (1 + 0.1 * draw), OTHER_START * prior * draw)
    return np.where(own_parameters(parameters), z, drawn)


def starts_agree(fit: Fit, point: Point, other: Point, found: Information) -> Gate:
    """Whether two starts end in the same place, in widened standard deviations of the shared parameters."""
    shared = ~own_parameters(fit.parameters)
    width = rules.INTERVAL * np.sqrt(np.diag(covariance(fit, found)))[shared]
    off = np.abs(point.z - other.z)[shared] / width
    worst = int(np.argmax(off))
    name = [p.name for p, s in zip(fit.parameters, shared, strict=True) if s][worst]
    words = f"Another start ends {off[worst]:.1f} widths away in {name}; objectives {point.objective:.0f} and "
    words += f"{other.objective:.0f}."
    return Gate("starts_agree", bool(off[worst] < AGREE), float(off[worst]), AGREE, words)


def gradient_small(fit: Fit, point: Point, found: Information) -> Gate:
    """Whether one more step promises little."""
    H = found.total + np.diag(1 / fit.prior**2)
    g = found.g.sum(axis=0) + point.z / fit.prior**2
    promised = float(g @ np.linalg.solve(H, g) / 2) / max(int((~own_parameters(fit.parameters)).sum()), 1)
    words = f"One more step promises {promised:.2f} units of the log-likelihood per shared parameter."
    return Gate("gradient_small", promised < PROMISED, promised, PROMISED, words)


def step_small(fit: Fit, point: Point) -> Gate:
    """Whether half the step gives the same residuals."""
    series = copy.copy(fit.series)
    series.refine = 2 * fit.series.refine
    models, tilt = fit.models(point.z)
    fine = series.residual(models, tilt, point.corrections)
    change = np.sqrt(np.sum((fine - fit.residual(point.z, point.corrections)) ** 2, axis=(1, 2)) / fit.series.count)
    median, decile = float(np.median(change)), float(np.quantile(change, 0.9))
    words = f"Half the step changes the residual by {median:.3f} noise widths (median), {decile:.3f} (ninth decile)."
    return Gate("step_small", median < STEP_MEDIAN and decile < STEP_DECILE, decile, STEP_DECILE, words)


def off_bounds(fit: Fit, point: Point) -> Gate:
    """Whether every parameter is inside its prior; a share between two forms of a law has a price, and no prior."""
    form = np.array([tuple(p.name.split(".")) in FORMS for p in fit.parameters])
    off = np.where(form, 0.0, np.abs(point.z) / fit.prior)
    worst = int(np.argmax(off))
    words = f"{fit.parameters[worst].name} is farthest from the centre of its prior: {off[worst]:.1f} deviations."
    return Gate("off_bounds", bool(off[worst] < BOUND), float(off[worst]), BOUND, words)


def runs_agree(fit: Fit, point: Point, found: Information) -> Gate:
    """Whether each run alone would move the shared parameters no farther than its own uncertainty."""
    shared = ~own_parameters(fit.parameters)
    off = []
    for i in range(fit.runs):
        out = own_parameters(fit.parameters, i)
        others = own_parameters(fit.parameters) & ~out
        keep = ~others
        H, g = found.H[i][np.ix_(keep, keep)], (found.g[i] + np.where(out, point.z / fit.prior**2, 0.0))[keep]
        H, g = eliminated(H, g, out[keep], fit.prior[keep])
        H = H + np.diag(1 / fit.prior[shared] ** 2)
        off.append(float(g @ np.linalg.solve(H, g)) / (rules.INTERVAL**2 * shared.sum()))
    worst = int(np.argmax(off))
    words = f"Run {fit.series.runs[worst].id} disagrees most with the others: {off[worst]:.2f} variances per parameter."
    return Gate("runs_agree", off[worst] < CONTRADICT, off[worst], CONTRADICT, words)
