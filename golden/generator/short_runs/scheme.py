"""Questions to other integrators (LS): the short runs of L5s, sixteen steps long, with the converged solution.

Expected: the C text of the law in long double with a 256th of the step. Bars: what eight integrators are off by at the
stated step after the same extrapolation as is made of an answer. Another integrator at small steps is held to the
expected values.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from golden.generator.bounds import programs, ways
from golden.generator.bounds.bars import FACTOR, Case
from golden.generator.short_runs import alone, apart, askew, basic, habits, memory, resolved, several
from golden.generator.short_runs.askew import STURDY
from rockref.conformance.backends.richardson import PARTS as OF_AN_ANSWER
from rockref.conformance.backends.richardson import SHOWN, WEIGHTS, extrapolated, refined
from rockref.conformance.judge import negligible
from rockref.conformance.vectors import problem_of
from rockref.engines import run
from rockref.model.problem import Problem

#: The questions of L5s, in order.
SHORT_RUNS = (basic.all_short, alone.alone, memory.memory, apart.apart, askew.askew, habits.habits, several.several)
#: Steps of a run, and the parts of a step of the converged solution: decided, a contact swings once in 200 steps.
STEPS, PARTS = 16, 256
#: By how many radians a block on its feet may swing in a step: decided, integrators that resolve a contact stay below.
LARGEST_SWING = 0.1
#: Bar: so many times the largest deviation of eight integrators, as for long runs.
SCHEME_FACTOR = 2
#: Runs of sixteen steps show more rules than the one of their first step: where they are judged, by number. What comes
#: near from above touches, and stands behind what touches from the first step on. What is pushed by springs alone comes
#: before what turns and is damped, and before feet that are unlike; a block that does not turn before one that does;
#: what never slides before what slides; what slides straight on, whatever its anchor, before anchors, these before
#: other sliding, and all behind what the forces of the first row show of it.
PLACES = {17: 22.79, 18: 22.791, 129: 29.9, 342: 30.02, 152: 30.05, 139: 30.8, 140: 30.81, 141: 30.82,
          142: 35.64, 143: 35.65, 343: 30.03, 36: 30.85, 37: 30.86, 82: 30.87, 111: 22.75, 120: 22.76, 157: 30.873,
          158: 30.874, 45: 43.05, 145: 43.1, 147: 43.2, 51: 43.3, 148: 43.4, 89: 49.6, 163: 49.81, 160: 50.91,
          132: 50.92, 66: 50.93, 67: 50.94, 68: 50.95, 134: 50.96, 149: 43.11, 184: 30.875,
          151: 43.115, 57: 51.2, 58: 51.21, 95: 51.22, 70: 56.1, 71: 56.11, 72: 56.12, 73: 56.13, 52: 56.5,
          53: 56.51, 54: 56.52, 94: 56.53, 55: 56.54, 56: 56.55, 150: 64.6, 161: 64.61, 177: 73.35,
          195: 50.97, 196: 50.98}  # fmt: skip
#: The number of the first run that other integrators alone are asked.
OWN = 401
#: Asked once more of a block that does not turn, whatever the moment: number, and the number of its twin.
NOT_TURNING = {142: 342, 143: 343}
#: Places within a step at which feet touch, for the bars of runs in which some do. Decided.
PHASES = 8
#: Least bar [m, rad, rad/s]: what is too small to be physical.
FLOOR = negligible.LENGTH


@lru_cache
def running(name: str) -> Any:
    """Start a program that answers many questions."""
    return programs.program(name)


def answer(name: str, problem: Problem) -> dict[str, Any]:
    """Return a run of a program."""
    return {k: np.asarray(v, np.longdouble) for k, v in running(name).simulate(problem).items()}


def last(out: dict[str, Any]) -> dict[str, np.ndarray]:
    """Return the last row."""
    return {k: out[k][-1] for k in SHOWN}


def solved(name: str, problem: Problem, parts: int = 1) -> dict[str, np.ndarray]:
    """Return the last row of a program's run with a part of the step and less, extrapolated as an answer is."""
    return last(extrapolated([answer(name, refined(problem, parts * k)) for k in OF_AN_ANSWER]))


def largest_deviations(problem: Problem) -> dict[str, float]:
    """Return by how much the integrators are off at the stated step, by result.

    Where a foot touches in the course of a run, its force jumps, and what an integrator is off by depends on where in a
    step that is: the run is made from several places on its way as well.
    """
    found = dict.fromkeys(SHOWN, 0.0)
    for i in range(PHASES if touches(problem) else 1):
        start = replace(problem.start, x=problem.start.x - problem.step * i / PHASES * problem.start.v)
        moved = replace(problem, start=start)
        right = last(answer("long", refined(moved, PARTS)))
        for name in ("double", *ways.OF_SHORT_RUNS):
            out = solved(name, moved)
            found = {k: max(size, float(np.max(np.abs(out[k] - right[k])))) for k, size in found.items()}
    return found


def touches(problem: Problem) -> bool:
    """Return whether a foot touches after the first row of a run."""
    fine = refined(problem, OF_AN_ANSWER[-1])
    anchored = run(replace(fine, output_rate=1 / fine.step), engine="numpy").anchored
    return bool(np.any(anchored[1:] & ~anchored[:-1]))


def converged(q: dict[str, Any]) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return the last row of a run, converged, by name, and its bars. Raises AssertionError where another integrator
    with the small step gives something else."""
    problem = problem_of(q)
    right, less = (last(answer("long", refined(problem, parts))) for parts in (PARTS, PARTS // 2))
    off = largest_deviations(problem)
    bars = {}
    for k, value in right.items():
        fine = np.abs(less[k] - value)
        bar = SCHEME_FACTOR * off[k] + FACTOR * np.max(fine) + FLOOR
        bars[k] = np.full(value.shape, float(bar))
    witness = solved("midpoint", problem, PARTS // OF_AN_ANSWER[-1])
    for k, value in right.items():
        # The witness is computed in doubles: each of its steps rounds a place of some metres, and extrapolation
        # multiplies that.
        rounding = sum(map(abs, WEIGHTS)) * STEPS * PARTS * np.spacing(max(1.0, float(np.max(np.abs(value)))))
        apart = np.max(np.abs(witness[k] - value) / (bars[k] + rounding))
        assert apart <= 1, f"{k}: two integrators converge to values {apart:.2g} bars apart"
    sideways = [{"x_T": a["x"][:2]} for a in (right, bars)]
    return {k: v.astype(float) for k, v in (right | sideways[0]).items()}, bars | sideways[1]


def asked(case: Case) -> Case | None:
    """Return a short run as a question to other integrators; None where it is one of the law's own scheme."""
    names = {name.partition("@")[0] for name in (*case.fields, *case.instead)} & {*SHOWN, "x_T"}
    if next(iter(case.fields.values()))[0] in ("N1", "N2") and case.instead:
        names -= {"Lambda"}  # a moment
    slippery = "F_T@0" in case.instead.values() and not np.any(case.inputs["mu_0"])
    if slippery:
        names = {"x_T"}  # no friction: the place along the plate
    h, rate = case.inputs["step"], case.inputs["output_rate"]
    swing = h * float(np.sqrt(np.sum(case.inputs["K_N"]) / case.inputs["mass"]))
    if not names or case.inputs.get("a") is not None or abs(rate * h - 1) > 1e-9 or swing > LARGEST_SWING:
        return None
    q = case.inputs | {"duration": STEPS * h, "output_rate": 1 / (STEPS * h)}
    rule = next(iter(case.fields.values()))[0]
    fields = {f"{k}@1": (rule, rule) for k in (*SHOWN, "x_T") if k in names}
    # Who shows the forces at the start is judged by them.
    stand_in = {f"{k.partition('@')[0]}@1": name for k, name in case.instead.items() if name.endswith("@0")}
    stand_in = {k: name for k, name in stand_in.items() if k in fields} | ({"x_T@1": "F_T@0"} if slippery else {})
    flags = (case.flags[0], f"{STEPS} steps")
    return Case(rule, "LS", "simulate", q, fields, flags, set="even feet", place=case.place, instead=stand_in)


def all_of_them() -> Iterator[tuple[int, Case]]:
    """Yield every question, with the number of its short run."""
    of_the_law = (case for group in SHORT_RUNS for case in group())
    groups = [enumerate(of_the_law, 1), enumerate(resolved.resolved(), OWN)]
    for group in groups:
        for number, case in group:
            found = asked(case)
            if found is not None:
                yield number, replace(found, place=PLACES.get(number, found.place))
            if found is not None and number in NOT_TURNING:
                twin, flags = NOT_TURNING[number], (*found.flags, "it does not turn")
                yield twin, replace(found, inputs=found.inputs | {"inertia": STURDY}, flags=flags, place=PLACES[twin])
