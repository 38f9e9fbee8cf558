"""The law in WebAssembly as a backend of the judge: `rockref conform rockref.lab.backend:WasmBackend`."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.effects import catalogue
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import pack, slots
from rockref.lab import layout
from rockref.lab.wasm import Module
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.model.problem import Problem, State, as_arrays
from rockref.model.response import Response
from rockref.model.simulate import check, output_steps

#: Contact points for which the C text has room when an effect makes new ones.
MOST_POINTS = 16
#: Steps are counted in 32 bits.
MOST_STEPS = 2**31 - 1


def numbers(a: Any) -> np.ndarray:
    """Return a contiguous float64 copy."""
    return np.array(a, np.float64, order="C")


class WasmBackend:
    """Runs, one step, and the pieces of a step, all computed by the C text; numbers in SI units."""

    language = "C, compiled to WebAssembly"
    precision = "float64"
    name = "rockref lab"

    def __init__(self) -> None:
        self.module = Module()

    def derived(self, **p: Any) -> dict[str, Any]:
        """Apply G1, G2, P1 to P3."""
        names = {f"delta_long_{i}": p["delta_long"][i - 1] for i in (1, 2, 3, 4)}
        given = {**p, **names, "g": 0.0, "foot_radius": 0.0, "points": 8, "theta_0": 0.0}
        model = numbers([given.get(name, 0.0) for name in layout.MODEL])
        body, P, props = np.zeros(col.BODY), np.zeros((8, 3)), np.zeros((8, col.PROPS))
        self.module.call("body_of", model, np.zeros(layout.count_values()), body, P, props)
        own = {k: props[:, j] for j, k in enumerate(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"))}
        return {"inertia": body[col.J : col.J + 9].reshape(3, 3), "P": P, **own}

    def release(self, mass: Any, g: Any, P: Any, K_N: Any, theta_0: Any) -> dict[str, Any]:
        """Apply R1, the release posture."""
        body, P, state = np.zeros(col.BODY), numbers(P), np.zeros(col.STATE)
        body[[col.MASS, col.GRAVITY]], body[[col.J, col.J + 4, col.J + 8]] = (float(mass), float(g)), 1.0
        props = np.zeros((len(P), col.PROPS))
        props[:, col.K_N] = K_N
        self.module.call("release_packed", len(P), body, P, props, float(theta_0), 0, 0.0, state)
        return {"x": state[0:3], "Lambda": state[6:15].reshape(3, 3)}

    def kinematics(self, x: Any, Lambda: Any, v: Any, W: Any, P: Any) -> dict[str, Any]:
        """Apply K1."""
        P = numbers(P)
        out = np.zeros((len(P), 10))
        self.module.call("piece_kinematics", *map(numbers, (x, Lambda, v, W)), len(P), P, out)
        return {"r": out[:, 0:3], "u": out[:, 3:6], "xi": out[:, 6], "xi_rate": out[:, 7], "v_slide": out[:, 8:10]}

    def contact_law(
        self, xi, xi_rate, u_t, v_slide, s, anchored, sliding, K_N, C_N, K_T, C_T, mu_0, mu
    ) -> dict[str, Any]:
        """Apply N1, N2, T1 to T6 for one point."""
        prop, memory, F = numbers([K_N, K_T, C_N, C_T, mu_0, mu, 0.0, 0.0]), np.zeros(col.MEMORY), np.zeros(3)
        memory[0:2], memory[2], memory[3] = s, anchored, sliding
        asked = float(xi), float(xi_rate), numbers(u_t), numbers(v_slide), prop, memory, F
        self.module.call("piece_contact_law", *asked)
        touching = bool(memory[2])
        anchor = memory[0:2] if touching else numbers(u_t)
        return {"F_N": F[2], "F_T": F[:2], "s": anchor, "touching": touching, "sliding": bool(memory[3])}

    def assemble(self, Lambda: Any, r: Any, F: Any, mass: Any, g: Any) -> dict[str, Any]:
        """Apply A1 to A3."""
        out, r = np.zeros(9), numbers(r)
        self.module.call("piece_assemble", numbers(Lambda), len(r), r, numbers(F), float(mass), float(g), out)
        return {"force": out[0:3], "moment": out[3:6], "T": out[6:9]}

    def rotate(self, Theta: Any) -> dict[str, Any]:
        """Return the exponential of I3."""
        Lambda = np.zeros((3, 3))
        self.module.call("piece_rotate", numbers(Theta), Lambda)
        return {"Lambda": Lambda}

    def integrate(self, x, v, Lambda, W, a, T, a_next, T_next, h, inertia) -> dict[str, Any]:
        """Apply I1 to I5 with prescribed accelerations and moments."""
        body, state, predicted = np.zeros(col.BODY), np.zeros(col.STATE), np.zeros(6)
        body[col.MASS] = 1.0
        body[col.J : col.J + 9] = numbers(inertia).ravel()
        self.module.call("shape_packed", np.zeros(layout.count_values()), 0, body, *(np.zeros(1) for _ in range(3)))
        state[0:3], state[3:6], state[6:15], state[15:18] = x, v, numbers(Lambda).ravel(), W
        state[18:21], state[21:24] = a, T
        self.module.call("piece_integrate", body, float(h), state, numbers(a_next), numbers(T_next), predicted)
        pose = {"x": state[0:3], "v": state[3:6], "Lambda": state[6:15].reshape(3, 3), "W": state[15:18]}
        return pose | {"v_predicted": predicted[:3], "W_predicted": predicted[3:]}

    def channel(self, W: Any, Lambda: Any) -> dict[str, Any]:
        """Apply M1: the page shows rates in degrees."""
        return {"crv_deg_s": numbers(W) * DEGREES}

    def step(self, problem: Problem) -> dict[str, Any]:
        """Return one full step from a state that brings a, T and F."""
        state = self.simulate(replace(problem, duration=problem.step, output_rate=1 / problem.step)).final_state
        return {k: getattr(state, k) for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "a", "T", "F")}

    def simulate(self, problem: Problem) -> Response:
        """Run a problem without effects, or with those of the catalogue as they act in the step.

        Raises InputError E-SIZE for more steps than 32 bits count, and those of the law's check.
        """
        problem = pack.with_memory(as_arrays(problem, np.float64))
        check(problem)
        if problem.base is not None:
            raise InputError("E-TWIN", "base motion", "has no twin in the C text", pack.NUMPY)
        return self._run(problem, pack.props_rows(problem), pack.effects_row(problem), pack.state_row(problem))

    def _run(self, problem: Problem, props: np.ndarray, e: np.ndarray, start: np.ndarray) -> Response:
        wanted, n = output_steps(problem), problem.points.n
        if wanted[-1] > MOST_STEPS:
            raise InputError("E-SIZE", "duration", f"{wanted[-1]} steps", "Ask for a shorter run.")
        rows = len(wanted)
        states, forces = np.zeros((rows, col.STATE)), np.zeros((rows, n, 3))
        memories = np.zeros((rows, n, col.MEMORY))
        given = np.zeros((n, 3)) if problem.start.F is None else numbers(problem.start.F)
        read = pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start)
        where = wanted.astype(np.int32)
        arguments = n, *read, given, e, start, float(problem.step), where, rows, states, forces, memories
        written = self.module.call("run_packed", *arguments)
        states[written:], forces[written:] = np.nan, np.nan
        states[written:, col.TIME] = start[col.ORIGIN] + (start[col.COUNT] + wanted[written:]) * problem.step
        return Response(
            problem=problem, t=states[:, col.TIME], x=states[:, 0:3], v=states[:, 3:6],
            Lambda=states[:, 6:15].reshape(rows, 3, 3), W=states[:, 15:18], F=forces, s=memories[:, :, 0:2],
            anchored=memories[:, :, 2] != 0, sliding=memories[:, :, 3] != 0,
            final_state=pack.final_state(problem, states[-1], memories[-1], forces[-1]),
        )  # fmt: skip

    def effect(self, problem: Problem, effect: str, parameters: dict[str, Any]) -> Response | None:
        """Run a problem of the plain law with an effect of the catalogue; body, release and step are the C text's."""
        if effect not in catalogue.EFFECTS:
            return None
        values = numbers(layout.values_of((catalogue.make(catalogue.find(effect), parameters, "effect"),)))
        problem = as_arrays(problem, np.float64)
        n, body = problem.points.n, pack.body_row(problem)
        P, props = np.zeros((MOST_POINTS, 3)), np.zeros((MOST_POINTS, col.PROPS))
        P[:n], props[:n] = problem.points.P, pack.props_rows(problem)
        m = self.module.call("shape_packed", values, n, body, P, props, np.zeros((MOST_POINTS, 3)))
        start, e = pack.state_row(problem), np.zeros(slots.SLOTS)
        if m != n:
            start[col.GIVEN] = 0.0
        self.module.call("start_packed", values, m, body, P[:m].copy(), props[:m].copy(), start, e)
        return self._run(shaped(problem, body, P[:m], props[:m]), props[:m].copy(), e, start)

    def sensor(self, effect: str, parameters: dict[str, Any], t: Any, crv_deg_s: Any) -> dict[str, Any] | None:
        """Return what the gyroscope makes of rates."""
        if effect not in catalogue.EFFECTS:
            return None
        values = numbers(layout.values_of((catalogue.make(catalogue.find(effect), parameters, "effect"),)))
        crv = np.radians(numbers(crv_deg_s))
        self.module.call("sensed", values, numbers(t), crv, len(crv))
        return {"crv_deg_s": np.degrees(crv)}


def shaped(problem: Problem, body: np.ndarray, P: np.ndarray, props: np.ndarray) -> Problem:
    """Return the problem with the body and the points that the C text has made; new points remember nothing."""
    n, more = len(P), len(P) - problem.points.n
    own: dict[str, Any] = {
        k: props[:, j].copy() for j, k in enumerate(("K_N", "K_T", "C_N", "C_T", "mu_0", "mu", "radius"))
    }
    names = problem.points.names if not more else tuple(f"{i % 4 + 1}" for i in range(n))
    block = replace(problem.block, inertia=body[col.J : col.J + 9].reshape(3, 3).copy())
    start: State = problem.start
    if more:
        fresh = State.at_rest(start.x, start.Lambda, more)
        joined: dict[str, Any] = {
            k: np.concatenate([getattr(start, k), getattr(fresh, k)]) for k in ("s", "anchored", "sliding")
        }
        start = replace(start, **joined, a=None, T=None, F=None)
    points = replace(problem.points, P=P.copy(), names=names, **own)
    return replace(problem, block=block, points=points, start=start)
