"""Whole tosses from their starts: many at once with the compiled step, or one by one by the law."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import Frames, cut, effect_of, frames_of, in_the_step, nominal_corners, throw_frame
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.engines import has_numba
from rockref.measure.tosses.flight import MOST, Poses, Starts, ballistic_starts, displaced, flight_frames, raw_starts
from rockref.model.problem import Problem, State, as_arrays
from rockref.model.simulate import check, largest_step, simulate

#: Steps a frame; decided by the gate `step_small`: where a contact is hard (90 kN/m) the error of the public held-out
#: tosses changes by some thousandths at twice as many. At 32 it changed by a fiftieth: five of 153 fell otherwise.
STEPS_A_FRAME = 64
#: Height above the plate [m] that the lowest corner must keep in a frame that counts as flight; decided: the rest
#: height of the public tosses scatters by 0.5 mm, and a block falls 7 mm between two frames.
CLEARANCE = 2e-3
STARTS = ("flight", "raw")


@dataclass(frozen=True)
class Prediction:
    """Predicted tracked poses x (B, F, 3) [m], Lambda (B, F, 3, 3), and the starts from which they come."""

    x: np.ndarray
    Lambda: np.ndarray
    starts: Starts
    frames: Frames


def gravity_of(model: Model, g: float) -> np.ndarray:
    """Return gravity in plate axes (3,) [m/s2], tilted as `plate_tilt` says."""
    tilt = effect_of(model, PlateTilt)
    return g * np.array([tilt.x, tilt.y, (tilt.x**2 + tilt.y**2) / 2 - 1])


def starts_of(model: Model, poses: Poses, frames: Frames, kind: str = "flight") -> Starts:
    """Return states of the centre of mass at the first frame, plate axes: from the flight, or the raw first frame."""
    block, _ = in_the_step(model).body()
    own = frames.over_plate(cut(poses, MOST + 1))
    if kind == "raw":
        W = poses.W @ frames.turn
        v = (frames.board_to_plate[:, 0] @ poses.v[..., None])[..., 0]
        return raw_starts(own, v + (own.Lambda[:, 0] @ np.cross(W, frames.centre)[..., None])[..., 0], W)
    # By the corners of the plain body: effects must not choose what is read.
    flight = flight_frames(poses, nominal_corners(model), CLEARANCE)
    return ballistic_starts(own, flight, gravity_of(model, float(block.g)), np.asarray(block.inertia))


def predict(
    model: Model,
    poses: Poses,
    start: str = "flight",
    steps: int = STEPS_A_FRAME,
    moved: np.ndarray | None = None,
    engine: str = "auto",
) -> Prediction:
    """Simulate every toss from its start over all its frames.

    Parameters
    ----------
    model : what is simulated.  poses : what was measured (only the flight, or the first frame, is used).
    start : "flight" or "raw".  steps : steps of the law between two frames.
    moved : (B, 12) what is added to the starts (position, turn, velocity, rates).
    engine : "auto" (compiled where it is there and knows the effects), "numpy".
    """
    frames = frames_of(model, throw_frame(poses))
    starts = starts_of(model, poses, frames, start)
    if moved is not None:
        starts = displaced(starts, moved)
    x, Lambda = simulated(model, starts, poses, steps, engine)
    return Prediction(*frames.to_tracked(x, Lambda), starts, frames)


def simulated(model: Model, starts: Starts, poses: Poses, steps: int, engine: str) -> tuple[np.ndarray, np.ndarray]:
    """Return poses of the centre of mass over the plate at every frame."""
    F = len(poses.t)
    rate = 1 / poses.t[1]
    n = in_the_step(model).body()[1].n
    first = State.at_rest(starts.x[0], starts.Lambda[0], n, starts.v[0], starts.W[0])
    problem = in_the_step(model).problem((F - 1) / rate, 1 / (rate * steps), rate, start=first)
    # A stiffer contact than expected gets the steps that it needs.
    steps = max(steps, int(np.ceil(1.001 / (rate * largest_step(problem)))))
    problem = problem.replace(step=1 / (rate * steps))
    check(problem)
    if engine != "numpy" and has_numba():
        from rockref.engines.compiled import pack

        if pack.has_twin(problem):
            return _compiled(problem, starts, poses, steps)
    return _by_the_law(problem, starts, F)


def _compiled(problem: Problem, starts: Starts, poses: Poses, steps: int) -> tuple[np.ndarray, np.ndarray]:
    from rockref.engines.compiled import columns as col
    from rockref.engines.compiled.batch import from_problems, run_batch

    one = from_problems([as_arrays(problem, np.float64)])
    B, F = len(starts.x), len(poses.t)

    def alike(a: np.ndarray) -> np.ndarray:
        return np.broadcast_to(a, (B, *a.shape[1:]))

    state = np.zeros((B, col.STATE))
    state[:, 0:3], state[:, 3:6] = starts.x, starts.v
    state[:, 6:15], state[:, 15:18] = starts.Lambda.reshape(B, 9), starts.W
    # A toss is simulated as long as it was measured; behind its end the last row is asked for again.
    wanted = np.minimum(np.arange(F), poses.frames[:, None] - 1) * steps
    batch = replace(
        one, body=alike(one.body), P=alike(one.P), props=alike(one.props), memory=alike(one.memory),
        effects=alike(one.effects), state=state, wanted=wanted, forces=np.zeros((B, one.P.shape[1], 3)),
    )  # fmt: skip
    rows = run_batch(batch)
    return rows[..., 0:3], rows[..., 6:15].reshape(B, F, 3, 3)


def _by_the_law(problem: Problem, starts: Starts, F: int) -> tuple[np.ndarray, np.ndarray]:
    n = problem.points.n
    start = State.at_rest(starts.x, starts.Lambda, n, starts.v, starts.W)
    found = simulate(problem.replace(start=start), keep_going=True)
    return found.x[:, :F], found.Lambda[:, :F]
