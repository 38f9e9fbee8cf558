"""Expected rows of a run, and their bars.

Values: `exact` in longdouble. Bars: 8 times the largest deviation, so far in the run, of the float64 law, of 16 runs
with all inputs
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
from rockref.conformance.other_scheme import KickAndDrift
from rockref.conformance.runs import upright
from rockref.conformance.vectors import problem_of
from rockref.engines import run
from rockref.model.problem import Problem, stack
from rockref.model.simulate import output_steps

ROUNDING_RUNS, SINGLE_RUNS = 8, 12
SHOWN = ("W", "x", "Lambda")
#: Comparison ends where the bar exceeds this share of the signal. float64: the issue's 1e-6. float32 and scheme:
#: decided; a tenth of the
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


def double_members(q: dict[str, Any], seed: int) -> list[Any]:
    """Correct float64 runs: the law, and moved and rearranged ones."""
    rng = random.Random(seed)
    problems = [problem_of(q)] + [problem_of(rearranged(q, rng)) for _ in range(ULP_RUNS)]
    return [run(p, engine="auto") for p in problems]


def inert(q: dict[str, Any], points: int) -> dict[str, Any]:
    """The inputs with points added that hang a metre above the centre of mass and never touch."""
    more = points - len(q["P"])
    if not more:
        return q
    added = {k: np.concatenate([q[k], np.ones(more)]) for k in PER_POINT if k != "P"}
    added["P"] = np.concatenate([q["P"], np.tile([0.0, 0.0, 1.0], (more, 1))])
    added["s"] = np.concatenate([q["s"], np.zeros((more, 2))])
    added |= {k: np.concatenate([q[k], np.zeros(more, bool)]) for k in ("anchored", "sliding")}
    return q | added | {"names": [*q["names"], *(f"inert {i}" for i in range(more))]}


def alike(qs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Inputs of one step made so alike that they can run in one batch: as many points, the longest duration, every
    row."""
    longest = {"duration": max(q["duration"] for q in qs), "output_rate": max(q["output_rate"] for q in qs)}
    return [inert(q, max(len(p["P"]) for p in qs)) | longest for q in qs]


def side_by_side(rules: pieces.Rules, many: list[list[dict[str, Any]]], dtype: Any = None) -> list[list[Any]]:
    """Several runs each of several inputs, all in one batch; each with its own rows."""
    flat = [q for qs in many for q in qs]
    shared = [problem_of(q) for q in alike(flat)]
    batch, steps = pieces.simulate(rules, stack(shared), dtype), output_steps(shared[0])
    picked = []
    for i, q in enumerate(flat):
        rows = np.searchsorted(steps, output_steps(problem_of(q)))
        run_ = batch.pick(i)
        picked.append(Rows(run_.t[rows], run_.W[rows], run_.x[rows], run_.Lambda[rows]))
    each = iter(picked)
    return [[next(each) for _ in qs] for qs in many]


def rounding_members(qs: list[dict[str, Any]], seed: int) -> list[list[Any]]:
    """Correct float64 runs under random rounding, for each of several inputs."""
    return side_by_side(noisy_rules(seed), [[q] * ROUNDING_RUNS for q in qs])


def single_members(qs: list[dict[str, Any]], seed: int) -> list[list[Any]]:
    """Correct float32 runs for each of several inputs, which are moved by a single-precision ulp before they are
    rounded."""
    rng = random.Random(seed)

    def rough(a: Any) -> Any:
        if isinstance(a, np.ndarray) and a.dtype == np.float64:
            shift = np.array([rng.uniform(-1, 1) for _ in range(a.size)]).reshape(a.shape)
            return a * (1 + 2.0**-23 * shift)
        return a

    many = [[q] + [allowed({k: rough(v) for k, v in q.items()}) for _ in range(SINGLE_RUNS - 1)] for q in qs]
    return side_by_side(pieces.law(), many, np.float32)


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


def impact_bars(found: list[Any], truth: Rows, end: float, factor: float = FACTOR) -> list[dict[str, float]]:
    """Main impacts up to `end` [s] with their bars [s]; the linear interpolation belongs to their definition."""
    right = [i for i in upright(truth.t, truth.Lambda) if i <= end]
    others = [upright(truth.t, m.Lambda) for m in found]
    result = []
    for k, instant in enumerate(right):
        apart = [abs(o[k] - instant) if len(o) > k else np.inf for o in others]
        result.append({"t_s": float(instant), "bar_s": float(factor * max(apart) + np.spacing(instant))})
    return result


def other_scheme(qs: list[dict[str, Any]]) -> list[Any]:
    """Runs by another integrator, for each of several inputs."""
    return [runs[0] for runs in side_by_side(KickAndDrift().rules, [[q] for q in qs])]


def converged(problem: Problem, step: float) -> Any:
    """The law's scheme with a step so small that it does not matter, rows as in the problem."""
    return run(replace(problem, step=step), engine="auto")
