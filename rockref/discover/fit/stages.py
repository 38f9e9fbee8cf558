"""The stages of a fit: how long runs remember, how innovations are smoothed, how fine the steps are."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from rockref.api import Model
from rockref.discover.listening.listener import Memory
from rockref.model.parameters import BLOCK

#: Half the diagonal of the source's block [m]: memories and horizons of another block scale with the root of its own,
#: as rocking does (G. W. Housner 1963, Bull. Seismol. Soc. Am. 53:403-417).
SOURCE_RADIUS = math.hypot(BLOCK["width"].value, BLOCK["height"].value) / 2
#: Stiffness for each kilogram of mass [N/m/kg] up to which the steps of a stage are fine enough, and the largest factor
#: on their number; decided: a contact of the source's block takes 48 steps of the finest stages.
STIFF, FINEST = 1.15e6, 1.8


@dataclass(frozen=True)
class Stage:
    """One stage: time constants of the memory, smoothing and jitter [s], steps in 0.5 ms.

    inflation : of the noise.  horizon [s] : how far runs are followed, None for all of it.
    rate [Hz] : faster records are thinned as long as so many samples a second are left, None where all are heard
    (decided for S1: eight samples in its smoothing).
    shortest : whether no memory is shorter: its objective is smooth enough for steps from far.
    """

    name: str
    rates: float
    attitude: float
    smoothing: float = 0.0
    jitter: float = 0.0
    steps: int = 16
    inflation: float = 1.0
    horizon: float | None = None
    rate: float | None = None
    shortest: bool = False

    @property
    def holds_forms(self) -> bool:
        """Return whether a fit leaves the forms of laws as they are: over a part of the runs, at the shortest memory,
        feet that are not right yet bend them far."""
        return self.shortest and self.horizon is not None

    def memory(self, time_scale: float, fineness: float) -> Memory:
        """Return the memory for a block whose motion is slower by `time_scale`, with finer steps."""
        return Memory(self.rates * time_scale, self.attitude * time_scale, math.ceil(self.steps * fineness))

    def inflated(self, by: float) -> Stage:
        """Return the stage with the noise taken larger."""
        return replace(self, inflation=by)

    def upto(self, horizon: float | None) -> Stage:
        """Return the stage up to a horizon [s]."""
        return replace(self, horizon=horizon)


#: Uncertainty of an instant [s] where innovations are not smoothed; decided: a fortieth of a tick, by which corners of
#: a record are cut. On a light block with stiff feet ticks a quarter as long take off the innovations what it does.
JITTER = 0.0125e-3
#: From short memories, whose objective is smooth and whose valley is wide, to a long one, which tells the most.
#: Decided on simulated blocks: not whitened, what is not there gains up to 60 nats at 20 ms, by fitting noise that the
#: motion has amplified, and up to 320 at 40 ms; half-size effects gain 30 to 200 at 20 ms, at 40 ms to five times that.
#: The attitude is remembered for half a second at least: its target is the integral of a noisy rate, which wanders by
#: 50 urad in three seconds; pulled after it at 0.5 s, a drift that is not there gains 114 nats at 20 ms, 31 at 2 s.
S1 = Stage("S1", 0.005, 0.5, smoothing=8e-3, steps=6, rate=1000.0, shortest=True)
S2 = Stage("S2", 0.010, 0.5, smoothing=2e-3, steps=12)
S3 = Stage("S3", 0.014, 0.5, jitter=JITTER)
F = Stage("F", 0.020, 2.0, jitter=JITTER)
#: By which errors in deg/s are told: it forgets more slowly than any fit, so that more of what is missing is seen
#: (decided).
TOLD = Stage("told", 0.040, 1.0)


def time_scale(model: Model) -> float:
    """Return by how much slower than the source's block a block rocks."""
    return math.sqrt(math.hypot(model.width, model.height) / 2 / SOURCE_RADIUS)


def fineness(stiffness: float, mass: float) -> float:
    """Return the factor on the steps for a normal stiffness [N/m] and mass [kg]."""
    return min(max(1.0, math.sqrt(stiffness / mass / STIFF)), FINEST)
