"""What runs could show: the least detectable amplitude of each effect, and effects that look alike in them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from rockref.discover.fit.problem import FitProblem
from rockref.discover.hypotheses.effects import own_value
from rockref.discover.hypotheses.parameter import Parameter

if TYPE_CHECKING:
    from rockref.discover.selection.score_test import ScoreTest
    from rockref.discover.verdict.calibration import Calibration

#: Typical sizes from which a limit says nothing (decided): a small step from zero does not show the effect, which a
#: search tries at finite sizes.
UNSEEN = 50.0


def detection(
    problem: FitProblem, test: ScoreTest, c: Calibration
) -> tuple[dict[str, dict[str, Any]], dict[str, dict[str, float]]]:
    """Return limits by number and cosines between effects, from the linearisation of a model and what it lacks.

    A limit is the amplitude from which the evidence for an effect, were it alone there, would be certain; none where
    no small step shows it.
    """
    base = len(problem.parameters())
    limits: dict[str, dict[str, Any]] = {}
    blocks, names = [], []
    order = np.concatenate([np.arange(test.own), *test.places.values()])
    S = eliminated(test.H[np.ix_(order, order)], test.own)
    at = 0
    for effect, places in test.places.items():
        numbers = problem.parameters((effect,))[base:]
        block = at + np.arange(len(places))
        at += len(places)
        sizes = [k for k, p in zip(block, numbers, strict=True) if p.typical > 0]
        if not sizes:
            continue
        blocks.append(np.array(sizes))
        names.append(effect)
        for k, p in zip(block, numbers, strict=True):
            if p.typical > 0 and p.run is None:
                found = limit(p, float(S[k, k]), c)
                limits |= {p.name: found} if found["in_typical_sizes"] < UNSEEN else {}
    table = np.round(cosines(S, blocks), 3).tolist()
    return limits, {a: dict(zip(names, row, strict=True)) for a, row in zip(names, table, strict=True)}


def eliminated(H: np.ndarray, own: int) -> np.ndarray:
    """Return the information about what follows the first `own` numbers once these are found along."""
    A, B, C = H[:own, :own], H[:own, own:], H[own:, own:]
    return C - B.T @ np.linalg.solve(A, B)


def limit(p: Parameter, information: float, c: Calibration) -> dict[str, Any]:
    """Return the amplitude from which a number is certain: its evidence outweighs Occam's factor and the prior odds."""
    data = max(information - 1.0, 1e-9) / c.temperature
    needed = np.log(1 / c.prior_odds) + np.log(c.certain / (1 - c.certain)) + 0.5 * np.log1p(data)
    z = float(np.sqrt(2 * needed / data))
    size = max(z / p.typical if p.typical else 0.0, c.least_amplitude)
    end = min(size * p.typical, 50.0)
    value = own_value(p, end) if p.centre == 0 or p.scale == "log" else abs(own_value(p, end) - p.centre)
    return {"value": float(value), "unit": p.unit, "in_typical_sizes": size}


def cosines(S: np.ndarray, blocks: Sequence[np.ndarray]) -> np.ndarray:
    """Return how alike effects are, (E, E) in 0 to 1: the mean canonical cosine over the numbers of the smaller effect.

    S (C, C): information about the numbers of all effects, everything else eliminated; blocks: whose number is whose.
    """
    size = np.sqrt(np.maximum(np.diag(S), 1e-300))
    S = S / np.outer(size, size)  # units of the numbers must not decide what counts as zero
    roots = []
    for b in blocks:
        value, vector = np.linalg.eigh(S[np.ix_(b, b)])
        if not value.max() > 0.0:  # it changes nothing here, and is like nothing
            roots.append(np.zeros_like(vector))
            continue
        value = np.maximum(value, 1e-9 * value.max())
        roots.append(vector / np.sqrt(value) @ vector.T)
    found = np.eye(len(blocks))
    for i, a in enumerate(blocks):
        for j in range(i):
            b = blocks[j]
            angle = np.linalg.svd(roots[i] @ S[np.ix_(a, b)] @ roots[j], compute_uv=False)
            found[i, j] = found[j, i] = float(np.clip(angle.mean(), 0.0, 1.0))
    return found
