"""Mistakes of habit: what engines do of themselves, and what a program takes for granted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Rows, Rules, evaluate_contact
from rockref.conformance.faults.mistake import Mistake
from rockref.model import integrator
from rockref.model.contact import kelvin_voigt, point_kinematics
from rockref.model.problem import Problem, State
from rockref.model.rotation import apply, apply_transposed, exp_minus_identity, hat


def put_to_rest(v, a, a_next, h):
    v_next = integrator.update_velocity(v, a, a_next, h)
    return np.where(np.abs(v_next) < 1e-6, 0 * v_next, v_next)


def first_order_when_small(Theta):
    small = np.sqrt(np.sum(Theta * Theta, axis=-1)) < 1e-4
    return np.where(small[..., None, None], hat(Theta), exp_minus_identity(Theta))


def eight_feet(xi, xi_rate, K_N, C_N):
    F_N = kelvin_voigt(xi, xi_rate, K_N, C_N)
    return np.where(np.arange(F_N.shape[-1]) < 8, F_N, 0 * F_N)


def levers_to_the_plate(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: forces attack at the surface of the plate, not at the foot below it."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    r = k.r.copy()
    r[..., 2] += np.maximum(k.xi, 0)
    return k._replace(r=r), c


def anchors_in_the_body(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: anchors turn with the block from one step to the next."""
    s = np.concatenate([state.s, np.zeros_like(state.s[..., :1])], axis=-1)
    back, forth = state.Lambda[..., None, :, :], Lambda[..., None, :, :]
    turned = apply(forth, apply_transposed(back, s))[..., :2]
    return evaluate_contact(rules, problem, replace(state, s=turned), x, Lambda, v, W)


def lifted(rules: Rules, problem: Problem) -> State:
    """Plant a fault: a block that overlaps the plate at the start is lifted out of it."""
    start = problem.start
    xi = point_kinematics(start.x, start.Lambda, start.v, start.W, problem.points.P).xi
    up = np.maximum(np.max(xi, axis=-1), 0)[..., None] * np.array([0.0, 0.0, 1.0])
    return rule_set.start(rules, replace(problem, start=replace(start, x=start.x + up)))


def flags_of_the_row_before(rows: Rows) -> Rows:
    late = np.concatenate([rows.anchored[..., :1, :], rows.anchored[..., :-1, :]], axis=-2)
    return replace(rows, anchored=late)


def _one(**changes: Any) -> Callable[[Rules], Rules]:
    return lambda rules: rules.replace(**changes)


OF_HABITS = (
    Mistake("Z134", "I4", "velocities below a micrometre a second are rest", _one(velocity=put_to_rest)),
    Mistake("Z135", "I3", "turns below 1e-4 rad to first order", _one(exponential=first_order_when_small)),
    Mistake("Z136", "N1", "no more than eight feet", _one(normal=eight_feet)),
    Mistake("Z137", "A2", "levers to the surface of the plate", _one(contact=levers_to_the_plate)),
    Mistake("Z138", "T5", "anchors turn with the block", _one(contact=anchors_in_the_body)),
    Mistake("Z139", "S2", "a start that overlaps is lifted", _one(start=lifted)),
    Mistake("Z140", "S2", "flags of the row before", report=flags_of_the_row_before),
)
