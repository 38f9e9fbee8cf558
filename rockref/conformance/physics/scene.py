"""What an adapter is asked: a body, a plate, a start, a schedule of gravity. Plain values, SI units."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

#: A schedule of gravity: from the time t [s] on the vector g (3,) [m/s2] acts; the first time is 0.
Gravity = list[tuple[float, tuple[float, float, float]]]


@dataclass(frozen=True)
class Scene:
    """A rigid body and the plate below it.

    shape : "box", or "sphere" (then `size` has its diameter three times)
    size : full sides along the body axes x, y, z [m]; the centre of mass is the middle
    mass : [kg];  inertia : principal moments about the body axes [kg m2]
    friction : Coulomb's coefficient between body and plate, static and dynamic
    plate : whether there is one; the plate is the rigid half-space z < 0
    step : of the integration [s]
    settings : the engine's knobs, by the adapter's own names
    """

    shape: str
    size: tuple[float, float, float]
    mass: float
    inertia: tuple[float, float, float]
    friction: float
    plate: bool = True
    step: float = 1e-3
    settings: dict[str, Any] = field(default_factory=dict)

    @property
    def half(self) -> np.ndarray:
        """Return half the sides, (3,) [m]."""
        return np.array(self.size) / 2

    def replace(self, **changes: Any) -> Scene:
        """Return a copy with some fields changed."""
        return replace(self, **changes)


class Start(NamedTuple):
    """The state at t = 0, world axes.

    x (3,) centre of mass [m]; R (3, 3) body to world; v (3,) [m/s]; omega (3,) [rad/s].
    """

    x: np.ndarray
    R: np.ndarray
    v: np.ndarray
    omega: np.ndarray

    @classmethod
    def at_rest(cls, x: Any, R: Any = None) -> Start:
        """Return a start without velocity; upright where `R` is not given."""
        R = np.eye(3) if R is None else np.asarray(R, float)
        return cls(np.asarray(x, float), R, np.zeros(3), np.zeros(3))


class Motion(NamedTuple):
    """The states at T instants, world axes: x (T, 3), R (T, 3, 3), v (T, 3), omega (T, 3); units as `Start`."""

    x: np.ndarray
    R: np.ndarray
    v: np.ndarray
    omega: np.ndarray

    def start(self, row: int) -> Start:
        """Return the state of a row as a start."""
        return Start(*(a[row] for a in self))


def box(size: tuple[float, float, float], mass: float, friction: float, **more: Any) -> Scene:
    """Return a uniform cuboid as a scene; size [m], mass [kg]."""
    a, b, c = (s * s for s in size)
    return Scene("box", size, mass, (mass / 12 * (b + c), mass / 12 * (a + c), mass / 12 * (a + b)), friction, **more)


def sphere(radius: float, mass: float, friction: float, **more: Any) -> Scene:
    """Return a uniform sphere as a scene; radius [m], mass [kg]."""
    J = 0.4 * mass * radius * radius
    return Scene("sphere", (2 * radius,) * 3, mass, (J, J, J), friction, **more)


def turn(axis: str, angle: float) -> np.ndarray:
    """Return the rotation by `angle` [rad] about the world axis "x", "y" or "z", (3, 3)."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    R = np.eye(3)
    R[i, i] = R[j, j] = c
    R[i, j], R[j, i] = -s, s
    return R


def down(g: float) -> Gravity:
    """Return the schedule of constant gravity g [m/s2] along -z."""
    return [(0.0, (0.0, 0.0, -g))]


class Leg(NamedTuple):
    """A piece of a run: set `gravity` (None: as before), make `steps` steps, then record a row where `record`."""

    gravity: tuple[float, float, float] | None
    steps: int
    record: bool


def legs(scene: Scene, times: np.ndarray, gravity: Gravity) -> list[Leg]:
    """Return a run as legs, so that an adapter needs one loop and counts no time itself.

    times : (T,) increasing instants of the rows [s];  gravity : the schedule. Both are rounded to whole steps.
    """
    rows = [round(float(t) / scene.step) for t in times]
    changes = {round(t / scene.step): g for t, g in gravity}
    recorded = set(rows)
    marks = sorted({0, *recorded, *(c for c in changes if c < rows[-1])})
    # At a mark the row is recorded first, with the state that the gravity before it made; then gravity changes.
    found = [Leg(changes.get(0), 0, rows[0] == 0)]
    for before, count in zip(marks, marks[1:], strict=False):
        found.append(Leg(changes.get(before) if before else None, count - before, count in recorded))
    return found


def stacked(rows: list[Start]) -> Motion:
    """Return recorded states as a motion."""
    return Motion(*(np.array([row[k] for row in rows], float) for k in range(4)))
