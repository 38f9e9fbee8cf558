"""The same physics by another integrator: kick and drift, with the same rules of contact.

It shows what the profile "scheme" is for, and is one of the two schemes from which its bars were measured.
"""

from __future__ import annotations

from dataclasses import replace

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.law import RulesBackend
from rockref.model.integrator import Inertia, times
from rockref.model.problem import Problem, State


def kick_and_drift(rules: rule_set.Rules, problem: Problem, state: State, inertia: Inertia) -> State:
    """Advance by symplectic Euler: velocities by the forces at n, then positions by the new velocities, then the forces
    there."""
    h = state.x.dtype.type(problem.step)
    v = state.v + h * state.a
    W = state.W + h * rules.acceleration(state.T, state.W, times(inertia.J, state.W), inertia.J_inverse)
    x = state.x + h * v
    Lambda = rules.rotation(state.Lambda, rules.exponential(h * W))
    a, T, F, c = rule_set.evaluate(rules, problem, state, x, Lambda, v, W)
    return replace(
        state, x=x, v=v, Lambda=Lambda, W=W, s=c.s, anchored=c.touching, sliding=c.sliding, a=a, T=T, F=F,
        t=state.origin + (state.count + 1) * problem.step, count=state.count + 1,
    )  # fmt: skip


class KickAndDrift(RulesBackend):
    """A backend with another integrator; it shows the pieces of contact, and none of the step."""

    step = integrate = None  # type: ignore[assignment]

    def __init__(self) -> None:
        super().__init__(rule_set.law().replace(step=kick_and_drift), name="kick and drift")
