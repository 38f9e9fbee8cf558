"""Mistakes in what is kept: digits, what a foot remembers, the clock, the start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Made, Rules, Touch, evaluate_contact, point_law
from rockref.conformance.faults.mistake import Mistake
from rockref.model.problem import Problem, State
from rockref.model.rotation import cross, product


def cut(a: np.ndarray) -> np.ndarray:
    """Return numbers cut to single precision."""
    return np.asarray(a).astype(np.float32).astype(np.asarray(a).dtype)


def cut_result(name: str) -> Callable[[Rules], Rules]:
    """Return a plant that cuts what a rule gives to single precision."""

    def plant(rules: Rules) -> Rules:
        right = getattr(rules, name)
        return rules.replace(**{name: lambda *given: cut(right(*given))})

    return plant


def levers_cut(rules: Rules) -> Rules:
    """Plant a fault: levers in single precision, and what is made of them."""

    def kinematics(x, Lambda, v, W, P):
        k = rules.kinematics(x, Lambda, v, W, P)
        r = cut(k.r)
        u, u_rate = x[..., None, :] + r, v[..., None, :] + cross(rules_rate(Lambda, W), r)
        return k._replace(r=r, u=u, u_rate=u_rate, xi=-u[..., 2], xi_rate=-u_rate[..., 2], v_slide=u_rate[..., :2])

    return rules.replace(kinematics=kinematics)


def rules_rate(Lambda, W):
    """Return rates in plate axes, one row for all feet."""
    return np.einsum("...ij,...j->...i", Lambda, W)[..., None, :]


def way_cut(x, v, a, h):
    return x + cut(h * v + h * h / 2 * a)


def increment_cut(Lambda, E):
    return Lambda + product(Lambda, cut(E))


def no_damper_at_first_touch(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    rate = np.where(anchored, xi_rate, 0 * xi_rate)
    return point_law(rules, xi, rate, u_t, v_slide, s, anchored, sliding, p)


def slid_is_anchored_anew(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: a foot that slid is tied where it is; that it slid is known."""
    s = np.where((anchored & sliding)[..., None], u_t, s)
    return point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)


def opened_and_still_slid(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: a foot that slid before it opened still counts as sliding when it touches."""
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    return c._replace(sliding=np.where(c.touching, c.sliding, sliding))


def stiffer_when_deep(xi, xi_rate, K_N, C_N):
    return np.maximum(K_N * (xi + 4 * np.maximum(xi - 3e-4, 0)) + C_N * xi_rate, 0)


def never_without_friction(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: coefficients below a hundredth are taken for one."""
    p = p._replace(mu_0=np.maximum(p.mu_0, 0.01), mu=np.maximum(p.mu, 0.01))
    return point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)


def friction_at_the_anchor(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: friction turns the block from where the anchor is, not from where the foot is."""
    k, c = evaluate_contact(rules, problem, state, x, Lambda, v, W)
    r = k.r.copy()
    r[..., :2] = np.where(c.touching[..., None], c.s - x[..., None, :2], r[..., :2])
    return k._replace(r=r), c


def clock_added_up(problem: Problem) -> np.ndarray:
    """Plant a fault: rows at the steps at which a clock in single precision, added up step by step, passes their
    instants."""
    wanted = rule_set.output_steps(problem)
    clock = np.cumsum(np.full(int(wanted[-1]) + 1, problem.step, np.float32), dtype=np.float32) - np.float32(
        problem.step
    )
    rows = np.searchsorted(clock, wanted * problem.step - problem.step / 2)
    return np.minimum(rows, wanted[-1])


def evaluated_anew(rules: Rules, problem: Problem) -> State:
    """Plant a fault: the forces that a start brings are not taken."""
    return rule_set.start(rules, replace(problem, start=replace(problem.start, a=None, T=None, F=None)))


def _one(**changes: Any) -> Callable[[Rules], Rules]:
    return lambda rules: rules.replace(**changes)


OF_MEMORY = (
    Mistake("Z109", "T1", "trial force in single precision", cut_result("trial"), digits=True),
    Mistake("Z110", "A1", "sum of the forces in single precision", cut_result("force"), digits=True),
    Mistake("Z111", "A2", "sum of the moments in single precision", cut_result("moment"), digits=True),
    Mistake("Z112", "K1", "levers in single precision", levers_cut, digits=True),
    Mistake("Z113", "I1", "way of a step in single precision", _one(position=way_cut), digits=True),
    Mistake("Z114", "I3", "increment of the pose in single precision", _one(rotation=increment_cut), digits=True),
    Mistake("Z115", "N1", "no damper at the first touch", _one(point_law=no_damper_at_first_touch)),
    Mistake("Z116", "T5", "a foot that slid is anchored anew", _one(point_law=slid_is_anchored_anew)),
    Mistake("Z117", "T5", "a foot that opens keeps that it slid", _one(point_law=opened_and_still_slid)),
    Mistake("Z118", "N1", "stiffer from 0.3 mm on", _one(normal=stiffer_when_deep)),
    Mistake("Z119", "T3", "never without friction", _one(point_law=never_without_friction)),
    Mistake("Z120", "A2", "friction attacks at the anchor", _one(contact=friction_at_the_anchor)),
    Mistake("Z121", "S2", "clock added up in single precision", recorded=clock_added_up),
    Mistake("Z122", "S2", "every start evaluated anew", _one(start=evaluated_anew)),
)
