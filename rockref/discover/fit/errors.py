"""The error of a fitted model over windows, by stretch and axis, on fitted and on held-out runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.stretches import AXES
from rockref.discover.fit.evidence import TRIMMED, on_held_out
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import Setup
from rockref.discover.windows.on_time import on_time
from rockref.measure.experiment import HOLDOUT, Experiment, load_experiment
from rockref.measure.impacts import main_impacts
from rockref.measure.repeatability import repeat_groups, repeatability
from rockref.model.channel import DEGREES

#: Stretches of windows: the one from the release on, those in which a main impact falls, and the others.
STRETCHES = ("release", "impact", "arc")
STRETCH_WORDS = {
    "release": "from the release past the first main impact",
    "impact": "windows with a main impact",
    "arc": "windows between main impacts",
}
FIT_STRETCH = (
    "windows of 50 to 90 ms over the first {end:g} s of each run, each restarted from the reconstructed state; the "
    "worst tenth of the windows left out"
)


@dataclass(frozen=True)
class Errors:
    """RMS of measured minus modelled in deg/s: `total`, `table` (stretch, axis), and the `noise` floor."""

    total: float
    table: np.ndarray
    noise: float

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers by stretch and axis."""
        rows = {s: {a: _plain(self.table[i, j]) for j, a in enumerate(AXES)} for i, s in enumerate(STRETCHES)}
        return {"total": self.total, "by_stretch_and_axis": rows}


def _plain(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def errors_of(fit: Fit, point: Point) -> Errors:
    """The errors of a fit over its windows, the worst tenth of them left out."""
    s = fit.series
    square = (fit.residual(point.z, point.corrections) * s.sigma * DEGREES) ** 2
    mean = square.sum(axis=(1, 2)) / s.count
    kept = mean <= np.quantile(mean, 1 - TRIMMED)
    per_axis, samples = square.sum(axis=1), s.count / 3
    table = np.full((len(STRETCHES), 3), np.nan)
    kinds = stretch_of(fit)
    for i, name in enumerate(STRETCHES):
        # A release is not restarted: it cannot be out of step, and is never left out.
        mask = (kinds == name) & (kept | s.first)
        if mask.any():
            table[i] = np.sqrt(per_axis[mask].sum(axis=0) / samples[mask].sum())
    total = float(np.sqrt(square[kept].sum() / s.count[kept].sum()))
    return Errors(total, table, float(DEGREES * s.sigma))


def stretch_of(fit: Fit) -> np.ndarray:
    """The stretch of each window, (B,) of names."""
    s = fit.series
    kinds = np.where(s.first, "release", "arc").astype("<U8")
    for i, run in enumerate(s.runs):
        times = np.asarray(main_impacts(run.t, run.crv).times) * s.rate
        for b in np.flatnonzero((s.run_of == i) & ~s.first):
            if np.any((times >= s.start[b]) & (times < s.stop[b])):
                kinds[b] = "impact"
    return kinds


def holdout_errors(setup: Setup, model: Model, effects: tuple[str, ...]) -> Errors | None:
    """Errors on the held-out runs, or None where there are none. Opens their files."""
    experiment = load_experiment(setup.experiment.path, uses=(HOLDOUT,))
    if not experiment.holdout_runs():
        return None
    return errors_of(*on_held_out(setup, model, effects, on_time(experiment)))


def spread_of(experiment: Experiment, end: float) -> np.ndarray | None:
    """By how much two repeated runs differ about each axis, (3,) deg/s, up to `end` s after the release; None without.

    The root of two times the standard deviation between runs, noise included, aligned at the first main impact.
    """
    squares = []
    for group in repeat_groups(experiment.runs):
        pairs = [(run.t, run.crv) for run in group if run.t is not None and run.crv is not None]
        found = repeatability(pairs)
        first = float(main_impacts(*pairs[0]).times[0])
        seen = found.spread[found.t < end - first]
        squares.append(2.0 * np.nanmean(seen**2, axis=0))
    return DEGREES * np.sqrt(np.mean(squares, axis=0)) if squares else None
