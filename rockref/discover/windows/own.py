"""Windows with a user's own effect: it has no compiled twin, so the law's text steps them, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import pack
from rockref.engines.compiled.batch import Batch
from rockref.model.errors import InputError
from rockref.model.integrator import first_evaluation, prepared_inertia, step
from rockref.model.problem import Block, ContactPoints, Problem, State, as_arrays


def own_of(effects: Sequence[Effect]) -> tuple[Effect, ...]:
    """Effects without a compiled twin. Raises InputError (E-TWIN) for one that acts on the sensor.

    A window begins where the gyroscope's record says that the block was, with the sensor undone; how an effect of the
    user's own is undone nobody knows.
    """
    own = tuple(effect for effect in effects if not pack.knows(effect))
    for effect in own:
        if type(effect).sensor is not Effect.sensor:
            what = "acts on the sensor: windows begin where the record says, with the sensor undone"
            raise InputError("E-TWIN", f"effect {effect.id}", what, "Simulate with it, or correct the records first.")
    return own


def known_own(names: Sequence[str]) -> tuple[str, ...]:
    """The ids of a user's own effects, each path/to/file.py:Class, that can be fitted.

    Raises InputError: E-EFFECT for one of the catalogue, or given twice; E-FILE, E-TWIN for one that cannot be used.
    """
    own = tuple(catalogue.named(name) for name in names)
    for k, kind in enumerate(own):
        if kind.file is None:
            cure = "Leave it out, or name a class of yours, path/to/file.py:Class."
            raise InputError("E-EFFECT", "--effect", f"{kind.id} is in the catalogue, which is tried anyway", cure)
        if kind.id in [other.id for other in own[:k]]:
            raise InputError("E-EFFECT", "--effect", f"{kind.id}: it is given twice", "Give each once.")
    own_of([kind.typical() for kind in own])
    return tuple(kind.id for kind in own)


def run_own(batch: Batch, problems: Sequence[Problem], run_of: np.ndarray, out: np.ndarray) -> np.ndarray:
    """What `run_batch` gives, by the law's text: out (B, R, STATE), rates W and the plate's motion only.

    Parameters
    ----------
    batch : B windows; wanted (B, R) rises in each up to the window's last step, and is negative after it
    problems : one a run, from its release, with all effects and their memories begun
    run_of : (B,) run of each window
    """
    out[...] = np.nan
    runs = list(dict.fromkeys(int(i) for i in run_of))
    groups: list[list[int]] = []
    for i in runs:  # a shaking base has a phase of its own in every run: such runs cannot be stepped together
        same = next((g for g in groups if problems[g[0]].effects == problems[i].effects), None)
        same.append(i) if same is not None else groups.append([i])
    for group in groups:
        lanes = np.flatnonzero(np.isin(run_of, group))
        out[lanes] = stepped(one_batch(batch, problems, run_of, lanes), batch.wanted[lanes], out[lanes])
    return out


def stepped(problem: Problem, wanted: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Step a batch to the end of its longest window; rows (b, R, STATE) are filled at the steps wanted (b, R)."""
    inertia = prepared_inertia(problem.block)
    with np.errstate(all="ignore"):
        state = first_evaluation(problem)
        for count in range(int(wanted.max()) + 1):
            if count:
                state = step(problem, state, inertia)
            lane, row = np.nonzero(wanted == count)
            rows[lane, row, col.W_ : col.W_ + 3] = state.W[lane]
            for effect, m in zip(problem.effects, state.memory, strict=True):
                for key, column in pack.PLATE_MEMORY.items() if pack.knows(effect) else ():
                    if key in m:
                        rows[lane, row, column] = m[key][lane]
    return rows


def one_batch(batch: Batch, problems: Sequence[Problem], run_of: np.ndarray, lanes: np.ndarray) -> Problem:
    """The windows `lanes` as one batch of the law; its time is an array, one a window."""
    first = problems[int(run_of[lanes[0]])]
    body, props, state = batch.body[lanes], batch.props[lanes], batch.state[lanes]
    memory = batch.memory[lanes]
    points = ContactPoints(
        P=batch.P[lanes],
        radius=None if first.points.radius is None else props[:, :, col.RADIUS],
        names=first.points.names,
        **{k: props[:, :, j] for j, k in enumerate(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"))},
    )
    start = State(
        x=state[:, col.X : col.X + 3],
        v=state[:, col.V : col.V + 3],
        Lambda=state[:, col.L : col.L + 9].reshape(-1, 3, 3),
        W=state[:, col.W_ : col.W_ + 3],
        s=memory[:, :, col.S_X : col.S_Y + 1],
        anchored=memory[:, :, col.ANCHORED] > 0,
        sliding=memory[:, :, col.SLIDING] > 0,
        t=state[:, col.TIME],  # type: ignore[arg-type]
        memory=tuple(
            begun(effect, k, [problems[int(i)] for i in run_of[lanes]], memory, state)
            for k, effect in enumerate(first.effects)
        ),
    )
    block = Block(body[:, col.MASS], body[:, col.J : col.J + 9].reshape(-1, 3, 3), body[:, col.GRAVITY])
    return as_arrays(Problem(block, points, start, batch.h, 1.0, 1.0, first.effects))


def begun(effect: Effect, k: int, problems: Sequence[Problem], memory: np.ndarray, state: np.ndarray) -> dict[str, Any]:
    """The memory of the k-th effect in each window: as at the release of its run, or what the window knows better."""
    m = {key: np.stack([np.asarray(p.start.memory[k][key]) for p in problems]) for key in problems[0].start.memory[k]}
    if pack.knows(effect):
        m |= {key: memory[:, :, column] for key, column in pack.POINT_MEMORY.items() if key in m}
        m |= {key: state[:, column] for key, column in pack.PLATE_MEMORY.items() if key in m}
    return m
