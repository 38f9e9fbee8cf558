"""What a run gives back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from rockref.model import energy as energies
from rockref.model.channel import crv_deg_s
from rockref.model.contact import point_kinematics
from rockref.model.errors import InputError
from rockref.model.problem import Block, Problem, State
from rockref.model.rotation import quaternion
from rockref.model.shown import Shown, span

if TYPE_CHECKING:
    import pandas

#: Tilt of the body's height from the vertical at which a block counts as overturned [rad]; decided: 45 degrees, where
#: no block slender enough to rock comes back.
OVERTURNED = np.pi / 4


@dataclass(frozen=True, repr=False)
class Response(Shown):
    """Recorded rows of a run; T rows, leading batch axes first.

    t : (T,) [s];  x, v : (..., T, 3) centre of mass [m, m/s];  Lambda : (..., T, 3, 3);  W : (..., T, 3) crv [rad/s]
    F : (..., T, n, 3) force of the plate on each point [N];  s : (..., T, n, 2) anchors [m]
    anchored, sliding : (..., T, n) bool;  final_state : restarts the run bit for bit

    >>> import rockref
    >>> model = rockref.Model.four_points()
    >>> r = rockref.simulate(model, duration=0.09, step=2e-5, output_rate=1000.0, theta_0=0.01)
    >>> r.crv.shape, r.overturned  # rates in deg/s, ninety-one rows
    ((91, 3), False)
    >>> print(r.main_impacts().round(4), r.tilt[[0, -1]].round(4))
    [0.0835] [-0.01    0.0015]
    >>> name, intervals = r.contacts()[0]
    >>> print(name, intervals.round(3))
    1ext [[0.    0.083]]
    >>> print(r.energy()["dissipated"][-1].round(3))  # J, by the impact
    0.015
    >>> list(r.columns())[:5]
    ['t_s', 'wx_deg_s', 'wy_deg_s', 'wz_deg_s', 'x_m']
    >>> onward = rockref.simulate(model.problem(duration=0.01, step=2e-5, start=r.state(-1)))
    >>> print(onward.tilt[0].round(4))
    0.0015
    """

    problem: Problem
    t: np.ndarray
    x: np.ndarray
    v: np.ndarray
    Lambda: np.ndarray
    W: np.ndarray
    F: np.ndarray
    s: np.ndarray
    anchored: np.ndarray
    sliding: np.ndarray
    final_state: State

    def facts(self) -> dict[str, str]:
        """Return duration, rows, main impacts, and the largest lean and rate, in words."""
        batch = {"blocks": " x ".join(map(str, self.problem.batch))} if self.problem.batch else {}
        if not len(self.t):
            return {**batch, "rows": "none"}
        L = self.Lambda
        lean = np.degrees(np.arctan2(np.hypot(L[..., 0, 2], L[..., 1, 2]), L[..., 2, 2])).max(axis=-1)
        impacts = {} if batch else {"main impacts": str(len(self.main_impacts()))}
        return {
            **batch,
            "duration": f"{self.t[-1] - self.t[0]:.6g} s",
            "rows": str(len(self.t)),
            "points": str(self.F.shape[-2]),
            **impacts,
            "largest lean": span(lean, "deg", 3),
            "largest rate": span(np.abs(self.crv).max(axis=(-2, -1)), "deg/s", 3),
            "overturned": "yes" if self.overturned else "no",
        }

    def __getitem__(self, index) -> Response:
        """Return one response of a batch."""
        if not self.problem.batch:
            raise InputError("E-BATCH", "response", "is of one block", "Only a batch can be indexed.")
        rows = {k: getattr(self, k)[index] for k in ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")}
        return replace(self, problem=pick(self.problem, index), final_state=pick_state(self.final_state, index), **rows)

    @property
    def crv(self) -> np.ndarray:
        """Return the crv about X, Y, Z in deg/s, (..., T, 3): what an ideal gyroscope shows (M1).

        Effects of the sensor are not in it; `rockref.effects.catalogue.measured` applies them to W.
        """
        return crv_deg_s(self.W)

    @property
    def tilt(self) -> np.ndarray:
        """Return signed tilt about the main axis [rad], (..., T): negative at release (the block leans to +y), zero
        when it passes upright."""
        return np.arctan2(self.Lambda[..., 2, 1], self.Lambda[..., 2, 2])

    @property
    def overturned(self) -> bool:
        """Return whether the block fell over (a result, not an error)."""
        return bool(np.any(self.Lambda[..., 2, 2] < np.cos(OVERTURNED)))

    def state(self, row: int) -> State:
        """Return the state at a recorded row, without the accelerations: a start for another run (not bit for bit; the
        `final_state` is)."""
        c = len(self.problem.batch)
        at = {k: np.take(getattr(self, k), row, axis=c) for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding")}
        return State(t=float(self.t[row]), **at)

    def main_impacts(self) -> np.ndarray:
        """Return instants of the main impacts [s]: where the block passes upright, between two rows by linear
        interpolation.

        Only crossings with a swing count: between two of them the tilt must exceed a thousandth of the largest
        (decided), so that the rest at the end gives none. One block only.
        """
        tilt = self.tilt
        if tilt.ndim != 1:
            raise InputError(
                "E-BATCH", "main_impacts", "was asked of a batch", "Index the response first: response[i]."
            )
        threshold = 1e-3 * np.max(np.abs(tilt))
        crossings = np.flatnonzero(np.signbit(tilt[1:]) != np.signbit(tilt[:-1]))
        instants, last = [], 0
        for i in map(int, crossings):
            if np.max(np.abs(tilt[last : i + 1])) > threshold:
                fraction = tilt[i] / (tilt[i] - tilt[i + 1])
                instants.append(self.t[i] + fraction * (self.t[i + 1] - self.t[i]))
                last = i + 1
        return np.array(instants)

    def contacts(self) -> list[tuple[str, np.ndarray]]:
        """Name of each point and its intervals of contact, (k, 2) [s], by the recorded rows. One block only."""
        if self.anchored.ndim != 2:
            raise InputError("E-BATCH", "contacts", "was asked of a batch", "Index the response first: response[i].")
        found = []
        for i, name in enumerate(self.problem.points.names):
            on = np.concatenate([[0], self.anchored[:, i], [0]])
            begin, end = np.flatnonzero(np.diff(on) == 1), np.flatnonzero(np.diff(on) == -1) - 1
            found.append((name, np.column_stack([self.t[begin], self.t[end]])))
        return found

    def energy(self) -> dict[str, np.ndarray]:
        """Return energies at every row [J], each (..., T): kinetic, potential, stored_normal, stored_tangential, total,
        and dissipated, which is what is missing of the total at the first row. On a plate that moves all are seen from
        the plate, and what B1 has given counts as negative dissipation."""
        block, points = self.problem.block, self.problem.points
        P, K_N, K_T, radius = points.P, points.K_N, points.K_T, points.radius
        if self.problem.batch:
            time = len(self.problem.batch)
            block = Block(*(np.expand_dims(a, time) for a in (block.mass, block.inertia, block.g)))
            P, K_N, K_T = (np.expand_dims(a, time) for a in (P, K_N, K_T))
            radius = None if radius is None else np.expand_dims(radius, time)
        k = point_kinematics(self.x, self.Lambda, self.v, self.W, np.broadcast_to(P, self.F.shape), radius)
        stored = energies.spring_energy(k.xi, self.anchored, k.u[..., :2], self.s, K_N, K_T)
        kinetic = energies.kinetic_energy(self.v, self.W, block.mass, block.inertia)
        e = energies.Energy(kinetic, energies.potential_energy(self.x, block.mass, block.g), *stored)
        return {**e._asdict(), "total": e.total, "dissipated": e.total[..., :1] - e.total}

    def to_frame(self) -> pandas.DataFrame:
        """Return the response of one block as a table; the column names carry the units.

        t_s, wx_deg_s .. wz_deg_s, x_m .. z_m, qw .. qz (body to plate), and for every point, for example, fx_1ext_N ..
        fz_1ext_N, contact_1ext, slip_1ext. Rates are those of `crv`, without effects of the sensor.
        """
        import pandas

        return pandas.DataFrame(self.columns("to_frame"))

    def columns(self, asked: str = "columns") -> dict[str, np.ndarray]:
        """Return the columns of `to_frame`, each (rows,), by name. Raises InputError (E-BATCH) for a batch, about
        `asked`."""
        if self.problem.batch:
            raise InputError("E-BATCH", asked, "was asked of a batch", "Index the response first: response[i].")
        columns = {"t_s": self.t}
        columns |= {f"w{a}_deg_s": self.crv[:, i] for i, a in enumerate("xyz")}
        columns |= {f"{a}_m": self.x[:, i] for i, a in enumerate("xyz")}
        q = quaternion(self.Lambda)
        columns |= {f"q{a}": q[:, i] for i, a in enumerate("wxyz")}
        for i, name in enumerate(self.problem.points.names):
            columns |= {f"f{a}_{name}_N": self.F[:, i, j] for j, a in enumerate("xyz")}
            columns |= {f"contact_{name}": self.anchored[:, i], f"slip_{name}": self.sliding[:, i]}
        return columns


def pick_state(state: State, index) -> State:
    """Return one state of a batch."""
    arrays = {k: getattr(state, k) for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "a", "T", "F")}
    memory = tuple({k: a[index] for k, a in m.items()} for m in state.memory)
    picked: dict[str, Any] = {k: None if a is None else a[index] for k, a in arrays.items()}
    return replace(state, memory=memory, **picked)


def pick(problem: Problem, index) -> Problem:
    """Return one problem of a batch."""
    block = replace(problem.block, **{k: getattr(problem.block, k)[index] for k in ("mass", "inertia", "g")})
    arrays = {k: getattr(problem.points, k) for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu", "radius")}
    picked: dict[str, Any] = {k: None if a is None else a[index] for k, a in arrays.items()}
    points = replace(problem.points, **picked)
    return replace(problem, block=block, points=points, start=pick_state(problem.start, index))
