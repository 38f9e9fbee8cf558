"""How predictable the block is: the growth of small differences from one main impact to the next."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.api import Model
from rockref.identify.candidates import OUTPUT_RATE, STEP, rates
from rockref.measure.signals.impacts import main_impacts
from rockref.model.errors import InputError
from rockref.model.rotation import exponential, product

#: Size of the differences put on the release [rad]. Decided: far above the rounding of 1e-16 that a run collects (some
#: 1e-13 at its end), far below what changes the order of two landings.
SIZE = 1e-9


@dataclass(frozen=True, eq=False)
class Growth:
    """impacts (K,) [s]; factors (N, K): difference of the rates shortly before an impact over that before the first,
    for N small differences; per_impact: the factor from one impact to the next, geometric mean over runs and impacts;
    spread: factor of one standard deviation of it over the runs."""

    impacts: np.ndarray
    factors: np.ndarray
    per_impact: float
    spread: float

    @property
    def digits_per_impact(self) -> float:
        """Return decimal digits that are lost from one main impact to the next."""
        return float(np.log10(self.per_impact))


def growth(
    model: Model, runs: int = 32, seed: int = 0, duration: float = 6.0, step: float = STEP, workers: int | None = None
) -> Growth:
    """Turn the block at release by 1e-9 rad about random axes and follow the difference of the rates.

    The difference is taken as the RMS over a tenth of the time to the next main impact, in the middle
    between two impacts, so that a shift of the impact itself is not counted.

    Raises InputError (E-IMPACTS) where the run ends before the second main impact.
    """
    rng = np.random.default_rng(seed)
    problem = model.problem(duration, step, OUTPUT_RATE)
    problems = [problem]
    for _ in range(runs):
        axis = rng.normal(size=3)
        turn = exponential(SIZE * axis / np.linalg.norm(axis))
        start = replace(problem.start, Lambda=product(problem.start.Lambda, turn))
        problems.append(problem.replace(start=start))
    crv = rates(problems, workers)
    t = np.arange(crv.shape[1]) / OUTPUT_RATE
    impacts = main_impacts(t, crv[0]).times
    check_impacts(impacts, duration)
    bounds = np.concatenate(([0.0], impacts))
    sizes = []
    for a, b in zip(bounds[:-1], bounds[1:], strict=True):
        middle = (t > a + 0.45 * (b - a)) & (t < a + 0.55 * (b - a))
        sizes.append(np.sqrt(np.mean(np.square(crv[1:, middle] - crv[0, middle]), axis=(1, 2))))
    factors = np.array(sizes).T / np.array(sizes).T[:, :1]
    # Only while the difference is small: beyond a thousandth of the motion it no longer grows.
    small = np.array(sizes).T < 1e-3 * float(np.sqrt(np.mean(np.square(crv[0]))))
    logs = np.log(factors)
    rate = np.array([slope(logs[i, small[i]]) for i in range(runs)])
    rate = rate[np.isfinite(rate)]
    return Growth(
        impacts, factors, float(np.exp(rate.mean())), float(np.exp(rate.std(ddof=1))) if len(rate) > 1 else 1.0
    )


def check_impacts(impacts: np.ndarray, duration: float) -> None:
    """Refuse a response of `duration` [s] whose main impacts (K,) [s] do not reach the second (E-IMPACTS)."""
    if len(impacts) < 2:
        what = f"reaches {len(impacts)} of two main impacts in {duration} s; a difference grows from one to the next"
        raise InputError("E-IMPACTS", "the model", what, "Give a duration that reaches the second main impact.")


def slope(y: np.ndarray) -> float:
    """Return slope of the straight line through y at 0, 1, 2, ..; NaN for fewer than two."""
    if len(y) < 2:
        return float("nan")
    k = np.arange(len(y)) - (len(y) - 1) / 2
    return float(k @ y / (k @ k))
