"""Mistakes in how the rules are put together: every piece is right, and the step or the run is not."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Rules, evaluate_contact, made
from rockref.conformance.faults.mistake import Mistake
from rockref.model.problem import Problem, State
from rockref.model.rotation import apply, apply_transposed


def old_velocities(v, a, W, A, h):
    return v, W


def half_step_velocities(v, a, W, A, h):
    return v + h / 2 * a, W + h / 2 * A


def rate_by_differences(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: penetration rate from two positions, not from the velocity."""
    k = rules.kinematics(x, Lambda, v, W, problem.points.P)
    if state.a is not None:
        before = rules.kinematics(state.x, state.Lambda, v, W, problem.points.P)
        k = k._replace(xi_rate=(k.xi - before.xi) / problem.step)
    arguments = (k.xi, k.xi_rate, k.u[..., :2], k.v_slide, state.s, state.anchored, state.sliding)
    return k, rules.point_law(rules, *arguments, made(problem.points))


def last_normal_force(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the sliding force takes the normal force of the step before."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    if state.F is None:
        return k, c
    p = made(problem.points)
    size = rules.size(c.F_trial)
    F_T = np.where(c.sliding[..., None], rules.friction(c.F_trial, size, ~c.sliding, p.mu * state.F[..., 2]), c.F_T)
    return k, c._replace(F_T=F_T, s=rules.anchor(F_T, k.u[..., :2], c.s_trial, k.v_slide, ~c.sliding, p.K_T, p.C_T))


def slip_after_the_force(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the trial force takes the places of the step before: the slip is added up after the force."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    if state.a is None:
        return k, c
    p = made(problem.points)
    before = rules.kinematics(state.x, state.Lambda, state.v, state.W, problem.points.P)
    kept = (c.touching & state.anchored & ~c.sliding)[..., None]
    late = rules.trial(before.u[..., :2], c.s_trial, k.v_slide, p.K_T, p.C_T)
    return k, c._replace(F_T=np.where(kept, late, c.F_T))


def anchor_turns_with_the_block(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the anchor is kept in body axes."""
    if state.a is None:
        return evaluate_contact(rules, problem, state, x, Lambda, v, W)
    arm = np.zeros(state.s.shape[:-1] + (3,), state.s.dtype)
    arm[..., :2] = state.s - state.x[..., None, :2]
    arm[..., 2] = -state.x[..., None, 2]
    body = apply_transposed(state.Lambda[..., None, :, :], arm)
    s = (x[..., None, :] + apply(Lambda[..., None, :, :], body))[..., :2]
    return evaluate_contact(rules, problem, replace(state, s=s), x, Lambda, v, W)


def slid_for_touched(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: what is remembered as touching is sliding."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    return k, c._replace(touching=c.sliding)


def anchor_of_the_foot_before(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: every foot is handed the anchor of another one."""
    return evaluate_contact(rules, problem, replace(state, s=np.roll(state.s, 1, axis=-2)), x, Lambda, v, W)


def one_slid_all_slid(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: whether a foot was sliding is kept once for all feet."""
    slid = np.broadcast_to(np.any(state.sliding, axis=-1, keepdims=True), state.sliding.shape)
    return evaluate_contact(rules, problem, replace(state, sliding=slid), x, Lambda, v, W)


def lever_from_the_origin(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the lever arm is counted from the origin of the plate."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    return k._replace(r=k.u), c


def lever_in_body_axes(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the lever arm is not turned."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    return k._replace(r=np.broadcast_to(problem.points.P, k.r.shape)), c


def no_first_evaluation(rules: Rules, problem: Problem) -> State:
    """Plant a fault: the first step finds no forces."""
    state = rule_set.start(rules, problem)
    if problem.start.a is not None:
        return state
    return replace(state, a=np.zeros_like(state.x), T=np.zeros_like(state.x))


def _one(**changes: Any) -> Any:
    return lambda rules: rules.replace(**changes)


OF_FLOW = (
    Mistake("Z81", "S1", "contact forces by the velocities of step n", _one(predicted=old_velocities)),
    Mistake("Z82", "S1", "contact forces by the half-step velocities", _one(predicted=half_step_velocities)),
    Mistake("Z05", "S1", "penetration rate by differences of positions", _one(contact=rate_by_differences)),
    Mistake("Z15", "T3", "sliding force by the normal force of the step before", _one(contact=last_normal_force)),
    Mistake("Z18", "T1", "slip added up after the force: a step late", _one(contact=slip_after_the_force)),
    Mistake("Z107", "T1", "trial force with the anchor of the foot before", _one(contact=anchor_of_the_foot_before)),
    Mistake("Z108", "T6", "one foot has slid: all are held to have slid", _one(contact=one_slid_all_slid)),
    Mistake("Z20", "T5", "anchor kept in body axes", _one(contact=anchor_turns_with_the_block)),
    Mistake("Z92", "T5", "the flags of touching and sliding exchanged", _one(contact=slid_for_touched)),
    Mistake("Z23", "A2", "lever arm from the origin of the plate", _one(contact=lever_from_the_origin)),
    Mistake("Z83", "A2", "lever arm left in body axes", _one(contact=lever_in_body_axes)),
    Mistake("Z33", "S2", "the first step finds no forces", _one(start=no_first_evaluation)),
    Mistake("Z84", "S2", "rows one step old", late=1),
)
