"""Expected rows of a run, and their bars.

Values: `exact` in longdouble. Bars: 8 times the largest deviation, so far in the run, of the float64 law, of 16 runs with all inputs
moved by an ulp and the points in random order, and of 8 runs under random rounding; plus an ulp.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.conformance import exact_run, pieces
from rockref.conformance.maker.answers import body_of, start_of
from rockref.conformance.maker.arithmetic import LongDoubles, converted
from rockref.conformance.maker.bars import FACTOR, ULP_RUNS, moved, ulp
from rockref.conformance.maker.noise import noisy_rules
from rockref.conformance.maker.scenes import PER_POINT
from rockref.conformance.vectors import problem_of
from rockref.engines import run
from rockref.model.problem import Problem, stack
from rockref.model.simulate import output_steps

ROUNDING_RUNS, SINGLE_RUNS = 8, 12
SHOWN = ("W", "x", "Lambda")
#: Comparison ends where the bar exceeds this share of the signal. float64: the issue's 1e-6. float32 and scheme: decided; a tenth of the
#: signal still tells a wrong rule from a right one.
HORIZON = {"": 1e-6, "float32_": 0.1, "scheme_": 0.1}


@dataclass
class Rows:
    """t (N,) [s]; W, x (N, 3), Lambda (N, 3, 3), in any precision."""

    t: np.ndarray
    W: np.ndarray
    x: np.ndarray
    Lambda: np.ndarray


def exactly(q: dict[str, Any]) -> Rows:
    """The rows by `exact` in longdouble."""
    m = LongDoubles
    numbers = {k: converted(v, m.number) for k, v in q.items() if k not in ("step", "duration", "output_rate", "names")}
    wanted = [int(i) for i in output_steps(problem_of(q))]
    h = m.number(q["step"])
    moments = list(exact_run.run(body_of(numbers), start_of(numbers), h, wanted, m))
    columns = {k: np.array([getattr(moment, k) for moment in moments], np.longdouble) for k in SHOWN}
    return Rows(q.get("t", 0.0) + np.array(wanted) * q["step"], **columns)


def rearranged(q: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """All inputs moved by an ulp, the points in random order."""
    order = list(range(len(q["P"])))
    rng.shuffle(order)
    keys = set(PER_POINT) | {"s", "anchored", "sliding"}
    return {k: v[order] if k in keys else v for k, v in allowed(moved(q, rng)).items()}


def allowed(q: dict[str, Any]) -> dict[str, Any]:
    """The inputs with mu_0 at least mu, where moving them has turned that round."""
    return q | {"mu_0": np.maximum(q["mu_0"], q["mu"])}


def members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float64 runs: the law, moved and rearranged ones, and (as one batch) those under random rounding."""
    rng = random.Random(seed)
    problems = [problem_of(q)] + [problem_of(rearranged(q, rng)) for _ in range(ULP_RUNS)]
    found: list[Any] = [run(p, engine="auto") for p in problems]
    batch = pieces.simulate(noisy_rules(seed), stack([problem_of(q)] * ROUNDING_RUNS))
    return found + [batch.pick(i) for i in range(ROUNDING_RUNS)]


def single_members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float32 runs: inputs moved by a single-precision ulp before they are rounded."""
    rng = random.Random(seed)

    def rough(a: Any) -> Any:
        if isinstance(a, np.ndarray) and a.dtype == np.float64:
            shift = np.array([rng.uniform(-1, 1) for _ in range(a.size)]).reshape(a.shape)
            return a * (1 + 2.0**-23 * shift)
        return a

    problems = [problem_of(q)] + [problem_of(allowed({k: rough(v) for k, v in q.items()})) for _ in range(SINGLE_RUNS - 1)]
    batch = pieces.simulate(pieces.law(), stack(problems), np.float32)
    return [batch.pick(i) for i in range(SINGLE_RUNS)]


def deviation(found: list[Any], truth: Rows, key: str) -> np.ndarray:
    """Largest deviation so far of W, x or Lambda, over the members and the components, (N,)."""
    right = getattr(truth, key)
    with np.errstate(all="ignore"):
        apart = [np.abs(np.asarray(getattr(m, key), np.longdouble) - right).reshape(len(right), -1) for m in found]
    largest = np.max([a.max(axis=1) for a in apart], axis=0).astype(float)
    return np.maximum.accumulate(np.where(np.isfinite(largest), largest, np.inf))


def bars(found: list[Any], truth: Rows, factor: float = FACTOR, dtype: Any = np.float64) -> dict[str, np.ndarray]:
    """bar_W, bar_x, bar_Lambda of every row."""
    size = {k: np.abs(getattr(truth, k)).reshape(len(truth.t), -1).max(axis=1).astype(float) for k in SHOWN}
    return {k: factor * deviation(found, truth, k) + ulp(size[k], dtype) for k in SHOWN}


def horizon(width: dict[str, np.ndarray], truth: Rows, share: float) -> float:
    """The last instant [s] at which no bar exceeds `share` of its signal (largest rate, way, and 1 for Lambda)."""
    signal = {
        "W": float(np.max(np.abs(truth.W))),
        "x": float(np.max(np.abs(truth.x - truth.x[0]))),
        "Lambda": 1.0,
    }
    good = np.ones(len(truth.t), bool)
    for key, bar in width.items():
        if signal[key] > 0:
            good &= bar <= share * signal[key]
    last = int(np.argmin(good)) - 1 if not good.all() else len(good) - 1
    return float(truth.t[max(last, 0)])


def impacts(t: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Instants at which the block passes upright, linear between rows; crossings of less than 0.01 rad do not count."""
    tilt = np.arctan2(np.asarray(Lambda[:, 2, 1], float), np.asarray(Lambda[:, 2, 2], float))
    found, last = [], 0
    for i in np.flatnonzero(np.signbit(tilt[1:]) != np.signbit(tilt[:-1])):
        if np.max(np.abs(tilt[last : i + 1])) > 0.01:
            share = tilt[i] / (tilt[i] - tilt[i + 1])
            found.append(t[i] + share * (t[i + 1] - t[i]))
            last = i + 1
    return np.array(found)


def impact_bars(found: list[Any], truth: Rows, end: float, factor: float = FACTOR) -> list[dict[str, float]]:
    """Main impacts up to `end` [s] with their bars [s]; the linear interpolation belongs to their definition."""
    right = [i for i in impacts(truth.t, truth.Lambda) if i <= end]
    others = [impacts(m.t, m.Lambda) for m in found]
    result = []
    for k, instant in enumerate(right):
        apart = [abs(o[k] - instant) if len(o) > k else np.inf for o in others]
        result.append({"t_s": float(instant), "bar_s": float(factor * max(apart) + np.spacing(instant))})
    return result


def converged(problem: Problem, step: float) -> Any:
    """The law's scheme with a step so small that it does not matter, rows as in the problem."""
    return run(replace(problem, step=step), engine="auto")
