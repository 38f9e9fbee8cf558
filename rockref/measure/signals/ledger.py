"""The energy ledger: what the rocking about the main axis loses in each free arc and in each main impact."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.arcs import Arcs, arcs
from rockref.measure.signals.impacts import Impacts, checked_signal, main_impacts
from rockref.model.errors import InputError
from rockref.model.problem import GRAVITY

# decided: a main impact is over after 20 ms (two or three drops), and begins, with clatter, some 5 ms before its drop.
BEFORE, AFTER = 0.005, 0.025
# decided: 100 ms average over two to ten periods of clatter, and stay on one side of the apex in arcs above 0.3 s.
FIT_WINDOW = 0.1
# decided: fewer samples than this do not determine two numbers through clatter.
LEAST_SAMPLES = 10


@dataclass(frozen=True)
class RockingBlock:
    """A block about its edge: mass kg, half diagonal ``radius`` m, slenderness ``alpha`` rad, inertias kg m^2.

    ``edge_inertia`` is that about an edge of the base parallel to X, ``upright_inertia`` the same about Y by symmetry;
    ``spin_inertia`` is that about Z.
    """

    mass: float
    radius: float
    alpha: float
    edge_inertia: float
    spin_inertia: float

    def potential(self, tilt: np.ndarray | float) -> np.ndarray:
        """Return the potential energy, J, at tilts of any shape, rad (either sign), above that at upright."""
        lift = np.cos(self.alpha - np.abs(tilt)) - math.cos(self.alpha)
        return self.mass * GRAVITY * self.radius * lift

    @property
    def rocking_rate(self) -> float:
        """Return the p of Housner (1963), 1/s: p^2 = m g R/I_O."""
        return math.sqrt(self.mass * GRAVITY * self.radius / self.edge_inertia)


def rocking_block(mass: float, width: float, height: float) -> RockingBlock:
    """Return the uniform block of mass kg with a square base of `width` m and a height in m.

    I_O = m (w^2/4 + h^2/4) + J with J = m (w^2 + h^2)/12. Raises InputError E-RANGE for numbers that are not positive.
    """
    if not (mass > 0.0 and width > 0.0 and height > 0.0):
        what = f"{mass:g} kg, {width:g} m, {height:g} m"
        raise InputError("E-RANGE", "arguments mass, width, height", what, "Give positive numbers.")
    squares = width**2 + height**2
    return RockingBlock(
        mass=mass,
        radius=0.5 * math.sqrt(squares),
        alpha=math.atan2(width, height),
        edge_inertia=mass * squares / 4.0 + mass * squares / 12.0,
        spin_inertia=mass * width**2 / 6.0,
    )


@dataclass(frozen=True, eq=False)
class Ledger:
    """The energy of rocking about the main axis, J, for M main impacts and the M - 1 complete arcs between them.

    Impacts, (M,): ``times`` s; ``signs`` of the rate; ``rate_before``, ``rate_after`` rad/s (magnitudes, of the free
    motion on either side, extrapolated to the instant); ``energy_before``, ``energy_after``, ``impact_loss`` J;
    ``restitution``, the ratio of the rates. NaN where the record ends too early.

    Arcs, (M - 1,): ``arc_starts``, ``arc_ends`` s; ``apex_angles`` rad with sign; ``apex_energy`` J, potential at the
    apex; ``free_loss`` J, from just after an impact to just before the next; ``path`` rad, integral of abs(w);
    ``square`` rad^2/s and ``cube`` rad^3/s^2, integrals of w^2 and abs(w)^3 (what dry, viscous and air resistance are
    proportional to); ``out_of_plane`` J, mean kinetic energy about Y and Z.

    Release: ``release_angle`` rad, integral of the rate up to the first impact, magnitude; ``release_loss`` J, from the
    potential energy at that angle to just before the first impact. NaN without an impact.
    """

    times: np.ndarray
    signs: np.ndarray
    rate_before: np.ndarray
    rate_after: np.ndarray
    energy_before: np.ndarray
    energy_after: np.ndarray
    impact_loss: np.ndarray
    restitution: np.ndarray
    arc_starts: np.ndarray
    arc_ends: np.ndarray
    apex_angles: np.ndarray
    apex_energy: np.ndarray
    free_loss: np.ndarray
    path: np.ndarray
    square: np.ndarray
    cube: np.ndarray
    out_of_plane: np.ndarray
    release_angle: float
    release_loss: float


def energy_ledger(t: np.ndarray, crv: np.ndarray, block: RockingBlock, impacts: Impacts | None = None) -> Ledger:
    """Return the ledger of a run with times t (N,) s and body rates crv (N, 3) rad/s.

    Raises InputError E-SIGNAL for arrays of other shapes.
    """
    t, crv = checked_signal(t, crv)
    impacts = main_impacts(t, crv) if impacts is None else impacts
    run_arcs = arcs(t, crv, impacts)
    before, after = _rates_at_impacts(t, crv[:, 0], block.rocking_rate, impacts, run_arcs)
    energy_before = 0.5 * block.edge_inertia * before**2
    energy_after = 0.5 * block.edge_inertia * after**2
    complete = run_arcs.complete
    starts, ends = run_arcs.starts[complete], run_arcs.ends[complete]
    angles = run_arcs.apex_angles[complete]
    wx = np.abs(crv[:, 0])
    out = 0.5 * (block.edge_inertia * crv[:, 1] ** 2 + block.spin_inertia * crv[:, 2] ** 2)
    release = abs(float(run_arcs.fall[0]))
    first = float(energy_before[0]) if len(impacts) else math.nan
    return Ledger(
        times=impacts.times,
        signs=impacts.signs,
        rate_before=before,
        rate_after=after,
        energy_before=energy_before,
        energy_after=energy_after,
        impact_loss=energy_before - energy_after,
        restitution=after / before,
        arc_starts=starts,
        arc_ends=ends,
        apex_angles=angles,
        apex_energy=block.potential(angles),
        free_loss=energy_after[:-1] - energy_before[1:],
        path=_integrals(t, wx, starts, ends),
        square=_integrals(t, wx**2, starts, ends),
        cube=_integrals(t, wx**3, starts, ends),
        out_of_plane=_integrals(t, out, starts, ends) / np.maximum(ends - starts, 1e-300),
        release_angle=release,
        release_loss=float(block.potential(release)) - first,
    )


def _integrals(t: np.ndarray, x: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the integrals of x (N,) over t (N,) s from each start to each end, (A,)."""
    total = np.concatenate(([0.0], np.cumsum(0.5 * (x[1:] + x[:-1]) * np.diff(t))))
    return np.interp(ends, t, total) - np.interp(starts, t, total)


def _rates_at_impacts(
    t: np.ndarray, wx: np.ndarray, p: float, impacts: Impacts, run_arcs: Arcs
) -> tuple[np.ndarray, np.ndarray]:
    """Return the magnitudes, (M,) rad/s each, to which the free motion before and after leads at each impact."""
    before, after = np.full(len(impacts), np.nan), np.full(len(impacts), np.nan)
    for k, (time, sign) in enumerate(zip(impacts.times, impacts.signs, strict=True)):
        apex_before, apex_after = run_arcs.apex_times[k], run_arcs.apex_times[k + 1]
        # The last arc may be cut before its apex; then it is followed as far as it goes.
        stop = apex_after if np.isfinite(apex_after) else t[-1]
        start = max(apex_before, time - BEFORE - FIT_WINDOW) if np.isfinite(apex_before) else time - BEFORE - FIT_WINDOW
        before[k] = _extrapolated(t, sign * wx, time, start, time - BEFORE, p)
        after[k] = _extrapolated(t, sign * wx, time, time + AFTER, min(stop, time + AFTER + FIT_WINDOW), p)
    return before, after


def _extrapolated(t: np.ndarray, w: np.ndarray, time: float, start: float, stop: float, p: float) -> float:
    """Return the value at `time` of the arc A cosh(p s) + B sinh(p s), s = t - time, fitted between two times.

    A free arc near upright follows w'' = p^2 w (Housner 1963, linear in the angle), whatever its height.
    """
    first, last = np.searchsorted(t, (start, stop))
    if last - first < LEAST_SAMPLES:
        return math.nan
    s = p * (t[first:last] - time)
    basis = np.stack((np.cosh(s), np.sinh(s)), axis=-1)
    solution, *_ = np.linalg.lstsq(basis, w[first:last], rcond=None)
    return float(solution[0])
