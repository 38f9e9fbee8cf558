"""One engine at one setting: the bodies of the checks, and the runs that several checks share."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

import numpy as np

from rockref.conformance.physics.adapter import Engine
from rockref.conformance.physics.scene import Motion, Start, box, down, turn
from rockref.conformance.physics.theory import Rocking

G = 9.81  # m/s2, decided: that of the law
#: Decided: slender enough to rock with small losses, heavy enough for single precision, friction that never slips.
BLOCK = box((0.2, 0.3, 1.0), 60.0, 0.8)
CUBE = box((0.3, 0.3, 0.3), 27.0, 0.5)
SLIDER = box((0.4, 0.4, 0.1), 40.0, 0.3)
#: Moments in the ratio 13 : 10 : 5; the middle axis is y.
FLIPPER = box((0.1, 0.2, 0.3), 6.0, 0.5, plate=False)
#: Decided: the sink over b alpha above which the contact is too soft to judge rocking. There the sunk pivot moves the
#: quarter period by more than the rest of its bar.
SOFT = 0.005
SETTLING = 2.0  # s, decided: ten times the decay time of a contact with a hundredth of critical damping at 50 Hz


#: The end of settling that is watched: five periods of a contact of 50 Hz. Decided.
WATCHED = 0.1  # s


class Rest(NamedTuple):
    """A settled body: its state, how far it sank below the touching pose [m], and its largest speed at the end [m/s].

    The sink is negative where a gap remains.
    """

    start: Start
    sink: float
    speed: float


class Trial:
    """The runs of an engine that the checks share, each made once."""

    def __init__(self, engine: Engine):
        self.engine = engine
        self.theory = Rocking.of(BLOCK, G)

    def settle(self, scene, R: np.ndarray | None = None) -> Rest:
        """Let a body settle on the plate from the touching pose, turned about z by `R`."""
        height = float(scene.half[2])
        start = Start.at_rest((0.0, 0.0, height), R)
        times = np.append(SETTLING - self.rows(WATCHED, 1e-3)[:0:-1], SETTLING)
        motion = self.engine.run(scene, start, times, down(G))
        speed = float(np.max(np.linalg.norm(motion.v, axis=1)))
        return Rest(motion.start(-1), height - float(motion.x[-1, 2]), speed)

    @cached_property
    def rest(self) -> Rest:
        """Return the settled block."""
        return self.settle(BLOCK)

    @property
    def softness(self) -> float:
        """Return the sink of the block over b alpha, without unit."""
        return abs(self.rest.sink) / (self.theory.b * self.theory.alpha)

    @property
    def is_soft(self) -> bool:
        """Return whether the contact is too soft to judge rocking."""
        return self.softness > SOFT

    @property
    def is_held(self) -> bool:
        """Return whether the plate holds the block: the sink is below half the height."""
        return self.rest.sink < self.theory.h

    def tilted(self, theta: float, about_z: float = 0.0) -> Start:
        """Return the block at rest at the tilt theta [rad] about its y axis, on the edge, turned about z [rad].

        The edge carries the weight alone, on half as many contacts: it lies twice as deep as at rest.
        """
        b, h, sink = self.theory.b, self.theory.h, self.rest.sink
        depth = 2 * sink if sink > 0 else sink
        z = b * np.sin(abs(theta)) + h * np.cos(theta) - depth
        return Start.at_rest((0.0, 0.0, z), turn("z", about_z) @ turn("y", theta))

    def rows(self, duration: float, interval: float, finer: int = 1) -> np.ndarray:
        """Return instants up to `duration`, whole steps apart, at most about `interval` [s]."""
        step = self.engine.step / finer
        stride = max(1, round(interval / step))
        return np.arange(round(duration / step) // stride + 1) * stride * step

    def released(self, theta: float, duration: float, about_z: float = 0.0, finer: int = 1) -> Swing:
        """Return free rocking from rest at theta [rad], a row a millisecond."""
        times = self.rows(duration, 1e-3, finer)
        motion = self.engine.run(BLOCK, self.tilted(theta, about_z), times, down(G), finer)
        return Swing(times, motion)

    @cached_property
    def swing(self) -> Swing:
        """Simulate free rocking from half the slenderness: 2.5 s hold seven apexes."""
        return self.released(0.5 * self.theory.alpha, 2.5)


class Swing(NamedTuple):
    """A rocking run: t (T,) [s] and the motion."""

    t: np.ndarray
    motion: Motion

    @property
    def tilt(self) -> np.ndarray:
        """Return the angle of the block's height from the vertical in the rocking plane, signed (T,) [rad].

        The plane is that of the start.
        """
        lean = self.motion.R[:, :2, 2]
        way = lean[0] / np.linalg.norm(lean[0])
        return np.arctan2(lean @ way, self.motion.R[:, 2, 2])

    def upright(self) -> float:
        """Return the first instant at which the tilt is zero [s]; nan where there is none.

        The two rows before are extrapolated: the impact comes with the pose and bends the line between rows.
        """
        tilt = self.tilt
        after = np.flatnonzero(tilt <= 0)
        if not len(after) or after[0] < 2:
            return float("nan")
        i = int(after[0]) - 1
        return float(self.t[i] + tilt[i] * (self.t[i] - self.t[i - 1]) / (tilt[i - 1] - tilt[i]))

    def apexes(self) -> list[int]:
        """Return the rows of the apexes: the start, then the largest tilt between two passes through zero."""
        tilt = self.tilt
        ends = np.flatnonzero(np.signbit(tilt[1:]) != np.signbit(tilt[:-1])) + 1
        rows = [0]
        for first, last in zip(ends, ends[1:], strict=False):
            row = int(first) + int(np.argmax(np.abs(tilt[first:last])))
            # Rattling at rest crosses zero too: a swing has more than a hundredth of the first amplitude (decided).
            if abs(tilt[row]) < 0.01 * abs(tilt[0]):
                break
            rows.append(row)
        return rows

    def amplitudes(self) -> np.ndarray:
        """Return the sizes of the apex tilts [rad], by a parabola through three rows; the start's is exact."""
        size = np.abs(self.tilt)
        found = [float(size[0])]
        for row in self.apexes()[1:]:
            a, b, c = size[row - 1 : row + 2]
            bend = a - 2 * b + c
            found.append(float(b - (c - a) ** 2 / (8 * bend)) if bend < 0 else float(b))
        return np.array(found)


def crossing(t: np.ndarray, y: np.ndarray, level: float) -> float:
    """Return the first instant at which y passes the level, by linear interpolation; nan where it does not."""
    above = np.asarray(y) > level
    change = np.flatnonzero(above[1:] != above[:-1])
    if not len(change):
        return float("nan")
    i = int(change[0])
    return float(t[i] + (level - y[i]) / (y[i + 1] - y[i]) * (t[i + 1] - t[i]))
