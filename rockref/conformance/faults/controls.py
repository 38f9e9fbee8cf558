"""Controls: other ways to compute the same. The judge must pass them all."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.conformance.backends import rule_set
from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.backends.rule_set import Rules
from rockref.model.assembly import resultant_force, resultant_moment
from rockref.model.contact import Kinematics
from rockref.model.integrator import Inertia, angular_acceleration, times
from rockref.model.problem import Problem, State, stack
from rockref.model.rotation import apply, apply_transposed, cross, from_quaternion, hat, product, quaternion


@dataclass(frozen=True)
class Control:
    """Something that is no mistake: id, one line, and the backend that does it."""

    id: str
    says: str
    make: Any

    def backend(self) -> Any:
        """Return a backend that does it."""
        return self.make()


def _rules(**changes: Any) -> Any:
    return lambda: RulesBackend(rule_set.law().replace(**changes))


def reversed_force(F, mass, g):
    return resultant_force(F[..., ::-1, :], mass, g)


def reversed_moment(r, F):
    return resultant_moment(r[..., ::-1, :], F[..., ::-1, :])


def pairwise_force(F, mass, g):
    even, odd = resultant_force(F[..., ::2, :], mass, g), resultant_force(F[..., 1::2, :], mass, 0 * g)
    return even + odd


def by_quaternions(Lambda, E):
    """Return Lambda exp(Theta^) as a product of unit quaternions, normalised."""
    p = quaternion(Lambda)
    # The quaternion of a small turn from its matrix less one: v = axis part of E / 4w.
    w = np.sqrt(1 + (E[..., 0, 0] + E[..., 1, 1] + E[..., 2, 2]) / 4)
    v = np.stack([E[..., 2, 1] - E[..., 1, 2], E[..., 0, 2] - E[..., 2, 0], E[..., 1, 0] - E[..., 0, 1]], -1)
    v = v / (4 * w)[..., None]
    a, b = p[..., 0], p[..., 1:]
    q = np.empty_like(p)
    q[..., 0] = a * w - (b[..., 0] * v[..., 0] + b[..., 1] * v[..., 1] + b[..., 2] * v[..., 2])
    q[..., 1:] = a[..., None] * v + w[..., None] * b + cross(b, v)
    return from_quaternion(q)


def orthonormalised(Lambda, E):
    """Return the pose made orthogonal again in every step, by one Newton step towards it."""
    L = Lambda + product(Lambda, E)
    return L * L.dtype.type(1.5) - product(L, product(L.swapaxes(-1, -2), L)) / 2


def open_at_zero(xi, F_N):
    return np.where(xi > 0, F_N, 0)


def touch_above_zero(xi, u_t, s, had_anchor):
    touching = xi > 0
    return np.where((touching & had_anchor)[..., None], s, u_t), touching


def by_hypot(F):
    return np.hypot(F[..., 0], F[..., 1])


def by_sine_and_cosine(Theta):
    """Return Rodrigues' formula with the library's sine."""
    q = np.sqrt(np.sum(Theta * Theta, axis=-1))
    safe = np.where(q > 0, q, 1)
    first = np.where(q > 0, np.sin(safe) / safe, 1)[..., None, None]
    second = np.where(q > 0, 2 * (np.sin(safe / 2) / safe) ** 2, 0.5)[..., None, None]
    H = hat(Theta)
    return first * H + second * product(H, H)


def fused(a, b, c):
    """Return a b + c rounded once, as a processor with fused multiply-add gives it (through longdouble)."""
    wide = np.longdouble
    return (np.asarray(a, wide) * np.asarray(b, wide) + np.asarray(c, wide)).astype(np.float64)


def _turned(A, P):
    B = A[..., None, :, :]
    return fused(B[..., 0], P[..., 0:1], fused(B[..., 1], P[..., 1:2], B[..., 2] * P[..., 2:3]))


def fused_kinematics(x, Lambda, v, W, P):
    r = _turned(Lambda, P)
    omega = _turned(Lambda, W[..., None, :])
    u = x[..., None, :] + r
    turning = np.stack(
        [
            fused(omega[..., (i + 1) % 3], r[..., (i + 2) % 3], -omega[..., (i + 2) % 3] * r[..., (i + 1) % 3])
            for i in range(3)
        ],
        -1,
    )
    u_rate = v[..., None, :] + turning
    return Kinematics(r, u, u_rate, -u[..., 2], -u_rate[..., 2], u_rate[..., :2])


FUSED = {
    "position": lambda x, v, a, h: fused(h * h / 2, a, fused(h, v, x)),
    "velocity": lambda v, a, a_next, h: fused(h / 2, a + a_next, v),
    "increment": lambda W, A, h: fused(h, W, h * h / 2 * A),
    "normal": lambda xi, xi_rate, K_N, C_N: np.maximum(fused(K_N, xi, C_N * xi_rate), 0),
    "trial": lambda u_t, s, v, K_T, C_T: fused(K_T[..., None], s - u_t, -C_T[..., None] * v),
    "kinematics": fused_kinematics,
}


def divided_gyroscopic_term(T, W, JW, J_inverse):
    """Return Euler's equations with the products in another order."""
    return angular_acceleration(T + cross(JW, W), 0 * W, JW, J_inverse)


def by_squares(F):
    """Return the length by the root of squares: zero below 1e-162."""
    return np.sqrt(F[..., 0] * F[..., 0] + F[..., 1] * F[..., 1])


def along_an_angle(F_trial, size, stick, mu_F_N):
    """Return the sliding force by the angle of the trial force."""
    angle = np.arctan2(F_trial[..., 1], F_trial[..., 0])
    along = mu_F_N[..., None] * np.stack([np.cos(angle), np.sin(angle)], -1)
    return np.where(stick[..., None], F_trial, along)


def drawn_anew(right):
    """Return a sum over the feet in an order that is drawn anew each time."""

    def summed(*given):
        feet = [i for i, a in enumerate(given) if np.ndim(a) >= 2]
        order = np.random.default_rng().permutation(given[feet[0]].shape[-2])
        return right(*(a[..., order, :] if i in feet else a for i, a in enumerate(given)))

    return summed


def momentum_in_plate_axes(rules: Rules, problem: Problem, state: State, inertia: Inertia) -> State:
    """Return the rates from Lambda J W, the momentum in plate axes."""
    after, h = rule_set.step(rules, problem, state, inertia), state.x.dtype.type(problem.step)
    assert state.T is not None and after.T is not None
    moments = apply(state.Lambda, state.T) + apply(after.Lambda, after.T)
    L = apply(state.Lambda, times(inertia.J, state.W)) + h / 2 * moments
    return replace(after, W=times(inertia.J_inverse, apply_transposed(after.Lambda, L)))


class Permuted(RulesBackend):
    """The points taken in another order inside, put back in the results."""

    order = np.array([5, 2, 7, 0, 3, 6, 1, 4])

    def simulate(self, problem: Problem) -> Any:
        """Return a run."""
        if problem.points.n != len(self.order):
            return super().simulate(problem)
        rows, back = super().simulate(self._shuffled(problem)), np.argsort(self.order)
        return replace(rows, F=rows.F[:, back], anchored=rows.anchored[:, back])

    def simulate_many(self, problems: list[Problem]) -> list[Any]:
        """Return runs, one batch."""
        if problems[0].points.n != len(self.order):
            return super().simulate_many(problems)
        back = np.argsort(self.order)
        found = super().simulate_many([self._shuffled(p) for p in problems])
        return [replace(r, F=r.F[:, back], anchored=r.anchored[:, back]) for r in found]

    def _shuffled(self, problem: Problem) -> Problem:
        p, s, o = problem.points, problem.start, self.order
        per_point = {k: getattr(p, k)[o] for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
        kept = ("s", "anchored", "sliding") if s.F is None else ("s", "anchored", "sliding", "F")
        memory = {k: getattr(s, k)[o] for k in kept}
        return replace(problem, points=replace(p, **per_point), start=replace(s, **memory))


class InCompany(RulesBackend):
    """Every run computed in a batch with another one beside it."""

    def simulate(self, problem: Problem) -> Any:
        """Return a run."""
        other = replace(problem, start=replace(problem.start, v=problem.start.v + 0.125))
        return rule_set.simulate(self.rules, stack([other, problem]), self.dtype).pick(1)


CONTROLS = (
    Control("C01", "the law itself", RulesBackend),
    Control("C02", "points summed from the last to the first", _rules(force=reversed_force, moment=reversed_moment)),
    Control("C03", "points summed in two halves", _rules(force=pairwise_force)),
    Control("C04", "points in another order throughout", Permuted),
    Control("C05", "quaternions for matrices", _rules(rotation=by_quaternions)),
    Control("C06", "pose made orthogonal again in every step", _rules(rotation=orthonormalised)),
    Control("C07", "> for >= at zero penetration", _rules(gap=open_at_zero, touch=touch_above_zero)),
    Control("C08", "hypot for the length", _rules(size=by_hypot)),
    Control("C09", "sine and cosine for the series", _rules(exponential=by_sine_and_cosine)),
    Control("C10", "fused multiply-add", _rules(**FUSED)),
    Control("C11", "longdouble", lambda: RulesBackend(dtype=np.longdouble)),
    Control("C12", "side by side with another run", InCompany),
    Control("C13", "gyroscopic term with its factors exchanged", _rules(acceleration=divided_gyroscopic_term)),
    Control("C14", "the root of squares for the length", _rules(size=by_squares)),
    Control("C15", "directions of sliding by atan2, cosine and sine", _rules(friction=along_an_angle)),
    Control(
        "C16",
        "points summed in an order that is drawn anew each time",
        _rules(force=drawn_anew(resultant_force), moment=drawn_anew(resultant_moment)),
    ),
    Control("C17", "momentum in plate axes", _rules(step=momentum_in_plate_axes)),
)
