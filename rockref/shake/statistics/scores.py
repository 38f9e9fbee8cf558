"""Scores of predicted probabilities against outcomes, and what they can reach at best."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.bands import wilson_interval
from rockref.shake.statistics.outcomes import finite, motions, outcomes

#: decided: a prediction is never believed beyond one in a million; one wrong certainty costs 13.8 nat, not infinity.
CLIP = 1e-6


def log_losses(probability: Any, fell: Any, clip: float = CLIP) -> np.ndarray:
    """Return -[y ln p + (1 - y) ln(1 - p)] of each test (n,) [nat], p clipped to clip ... 1 - clip.

    Raises InputError E-SHAPE, E-RANGE.
    """
    p, y = _pair(probability, fell)
    p = np.clip(p, clip, 1.0 - clip)
    return -(y * np.log(p) + (1.0 - y) * np.log1p(-p))


def brier_scores(probability: Any, fell: Any) -> np.ndarray:
    """Return (p - y)^2 of each test (n,). Raises InputError E-SHAPE, E-RANGE."""
    p, y = _pair(probability, fell)
    return (p - y) ** 2


def hits(probability: Any, fell: Any) -> np.ndarray:
    """Return 1 for each test (n,) whose outcome is the more probable one, one half at p = 0.5, else 0."""
    p, y = _pair(probability, fell)
    return np.where(p == 0.5, 0.5, ((p > 0.5) == (y == 1.0)).astype(float))


def _pair(probability: Any, fell: Any) -> tuple[np.ndarray, np.ndarray]:
    p, y = finite(probability, "probability"), outcomes(fell)
    if len(p) != len(y):
        raise InputError("E-SHAPE", "probability", f"has {len(p)} values", f"Give {len(y)}, one for each outcome.")
    if p.min() < 0.0 or p.max() > 1.0:
        raise InputError("E-RANGE", "probability", f"reaches {p.min():g} and {p.max():g}", "Give numbers from 0 to 1.")
    return p, y


@dataclass(frozen=True)
class ReliabilityBin:
    """Tests of one range of predicted probability: mean prediction, share that fell, its Wilson interval, number."""

    predicted: float
    observed: float
    low: float
    high: float
    n: int


def reliability(probability: Any, fell: Any, bins: int = 10) -> list[ReliabilityBin]:
    """Return predicted beside observed shares in ranges of equal width that hold a test."""
    p, y = _pair(probability, fell)
    place = np.minimum((p * bins).astype(int), bins - 1)
    found = []
    for k in np.unique(place):
        inside = place == k
        n, fallen = int(inside.sum()), int(y[inside].sum())
        found.append(ReliabilityBin(float(p[inside].mean()), fallen / n, *wilson_interval(fallen, n), n))
    return found


@dataclass(frozen=True)
class Repeats:
    """How many pairs of tests repeat each other, how many of them have the same outcome, and what that allows.

    best_accuracy is the most that a prediction can expect on such pairs; low and high: the same from the Wilson
    interval of the share, which takes pairs as independent.
    """

    pairs: int
    agree: int
    best_accuracy: float
    low: float
    high: float

    def floors(self) -> dict[str, float]:
        """Return what Brier score and log loss [nat] no prediction of such tests expects to fall below.

        Pairs differ with 2 p (1 - p) = 1 - c. The Brier score of p itself is p (1 - p), and its log loss is at least
        4 ln 2 times that, whatever p is; both are linear in p (1 - p), so they hold for any mixture of tests.
        """
        half = 0.5 * (1.0 - self.agree / self.pairs)
        return {"least_brier": half, "least_log_loss": 4.0 * math.log(2.0) * half}


def repeats(motion: Any, size: Any, fell: Any, width: float = 0.05) -> Repeats:
    """Return the ceiling that repeats set: pairs of one motion whose sizes differ by less than a share `width`.

    Raises InputError E-SHAPE, E-RANGE; E-REPEATS where no test repeats another.
    """
    y, x = outcomes(fell), finite(size, "size of the motion")
    group, _ = motions(motion, len(y))
    pairs = [
        (i, j)
        for k in np.unique(group)
        for i, j in combinations(np.flatnonzero(group == k), 2)
        if abs(x[i] - x[j]) < width * max(x[i], x[j])
    ]
    if not pairs:
        raise InputError("E-REPEATS", "motion", "no two tests repeat each other", "Widen width, or repeat some tests.")
    agree = sum(bool(y[i] == y[j]) for i, j in pairs)
    low, high = wilson_interval(agree, len(pairs))
    return Repeats(len(pairs), agree, *(best_accuracy(share) for share in (agree / len(pairs), low, high)))


def best_accuracy(agreement: float) -> float:
    """Return the largest expected accuracy where repeats agree with this probability.

    A test that falls with probability p agrees with its repeat with p^2 + (1 - p)^2 = c and is predicted rightly with
    max(p, 1 - p) = (1 + sqrt(2 c - 1))/2 at most. That is concave in c, so a mixture of tests does no better than the
    same number with their mean c. Below c = 1/2, which no mixture has, it stays 1/2.

    >>> from rockref.shake.statistics.scores import best_accuracy
    >>> round(best_accuracy(0.82), 3)
    0.9
    """
    return 0.5 * (1.0 + math.sqrt(max(0.0, 2.0 * agreement - 1.0)))
