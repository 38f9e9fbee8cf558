"""What a candidate is worth: gains window by window, on the runs that were fitted and on those that were not."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.api import Model
from rockref.discover.fit.approach import approached
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import MIDDLE, Setup, windows
from rockref.measure.experiment import Experiment

#: A window counts at most this much per sample value in a gain; decided: windows that fall into another order of corner
#: impacts by luck would else outweigh all others.
CLIP = 0.12
#: Share of the windows, the worst fitting ones, that the error in deg/s leaves out: they are out of step.
TRIMMED = 0.10


def clipped_gain(worse: np.ndarray, better: np.ndarray, count: np.ndarray) -> float:
    """Sum over windows of the loss difference, each clipped to CLIP per sample value."""
    limit = CLIP * count
    return float(np.sum(np.clip(worse - better, -limit, limit)))


def rms_deg_s(fit: Fit, point: Point) -> float:
    """RMS of the residual in deg/s over the windows, the worst TRIMMED share of them left out."""
    r = fit.residual(point.z, point.corrections) * fit.series.sigma
    mean = np.sum(r**2, axis=(1, 2)) / fit.series.count
    kept = mean <= np.quantile(mean, 1 - TRIMMED)
    return float(np.degrees(np.sqrt(np.sum(r[kept] ** 2) / np.sum(fit.series.count[kept]))))


@dataclass
class Losses:
    """Loss, number of values, and run of each window."""

    loss: np.ndarray
    count: np.ndarray
    run_of: np.ndarray


@dataclass
class HeldOut(Losses):
    """Held-out runs seen by a model whose shared parameters are fixed, and their RMS in deg/s (NaN without any)."""

    rms: float


def held_out(setup: Setup, fit: Fit, point: Point, experiment: Experiment, effects: tuple[str, ...]) -> HeldOut:
    """Apply the parameters of a fit to the held-out runs: only release tilt, phases and window states are free."""
    if not experiment.holdout_runs():
        return HeldOut(np.zeros(0), np.zeros(0), np.zeros(0, int), float("nan"))
    free, best = on_held_out(setup, fit.models(point.z)[0][0], effects, experiment)
    return HeldOut(best.loss, free.series.count, free.series.run_of, rms_deg_s(free, best))


def on_held_out(setup: Setup, model: Model, effects: tuple[str, ...], experiment: Experiment) -> tuple[Fit, Point]:
    """A model with all its shared numbers fixed on the held-out runs: only tilt, phases and window starts are free."""
    own = replace(setup, experiment=experiment, runs=experiment.holdout_runs(), base=model)
    parameters = tuple(p for p in own.parameters(effects) if p.run is not None)
    free = Fit(windows(own, MIDDLE, model), model, parameters, log=setup.log)
    start = free.relax_states(approached(free, np.zeros(len(parameters))), 2)
    return free, free.run(start, 3, np.random.default_rng(1))


def held_gains(plain: Losses, other: Losses, most: float = 3.0) -> list[float]:
    """By how much the loss falls on each run (1 is noise, `most` the most that a window counts).

    The windows of the two fits may be cut differently.
    """
    found = []
    for i in np.unique(plain.run_of):
        a, b = plain.run_of == i, other.run_of == i
        worse = np.minimum(2 * plain.loss[a] / plain.count[a], most)
        better = np.minimum(2 * other.loss[b] / other.count[b], most)
        found.append(float(np.mean(worse) - np.mean(better)))
    return found
