"""What a fitted model of tosses must show: the fall of the error, the floor of the starts, the gate of the step."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.tosses import descent
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.fit import TossFit, drawn_starts
from rockref.discover.tosses.predict import STEPS_A_FRAME, predict, simulated
from rockref.measure.tosses.flight import Poses, displaced

#: Resamples of the paired bootstrap, and the share of its interval, of all comparisons together.
RESAMPLES, INTERVAL = 10000, 0.90


def total(e: Errors) -> float:
    """Return position [%] plus rotation [deg], mean over the tosses."""
    return float(np.mean(100 * e.position + e.rotation))


def paired(before: Errors, after: Errors, comparisons: int = 1) -> dict[str, Any]:
    """Return by how much the error falls on the same tosses: position [%] plus rotation [deg], with its interval.

    The interval is the bootstrap's. Of several comparisons each has a wider one, so that all of them hold together with
    INTERVAL (O. J. Dunn 1961, J. Am. Stat. Assoc. 56:52-64, doi:10.1080/01621459.1961.10482090).
    """
    share = 1 - (1 - INTERVAL) / max(comparisons, 1)
    fall = (100 * before.position + before.rotation) - (100 * after.position + after.rotation)
    rng = np.random.default_rng(11)
    means = fall[rng.integers(len(fall), size=(RESAMPLES, len(fall)))].mean(axis=1)
    low, high = np.quantile(means, ((1 - share) / 2, (1 + share) / 2))
    return {
        "mean": round(float(fall.mean()), 3), "low": round(float(low), 3), "high": round(float(high), 3),
        "better_percent": round(100 * float(np.mean(fall > 0)), 1), "interval": round(share, 4),
    }  # fmt: skip


def floor_of(model: Model, poses: Poses, width: float, draws: int = 4) -> dict[str, float]:
    """Return error that a true model would have: predictions from drawn starts against that from the start itself."""
    first = predict(model, poses)
    as_measured = poses._replace(x=first.x, Lambda=np.nan_to_num(first.Lambda))
    rng = np.random.default_rng(5)
    found = []
    for _ in range(draws):
        x, Lambda = simulated(model, displaced(first.starts, drawn_starts(first, rng)), poses, STEPS_A_FRAME, "auto")
        x, Lambda = first.frames.to_tracked(x, Lambda)
        found.append(errors(replace(first, x=x, Lambda=Lambda), as_measured, width))
    return {
        "position_percent": round(100 * float(np.mean([e.position for e in found])), 2),
        "rotation_deg": round(float(np.mean([e.rotation for e in found])), 2),
        "position_percent_median": round(100 * float(np.median([e.position for e in found])), 2),
        "rotation_deg_median": round(float(np.median([e.rotation for e in found])), 2),
    }


def step_small(model: Model, poses: Poses, width: float) -> dict[str, Any]:
    """Return the gate: whether twice as many steps change the held-out errors."""
    usual = errors(predict(model, poses), poses, width)
    fine = errors(predict(model, poses, steps=2 * STEPS_A_FRAME), poses, width)
    # Decided: below one, percent and degrees together, the start's uncertainty is all that an error tells.
    change = abs(total(fine) - total(usual)) / max(total(usual), 1.0)
    # Limit, decided: a fiftieth of the error is below every bootstrap interval of the staircase.
    return {"name": "step_small", "passed": bool(change < 0.02), "value": round(float(change), 5), "limit": 0.02}


def off_bounds(fit: TossFit, z: np.ndarray) -> dict[str, Any]:
    """Return gate: whether every number ended inside what its prior and its quantity allow; value: how many did not.

    A number that ends where its effect is absent is no bound that was reached.
    """
    low, high = descent.limits(fit.parameters)
    stuck = ((z <= low) | (z >= high)) & (z != 0)
    names = [p.name for p, s in zip(fit.parameters, stuck, strict=True) if s]
    return {"name": "off_bounds", "passed": not names, "value": float(len(names)), "limit": 0.0, "at_bounds": names}


def uses_agree(fitted: Errors, held: Errors) -> dict[str, Any]:
    """Return gate: whether held-out tosses are predicted as well as those of the fit, in standard errors of the means.

    A fit with more numbers than its tosses bear would be better on its own tosses alone.
    """
    a, b = (100 * e.position + e.rotation for e in (fitted, held))
    error = float(np.sqrt(np.var(a) / len(a) + np.var(b) / len(b)))
    # Limit, decided: one in seven hundred by luck; a toss that ends on another face makes the tails heavy.
    apart = float(np.mean(b) - np.mean(a)) / max(error, 1e-12)
    return {"name": "uses_agree", "passed": bool(apart < 3.0), "value": round(apart, 3), "limit": 3.0}
