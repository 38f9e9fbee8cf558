"""Energy of the block and of the contact springs, and the work that the contacts take from the block.

kinetic + potential + stored + dissipated = constant, in the limit of small steps. The dissipated part is what the
contacts took and did not store: dampers, sliding, springs that relax behind the no-tension cut, anchors that are lost.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.model.contact import point_kinematics
from rockref.model.integrator import first_evaluation, prepared_inertia, step
from rockref.model.problem import Problem, State, as_arrays
from rockref.model.rotation import apply, dot


class Energy(NamedTuple):
    """Energies [J], each (...)."""

    kinetic: np.ndarray
    potential: np.ndarray
    stored_normal: np.ndarray
    stored_tangential: np.ndarray

    @property
    def mechanical(self) -> np.ndarray:
        """Kinetic and potential energy of the block [J]."""
        return self.kinetic + self.potential

    @property
    def total(self) -> np.ndarray:
        """Mechanical energy and what the contact springs store [J]."""
        return self.kinetic + self.potential + self.stored_normal + self.stored_tangential


def kinetic_energy(v: np.ndarray, W: np.ndarray, mass: np.ndarray, J: np.ndarray) -> np.ndarray:
    """m v.v / 2 + W.J W / 2 [J]; v, W (..., 3); mass (...); J (..., 3, 3)."""
    return mass * dot(v, v) / 2 + dot(W, apply(J, W)) / 2


def potential_energy(x: np.ndarray, mass: np.ndarray, g: np.ndarray) -> np.ndarray:
    """m g z [J]; x (..., 3)."""
    return mass * g * x[..., 2]


def spring_energy(xi, touching, u_t, s, K_N, K_T) -> tuple[np.ndarray, np.ndarray]:
    """What the normal and the tangential springs of the touching points store [J], two (...)."""
    stretch = u_t - s
    normal = np.where(touching, K_N * xi * xi / 2, 0)
    tangential = np.where(touching, K_T * (stretch[..., 0] ** 2 + stretch[..., 1] ** 2) / 2, 0)
    return np.sum(normal, axis=-1), np.sum(tangential, axis=-1)


def energy(problem: Problem, state: State) -> Energy:
    """The energies at a state of the plain law (effects may store more)."""
    block, points = problem.block, problem.points
    k = point_kinematics(state.x, state.Lambda, state.v, state.W, points.P, points.radius)
    stored = spring_energy(k.xi, state.anchored, k.u[..., :2], state.s, points.K_N, points.K_T)
    return Energy(
        kinetic_energy(state.v, state.W, block.mass, block.inertia),
        potential_energy(state.x, block.mass, block.g),
        *stored,
    )


def contact_work(problem: Problem, before: State, after: State) -> np.ndarray:
    """Work that the contacts take from the block in one step [J], (...): -sum of mean force times way of the point.

    Both states come from a step, or from `first_evaluation`: they bring their point forces.
    """
    points = problem.points
    u_before, u_after = (point_kinematics(s.x, s.Lambda, s.v, s.W, points.P, points.radius).u for s in (before, after))
    mean_force = (np.asarray(before.F) + np.asarray(after.F)) / 2
    return -np.sum(mean_force * (u_after - u_before), axis=(-1, -2))


class Balance(NamedTuple):
    """Energy account of a run, a row a step: t (steps+1,) [s]; energies and work so far (steps+1, ...) [J]."""

    t: np.ndarray
    mechanical: np.ndarray
    stored: np.ndarray
    work: np.ndarray

    @property
    def dissipated(self) -> np.ndarray:
        """Work taken by the contacts and not stored in their springs [J]."""
        return self.work - (self.stored - self.stored[0])

    @property
    def residual(self) -> np.ndarray:
        """What the step itself creates or loses: mechanical energy plus contact work against the start [J]."""
        return self.mechanical - self.mechanical[0] + self.work


def balance(problem: Problem, dtype=None) -> Balance:
    """Run the problem and keep the account of every step (point feet; no effects)."""
    problem = as_arrays(problem, dtype)
    state = first_evaluation(problem)
    inertia = prepared_inertia(problem.block)
    steps = int(round(problem.duration / problem.step))
    rows = []
    work = np.zeros_like(problem.block.mass)
    for i in range(steps + 1):
        e = energy(problem, state)
        rows.append((state.t, e.mechanical, e.total - e.mechanical, work))
        if i < steps:
            after = step(problem, state, inertia)
            work = work + contact_work(problem, state, after)
            state = after
    return Balance(*(np.array(column) for column in zip(*rows, strict=True)))
