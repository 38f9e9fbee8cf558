"""The whole empirical sensitivity analysis of one model: time step, last digits, release angle, digits, growth."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.identify.search import versions
from rockref.studies.predictability import Growth, check_impacts, growth
from rockref.studies.sensitivity import (
    RELEASE_ERROR,
    SHARES,
    STEPS,
    Digits,
    Family,
    last_digits,
    release_angle,
    significant_digits,
    time_steps,
    varied,
)

SCHEMA = "rockref-sensitivity-1"
AXES = ("main", "transverse", "longitudinal")


@dataclass(frozen=True, eq=False)
class Study:
    """The families of Figures 3.5 to 3.7, the digits of Table 3.1 by their definition, the growth of differences."""

    seed: int
    steps: Family
    last_digits: Family
    angles: Family
    digits: tuple[Digits, ...]
    growth: Growth

    def families(self) -> dict[str, Family]:
        """Return the families by name."""
        return {"time_step": self.steps, "last_digits": self.last_digits, "release_angle": self.angles}


def study(
    model: Model,
    seed: int = 0,
    duration: float = 6.0,
    steps: Sequence[float] = STEPS,
    trials: int = 10,
    workers: int | None = None,
    report: Callable[[str], None] | None = None,
) -> Study:
    """Run everything.

    model : released from theta_0 [rad];  seed : of the signs and of the small differences;  duration [s];
    steps [s] : of Fig. 3.5;  trials : chromosomes of Fig. 3.6 (the source shows two);  report : called with each name.

    Raises InputError (E-MOOT; E-IMPACTS, where the second main impact is not reached; E-STEP, ...) as the simulation.
    """
    say = report or (lambda name: None)
    varied(model)
    say("time step")
    by_step = time_steps(model, steps, duration, workers)
    check_impacts(by_step.impacts[0], duration)
    say("last digits")
    by_digit = last_digits(model, seed, trials, duration, workers=workers)
    say("release angle")
    by_angle = release_angle(model, RELEASE_ERROR, duration, workers=workers)
    say("significant digits")
    table = tuple(significant_digits(model, workers=workers, duration=duration))
    say("growth of small differences")
    return Study(seed, by_step, by_digit, by_angle, table, growth(model, seed=seed, duration=duration, workers=workers))


def record(study: Study) -> dict[str, Any]:
    """Return what the study found, for JSON.

    Null: a horizon that was not reached within the run; a change that is infinite, where nothing moved before.
    """
    return {
        "schema": SCHEMA,
        "seed": study.seed,
        "versions": versions(),
        "families": {name: _family(f) for name, f in study.families().items()},
        "significant_digits": [{k: None if v == np.inf else v for k, v in asdict(d).items()} for d in study.digits],
        "growth": {
            "factor_per_impact": study.growth.per_impact,
            "spread_factor": study.growth.spread,
            "digits_per_impact": study.growth.digits_per_impact,
            "runs": len(study.growth.factors),
            "impacts_s": study.growth.impacts.tolist(),
            "median_factor_before_impact": np.median(study.growth.factors, axis=0).tolist(),
        },
    }


def _family(f: Family) -> dict[str, Any]:
    horizons = {
        f"agree_to_{share:g}_until_s": {
            axis: float(h) if np.isfinite(h) else None for axis, h in zip(AXES, row, strict=True)
        }
        for share, row in zip(SHARES, f.horizons, strict=True)
    }
    return {
        "labels": list(f.labels),
        "duration_s": float(f.t[-1]),
        **horizons,
        "impacts_s": {label: i.tolist() for label, i in zip(f.labels, f.impacts, strict=True)},
    }
