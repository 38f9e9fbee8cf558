"""Mistakes on the way from the documents to a program in another language, which the pieces or the first short runs let
through or gave the name of another rule."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Made, Rules, Touch, evaluate_contact, point_law
from rockref.conformance.faults.mistake import Mistake
from rockref.conformance.faults.whole_runs import loaded
from rockref.model.problem import Problem, State
from rockref.model.rotation import apply, cross


def gyroscopic_moment_in_plate_axes(rules: Rules, state: State, inertia: Any, h: Any) -> Any:
    """Plant a fault: the rates of the gyroscopic moment are those in plate axes, its momentum is that in body axes."""

    def acceleration(T, W, JW, J_inverse):
        return rules.acceleration(T - cross(apply(state.Lambda, W), JW), 0 * W, JW, J_inverse)

    return rule_set.first_half(rules.replace(acceleration=acceleration), state, inertia, h)


def attitude_of_the_step_before(rules: Rules, state: State) -> Rules:
    """Plant a fault: the moment is turned into the body axes that the block had at the begin of the step."""
    return rules.replace(body_moment=lambda Lambda, M: rules.body_moment(state.Lambda, M))


def read_column_by_column(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the points (n, 3), a list of rows, are taken for a list of columns."""
    P = problem.points.P
    turned = P.reshape(*P.shape[:-2], 3, P.shape[-2]).swapaxes(-1, -2)
    changed = replace(problem, points=replace(problem.points, P=turned))
    return evaluate_contact(rules, changed, state, x, Lambda, v, W)


def one_array_of_anchors(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: all feet share the place of one anchor, in which the last foot writes last."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    return k, c._replace(s=np.broadcast_to(c.s[..., -1:, :], c.s.shape).copy())


def sliding_velocity_before(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the sliding velocity takes the velocities of the step before, the penetration rate the predicted
    ones."""
    k = rules.kinematics(x, Lambda, v, W, problem.points.P)
    k = k._replace(v_slide=rules.kinematics(x, Lambda, state.v, state.W, problem.points.P).v_slide)
    arguments = (k.xi, k.xi_rate, k.u[..., :2], k.v_slide, state.s, state.anchored, state.sliding)
    return k, rules.point_law(rules, *arguments, rule_set.made(problem.points))


def opens_late(xi, u_t, s, had_anchor):
    touching = (xi >= 0) | (had_anchor & (xi > -1e-7))
    return np.where((touching & had_anchor)[..., None], s, u_t), touching


def whole_numbers(size, limit):
    return np.trunc(size) <= limit


def slid_until_it_opens(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: a foot that has slid is flagged as sliding until it opens."""
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    return c._replace(sliding=c.sliding | (c.touching & anchored & sliding))


def no_force_below_a_nanometre(xi, xi_rate, K_N, C_N):
    return np.where(xi > 1e-9, np.maximum(K_N * xi + C_N * xi_rate, 0), 0)


def no_force_below_a_millinewton(xi, xi_rate, K_N, C_N):
    F_N = np.maximum(K_N * xi + C_N * xi_rate, 0)
    return np.where(F_N < 1e-3, 0, F_N)


def at_home(problem: Problem) -> Problem:
    """Return the problem with the source's gravity."""
    return replace(problem, block=replace(problem.block, g=0 * problem.block.g + 9.81))


def gravity_in_the_step(rules: Rules) -> Rules:
    """Plant a fault: the sums take the gravity that they are given; step and start hand them the source's."""

    def step(rules: Rules, problem: Problem, state: State, inertia: Any) -> State:
        return rule_set.step(rules, at_home(problem), state, inertia)

    def start(rules: Rules, problem: Problem) -> State:
        return rule_set.start(rules, at_home(problem))

    return rules.replace(step=step, start=start)


def _one(**changes: Any) -> Callable[[Rules], Rules]:
    return lambda rules: rules.replace(**changes)


OF_PORTS = (
    Mistake("Z123", "I2", "gyroscopic moment by the rates in plate axes",
            _one(first_half=gyroscopic_moment_in_plate_axes)),
    Mistake("Z124", "A3", "moment turned back by the attitude of the step before", loaded(attitude_of_the_step_before)),
    Mistake("Z125", "K1", "points read column by column", _one(contact=read_column_by_column)),
    Mistake("Z126", "T5", "one array for the anchors of all feet", _one(contact=one_array_of_anchors)),
    Mistake("Z127", "S1", "sliding velocity of the step before", _one(contact=sliding_velocity_before)),
    Mistake("Z128", "T5", "contact ends a tenth of a micrometre above the plate", _one(touch=opens_late)),
    Mistake("Z129", "T2", "trial force cut to whole newtons", _one(sticks=whole_numbers)),
    Mistake("Z130", "T2", "who has slid is flagged until it opens", _one(point_law=slid_until_it_opens)),
    Mistake("Z131", "N1", "no force below a nanometre of depth", _one(normal=no_force_below_a_nanometre)),
    Mistake("Z132", "N1", "no force below a millinewton", _one(normal=no_force_below_a_millinewton)),
    Mistake("Z133", "A1", "the source's gravity in the step alone", gravity_in_the_step),
)  # fmt: skip
