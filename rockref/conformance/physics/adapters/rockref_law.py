"""rockref itself: the law on eight points, the corners of the base and four points inside them."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Leg, Motion, Scene, Start, legs, stacked

NAME = "rockref, eight points"
# K: the sink under the weight is far below b alpha. The step is a tenth of the contact's period. More damping for care.
SETTINGS = {
    "default": {"inner": 0.006, "K": 1e7, "beta": 0.1, "step": 5e-5},
    "careful": {"inner": 0.006, "K": 1e7, "beta": 0.3, "step": 2.5e-5},
}
PASSPORT = {"K 1e7, beta 0.05": {"inner": 0.006, "K": 1e7, "beta": 0.05, "step": 5e-5}}
KNOBS = {"soft": "raise K", "rattling": "raise beta", "energy": "halve the step"}


def facts() -> dict[str, str]:
    """Return version and integrator."""
    import rockref

    return {"version": rockref.__version__, "integrator": "the source's, first order at contacts"}


def contact_points(scene: Scene):
    """Return the points of a scene: eight, or four where `inner` is zero, the foot of a sphere, none without plate.

    C = 2 beta sqrt(K m), as in the law; static and dynamic friction are the same.
    """
    from rockref.model.geometry import eight_points, four_points
    from rockref.model.problem import ContactPoints

    knobs = {"inner": 0.0, "K": 1e7, "beta": 0.1} | scene.settings
    radius = None
    if not scene.plate:
        P = np.zeros((0, 3))
    elif scene.shape == "sphere":
        P, radius = np.array([[0.0, 0.0, -scene.half[2]]]), scene.half[2:]
    else:
        inner = knobs["inner"]
        P = eight_points(*scene.size, np.zeros(4), inner) if inner else four_points(*scene.size)
    K, mu = np.full(len(P), float(knobs["K"])), np.full(len(P), scene.friction)
    C = 2 * knobs["beta"] * np.sqrt(K * scene.mass)
    return ContactPoints(P, K, K, C, C, mu, mu, radius, tuple(f"{k + 1}" for k in range(len(P))))


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`."""
    from rockref.model.problem import Block, State

    points = contact_points(scene)
    state = State.at_rest(start.x, start.R, points.n, start.v, start.R.T @ start.omega)
    rows = []
    for acting, steps in under_one_gravity(legs(scene, times, gravity)):
        block = Block(np.array(scene.mass), np.diag(scene.inertia), np.array(-acting[2]))
        found, state = advance(scene, block, points, state, acting, steps)
        rows += found
    return stacked(rows)


def under_one_gravity(found: list[Leg]):
    """Yield gravity and the legs that it rules, as (steps, record) each."""
    acting = found[0].gravity
    group: list[tuple[int, bool]] = []
    for leg in found:
        if leg.gravity is not None and group:
            yield acting, group
            group = []
        acting = acting if leg.gravity is None else leg.gravity
        group.append((leg.steps, leg.record))
    yield acting, group


def advance(scene: Scene, block, points, state, gravity, steps: list[tuple[int, bool]]):
    """Return the recorded states of the legs under one gravity, and the last state.

    Gravity off the vertical is a steady acceleration of the base. Anchors of the contact points are kept; the forces
    of the first step are made anew.
    """
    from rockref.effects.loads.base_vibration import BaseVibration
    from rockref.engines import run as simulated
    from rockref.model.problem import Problem

    counts = np.cumsum([n for n, _ in steps])
    state = type(state)(**vars(state) | {"a": None, "T": None, "F": None, "memory": ()})
    ahead = np.hypot(*gravity[:2])
    shaken = BaseVibration(float(ahead), 0.0, float(np.arctan2(-gravity[0], -gravity[1])))
    effects = (shaken,) if ahead else ()
    rows = [Start(state.x, state.Lambda, state.v, state.Lambda @ state.W)] * (not counts[0] and steps[0][1])
    stride = int(np.gcd.reduce(counts))
    if not stride:
        return rows, state
    rate = 1 / (stride * scene.step)
    found = simulated(Problem(block, points, state, scene.step, float(counts[-1] * scene.step), rate, effects))
    for count, (n, record) in zip(counts, steps, strict=True):
        if record and n:
            k = count // stride
            rows.append(Start(found.x[k], found.Lambda[k], found.v[k], found.Lambda[k] @ found.W[k]))
    return rows, found.final_state
