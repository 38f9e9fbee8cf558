"""The energy account of a run: what the block has, what the contact springs store, what the contacts took.

kinetic + potential + stored + dissipated = constant, in the limit of small steps. What the step itself creates or loses
is the residual of the balance; for a body that does not turn it is exactly m h^2/8 (a.a - a_0.a_0): it does not grow
with time, and falls with the square of the step.

What is dissipated is what the contacts took and did not store, and where it cannot be negative was found out:

- *Normal direction*: never negative. In contact the power is C_N xi_rate^2; behind the no-tension cut it is
  -K_N xi xi_rate with xi_rate < 0, the spring relaxing without pushing anybody. In steps of length h a dip of
  C_N h^3 (jump of the acceleration)^2 / 64 is possible where xi_rate changes sign.
- *Friction, sticking*: C_T |v_slide|^2, never negative.
- *Friction, sliding*: the force never delivers power to the anchor, -F_T . ds = mu F_N (|F*| - mu F_N) / K_T >= 0 in
  every step. But the law's damper acts with the whole sliding velocity although it sits beside the spring, which
  moves only with (u - s): the rest is C_T v_slide . d(u - s)/dt, and that has either sign. When C_T |v_slide| is above
  mu F_N the anchor of T4 lies ahead of the point and its spring "stores" |F_T + C_T v_slide|^2 / 2 K_T, which rises
  with the speed: there the sum of both springs' energies is an account, not a reserve that the contact could give
  back, and the dissipation of a single step may be negative. Over a closed slip it is not.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.model.contact import point_kinematics
from rockref.model.energy import kinetic_energy, potential_energy, spring_energy
from rockref.model.errors import InputError
from rockref.model.response import Response


class Balance(NamedTuple):
    """Energy account of a run, one row a step, (T,) each [J]; the work is counted from the first row.

    t [s]; mechanical: kinetic and potential; stored_normal, stored_friction: in the contact springs; work_normal,
    work_friction: taken from the block by the normal and the friction forces, with their mean over each step.
    """

    t: np.ndarray
    mechanical: np.ndarray
    stored_normal: np.ndarray
    stored_friction: np.ndarray
    work_normal: np.ndarray
    work_friction: np.ndarray

    @property
    def dissipated_normal(self) -> np.ndarray:
        """Return work taken by the normal forces and not stored [J]."""
        return self.work_normal - (self.stored_normal - self.stored_normal[0])

    @property
    def dissipated_friction(self) -> np.ndarray:
        """Return work taken by the friction forces and not stored [J]."""
        return self.work_friction - (self.stored_friction - self.stored_friction[0])

    @property
    def dissipated(self) -> np.ndarray:
        """Return work taken by the contacts and not stored in their springs [J]."""
        return self.dissipated_normal + self.dissipated_friction

    @property
    def residual(self) -> np.ndarray:
        """Return what the step itself creates or loses: mechanical energy plus contact work against the start [J]."""
        return self.mechanical - self.mechanical[0] + self.work_normal + self.work_friction


def balance(response: Response) -> Balance:
    """Return the energy account of the response of one block, recorded at every step: point feet, no effects.

    Raises
    ------
    InputError
        E-RATE, where the response does not have a row for every step; E-BATCH, for a batch.
    """
    problem, points = response.problem, response.problem.points
    if problem.batch:
        raise InputError("E-BATCH", "balance", "was asked of a batch", "Index the response first: response[i].")
    if len(response.t) - 1 != round((response.t[-1] - response.t[0]) / problem.step):
        raise InputError(
            "E-RATE",
            "output_rate",
            f"{problem.output_rate:g} Hz skips steps",
            f"Record {1 / problem.step:g} rows a second.",
        )
    u = point_kinematics(response.x, response.Lambda, response.v, response.W, points.P).u
    taken = -(response.F[1:] + response.F[:-1]) / 2 * np.diff(u, axis=0)
    stored = spring_energy(-u[..., 2], response.anchored, u[..., :2], response.s, points.K_N, points.K_T)
    kinetic = kinetic_energy(response.v, response.W, problem.block.mass, problem.block.inertia)
    return Balance(
        response.t,
        kinetic + potential_energy(response.x, problem.block.mass, problem.block.g),
        *stored,
        from_start(np.sum(taken[..., 2], axis=-1)),
        from_start(np.sum(taken[..., :2], axis=(-1, -2))),
    )


def from_start(increments: np.ndarray) -> np.ndarray:
    """Return sums of the increments so far, with zero at the start, (N,) -> (N+1,)."""
    return np.concatenate([np.zeros(1, increments.dtype), np.cumsum(increments)])
