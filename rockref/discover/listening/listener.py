"""The measured runs of an experiment beside models that listen to them: predicted records and innovations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rockref.api import Model
from rockref.discover.listening.released import released
from rockref.discover.listening.target import Grid, Target, grid, target_of, ticks_upto, zero_offset
from rockref.discover.threads import on_threads, threads_left
from rockref.effects.base import Effect
from rockref.engines.compiled import pack
from rockref.engines.compiled.batch import batch_of
from rockref.engines.compiled.lanes import LANES
from rockref.engines.heard import Listening
from rockref.engines.listening import run_listening
from rockref.measure.gyroscope import expected, limited, sample
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.measure.signals.noise import noise_floor
from rockref.model.errors import InputError

#: The time for which a memory states its steps [s].
TICK = 0.5e-3
#: Rate that stands for a motion that lost its numbers [rad/s].
LOST = 50.0
#: Rows that are simulated at a time; decided: their rates at the ticks stay below 30 MB, which allocators keep at hand.
ROWS = 128
#: Innovations count no further than this many noise widths; decided: the robust loss is flat there.
FARTHEST = 1e3
#: Share by which measured and stated noise may differ and agree; decided: forty samples tell noise to a ninth.
AGREES = 0.12
#: Samples over which the steepest change about a sample is taken, and what of it is noise, in noise widths of a
#: difference (decided: five samples hold an impact's corner; 1.3 differences are rarely exceeded by noise alone).
STEEPEST, STEEP_NOISE = 5, 1.3


class Memory(NamedTuple):
    """How long a run remembers by itself: time constants of rates and attitude [s], and steps of the law in 0.5 ms.

    A run that listens is a Luenberger observer; its residuals are the innovations of prediction-error identification
    (L. Ljung, System Identification, 2nd ed., ISBN 0-13-656695-2, chapter 7).
    """

    rates: float
    attitude: float
    steps: int = 16


@dataclass(frozen=True)
class Job:
    """One set of models to be run: of each run the model that is released, or None where the run is left out."""

    models: tuple[Model | None, ...]


class Listener:
    """Runs of an experiment, ready to be compared with models that listen to them.

    Attributes
    ----------
    measured : (R, N, 3) records [rad/s], padded;  valid : (R, N) bool, which samples there are
    sigma : (R, 3) noise of a sample [rad/s];  slope : (R, N, 3) steepest change of the record nearby [rad/s^2]
    whole : the listener of which this one is a part: it knows the noise, and counts the block-steps, too
    """

    def __init__(
        self, experiment: Experiment, runs: Sequence[Run], end: float, workers: int | None = None,
        whole: Listener | None = None,
    ):  # fmt: skip
        if experiment.gyro is None:
            raise InputError("E-GYRO", f"{experiment.path}", "has no [gyro]", "State the gyroscope in experiment.toml.")
        self.experiment, self.gyro, self.runs = experiment, experiment.gyro, tuple(runs)
        self.end, self.workers = end, workers
        records = [record_of(run) for run in runs]
        counts = [int(np.searchsorted(t, end - 1e-9)) for t, _ in records]
        self.t = [t[:n] for (t, _), n in zip(records, counts, strict=True)]
        self.N = max(counts)
        self.measured = np.zeros((len(runs), self.N, 3))
        self.valid = np.zeros((len(runs), self.N), bool)
        for i, ((_, crv), n) in enumerate(zip(records, counts, strict=True)):
            self.measured[i, :n], self.valid[i, :n] = crv[:n], True
        noise = noise_of(runs, self.gyro) if whole is None else whole.sigma[0]
        self.sigma: np.ndarray = np.tile(noise, (len(runs), 1))
        self.slope = np.stack(
            [steepest(self.measured[i], self.sigma[i], self.gyro.sample_rate) for i in range(len(runs))]
        )
        self.ticks = grid(self.gyro.sample_rate, min(end, max(float(t[-1]) for t in self.t)))
        self._at = [ticks_at(self.ticks, t) for t in self.t]
        self._targets: dict[tuple, Target] = {}
        self._undone: dict[tuple[int, int], dict] = {}
        self._thinned: dict[int, Listener] = {}
        self._steps: list[int] = whole._steps if whole else []

    @property
    def simulated(self) -> int:
        """Return the number of block-steps so far."""
        return sum(self._steps)

    def thinned(self, most: float) -> Listener:
        """Return a listener to every second or further sample of faster records, so that `most` [Hz] or more are left.

        Where a memory is short and innovations are smoothed, more samples only take time.
        """
        factor = int(self.gyro.sample_rate / most + 1e-9)
        if factor < 2:
            return self
        if factor not in self._thinned:
            gyro = replace(self.gyro, sample_rate=self.gyro.sample_rate / factor)
            records = [(run, *record_of(run)) for run in self.runs]
            runs = [replace(run, t=t[::factor], crv=crv[::factor]) for run, t, crv in records]
            few = Listener(replace(self.experiment, gyro=gyro), runs, self.end, self.workers, whole=self)
            self._thinned[factor] = few
        return self._thinned[factor]

    def quieten(self, share: np.ndarray) -> None:
        """Take the noise of each axis to be a share (3,) of what it was taken for."""
        self.sigma = self.sigma * share
        for few in self._thinned.values():
            few.sigma = self.sigma

    def target(self, i: int, effects: tuple[Effect, ...], ticks: Grid | None = None) -> Target:
        """Return what run i tells of the block, its sensor having these effects; the last hundred are kept."""
        ticks = ticks or self.ticks
        key = (i, effects, ticks.count)
        if key not in self._targets:
            if len(self._targets) >= 100:
                self._targets.clear()
                self._undone.clear()
            undone = self._undone.setdefault((i, ticks.count), {})
            self._targets[key] = target_of(self.runs[i], self.gyro, effects, ticks, undone)
        return self._targets[key]

    def predict(self, jobs: Sequence[Job], memory: Memory, horizon: float | None = None) -> np.ndarray:
        """Return what the gyroscope would show of listening models, (J, R, N, 3) [rad/s]; zero where a run is left out.

        horizon [s] : how far each run is followed; N is then shorter.
        """
        N = self.N if horizon is None else min(self.N, int(horizon * self.gyro.sample_rate) + 1)
        out = np.zeros((len(jobs), len(self.runs), N, 3))
        rows = [(j, i, model) for j, job in enumerate(jobs) for i, model in enumerate(job.models) if model is not None]
        rows.sort(key=lambda row: [e.id for e in row[2].effects])  # stable: blocks with the same effects side by side
        threads = threads_left(len(rows), self.workers)
        size = min(ROWS, LANES * math.ceil(len(rows) / (LANES * threads)))
        pieces = [rows[k : k + size] for k in range(0, len(rows), size)]
        steps = on_threads(lambda piece: self._predict_rows(piece, memory, N, out), pieces, threads)
        self._steps += steps
        return out

    def _predict_rows(self, rows, memory: Memory, N: int, out: np.ndarray) -> int:
        """Write what is seen of some rows (job, run, model) to `out`; return the number of block-steps."""
        last = max(float(t[min(N, len(t)) - 1]) for t in self.t)
        ticks = Grid(self.ticks.interval, min(self.ticks.count, ticks_upto(last, self.ticks.interval)))
        problems = released([model for _, _, model in rows], [self.runs[i] for _, i, _ in rows])
        zeros = [zero_offset(model) for _, _, model in rows]
        rates, steps = self.listened([i for _, i, _ in rows], problems, memory, ticks, zeros)
        groups: dict[tuple[Effect, ...], list[int]] = {}
        for k, (_, _, model) in enumerate(rows):
            groups.setdefault(sensor_effects(model), []).append(k)
        for effects, members in groups.items():
            shown = expected(ticks.t, rates[members], self.gyro, effects)
            for k, seen in zip(members, shown, strict=True):
                j, i, _ = rows[k]
                t, at = self.t[i][:N], self._at[i]
                sampled = (sample(ticks.t, seen, t) if at is None else seen[at[:N]]) + zeros[k]
                out[j, i, : len(t)] = limited(t, sampled, self.gyro, effects)
        return steps

    def listened(
        self, which: Sequence[int], problems: Sequence, memory: Memory, ticks: Grid, zeros: Sequence = ()
    ) -> tuple[np.ndarray, int]:
        """Return body rates (B, K, 3) [rad/s] of released problems that listen to the runs `which`, and block-steps.

        zeros : offset (3,) [rad/s] of the gyroscope's zero in each
        """
        zeros = zeros or [(0.0,) * 3] * len(problems)
        rates, steps = np.empty((len(problems), ticks.count, 3)), 0
        numbers = np.array([p.points.n for p in problems])
        for n in np.unique(numbers):
            rows = np.flatnonzero(numbers == n).tolist()
            runs, alike, taken_off = ([of[k] for k in rows] for of in (which, problems, zeros))
            rates[rows], more = self._alike(runs, alike, taken_off, memory, ticks)
            steps += more
        np.nan_to_num(rates, copy=False, nan=LOST, posinf=LOST, neginf=-LOST)
        return np.clip(rates, -LOST, LOST, out=rates), steps

    def _alike(
        self, which: Sequence[int], problems: Sequence, zeros: Sequence, memory: Memory, ticks: Grid
    ) -> tuple[np.ndarray, int]:
        """Return the rates (B, K, 3) [rad/s] of problems with as many points each, and block-steps."""
        every = math.ceil(memory.steps * ticks.interval / TICK - 1e-9)
        keys = [(i, sensor_effects(p), zero) for i, p, zero in zip(which, problems, zeros, strict=True)]
        distinct = list(dict.fromkeys(keys))
        targets = [self.target(i, effects, ticks).less(zero, ticks) for i, effects, zero in distinct]
        K = ticks.count
        gains = [1.0 - math.exp(-ticks.interval / tau) for tau in (memory.rates, memory.attitude)]
        listening = Listening(
            rates=np.stack([t.rates[:K] for t in targets]),
            turns=np.stack([t.turns[:K] for t in targets]),
            heard=np.stack([t.heard[:K] for t in targets]),
            which=np.array([distinct.index(key) for key in keys]),
            gain_rate=np.full(len(problems), gains[0]),
            gain_attitude=np.full(len(problems), gains[1]),
            every=every,
        )
        stepped = [replace(p, step=ticks.interval / every) for p in problems]
        batch = batch_of(stepped, np.zeros(1, np.int64)) if all(map(pack.has_twin, problems)) else stepped
        return run_listening(batch, listening, workers=1), len(problems) * (K - 1) * every

    def innovations(self, predicted: np.ndarray, jitter: float = 0.0) -> np.ndarray:
        """Return (measured - predicted) in noise widths, (..., R, N, 3) as `predicted`; zero where there is no sample.

        jitter [s] : uncertainty of an instant, by which steep parts of a record count less, alike for all models.
        """
        N = predicted.shape[-2]
        width = np.sqrt(self.sigma[:, None, :] ** 2 + (jitter * self.slope[:, :N]) ** 2)
        r = self.measured[:, :N] - predicted
        r /= width
        np.clip(r, -FARTHEST, FARTHEST, out=r)
        r *= self.valid[:, :N, None]
        return r


def ticks_at(ticks: Grid, t: np.ndarray) -> np.ndarray | None:
    """Return which ticks the instants t (N,) [s] of a record are, (N,); None where they lie between ticks."""
    near = np.rint(t / ticks.interval).astype(int)
    # As `rockref.measure.gyroscope.sample` has it: a thousandth of a step is rounding of the clock.
    is_tick = np.abs(near * ticks.interval - t) <= 1e-3 * ticks.interval
    return near if is_tick.all() and near[-1] < ticks.count else None


def record_of(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Return times (N,) [s] and rates (N, 3) [rad/s] of an opened run."""
    assert run.t is not None and run.crv is not None
    return run.t, run.crv


def noise_of(runs: Sequence[Run], gyro: Gyro) -> np.ndarray:
    """Return the noise of a sample of each axis (3,) [rad/s]: the stated one, where calm stretches of the runs agree.

    Noise is the instrument's: where a block is never calm about an axis, the calmest run tells it. At least that of
    rounding.
    """
    rounding = gyro.resolution / math.sqrt(12)
    stated = math.hypot(gyro.noise, rounding)
    measured = [found for run in runs if (found := calm_noise(run)) is not None]
    if not measured:
        return np.full(3, stated)
    calmest = np.maximum(np.min(measured, axis=0), rounding)
    return np.where(np.abs(calmest - stated) <= AGREES * stated, stated, calmest)


def calm_noise(run: Run) -> np.ndarray | None:
    """Return the noise of each axis (3,) [rad/s] in calm stretches of a run; None of a run that is too short."""
    try:
        return noise_floor(*record_of(run)).sigma
    except InputError:
        return None


def steepest(crv: np.ndarray, sigma: np.ndarray, rate: float) -> np.ndarray:
    """Return the steepest change (N, 3) [rad/s^2] of a record among the samples nearby, noise taken off."""
    from scipy.ndimage import maximum_filter1d

    change = np.maximum(np.abs(np.gradient(crv, axis=0)) - STEEP_NOISE * sigma / math.sqrt(2), 0.0)
    return maximum_filter1d(change, STEEPEST, axis=0) * rate


def sensor_effects(thing) -> tuple[Effect, ...]:
    """Return the effects of a model or problem that act on the sensor."""
    return tuple(e for e in thing.effects if type(e).sensor is not Effect.sensor and not e.is_absent())
