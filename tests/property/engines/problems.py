"""Random problems of every shape that the engines take: any points, inertia and pose, near the plate or in flight."""

from dataclasses import replace

import numpy as np
from hypothesis import strategies as st

from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.rotation import exponential

STEP = 1e-5


def rotation(rng, largest: float) -> np.ndarray:
    axis = rng.normal(size=3)
    return exponential(axis / np.linalg.norm(axis) * rng.uniform(0, largest))


def inertia(rng, principal: bool) -> np.ndarray:
    J = np.diag(rng.uniform(0.5, 3.0, 3))
    if principal:
        return J
    R = rotation(rng, 3.0)
    J = R @ J @ R.T
    return (J + J.T) / 2


def contact_points(rng, n: int, round_feet: bool) -> ContactPoints:
    P = np.column_stack([rng.uniform(-0.3, 0.3, (n, 2)), -0.3 + rng.uniform(-1e-4, 1e-4, n)])
    mu = rng.uniform(0.0, 0.8, n)
    return ContactPoints(
        P,
        K_N=10 ** rng.uniform(5, 8, n), K_T=10 ** rng.uniform(5, 8, n),
        C_N=rng.uniform(0, 2e4, n), C_T=rng.uniform(0, 2e4, n),
        mu_0=mu + rng.choice([0.0, 0.1], n), mu=mu,
        radius=rng.uniform(0, 5e-3, n) if round_feet else None,
        names=tuple(f"{1 + i % 4}p{i}" for i in range(n)),
    )  # fmt: skip


def state(rng, n: int, fast: bool, history: bool) -> State:
    """Upright to some millidegrees, within a tenth of a millimetre of touching, at rates that slide, spin and hop."""
    rates = 3e3 if fast else 2.0  # rad/s; 3e3 turns by 0.03 rad in a step: the long series of the rotation
    s = State.at_rest(
        np.append(rng.uniform(-1, 1, 2), 0.3 + rng.uniform(-5e-5, 1e-4)), rotation(rng, 2e-4), n,
        v=rng.normal(size=3) * 0.3, W=rng.normal(size=3) * rates,
    )  # fmt: skip
    if history:
        s = replace(
            s,
            s=rng.uniform(-1, 1, (n, 2)),
            anchored=rng.random(n) < 0.5,
            sliding=rng.random(n) < 0.5,
            t=float(rng.uniform(0, 5)),
        )
    return s


@st.composite
def problems(draw, steps: int = 40, effects=()):
    """One problem of `steps` steps, each of them recorded."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    n = draw(st.integers(1, 11))
    block = Block(np.array(rng.uniform(20.0, 80.0)), inertia(rng, draw(st.booleans())), np.array(rng.uniform(1, 20)))
    points = contact_points(rng, n, draw(st.booleans()))
    start = state(rng, n, draw(st.booleans()), draw(st.booleans()))
    return Problem(block, points, start, STEP, steps * STEP, 1 / STEP, tuple(effects))


def similar_problem(seed: int, n: int, steps: int = 20) -> Problem:
    """Problems that a batch may hold: the same number of round feet and the same step, all else different."""
    rng = np.random.default_rng(seed)
    block = Block(np.array(rng.uniform(20.0, 80.0)), inertia(rng, True), np.array(9.81))
    start = state(rng, n, False, True)
    start = replace(start, t=0.0)  # a batch shares the clock
    return Problem(block, contact_points(rng, n, True), start, STEP, steps * STEP, 1 / STEP)
