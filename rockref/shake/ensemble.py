"""Ensembles: many runs of a block on shaken plates, over what is unknown of block, placing and motion.

A run is made from its number alone: its generator is seeded with the ensemble's seed and the number, so the bits of a
run depend neither on the workers nor on where the ensemble was interrupted.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, astuple, dataclass, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.shown import Shown, span
from rockref.model.standing import standing_posture
from rockref.shake import extremes
from rockref.shake.extremes import COLUMNS, Extremes
from rockref.shake.motion_size import motion_size

#: Time after the record that a run may take to fall or to come to rest [s]. Decided: a rocking block of a metre has
#: spent its energy in ten.
AFTER = 10.0
#: Runs that are made and run at a time. Decided: a few queues a thread; what is lost by an interruption.
BLOCK = 256
#: Postures that are remembered at most; decided: some ten megabytes of them.
MOST_STOOD = 10_000
_STOOD: dict[tuple, State] = {}


@dataclass(frozen=True)
class Draws:
    """What is drawn anew for every run.

    heading : largest turn about the vertical to either side, uniform [degrees]
    feet : standard deviation of the height of each foot, normal [m]
    friction : standard deviation of the logarithm of one factor on all friction coefficients, normal
    """

    heading: float = 0.0
    feet: float = 0.0
    friction: float = 0.0

    def __post_init__(self) -> None:
        """Refuse sizes that are none (E-RANGE)."""
        for key, value in asdict(self).items():
            if not (math.isfinite(value) and value >= 0):
                raise InputError("E-RANGE", f"draws: {key}", f"is {value!r}", "Give a finite number, not negative.")


@dataclass(frozen=True, repr=False)
class Ensemble(Shown):
    """A block, the motions of its plate, the factors on them, and what is drawn.

    Runs take pairs of motion and factor in turn: run k has pair k modulo their number, so each has as many runs.
    step [s], or several of them, which runs take in turn, too; after : time after the record [s]; seed : of all draws
    """

    model: Model
    motions: tuple[BaseMotion, ...]
    factors: tuple[float, ...] = (1.0,)
    draws: Draws = Draws()
    step: float | tuple[float, ...] = 1e-5
    after: float = AFTER
    seed: int = 0

    def facts(self) -> dict[str, str]:
        """Return block, motions with their peaks, what is drawn, and the time step, in words."""
        sizes = np.array([motion_size(base.scaled(f)) for base in self.motions for f in self.factors])
        drawn = {"heading": (1.0, "deg"), "feet": (1e3, "mm"), "friction": (1.0, "in its logarithm")}
        draws = [f"{key} {by * getattr(self.draws, key):g} {unit}" for key, (by, unit) in drawn.items()
                 if getattr(self.draws, key)]  # fmt: skip
        return {
            "mass": f"{self.model.mass:g} kg",
            "points": self.model.points,
            "motions": str(len(self.motions)),
            "factors": span(self.factors) + (f" ({len(self.factors)})" if len(self.factors) > 1 else ""),
            "PGA": span(sizes[:, 0], "m/s2", 3),
            "PGV": span(sizes[:, 1], "m/s", 3),
            "draws": ", ".join(draws) or "none",
            "step": span(self.steps, "s"),
            "seed": str(self.seed),
        }

    @property
    def steps(self) -> tuple[float, ...]:
        """Return the time steps [s]."""
        return self.step if isinstance(self.step, tuple) else (self.step,)

    def drawn(self, k: int) -> dict[str, Any]:
        """Return what run k has: record, factor, step [s], heading [rad], feet (4,) [m], factor on friction."""
        rng = np.random.default_rng([self.seed, k])
        heading, feet, friction = rng.uniform(-1, 1), rng.standard_normal(4), rng.standard_normal()
        turn, pair = divmod(k, len(self.motions) * len(self.factors))
        return {
            "step": self.steps[turn % len(self.steps)],
            "record": pair // len(self.factors),
            "factor": self.factors[pair % len(self.factors)],
            "heading": math.radians(self.draws.heading) * heading,
            "feet": self.draws.feet * feet,
            "friction": math.exp(self.draws.friction * friction),
        }

    def problem(self, k: int, body: tuple[Block, ContactPoints], bases: dict[Any, BaseMotion]) -> Problem:
        """Return run k; body, what the model makes; bases, the scaled motions made so far, which is added to."""
        own = self.drawn(k)
        key = own["record"], own["factor"]
        if key not in bases:
            bases[key] = self.motions[own["record"]].scaled(own["factor"])
        base, (block, points) = bases[key], body
        points = with_feet(points, own["feet"])
        points = replace(points, mu_0=points.mu_0 * own["friction"], mu=points.mu * own["friction"])
        start = posture(block, points, own["heading"])
        duration = max(base.end, 0.0) + self.after
        effects = self.model.active_effects()
        return Problem(block, points, start, own["step"], duration, 1 / extremes.TICK, effects, base=base)

    def rows(self, first: int, last: int, workers: int | None = None) -> list[dict[str, Any]]:
        """Run the runs first to last - 1 and return their rows of the table.

        Raises InputError as a run does, and E-STAND with the number of a run whose block does not stand.
        """
        body, bases = self.model.body(), dict[Any, BaseMotion]()
        problems = []
        for k in range(first, last):
            try:
                problems.append(self.problem(k, body, bases))
            except InputError as e:
                raise InputError(e.code, f"run {k}: {e.where}", e.what, e.cure) from e
        found: dict[int, Extremes] = {}
        # Runs of a batch share their step.
        for step in self.steps:
            own = [i for i, problem in enumerate(problems) if problem.step == step]
            found |= zip(own, run_all([problems[i] for i in own], workers), strict=True) if own else {}
        return [self.row(first + i, found[i], problem) for i, problem in enumerate(problems)]

    def row(self, k: int, found: Extremes, problem: Problem) -> dict[str, Any]:
        """Return the row of one run: its number, what was drawn, the peak of its motion, what was found."""
        own, base = self.drawn(k), problem.base
        assert base is not None
        feet = {f"foot_{i + 1}_m": float(height) for i, height in enumerate(own["feet"])}
        pga, pgv = motion_size(base)
        drawn = {"run": k, "record": base.name, "factor": own["factor"], "pga_m_s2": pga, "pgv_m_s": pgv}
        drawn |= {"step_s": own["step"], "heading_rad": own["heading"], **feet, "friction_factor": own["friction"]}
        return drawn | dict(zip(COLUMNS, astuple(found), strict=True))


def posture(block: Block, points: ContactPoints, heading: float) -> State:
    """Return what `standing_posture` does, from memory where the same block has stood before.

    Ensembles under the same draws differ in motions or friction, and stand alike.
    """
    arrays = (block.mass, block.g, points.P, points.K_N, points.radius)
    key = (heading, *(None if a is None else np.asarray(a).tobytes() for a in arrays))
    if key not in _STOOD:
        if len(_STOOD) >= MOST_STOOD:
            _STOOD.clear()
        _STOOD[key] = standing_posture(block, points, heading)
    return _STOOD[key]


def with_feet(points: ContactPoints, heights: np.ndarray) -> ContactPoints:
    """Return the points with each foot raised by its height [m]; a point's foot is the digit its name begins with.

    Raises InputError (E-FEET) where heights are given to points without a foot.
    """
    if not np.any(heights):
        return points
    feet = [int(name[0]) - 1 if name[:1] in "1234" and name else -1 for name in points.names]
    if min(feet) < 0:
        what = f"{points.names[int(np.argmin(feet))]!r} belongs to no foot, 1 to 4"
        raise InputError("E-FEET", "contact points", what, "Leave the draws of feet out, or begin names with a digit.")
    P = points.P.copy()
    P[:, 2] += heights[feet]
    return replace(points, P=P)


def run_all(problems: Sequence[Problem], workers: int | None = None) -> list[Extremes]:
    """Return the extremes of runs that share step and number of points, on `workers` threads (None: all cores).

    Without numba, and for effects that only the law knows, the runs are made one by one, which is a thousand times
    slower.
    """
    from rockref.engines import chosen, run
    from rockref.model.simulate import check

    for problem in problems[:1]:
        check(problem)
    limit, every = extremes.limits(problems[0].step)
    counts = [extremes.ticks(p, every) for p in problems]
    if all(chosen(p, "auto") == "numba" for p in problems):
        from rockref.engines.compiled.batch import batch_of
        from rockref.engines.compiled.pack import with_memory
        from rockref.engines.compiled.shaken import run_shaken

        batch = batch_of([with_memory(p) for p in problems], np.array([0]))
        number, quiet = np.array(counts, float).T
        return [extremes.from_row(row) for row in run_shaken(batch, limit, every, number, quiet, workers)]
    rate = 1 / (every * problems[0].step)
    return [
        extremes.watched(run(p.replace(output_rate=rate)), quiet)
        for p, (_, quiet) in zip(problems, counts, strict=True)
    ]


def run_ensemble(
    ensemble: Ensemble,
    runs: int,
    workers: int | None = None,
    done: Callable[[int, list[dict[str, Any]]], None] | None = None,
    have: Callable[[int, int], list[dict[str, Any]] | None] | None = None,
    executor: Executor | None = None,
) -> list[dict[str, Any]]:
    """Run an ensemble block by block and return its rows.

    done : called with the number of a block and its rows when it is finished, in the order of the blocks.
    have : asked for the rows of a block of so many runs before it is run; None where they are not known.
    executor : runs the blocks, for example on other machines; each on `workers` threads, by default one.
    """
    blocks = [(first, min(first + BLOCK, runs)) for first in range(0, runs, BLOCK)]
    known = [have(k, last - first) if have is not None else None for k, (first, last) in enumerate(blocks)]
    sent = {
        k: executor.submit(ensemble.rows, *span, workers or 1)
        for k, span in enumerate(blocks)
        if executor is not None and known[k] is None
    }
    rows: list[dict[str, Any]] = []
    for k, (first, last) in enumerate(blocks):
        own = known[k]
        if own is None:
            own = sent[k].result() if k in sent else ensemble.rows(first, last, workers)
            if done is not None:
                done(k, own)
        rows += own
    return rows


def shares_that_fell(rows: Sequence[dict[str, Any]], pairs: int) -> np.ndarray:
    """Return the share (pairs,) of runs that fell, by pair of motion and factor; rows take the pairs in turn."""
    return np.array([row["fell"] for row in rows], float).reshape(-1, pairs).mean(axis=0)
