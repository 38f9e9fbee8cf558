"""Mistakes of those who show nothing but runs: each was tried on a backend of one's own, and short runs did not see it,
or gave it the name of another rule."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.rule_set import Made, Rules, Touch, evaluate_contact, point_law
from rockref.conformance.faults.mistake import Mistake
from rockref.model.integrator import times
from rockref.model.problem import Problem, State
from rockref.model.rotation import apply, cross, hat, product


def principal_axes_only(T, W, JW, J_inverse):
    """Plant a fault: Euler's equations with the diagonal of the inverse inertia."""
    diagonal = J_inverse if J_inverse.ndim == T.ndim else np.diagonal(J_inverse, axis1=-2, axis2=-1)
    return times(diagonal, T - cross(W, JW))


def no_case_for_rest(Theta):
    """Plant a fault: Rodrigues' formula without its case for no rotation."""
    with np.errstate(all="ignore"):
        angle = np.sqrt(np.sum(Theta * Theta, axis=-1))
        first, second = np.sin(angle) / angle, 2 * (np.sin(angle / 2) / angle) ** 2
        H = hat(Theta)
        return first[..., None, None] * H + second[..., None, None] * product(H, H)


def damper_ramped_up(xi, xi_rate, K_N, C_N):
    """Plant a fault: the damper grows over the first two micrometres, as some multi-body codes have it."""
    return np.maximum(K_N * xi + C_N * np.clip(xi / 2e-6, 0, 1) * xi_rate, 0)


def cut_on_the_sum(xi, xi_rate, K_N, C_N):
    """Plant a fault: tension is cut where all feet together would pull."""
    force = K_N * xi + C_N * xi_rate
    total = np.sum(np.where(xi >= 0, force, 0), axis=-1, keepdims=True)
    return np.where(total < 0, 0, force)


def small_forces_dropped(rules: Rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p: Made) -> Touch:
    """Plant a fault: a point force below one newton counts for nothing."""
    c = point_law(rules, xi, xi_rate, u_t, v_slide, s, anchored, sliding, p)
    kept = np.sqrt(c.F_N**2 + np.sum(c.F_T**2, axis=-1)) >= 1
    return c._replace(F_N=np.where(kept, c.F_N, 0), F_T=np.where(kept[..., None], c.F_T, 0))


def friction_of_the_other_feet(rules: Rules, problem: Problem, state: State, x, Lambda, v, W) -> Any:
    """Plant a fault: the coefficients of the first half of the feet and of the second exchanged."""
    points = problem.points
    half = points.mu.shape[-1] // 2
    changed = replace(points, mu=np.roll(points.mu, half, -1), mu_0=np.roll(points.mu_0, half, -1))
    return evaluate_contact(rules, replace(problem, points=changed), state, x, Lambda, v, W)


def loaded(change: Callable[[Rules, State], Rules]) -> Callable[[Rules], Rules]:
    """Return a plant that adds loads which depend on how the block moves at the begin of the step."""

    def step(rules: Rules, problem: Problem, state: State, inertia: Any) -> State:
        return rule_set.step(change(rules, state), problem, state, inertia)

    def start(rules: Rules, problem: Problem) -> State:
        return rule_set.start(change(rules, problem.start), problem)

    return lambda rules: rules.replace(step=step, start=start)


def dragged(rules: Rules, state: State) -> Rules:
    """Plant a fault: air that holds back in proportion to the velocity."""

    def force(F, mass, g):
        return rules.force(F, mass, g) - 1e-3 * np.asarray(mass)[..., None] * state.v

    return rules.replace(force=force)


def boring(rules: Rules, state: State) -> Rules:
    """Plant a fault: feet that resist a spin about the height by a moment of their own."""
    about = np.sign(apply(state.Lambda, state.W)[..., 2])

    def moment(r, F):
        M = rules.moment(r, F)
        M[..., 2] -= 1e-4 * np.sum(F[..., 2], axis=-1) * about
        return M

    return rules.replace(moment=moment)


def truncated(problem: Problem) -> np.ndarray:
    """Plant a fault: rows at the last step before their instants, not at the nearest one."""
    rows = len(rule_set.output_steps(problem))
    return np.floor(np.arange(rows) / (problem.output_rate * problem.step) + 1e-6).astype(np.int64)


def _one(**changes: Any) -> Callable[[Rules], Rules]:
    return lambda rules: rules.replace(**changes)


OF_RUNS = (
    Mistake("Z93", "I2", "products of inertia left out of Euler's equations", _one(acceleration=principal_axes_only)),
    Mistake("Z94", "A1", "a drag in the sum of forces", loaded(dragged)),
    Mistake("Z95", "S2", "rows at the last step before their instants", recorded=truncated),
    Mistake("Z96", "T6", "coefficients of other feet", _one(contact=friction_of_the_other_feet)),
    Mistake("Z97", "N1", "damper ramped up over two micrometres", _one(normal=damper_ramped_up)),
    Mistake("Z98", "N1", "tension cut on the sum of the feet", _one(normal=cut_on_the_sum)),
    Mistake("Z99", "A2", "a moment of the feet against spinning", loaded(boring)),
    Mistake("Z100", "N1", "forces below one newton dropped", _one(point_law=small_forces_dropped)),
    Mistake("Z101", "I3", "0/0 in the exponential of no rotation", _one(exponential=no_case_for_rest)),
)
