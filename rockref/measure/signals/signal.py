"""What the checks look at: a record beside what its block can do, computed once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rockref.measure.reading.columns import RATES
from rockref.measure.reading.table import Table
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.measure.signals.arcs import turned_angle
from rockref.measure.signals.impacts import Impacts, main_impacts
from rockref.measure.signals.noise import WINDOW, NoiseFloor, noise_floor, smallest_step
from rockref.measure.signals.running import sample_step
from rockref.model.problem import GRAVITY

#: sqrt(R/g) of the block of Table 3.1 [s], on whose records the stretches of time of the checks were decided.
REFERENCE_SCALE = math.sqrt(0.5 * math.hypot(0.100, 0.688) / GRAVITY)


def rocking_rate(tilt: float, width: float, height: float) -> float:
    """Return the rate, rad/s, at which a block let go at `tilt` rad reaches upright without loss (Housner 1963).

    width and height in m. The block turns about its edge: w^2 = 3g/(2R) (cos(alpha - tilt) - cos(alpha)).
    """
    radius, alpha = 0.5 * math.hypot(width, height), math.atan2(width, height)
    return math.sqrt(1.5 * GRAVITY / radius * (math.cos(alpha - tilt) - math.cos(alpha)))


def rocking_time(tilt: float, width: float, height: float) -> float:
    """Return the time, s, from the release at `tilt` rad to upright: cosh(p T) = alpha/(alpha - tilt), p^2 = 3g/(4R).

    width and height in m; linear in the angle (Housner 1963), which is enough for a slender block.
    """
    alpha = math.atan2(width, height)
    return math.acosh(alpha / (alpha - tilt)) / growth_rate(width, height)


def growth_rate(width: float, height: float) -> float:
    """Return p, 1/s, of a slender block on its edge: arcs grow as cosh(p t), p^2 = 3g/(4R) (Housner 1963).

    width and height in m; doi:10.1785/BSSA0530020403.
    """
    return math.sqrt(0.75 * GRAVITY / (0.5 * math.hypot(width, height)))


def side_of(run: Run) -> int:
    """Return the sign of the first swing of a run: -1 where the block is turned."""
    return -1 if abs(run.block_turned) > 0.5 * math.pi else 1


def tilts(t: np.ndarray, wx: np.ndarray, tilt: float, side: int) -> np.ndarray:
    """Return the tilt, rad, after each sample of rates wx (N,) rad/s: `tilt` rad of the release less their integral.

    Positive on the side of the release, turned block or not.
    """
    return tilt - side * np.cumsum(wx) * sample_step(t)


@dataclass(frozen=True, eq=False)
class Signal:
    """A record of a release, and what its block and its gyroscope lead to expect.

    Attributes: ``t`` (N,) s; ``crv`` (N, 3) rad/s; ``names`` of the three columns; ``path`` of the file; ``gyro``;
    ``width``, ``height`` m; ``tilt`` rad, of the release; ``sign`` of its first swing.
    """

    t: np.ndarray
    crv: np.ndarray
    names: tuple[str, str, str]
    path: str
    gyro: Gyro
    width: float
    height: float
    tilt: float
    sign: int

    @classmethod
    def of(cls, t: np.ndarray, crv: np.ndarray, table: Table, run: Run, experiment: Experiment) -> Signal:
        """Return the signal of a run: times t (N,) s and body rates crv (N, 3) rad/s of a table of an experiment."""
        assert run.release_tilt is not None and experiment.gyro is not None
        x, y, z = (table.names[quantity] for quantity in RATES)
        size = experiment.width, experiment.height
        return cls(t, crv, (x, y, z), str(table.path), experiment.gyro, *size, run.release_tilt, side_of(run))

    @cached_property
    def step(self) -> float:
        """Return mean interval between samples, s."""
        return sample_step(self.t)

    @cached_property
    def rate(self) -> float:
        """Return rate of the first swing at upright, rad/s."""
        return rocking_rate(self.tilt, self.width, self.height)

    @cached_property
    def duration(self) -> float:
        """Return time from the release to upright, s."""
        return rocking_time(self.tilt, self.width, self.height)

    @cached_property
    def alpha(self) -> float:
        """Return tipping angle, rad."""
        return math.atan2(self.width, self.height)

    @cached_property
    def scale(self) -> float:
        """Return how much slower the block is than that of Table 3.1: stretches of time go with sqrt(R/g)."""
        return math.sqrt(0.5 * math.hypot(self.width, self.height) / GRAVITY) / REFERENCE_SCALE

    @cached_property
    def tilts(self) -> np.ndarray:
        """Return tilt after each sample, (N,) rad, positive on the side of the release."""
        return tilts(self.t, self.crv[:, 0], self.tilt, self.sign)

    @cached_property
    def impacts(self) -> Impacts:
        """Return main impacts. Raises InputError E-SIGNAL."""
        return main_impacts(self.t, self.crv)

    @cached_property
    def floor(self) -> NoiseFloor:
        """Return the noise floor; a block smaller than that of Table 3.1 is calm for a shorter time."""
        return noise_floor(self.t, self.crv, window=WINDOW * min(1.0, self.scale))

    @cached_property
    def turned(self) -> np.ndarray:
        """Return the angle that the rate about X adds up to, (N,) rad, from the first sample."""
        return turned_angle(self.t, self.crv[:, 0])

    @cached_property
    def steps(self) -> np.ndarray:
        """Step between the values of each channel, (3,) rad/s; 0 where there is none."""
        return smallest_step(self.crv)

    @cached_property
    def grain(self) -> float:
        """Return stated width of a value, rad/s: noise and resolution together."""
        return math.hypot(self.gyro.noise, self.gyro.resolution)

    def column(self, axis: int) -> str:
        """Return the place of an axis for a message: file and column."""
        return f"{self.path}, column {self.names[axis]}"


def stretches(mask: np.ndarray) -> np.ndarray:
    """Return first and last row, the last exclusive, of every stretch of True in mask (N,): (K, 2)."""
    padded = np.concatenate(([0], mask.astype(np.int8), [0]))
    return np.flatnonzero(np.diff(padded)).reshape(-1, 2)
