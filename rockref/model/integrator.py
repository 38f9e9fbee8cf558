"""One step of Simo & Wong's explicit algorithm, and the force evaluation in it.

Source: J. C. Simo, K. K. Wong (1991), Unconditionally stable algorithms for rigid body dynamics that exactly preserve
energy and momentum, Int. J. Numer. Methods Eng. 31:19-52, doi:10.1002/nme.1620310103. Without external moment the
spatial angular momentum Lambda J W is conserved to rounding.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from rockref.model import assembly, contact
from rockref.model.base_motion import inertial_force, plate_acceleration
from rockref.model.contact import Kinematics
from rockref.model.problem import Block, Problem, State, complete_state
from rockref.model.rotation import apply, apply_transposed, cross, empty, exp_minus_identity, inverse, product


class Contact(NamedTuple):
    """What the points do at one instant.

    t : time [s];  k : Kinematics;  touching, sliding : (..., n) bool;  s : (..., n, 2) anchors [m]
    F_N : (..., n) normal force [N];  F : (..., n, 3) force of the plate on each point, plate axes [N]
    turn : (..., 3) rotation since the last evaluation, plate axes [rad]
    """

    t: float
    k: Kinematics
    touching: np.ndarray
    sliding: np.ndarray
    s: np.ndarray
    F_N: np.ndarray
    F: np.ndarray
    turn: np.ndarray | None


class Inertia(NamedTuple):
    """J [kg m2] and its inverse in body axes: (..., 3, 3), or their diagonals (..., 3) where the axes are principal."""

    J: np.ndarray
    J_inverse: np.ndarray


def prepared_inertia(block: Block) -> Inertia:
    """Return the inertia as the step uses it: as a diagonal, which costs a tenth, where the body axes are principal.

    A batch needs full matrices as soon as one of its blocks does. The others keep the inverse that they have alone,
    1 / J: that by cofactors differs from it in the last bit.
    """
    J = block.inertia
    diagonal = np.arange(3), np.arange(3)
    principal = empty(J.shape[:-2], (3,), J.dtype)
    principal[...] = J[(..., *diagonal)]
    is_principal = np.count_nonzero(J, axis=(-2, -1)) == np.count_nonzero(principal, axis=-1)
    if np.all(is_principal):
        return Inertia(principal, 1 / principal)
    J_inverse = np.empty_like(J)
    J_inverse[...] = inverse(J)
    J_inverse[is_principal] = (1 / principal[is_principal])[..., None] * np.eye(3)
    return Inertia(J, J_inverse)


def times(J: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Return J a for an inertia given as matrix or as diagonal; a (..., 3)."""
    return J * a if J.ndim == a.ndim else apply(J, a)


def update_position(x, v, a, h):
    """Rule I1: x at n+1, from position [m], velocity [m/s] and acceleration [m/s2] at n. All (..., 3)."""
    return x + h * v + (h * h / 2) * a  # I1


def rotation_increment(W, A, h):
    """Rule I2: the rotation vector of the step, Theta [rad], in body axes. All (..., 3)."""
    return h * W + (h * h / 2) * A  # I2


def update_rotation(Lambda, E):
    """Rule I3: Lambda exp(Theta^) at n+1, with E = exp(Theta^) - I. All (..., 3, 3)."""
    return Lambda + product(Lambda, E)  # I3


def update_velocity(v, a, a_next, h):
    """Rule I4: v at n+1 [m/s], from the accelerations at n and n+1. All (..., 3)."""
    return v + (h / 2) * (a + a_next)  # I4


def update_momentum(JW, T, T_next, E, h):
    """Rule I5: J W at n+1 [kg m2/s], body axes: the momentum and half the moment turned back, half the new moment.

    JW, T, T_next : (..., 3); E = exp(Theta^) - I, whose transpose is exp(-Theta^) - I.
    """
    half = JW + (h / 2) * T
    return half + apply_transposed(E, half) + (h / 2) * T_next  # I5


def update_rates(W, JW, JW_next, J_inverse):
    """Return W at n+1 [rad/s] from J W at n and n+1 [kg m2/s], body axes, by its increment. All (..., 3); J^-1 as in
    `times`.

    J^-1 (J W) is W but for a rounding that is the same in every step: over 1e5 steps it would add up to 1e-12 of the
    angular momentum. The increment is small, and so is what is rounded of it.
    """
    return W + times(J_inverse, JW_next - JW)


def angular_acceleration(T, W, JW, J_inverse):
    """Return A = J^-1 (T - W x J W) [rad/s2], body axes (Euler's equations). All (..., 3); J^-1 as in `times`."""
    return times(J_inverse, T - cross(W, JW))


def acting(problem: Problem, memory) -> tuple:
    """Return pairs of effect and memory, in the order in which they act; none for the law alone."""
    return tuple(zip(problem.effects, memory, strict=True)) if problem.effects else ()


def plate_motion(effects, t: float):
    """Return displacement and velocity of the plate, two (..., 3), summed over the effects; None while it is fixed.

    Where an effect turns it, its turn and the rate of that follow.

    effects : pairs of effect and memory; t : time [s].
    """
    motions = [effect.plate_motion(t, m) for effect, m in effects]
    motions = [motion for motion in motions if motion is not None]
    most = max(map(len, motions), default=0)
    return tuple(sum(motion[k] for motion in motions if k < len(motion)) for k in range(most)) or None


def evaluate_contact(problem: Problem, state: State, x, Lambda, v, W, turn, t, memory) -> Contact:
    """Apply rules K1 to T6 for all points at one instant, with the effects that act on them.

    `state` brings the anchors of the last step; `turn` (..., 3) [rad, plate axes] is the rotation since then, which
    only round feet and some effects need; `memory` holds one mapping per effect, whose entries it may replace.
    """
    points, effects = problem.points, acting(problem, memory)
    plate = plate_motion(effects, t) if effects else None
    k = contact.point_kinematics(x, Lambda, v, W, points.P, points.radius, plate)
    u_t = k.u[..., :2]

    if effects:
        F_N = contact.altered_normal_force(k, points, effects)
    else:
        F_N = contact.open_gap(k.xi, contact.kelvin_voigt(k.xi, k.xi_rate, points.K_N, points.C_N))
    mu_0, mu = points.mu_0, points.mu
    for effect, m in effects:
        mu_0, mu = effect.friction_coefficient(mu_0, mu, F_N, k, points, m)

    s_before = state.s if points.radius is None else contact.roll_anchor(state.s, points.radius, turn)
    s, touching = contact.touch(k.xi, u_t, s_before, state.anchored)
    F_trial = contact.trial_force(u_t, s, k.v_slide, points.K_T, points.C_T)
    size = contact.norm(F_trial)
    stick = contact.sticks(size, contact.threshold(F_N, state.sliding & touching, mu_0, mu))
    F_T = contact.radial_return(F_trial, size, stick, mu * F_N)
    s = contact.move_anchor(F_T, u_t, s, k.v_slide, stick, points.K_T, points.C_T)

    F = np.empty_like(k.u)
    F[..., :2] = F_T
    F[..., 2] = F_N
    if problem.first_by_share:
        F = contact.share_of_first(k.xi, k.xi_rate, problem.step)[..., None] * F
        F_N = F[..., 2]
    return Contact(t, k, touching, touching & ~stick, s, F_N, F, turn)


def resultants(problem: Problem, c: Contact, x, Lambda, v, W, memory) -> tuple[np.ndarray, np.ndarray]:
    """Apply rules A1 to A3 and B1 with the effects that add loads: acceleration [m/s2], body moment [N m], (..., 3)."""
    block = problem.block
    force = assembly.resultant_force(c.F, block.mass, block.g)
    moment = assembly.resultant_moment(c.k.r, c.F)
    if problem.base is not None:
        force = force + inertial_force(block.mass, plate_acceleration(problem.base, c.t))
    for effect, m in acting(problem, memory):
        for load in (effect.point_wrench(problem, c, m), effect.body_wrench(problem, c, x, Lambda, v, W, m)):
            if load is not None:
                force, moment = force + load[0], moment + load[1]
    return force / block.mass[..., None], assembly.body_moment(Lambda, moment)


def evaluate(problem: Problem, state: State, x, Lambda, v, W, turn, t):
    """Return one force evaluation: acceleration, body moment, contact, and the memories of the effects afterwards."""
    memory = tuple(dict(m) for m in state.memory)
    c = evaluate_contact(problem, state, x, Lambda, v, W, turn, t, memory)
    a, T = resultants(problem, c, x, Lambda, v, W, memory)
    return a, T, c, memory


def first_evaluation(problem: Problem) -> State:
    """Return the start with accelerations, anchors, forces and memories filled in, as the first step needs them.

    A state that comes from a run has them already; it is left as it is, so that the run continues bit for bit.
    """
    state = problem.start
    if state.h != problem.step:
        state = replace(state, origin=state.t, count=0, h=problem.step)
    if len(state.memory) != len(problem.effects):
        state = replace(state, memory=tuple(effect.start(problem) for effect in problem.effects))
    if state.a is not None and state.T is not None and state.F is not None:
        return state
    no_turn = np.zeros_like(state.W)
    a, T, c, memory = evaluate(problem, state, state.x, state.Lambda, state.v, state.W, no_turn, state.t)
    return replace(state, a=a, T=T, F=c.F, s=c.s, anchored=c.touching, sliding=c.sliding, memory=memory)


def step(problem: Problem, state: State, inertia: Inertia) -> State:
    """Apply rules I1 to I5: the state one step of length h later.

    Decided (the source is silent): the contact forces at n+1 take x and Lambda at n+1 and the velocities predicted
    from n, v + h a and W + h A, so that a step costs one force evaluation.
    """
    h = state.x.dtype.type(problem.step)
    JW = times(inertia.J, state.W)
    A = angular_acceleration(state.T, state.W, JW, inertia.J_inverse)

    x = update_position(state.x, state.v, state.a, h)
    Theta = rotation_increment(state.W, A, h)
    E = exp_minus_identity(Theta)
    Lambda = update_rotation(state.Lambda, E)

    t = state.origin + (state.count + 1) * problem.step
    turn = apply(state.Lambda, Theta) if problem.effects or problem.points.radius is not None else None
    a, T, c, memory = evaluate(problem, state, x, Lambda, state.v + h * state.a, state.W + h * A, turn, t)
    for effect, m in acting(problem, memory):
        effect.advance(problem, c, h, m)

    v = update_velocity(state.v, state.a, a, h)
    W = update_rates(state.W, JW, update_momentum(JW, state.T, T, E, h), inertia.J_inverse)
    return complete_state(
        x=x, v=v, Lambda=Lambda, W=W, s=c.s, anchored=c.touching, sliding=c.sliding, a=a, T=T, F=c.F,
        t=t, origin=state.origin, count=state.count + 1, h=state.h, memory=memory,
    )  # fmt: skip
