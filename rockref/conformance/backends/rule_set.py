"""The law as a set of replaceable rules, and the step made of them.

`law()` gathers the functions of `rockref.model` as they are when it is called; `replace` plants something else in the
place of
one of them. The compositions below repeat the order of the step and no equation of it; with nothing replaced their
bits are those of the law (a test looks).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from rockref.model import assembly, channel, contact, geometry, integrator, parameters, release, rotation
from rockref.model.integrator import Inertia, prepared_inertia, times
from rockref.model.problem import ContactPoints, Problem, State, as_arrays
from rockref.model.simulate import output_steps


@dataclass(frozen=True)
class Rules:
    """One function per rule, in data-flow order; the last ones put them together."""

    inertia: Callable  # G1
    points: Callable  # G2
    stiffness: Callable  # P1
    damping: Callable  # P2
    damping_ratio: Callable  # P3
    release: Callable  # R1
    position: Callable  # I1
    acceleration: Callable  # I2, Euler's equations
    increment: Callable  # I2
    exponential: Callable  # I3, exp - I
    rotation: Callable  # I3
    predicted: Callable  # S1
    kinematics: Callable  # K1
    normal: Callable  # N1
    gap: Callable  # N2
    touch: Callable  # T5
    trial: Callable  # T1
    size: Callable  # T2
    threshold: Callable  # T6
    sticks: Callable  # T2
    friction: Callable  # T3
    anchor: Callable  # T4
    force: Callable  # A1
    moment: Callable  # A2
    body_moment: Callable  # A3
    velocity: Callable  # I4
    momentum: Callable  # I5
    rates: Callable  # I5
    channel: Callable  # M1
    first_half: Callable
    point_law: Callable
    contact: Callable
    step: Callable
    start: Callable

    def replace(self, **changes: Callable) -> Rules:
        """Return a copy with some rules replaced."""
        return replace(self, **changes)


def law() -> Rules:
    """Return the rules as `rockref.model` has them at this moment."""
    return Rules(
        inertia=geometry.cuboid_inertia,
        points=geometry.eight_points,
        stiffness=parameters.common_stiffness,
        damping=parameters.viscous_damping,
        damping_ratio=parameters.common_damping_ratio,
        release=release.release_posture,
        position=integrator.update_position,
        acceleration=integrator.angular_acceleration,
        increment=integrator.rotation_increment,
        exponential=rotation.exp_minus_identity,
        rotation=integrator.update_rotation,
        predicted=predicted,
        kinematics=contact.point_kinematics,
        normal=contact.kelvin_voigt,
        gap=contact.open_gap,
        touch=contact.touch,
        trial=contact.trial_force,
        size=contact.norm,
        threshold=contact.threshold,
        sticks=contact.sticks,
        friction=contact.radial_return,
        anchor=contact.move_anchor,
        force=assembly.resultant_force,
        moment=assembly.resultant_moment,
        body_moment=assembly.body_moment,
        velocity=integrator.update_velocity,
        momentum=integrator.update_momentum,
        rates=integrator.update_rates,
        channel=channel_of_history,
        first_half=first_half,
        point_law=point_law,
        contact=evaluate_contact,
        step=step,
        start=start,
    )


class Touch(NamedTuple):
    """What the points do: F_N (..., n), F_T and s (..., n, 2), flags; s_trial, F_trial, threshold on the way."""

    F_N: np.ndarray
    F_T: np.ndarray
    s: np.ndarray
    touching: np.ndarray
    sliding: np.ndarray
    s_trial: np.ndarray
    F_trial: np.ndarray
    threshold: np.ndarray


class Made(NamedTuple):
    """What the points are made of, (..., n) each."""

    K_N: np.ndarray
    C_N: np.ndarray
    K_T: np.ndarray
    C_T: np.ndarray
    mu_0: np.ndarray
    mu: np.ndarray


def made(points: ContactPoints) -> Made:
    """Return the six properties of contact points."""
    return Made(points.K_N, points.C_N, points.K_T, points.C_T, points.mu_0, points.mu)


def predicted(v, a, W, A, h):
    """Return velocities with which the contact forces at n+1 are evaluated: v + h a, W + h A (decided in the law)."""
    return v + h * a, W + h * A


def channel_of_history(W: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Apply rule M1 on a history: W (N, 3) [rad/s] -> (N, 3) [deg/s]. The pose does not enter."""
    return channel.crv_deg_s(W)


def point_law(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Apply rules N1 to T6, in the order of the step."""
    F_N = rules.gap(xi, rules.normal(xi, xi_rate, p.K_N, p.C_N))
    s_trial, touching = rules.touch(xi, u_t, s, anchored)
    F_trial = rules.trial(u_t, s_trial, v_slide, p.K_T, p.C_T)
    size = rules.size(F_trial)
    threshold = rules.threshold(F_N, sliding & touching, p.mu_0, p.mu)
    stick = rules.sticks(size, threshold)
    F_T = rules.friction(F_trial, size, stick, p.mu * F_N)
    moved = rules.anchor(F_T, u_t, s_trial, v_slide, stick, p.K_T, p.C_T)
    return Touch(F_N, F_T, moved, touching, touching & ~stick, s_trial, F_trial, threshold)


def evaluate_contact(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> tuple[Any, Touch]:
    """Return kinematics and touch of all points at one pose; `state` brings the memory of the last step."""
    k = rules.kinematics(x, Lambda, v, W, problem.points.P)
    arguments = (k.xi, k.xi_rate, k.u[..., :2], k.v_slide, state.s, state.anchored, state.sliding)
    return k, rules.point_law(rules, *arguments, made(problem.points))


def evaluate(rules: Rules, problem: Problem, state: State, x, Lambda, v, W):
    """Return one force evaluation: acceleration, body moment, point forces, touch."""
    k, c = rules.contact(rules, problem, state, x, Lambda, v, W)
    F = np.empty_like(k.u)
    F[..., :2], F[..., 2] = c.F_T, c.F_N
    force = rules.force(F, problem.block.mass, problem.block.g)
    T = rules.body_moment(Lambda, rules.moment(k.r, F))
    return force / problem.block.mass[..., None], T, F, c


def start(rules: Rules, problem: Problem) -> State:
    """Return the start with the first force evaluation made, unless the state brings one."""
    state = replace(problem.start, origin=problem.start.t, count=0, h=problem.step)
    if state.a is not None and state.T is not None and state.F is not None:
        return state
    a, T, F, c = evaluate(rules, problem, state, state.x, state.Lambda, state.v, state.W)
    return replace(state, a=a, T=T, F=F, s=c.s, anchored=c.touching, sliding=c.sliding)


def first_half(rules: Rules, state: State, inertia: Inertia, h):
    """Apply I1 to I3 and the prediction: x, Theta, Lambda, predicted v and W; and E, J W for the second half."""
    JW = times(inertia.J, state.W)
    A = rules.acceleration(state.T, state.W, JW, inertia.J_inverse)
    x = rules.position(state.x, state.v, state.a, h)
    Theta = rules.increment(state.W, A, h)
    E = rules.exponential(Theta)
    Lambda = rules.rotation(state.Lambda, E)
    v_predicted, W_predicted = rules.predicted(state.v, state.a, state.W, A, h)
    return x, Theta, Lambda, v_predicted, W_predicted, E, JW


def step(rules: Rules, problem: Problem, state: State, inertia: Inertia) -> State:
    """Return one step: I1 to I3, prediction, forces, I4 and I5."""
    h = state.x.dtype.type(problem.step)
    x, _, Lambda, v_p, W_p, E, JW = rules.first_half(rules, state, inertia, h)
    a, T, F, c = evaluate(rules, problem, state, x, Lambda, v_p, W_p)
    v = rules.velocity(state.v, state.a, a, h)
    W = integrator.update_rates(state.W, JW, rules.momentum(JW, state.T, T, E, h), inertia.J_inverse)
    return replace(
        state, x=x, v=v, Lambda=Lambda, W=W, s=c.s, anchored=c.touching, sliding=c.sliding, a=a, T=T, F=F,
        t=state.origin + (state.count + 1) * problem.step, count=state.count + 1,
    )  # fmt: skip


@dataclass(frozen=True)
class Rows:
    """What a run gives back: t (N,), and W, x (..., N, 3), Lambda (..., N, 3, 3), F (..., N, n, 3), anchored (..., N,
    n)."""

    t: np.ndarray
    W: np.ndarray
    x: np.ndarray
    Lambda: np.ndarray
    F: np.ndarray
    anchored: np.ndarray

    def pick(self, index: int) -> Rows:
        """Return one run of a batch."""
        return Rows(self.t, *(getattr(self, k)[index] for k in RECORDED))


RECORDED = ("W", "x", "Lambda", "F", "anchored")


def simulate(rules: Rules, problem: Problem, dtype=None, late: int = 0, recorded: Callable = output_steps) -> Rows:
    """Run a problem, one or a batch, by these rules. A run that loses its numbers goes on with them.

    late : rows hold the state of so many steps before; recorded : numbers of the steps of the rows; for the zoo.
    """
    problem = as_arrays(problem, dtype)
    inertia = prepared_inertia(problem.block)
    with np.errstate(all="ignore"):
        state = rules.start(rules, problem)
        wanted, done, t = np.maximum(recorded(problem) - late, 0), 0, []
        columns: dict[str, list] = {k: [] for k in RECORDED}
        for count in wanted:
            for _ in range(done, int(count)):
                state = rules.step(rules, problem, state, inertia)
            done = int(count)
            t.append(state.t if not late else problem.start.t + (done + late) * problem.step)
            for key, column in columns.items():
                column.append(getattr(state, key))
    axis = len(problem.batch)
    return Rows(np.array(t), **{k: np.stack(c, axis=axis) for k, c in columns.items()})
