"""What defects of the feet do in an earthquake: the calibrated block and its symmetric twin under the same signals.

The source's authors compared the two under 2000 artificial bidirectional signals (MATEC Web of Conferences 24, 09004,
2015, doi 10.1051/matecconf/20152409004). Their signals are not public; these are made here, by seed.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.model.base_motion import BaseMotion
from rockref.shake.ensemble import Ensemble, run_ensemble
from rockref.shake.ensemble_store import EnsembleFolder
from rockref.shake.motion_size import motion_size
from rockref.shake.pulses import envelope, kanai_tajimi
from rockref.shake.statistics.bands import paired_interval, wilson_interval

#: Signals of the source, all levels together.
SIGNALS = 2000
#: Levels of PGA [m/s2]; decided: from the acceleration that lifts the block, g b/h = 1.43, to where nearly all fall.
LEVELS = (1.45, 1.6, 1.75, 1.9, 2.05, 2.2, 2.35, 2.5, 2.65, 2.8)
#: Interval of the samples [s]; decided: four samples in the shortest period that the ground lets through, 25 Hz.
INTERVAL = 0.01
#: Rise, strong motion [s] and decay [1/s] of the envelope, and its length [s]; decided: as of a moderate earthquake.
RISE, STRONG, DECAY, LENGTH = 2.0, 6.0, 1.0, 14.0
#: Filter that takes slow motion away [Hz]; decided: below it records are cut too.
LOW_CUT = 0.25
#: decided: a tenth of the angle at which the block balances on an edge; clatter of uneven feet stays below.
ROCKED = 0.1 * math.atan2(0.100, 0.688)
#: decided: a block that still rocks five seconds after the signal does not fall any more.
AFTER = 5.0
#: Time step [s]; decided: that of the source, for the whole study takes a minute or two.
STEP = 1e-5
#: The two blocks.
NAMES = ("calibrated", "symmetric")


def symmetric_twin(model: Model) -> Model:
    """Return the model with all four feet at the mean of their heights; all else as it is."""
    heights = np.asarray(model.parameters.delta_long, float)
    return model.replace(delta_long=tuple(np.full(4, heights.mean()).tolist()))


def signal(seed: int, pga: float) -> BaseMotion:
    """Return a signal along x and y: independent noise of Kanai and Tajimi in an envelope, scaled to one PGA [m/s2].

    PGA is the largest length of the horizontal acceleration.
    """
    window = envelope(RISE, STRONG, DECAY)
    parts = [kanai_tajimi(2 * seed + k, 1.0, LENGTH, INTERVAL, low_cut=LOW_CUT, window=window).a[:, 0] for k in (0, 1)]
    made = BaseMotion(0.0, INTERVAL, np.column_stack([*parts, np.zeros_like(parts[0])]), f"signal_{seed}")
    return made.scaled(pga / motion_size(made)[0])


@dataclass(frozen=True)
class Difference:
    """A share of the calibrated block less that of the symmetric one, with its interval of 95 %."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Level:
    """Both blocks under the signals of one PGA [m/s2]: how many fell and rocked, and the paired differences."""

    pga: float
    signals: int
    fell: tuple[int, int]
    rocked: tuple[int, int]
    fell_more: Difference
    rocked_more: Difference

    def to_dict(self) -> dict[str, Any]:
        """Return the level as plain values, with the Wilson interval of each share that fell."""
        return asdict(self) | {"fell_interval": [wilson_interval(k, self.signals) for k in self.fell]}


def run_level(folder: Path, index: int, signals: int, step: float, workers: int | None = None) -> dict[str, np.ndarray]:
    """Run both blocks under the signals of level `index` and return what fell and rocked (2, signals).

    Signals differ from level to level. What is done is kept in `folder`, and not run again.
    """
    block = Model.table_3_1()
    motions = tuple(signal(index * 10**6 + k, LEVELS[index]) for k in range(signals))
    fell, rocked = [], []
    for name, own in zip(NAMES, (block, symmetric_twin(block)), strict=True):
        ensemble = Ensemble(own, motions, step=step, after=AFTER)
        store = EnsembleFolder(folder / f"level_{index + 1:02d}_{name}", ensemble)
        rows = run_ensemble(ensemble, signals, workers, store.keep, store.known)
        fell.append([row["fell"] for row in rows])
        rocked.append([row["fell"] or row["tilt_rad"] > ROCKED for row in rows])
    return {"fell": np.array(fell, float), "rocked": np.array(rocked, float)}


@dataclass(frozen=True)
class Defects:
    """The study: levels, and the differences over all of them."""

    levels: tuple[Level, ...]
    fell_more: Difference
    rocked_more: Difference
    discordant: tuple[int, int]
    step: float

    def to_dict(self) -> dict[str, Any]:
        """Return the study as plain values."""
        return {
            "schema": "rockref.earthquake/1", "step_s": self.step, "levels": [a.to_dict() for a in self.levels],
            "fell_more": asdict(self.fell_more), "rocked_more": asdict(self.rocked_more),
            "only_calibrated_fell": self.discordant[0], "only_symmetric_fell": self.discordant[1],
        }  # fmt: skip


def study(
    folder: Path,
    signals: int = SIGNALS,
    step: float = STEP,
    workers: int | None = None,
    say: Callable[[str], None] = lambda text: None,
) -> Defects:
    """Run all levels, `signals` in all, and return the study.

    Raises InputError E-ENSEMBLE for a folder that holds another study.
    """
    each = max(2, math.ceil(signals / len(LEVELS)))
    found, levels = [], []
    for index, pga in enumerate(LEVELS):
        say(f"level {index + 1} of {len(LEVELS)}, {pga:g} m/s2, {each} signals")
        own = run_level(folder, index, each, step, workers)
        found.append(own)
        levels.append(_level(pga, own))
    one, other = np.concatenate([own["fell"] for own in found], axis=1)
    rocked = np.concatenate([own["rocked"] for own in found], axis=1)
    discordant = int(np.sum(one > other)), int(np.sum(other > one))
    return Defects(tuple(levels), difference(one, other), difference(*rocked), discordant, step)


def difference(one: np.ndarray, other: np.ndarray) -> Difference:
    """Return the share of events (n,) of one block less that of the other under the same signals."""
    ends = paired_interval(int(np.sum(one > other)), int(np.sum(other > one)), len(one))
    return Difference(float(np.mean(one - other)), *ends)


def _level(pga: float, own: dict[str, np.ndarray]) -> Level:
    fell, rocked = ((int(a.sum()), int(b.sum())) for a, b in own.values())
    return Level(pga, own["fell"].shape[1], fell, rocked, *[difference(a, b) for a, b in own.values()])
