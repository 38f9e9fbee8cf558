"""Expected rows of a run, and their bars.

Values: longdouble. Bars: 8 times the largest deviation, so far in the run, of the float64 law, of 16 runs with all
inputs moved by an ulp and the points in random order, of 5 other ways to write the law (`ways.py`), and of 8 runs under
random rounding; plus an ulp.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from golden.generator.bounds import programs, ways
from golden.generator.bounds.answers import body_of, start_of
from golden.generator.bounds.arithmetic import LongDoubles, converted
from golden.generator.bounds.bars import FACTOR, ULP_RUNS, moved, ulp
from golden.generator.questions.scenes import PER_POINT
from golden.independent import exact_run
from rockref.conformance.judge.trajectories import upright
from rockref.conformance.vectors import problem_of
from rockref.engines import run
from rockref.model.problem import Problem
from rockref.model.simulate import output_steps

ROUNDING_RUNS, SINGLE_RUNS = 8, 12
SHOWN = ("W", "x", "Lambda")
#: Comparison ends where the bar exceeds this share of the signal. Decided: a millionth shows any rule; of float32 and
#: other schemes, a tenth of the signal still tells a wrong rule from a right one.
HORIZON = {"": 1e-6, "float32_": 0.1, "scheme_": 0.1}


@dataclass
class Rows:
    """t (N,) [s]; W, x (N, 3), Lambda (N, 3, 3), in any precision."""

    t: np.ndarray
    W: np.ndarray
    x: np.ndarray
    Lambda: np.ndarray


def by_exact(q: dict[str, Any]) -> Rows:
    """Return the rows by `exact` in longdouble: a third of a millisecond a step."""
    m = LongDoubles
    numbers = {k: converted(v, m.number) for k, v in q.items() if k not in ("step", "duration", "output_rate", "names")}
    wanted = [int(i) for i in output_steps(problem_of(q))]
    h = m.number(q["step"])
    moments = list(exact_run.run(body_of(numbers), start_of(numbers), h, wanted, m))
    columns = {k: np.array([getattr(moment, k) for moment in moments], np.longdouble) for k in SHOWN}
    return Rows(np.array(wanted) * q["step"], **columns)


def as_rows(out: Any) -> Rows:
    """Return the rows of an answer."""
    out = out if isinstance(out, dict) else vars(out)
    return Rows(*(np.asarray(out[k]) for k in ("t", *SHOWN)))


def in_longdouble(q: dict[str, Any]) -> Rows:
    """Return the rows by the C text of the law in longdouble, rounded to float64."""
    return as_rows(programs.answer("long", [problem_of(q)])[0])


def held_to_exact(q: dict[str, Any], truth: Rows, width: dict[str, np.ndarray], share: float) -> None:
    """Compare the first part of a run with `exact`. Raises AssertionError where they are more than a bar apart."""
    first = by_exact(q | {"duration": share * q["duration"]})
    for key, bar in width.items():
        right = getattr(first, key)
        apart = np.abs(getattr(truth, key)[: len(right)] - right).reshape(len(right), -1).max(axis=1)
        assert np.all(apart <= bar[: len(right)]), f"{key}: two texts of the law differ"


def rearranged(q: dict[str, Any], rng: random.Random) -> dict[str, Any]:
    """Return all inputs moved by an ulp, the points in random order."""
    order = list(range(len(q["P"])))
    rng.shuffle(order)
    keys = set(PER_POINT) | {"s", "anchored", "sliding"}
    return {k: v[order] if k in keys else v for k, v in allowed(moved(q, rng)).items()}


def allowed(q: dict[str, Any]) -> dict[str, Any]:
    """Return the inputs with mu_0 at least mu and a symmetric inertia, where moving them has changed that."""
    upper = np.triu(q["inertia"])
    return q | {"mu_0": np.maximum(q["mu_0"], q["mu"]), "inertia": upper + np.triu(upper, 1).T}


def double_members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float64 runs: the law, and moved and rearranged ones."""
    rng = random.Random(seed)
    problems = [problem_of(q)] + [problem_of(rearranged(q, rng)) for _ in range(ULP_RUNS)]
    return [run(p, engine="auto") for p in problems]


def way_members(q: dict[str, Any]) -> list[Any]:
    """Correct float64 runs by other ways to write the law."""
    return [as_rows(programs.answer(name, [problem_of(q)])[0]) for name in ways.WAYS]


def scheme_members(q: dict[str, Any]) -> list[Any]:
    """Return runs by other integrators at the stated step."""
    return [as_rows(programs.answer(name, [problem_of(q)])[0]) for name in ways.SCHEMES]


def rounding_members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float64 runs under random rounding."""
    return [as_rows(programs.answer("rounding", [problem_of(q)], seed + i)[0]) for i in range(ROUNDING_RUNS)]


def single_members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float32 runs, of inputs moved by a single-precision ulp before they are rounded."""
    rng = random.Random(seed)

    def rough(a: Any) -> Any:
        if isinstance(a, np.ndarray) and a.dtype == np.float64:
            shift = np.array([rng.uniform(-1, 1) for _ in range(a.size)]).reshape(a.shape)
            return a * (1 + 2.0**-23 * shift)
        return a

    moved_ = [allowed({k: rough(v) for k, v in q.items()}) for _ in range(SINGLE_RUNS - 1)]
    return list(map(as_rows, programs.answer("single", [problem_of(p) for p in (q, *moved_)])))


def deviation(found: list[Any], truth: Rows, key: str) -> np.ndarray:
    """Return largest deviation so far of W, x or Lambda, over the members and the components, (N,)."""
    right = getattr(truth, key)
    with np.errstate(all="ignore"):
        apart = [np.abs(np.asarray(getattr(m, key), np.longdouble) - right).reshape(len(right), -1) for m in found]
    largest = np.max([a.max(axis=1) for a in apart], axis=0).astype(float)
    return np.maximum.accumulate(np.where(np.isfinite(largest), largest, np.inf))


def bars(found: list[Any], truth: Rows, factor: float = FACTOR, dtype: Any = np.float64) -> dict[str, np.ndarray]:
    """Return bar_W, bar_x, bar_Lambda of every row."""
    size = {k: np.abs(getattr(truth, k)).reshape(len(truth.t), -1).max(axis=1).astype(float) for k in SHOWN}
    return {k: factor * deviation(found, truth, k) + ulp(size[k], dtype) for k in SHOWN}


def horizon(width: dict[str, np.ndarray], truth: Rows, share: float) -> float:
    """Return last instant [s] at which no bar exceeds `share` of its signal (largest rate, way, and 1 for Lambda)."""
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


def impact_bars(found: list[Any], truth: Rows, end: float, factor: float = FACTOR) -> list[dict[str, float]]:
    """Return main impacts up to `end` [s] with their bars [s]; the linear interpolation belongs to their definition."""
    right = [i for i in upright(truth.t, truth.Lambda) if i <= end]
    others = [upright(truth.t, m.Lambda) for m in found]
    result = []
    for k, instant in enumerate(right):
        apart = [abs(o[k] - instant) if len(o) > k else np.inf for o in others]
        result.append({"t_s": float(instant), "bar_s": float(factor * max(apart) + np.spacing(instant))})
    return result


def converged(problem: Problem, step: float) -> Any:
    """Return the law's scheme with a step so small that it does not matter, rows as in the problem."""
    return run(replace(problem, step=step), engine="auto")
