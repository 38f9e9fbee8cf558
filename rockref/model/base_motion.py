"""The plate's recorded acceleration, and the force that the block feels in axes that move with the plate."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.model.errors import InputError


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Acceleration of a plate that translates, sampled at t_0, t_0 + dt, ...; linear between samples, else zero.

    t_0 : time of the first sample, in the time of the run [s];  dt : interval [s]
    a : (n, 3) acceleration in the axes of the plate, z upwards [m/s2];  name : what tables call the record

    Raises InputError: E-TYPE, E-RANGE, E-SHAPE.

    >>> from rockref.model.base_motion import BaseMotion, plate_acceleration
    >>> base = BaseMotion(t_0=0.5, dt=0.25, a=[[0.0, 0.0, 0.0], [2.0, 0.0, -1.0], [0.0, 4.0, 0.0]])
    >>> plate_acceleration(base, 0.875).tolist()
    [1.0, 2.0, -0.5]
    >>> base.rotated(90).scaled(0.5).a[2].tolist()
    [-2.0, 0.0, 0.0]
    """

    t_0: float
    dt: float
    a: np.ndarray
    name: str = ""

    def __post_init__(self) -> None:
        """Refuse what is no record."""
        try:
            a = np.asarray(self.a, order="C")
            a = a if a.dtype in (np.float32, np.longdouble) else np.asarray(a, np.float64)
            times = {"t_0": float(self.t_0), "dt": float(self.dt)}
        except (TypeError, ValueError):
            cure = "Give t_0 and dt as numbers [s], a as n rows of three numbers [m/s2]."
            raise InputError("E-TYPE", "base motion", "is not made of numbers", cure) from None
        for key, value in times.items():
            if not math.isfinite(value) or (key == "dt" and value <= 0):
                cure = "Give a finite number of seconds; the interval is positive."
                raise InputError("E-RANGE", f"base motion {key}", f"is {value!r}", cure)
            object.__setattr__(self, key, value)
        if a.ndim != 2 or a.shape[1:] != (3,) or not len(a):
            raise InputError("E-SHAPE", "base motion a", f"has shape {a.shape}", "Give one row of three a sample.")
        if not np.all(np.isfinite(a)):
            k = int(np.argwhere(~np.isfinite(a))[0][0])
            raise InputError("E-RANGE", f"base motion a, sample {k}", "is not finite", "Repair or cut the record.")
        object.__setattr__(self, "a", a)

    def __eq__(self, other: object) -> bool:
        """Return whether two records have the same samples at the same times; names do not count."""
        if not isinstance(other, BaseMotion):
            return NotImplemented
        return (self.t_0, self.dt) == (other.t_0, other.dt) and np.array_equal(self.a, other.a)

    def __hash__(self) -> int:
        """Return the hash of the samples and their times."""
        return hash((self.t_0, self.dt, self.a.tobytes()))

    @property
    def end(self) -> float:
        """Return time of the last sample [s]."""
        return self.t_0 + (len(self.a) - 1) * self.dt

    def scaled(self, factor: float) -> BaseMotion:
        """Return the record with every acceleration times `factor`."""
        return replace(self, a=self.a * factor)

    def rotated(self, degrees: float) -> BaseMotion:
        """Return the record with its vectors turned about z, from x towards y. Quarter turns are exact."""
        quarters = round(degrees / 90)
        rest = math.radians(degrees - 90 * quarters)
        c, s = math.cos(rest), math.sin(rest)
        for _ in range(quarters % 4):
            c, s = -s, c
        x, y, z = self.a.T
        return replace(self, a=np.stack([c * x - s * y, s * x + c * y, z], axis=1))


def plate_acceleration(base: BaseMotion, t: float) -> np.ndarray:
    """Return the plate's acceleration (3,) [m/s2] at a time t [s].

    a(t) = a_k + (a_{k+1} - a_k) (t - t_k)/dt with t_k = t_0 + k dt; zero before t_0 and after the last sample.
    """
    place = (t - base.t_0) / base.dt
    last = len(base.a) - 1
    if not 0 <= place <= last:
        return np.zeros(3, base.a.dtype)
    k = math.floor(place)
    return base.a[k] + (base.a[min(k + 1, last)] - base.a[k]) * base.a.dtype.type(place - k)


def inertial_force(mass: Any, a: np.ndarray) -> np.ndarray:
    """Rule B1: F = -m a(t) [N] at the centre of mass, without moment, in axes that translate with the plate.

    mass : (...) [kg];  a : (3,) acceleration of the plate [m/s2]  ->  (..., 3).

    Exact for a plate that translates: contact depends on relative motion only, and the rotation is that seen from the
    ground. A plate that turns would need the forces of Coriolis, Euler and the centrifugal one too.

    Decided: a step from n to n+1 reads a(t) at n+1, as its one force evaluation does everything else. Positions then
    feel a(t_n), and velocities (I4) the mean of both ends, which integrates a record that is linear within the step
    exactly.
    """
    return -np.asarray(mass)[..., None] * a  # B1
