"""Batches of runs that listen to observed rates; only their own rates come out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rockref.engines import ENGINES, has_numba
from rockref.engines.heard import Listening
from rockref.model.errors import InputError
from rockref.model.listening import Target, listen
from rockref.model.problem import Problem, stack

if TYPE_CHECKING:
    from rockref.engines.compiled.batch import Batch


def run_listening(
    batch: Batch | Sequence[Problem], listening: Listening, workers: int | None = None, engine: str = "auto"
) -> np.ndarray:
    """Run a batch that listens, on `workers` threads (default: all cores).

    Parameters
    ----------
    batch : arrays for the compiled engine, or problems that share step and number of points, whose effects may be a
        user's own. What the batch wants recorded is left aside.
    engine : "numba", "numpy" (problems only), or "auto": numba where it is installed and knows every effect.

    Returns
    -------
    (B, K, 3) body rates [rad/s] at the ticks, each before its own correction; the first are those of the start. A run
    that loses its numbers has NaN from there on. The bits do not depend on the number of workers.

    Raises
    ------
    InputError
        E-SHAPE, where the arrays do not fit together; E-RANGE, for a number that is not finite, a gain or factor
        outside 0 to 1, or a target that is not there; E-ENGINE, where the engine cannot run the batch; E-STACK, E-TWIN
        as `rockref.engines.compiled.batch.from_problems`.
    """
    problems = None if hasattr(batch, "props") else list(batch)  # type: ignore[call-overload]
    runs = len(batch.props) if problems is None else len(problems)  # type: ignore[union-attr]
    listening = checked(listening, runs)
    if compiles(problems, engine):
        from rockref.engines.compiled import batch as compiled

        arrays: Any = batch if problems is None else compiled.from_problems(problems)
        return compiled.run_listening(arrays, listening, workers)
    return side_by_side(problems or [], listening)


def compiles(problems: list[Problem] | None, engine: str) -> bool:
    """Return whether the compiled engine runs these problems, or arrays (None); raises InputError (E-ENGINE)."""
    if engine not in ENGINES:
        raise InputError("E-ENGINE", "engine", f"is {engine!r}", f"Use one of {', '.join(ENGINES)}.")
    if engine == "numpy" and problems is None:
        raise InputError("E-ENGINE", "engine", "is numpy, which takes no arrays", "Give problems.")
    if engine != "numpy" and problems is not None and not has_numba():
        engine = "numpy" if engine == "auto" else engine
    if engine != "numpy" and not has_numba():
        raise InputError("E-ENGINE", "engine", "numba is not installed", "pip install 'rockref[fast]', or use numpy.")
    if engine == "auto" and problems is not None:
        from rockref.engines.compiled.pack import has_twin

        return all(map(has_twin, problems))
    return engine != "numpy"


def side_by_side(problems: Sequence[Problem], listening: Listening) -> np.ndarray:
    """Return the rates (B, K, 3) by the law's text: runs with equal effects are stepped as one batch.

    Where a step of a batch turns a block too far, its runs are stepped one by one, and that one has NaN.
    """
    found = np.full((len(problems), *listening.rates.shape[1:]), np.nan)
    groups: list[list[int]] = []
    for b, p in enumerate(problems):
        same = next((g for g in groups if problems[g[0]].effects == p.effects), None)
        groups.append([b]) if same is None else same.append(b)
    for group in groups:
        fill(found, problems, listening, group)
    return found


def fill(found: np.ndarray, problems: Sequence[Problem], listening: Listening, members: list[int]) -> None:
    """Step some runs as one batch; where one of them is turned too far in a step, one by one, and that one has NaN."""
    try:
        found[members] = listen(stack([problems[b] for b in members]), target_of(listening, members))
    except InputError as error:
        if error.code != "E-ANGLE":
            raise
        for b in members if len(members) > 1 else ():
            fill(found, problems, listening, [b])


def target_of(listening: Listening, rows: Sequence[int]) -> Target:
    """Return what these runs listen to."""
    m, b = listening.which[list(rows)], list(rows)
    heard = listening.heard[m] if listening.heard is not None else np.ones((len(b), listening.rates.shape[1], 4))
    gain_rate = listening.gain_rate[b, None, None] * heard[..., :3]
    return Target(
        rates=listening.rates[m], turns=listening.turns[m], gain_rate=gain_rate,
        gain_attitude=listening.gain_attitude[b, None] * heard[..., 3], every=listening.every,
    )  # fmt: skip


def checked(listening: Listening, runs: int) -> Listening:
    """Return the target as contiguous float64 arrays; raises InputError (E-SHAPE, E-RANGE)."""
    M, K = np.shape(listening.rates)[:2]
    heard = np.ones((M, K, 4)) if listening.heard is None else listening.heard
    most = np.finfo(float).max
    given = {
        "rates": (listening.rates, (M, K, 3), -most, most), "turns": (listening.turns, (M, K, 3, 3), -most, most),
        "heard": (heard, (M, K, 4), 0, 1), "gain_rate": (listening.gain_rate, (runs,), 0, 1),
        "gain_attitude": (listening.gain_attitude, (runs,), 0, 1), "which": (listening.which, (runs,), 0, M - 1),
        "every": (listening.every, (), 1, most),
    }  # fmt: skip
    ready: dict[str, Any] = {}
    for key, (value, shape, low, high) in given.items():
        a = np.require(value, np.int64 if key in ("which", "every") else np.float64, ["C", "W"])
        if a.shape != shape:
            raise InputError("E-SHAPE", f"listening.{key}", f"has shape {a.shape}", f"Give {shape}.")
        if not np.all((a >= low) & (a <= high)):
            raise InputError(
                "E-RANGE", f"listening.{key}", "is out of range", f"Give numbers from {low:g} to {high:g}."
            )
        ready[key] = a
    return replace(listening, **{**ready, "every": int(ready["every"])})
