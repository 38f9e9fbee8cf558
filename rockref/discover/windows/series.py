"""Short windows of a run, each restarted from the reconstructed state, laid end to end and seen through the gyroscope.

A rocking block forgets: after a few impacts a model that is right in everything but its start is out of step. Over a
tenth of a second it is not. So each run is cut where the motion is smooth; every window starts from the state that the
gyroscope implies, with five small corrections of its own; and the pieces, joined, pass through the gyroscope's filter.
"""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, field, replace

import numpy as np

from rockref.api import Model
from rockref.discover.threads import threads_left
from rockref.discover.windows.clipped import unclipped
from rockref.discover.windows.handed_on import leaves_dents, plate_of, spin_slip
from rockref.discover.windows.on_time import gyro_of
from rockref.discover.windows.own import own_of, run_own
from rockref.discover.windows.pieces import pieces
from rockref.discover.windows.reconstruct import (
    attitudes,
    local_rates,
    plate_motion,
    roughness,
    standing_place,
    yaw_since_touch,
)
from rockref.discover.windows.record import filter_coefficients, records
from rockref.discover.windows.standing import standing_starts
from rockref.effects.sensor.gyro_bandwidth import DAMPING, undo_low_pass
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.engines.compiled import columns as col
from rockref.engines.compiled import pack, slots
from rockref.engines.compiled.batch import Batch, run_batch
from rockref.measure.experiment import Experiment
from rockref.measure.impacts import main_impacts
from rockref.model.errors import InputError
from rockref.model.problem import Problem
from rockref.model.rotation import exponential
from rockref.model.simulate import largest_step

#: Step inside windows [s]; decided: 16 steps a millisecond; halving it changes the residual by less than a hundredth
#: of the noise (the gate measures it again on every experiment).
STEP = 1e-3 / 16
#: Seconds after a restart whose samples do not count: the filter of the gyroscope settles (300 Hz: 0.75 ms).
SETTLE = 4e-3
#: Corrections of a window's start: tilt, roll [rad], three rates [rad/s].
STATES = 5


def refinement(model: Model) -> int:
    """Into how many parts `STEP` is divided, so that it is stable inside windows with all points on the plate at once.

    One for blocks up to nearly twice as stiff as that of Table 3.1. With twenty times its stiffness and undivided
    steps, windows that begin at the truth leave 1.24 times the noise, and 0.97 with these.
    """
    return math.ceil(STEP / largest_step(model.problem()))


@dataclass(frozen=True)
class Cut:
    """Windows of one run: first and last+1 sample of each, (w,)."""

    start: np.ndarray
    stop: np.ndarray


def cut(crv: np.ndarray, rate: float, shortest: float, longest: float, first_end: float, end: float) -> Cut:
    """Cut a record where it is smooth: the first window ends after `first_end` s, the others have the given lengths.

    crv : (N, 3) [rad/s], with the gyroscope's filter undone; rate [Hz]; end [s]: what lies beyond is not used.
    """
    rough = roughness(crv, rate)
    last = min(len(crv), int(end * rate))
    marks = [0]
    low, high = int(first_end * rate), int((first_end + longest - shortest + 0.02) * rate)
    while high < last:
        marks.append(low + int(np.argmin(rough[low:high])))
        low, high = marks[-1] + int(shortest * rate), marks[-1] + int(longest * rate)
    marks.append(last)
    if len(marks) > 2 and marks[-1] - marks[-2] < shortest * rate / 2:
        marks.pop(-2)
    return Cut(np.array(marks[:-1]), np.array(marks[1:]))


@dataclass(frozen=True)
class Sensor:
    """What is between the block and the record: everything that a gyroscope may do to the crv.

    turn : rotation vector of a misalignment [rad]; skew : xy, xz, yz of axes that are not square [rad]
    scale : of each axis; bias [rad/s]; drift [rad/s2]
    bandwidth, damping : [Hz] and [1] of a further low-pass, inf for none; range : [rad/s] at which it saturates
    softness : share by which its stops are soft
    clock : seconds of the block per second of the device
    """

    turn: np.ndarray = field(default_factory=lambda: np.zeros(3))
    skew: np.ndarray = field(default_factory=lambda: np.zeros(3))
    scale: np.ndarray = field(default_factory=lambda: np.ones(3))
    bias: np.ndarray = field(default_factory=lambda: np.zeros(3))
    drift: np.ndarray = field(default_factory=lambda: np.zeros(3))
    bandwidth: float = np.inf
    damping: float = DAMPING
    range: float = np.inf
    softness: float = 0.0
    clock: float = 1.0

    def matrix(self) -> np.ndarray:
        """(3, 3) scale times skew times rotation: what the axes of the record are made of."""
        xy, xz, yz = self.skew
        square = np.array([[1.0, xy, xz], [xy, 1.0, yz], [xz, yz, 1.0]])
        return self.scale[:, None] * (square @ exponential(np.asarray(self.turn, float)))


def sensor_of(model: Model) -> Sensor:
    """The sensor effects of a model as one Sensor. Raises InputError (E-TWIN) for a delay, which windows do not know.

    A window begins where the record says that the block was at that instant.
    """
    values: dict = {}
    for e in model.effects:
        v = e.values()
        if e.id == "gyro_misalignment":
            values["turn"] = np.array([v["x"], v["y"], v["z"]])
            values["skew"] = np.array([v["xy"], v["xz"], v["yz"]])
        elif e.id == "gyro_scale":
            values["scale"] = np.array([v["x"], v["y"], v["z"]])
        elif e.id == "gyro_drift":
            values["bias"] = np.array([v["bias_x"], v["bias_y"], v["bias_z"]])
            values["drift"] = np.array([v["rate_x"], v["rate_y"], v["rate_z"]])
        elif e.id == "gyro_bandwidth":
            values["bandwidth"], values["damping"] = v["frequency"], v["damping"]
            if v["delay"]:
                cure = "Take the delay off the times of the records first, and out of the model."
                raise InputError("E-TWIN", f"effect {e.id}", "has a delay: windows begin where the record says", cure)
        elif e.id == "gyro_saturation":
            values["range"], values["softness"] = v["range"], v["softness"]
        elif e.id == "clock_error":
            values["clock"] = v["rate"]
    return Sensor(**values)


def true_rates(crv: np.ndarray, t: np.ndarray, rate: float, bandwidth: float, sensor: Sensor) -> np.ndarray:
    """The block's rates at the samples of a record, with the sensor undone, (N, 3) [rad/s]; crv: with no flat tops.

    Sample k of the device stands at t_k * clock in the block's own time.
    """
    _, bent_back = GyroSaturation(sensor.range, sensor.softness).undo(t, crv)
    w = bent_back - sensor.bias - sensor.drift * t[:, None]
    own = ((sensor.bandwidth, sensor.damping),) if np.isfinite(sensor.bandwidth) else ()
    return undo_low_pass(w, rate, ((bandwidth, DAMPING), *own)) @ np.linalg.inv(sensor.matrix()).T


def running_mean(r: np.ndarray, samples: int) -> np.ndarray:
    """Means of r (B, M, 3) over so many samples about each, times their root: white noise keeps its size.

    At the ends the mean is over what is there, and counts for less.
    """
    sums = np.concatenate([np.zeros_like(r[:, :1]), np.cumsum(r, axis=1)], axis=1)
    first = np.arange(r.shape[1]) - samples // 2
    begin, end = np.maximum(first, 0), np.minimum(first + samples, r.shape[1])
    return (sums[:, end] - sums[:, begin]) / np.sqrt(samples)


class Series:
    """The runs of an experiment cut into windows, ready to be compared with any model.

    B windows in all; residuals are (B, M, 3) in noise sigmas, zero where a sample does not count. `refine` divides the
    step inside the windows.
    """

    ROWS_PER_SAMPLE = 2

    def __init__(self, experiment: Experiment, runs, cuts, refine: int = 1, workers: int | None = None):
        self.experiment, self.runs, self.cuts = experiment, tuple(runs), tuple(cuts)
        self.refine, self.workers = refine, workers
        gyro = gyro_of(experiment)
        self.rate, self.bandwidth = gyro.sample_rate, gyro.bandwidth
        self.sigma = float(np.sqrt(gyro.noise**2 + gyro.resolution**2 / 12))
        self.run_of = np.concatenate([np.full(len(c.start), i) for i, c in enumerate(self.cuts)])
        self.start = np.concatenate([c.start for c in self.cuts])
        self.stop = np.concatenate([c.stop for c in self.cuts])
        self.length = self.stop - self.start
        self.first = self.start == 0
        self.B, self.M = len(self.start), int(self.length.max())
        self.time = self.start / self.rate
        k = np.arange(self.M)
        settled = k[None, :] >= max(2, round(SETTLE * self.rate))
        self.valid = (k[None, :] < self.length[:, None]) & (settled | self.first[:, None])
        self.count = 3 * self.valid.sum(axis=1)
        self.measured = np.zeros((self.B, self.M, 3))
        for b in range(self.B):
            self.measured[b, : self.length[b]] = self.runs[self.run_of[b]].crv[self.start[b] : self.stop[b]]
        self._weight = self.valid[:, :, None] / self.sigma
        self._unclipped = unclipped(experiment, self.runs)
        self._rates: dict = {}
        self._rows = np.empty((0, col.STATE))
        self._prepared: tuple | None = None
        self._wanted: tuple | None = None
        self._releases: list[Problem] = []
        self._carried, self._pressed = np.zeros((self.B, 4)), np.zeros((self.B, 1))

    def twin(self) -> Series:
        """The same windows for another thread: what is kept from call to call is its own."""
        other = copy.copy(self)
        other._rates = dict(self._rates)
        other._rows = np.empty((0, col.STATE))
        other._carried, other._pressed = self._carried.copy(), self._pressed.copy()
        return other

    def rates(self, i: int, sensor: Sensor) -> tuple[np.ndarray, np.ndarray]:
        """True rates of run i and the smoothed ones; kept for the sensors that were seen last."""
        names = ("turn", "skew", "scale", "bias", "drift", "bandwidth", "damping", "range", "softness")
        key = (i, *(np.asarray(getattr(sensor, n), float).tobytes() for n in names))
        if key not in self._rates:
            if len(self._rates) > 64:
                self._rates.clear()
            run = self.runs[i]
            w = true_rates(self._unclipped[i], run.t, self.rate, self.bandwidth, sensor)
            self._rates[key] = (np.ascontiguousarray(w), local_rates(w, self.rate))
        return self._rates[key]

    def prepared(self, models, tilt: np.ndarray, sensor: Sensor) -> tuple[np.ndarray, ...]:
        """All windows but for their corrections; the last answer is kept, since corrections move far more often.

        body, P, props, effects rows, attitude, rates, standing orientation and place, release state and memory, and
        the turn in spin of the carrying point and the motion of the plate under it. With a user's own effect the
        releases are kept as problems, too.
        """
        key = (tuple(id(m) for m in models), tilt.tobytes())
        if self._prepared is not None and self._prepared[0] == key:
            return self._prepared[2]
        B, n = self.B, models[0].body()[1].n
        body, P, props = np.empty((B, col.BODY)), np.empty((B, n, 3)), np.empty((B, n, col.PROPS))
        effects, state = np.zeros((B, slots.SLOTS)), np.zeros((B, col.STATE))
        memory, Lambda, W = np.zeros((B, n, col.MEMORY)), np.empty((B, 3, 3)), np.empty((B, 3))
        upright, place, yaw, plate = np.empty((B, 3, 3)), np.empty((B, 3)), np.zeros(B), np.zeros((B, 4))
        releases: list[Problem] = []
        for i, run in enumerate(self.runs):
            turned = bool(run.block_turned)
            roll = float(models[i].origin.get("roll_offset", 0.0))
            start_of = {"theta_0": tilt[i], "turned": turned, "out_of_plane": roll}
            problem = pack.with_memory(models[i].problem(duration=1.0, **start_of))
            at = np.flatnonzero(self.run_of == i)
            body[at], P[at], props[at] = pack.body_row(problem), problem.points.P, pack.props_rows(problem)
            if own_of(problem.effects):
                releases.append(problem)
            else:
                effects[at] = pack.effects_row(problem)
            w, smooth = self.rates(i, sensor)
            start = problem.start
            L = attitudes(np.ascontiguousarray(start.Lambda), w, sensor.clock / self.rate)
            Lambda[at], W[at] = L[self.start[at]], smooth[self.start[at]]
            standing = np.diag([-1.0, -1.0, 1.0]) if turned else np.eye(3)
            upright[at], place[at] = standing, standing_place(problem.points.P, standing, start.x, start.Lambda)
            state[at], memory[at] = pack.state_row(problem), pack.memory_rows(start)
            if most := spin_slip(models[i], problem):
                dt = sensor.clock / self.rate
                yaw[at] = yaw_since_touch(L, w, problem.points.P, self.start[at], dt, most)
            if support := plate_of(models[i]):
                dt, mass, g = sensor.clock / self.rate, float(problem.block.mass), float(problem.block.g)
                feet = np.ascontiguousarray((problem.points.P @ standing.T + place[at[0]])[:, 1])
                plate[at] = plate_motion(L, w, problem.points.P, feet, dt, mass, g, *support)[self.start[at]]
        result = (body, P, props, effects, Lambda, W, upright, place, state, memory, yaw, plate)
        self._prepared, self._releases = (key, models, result), releases
        return result

    def starts(self, models, tilt: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Attitude (B, 3, 3) and rates (B, 3) [rad/s] with which the windows begin, without corrections."""
        _, _, _, _, Lambda, W, *_ = self.prepared(models, tilt, sensor_of(models[0]))
        return Lambda, W

    def pieces(self, which=None, beyond: int = 0) -> list[tuple[slice, int]]:
        """Neighbours among the windows `which` (default all) that are alike, and how many samples of them count, and so
        many `beyond`."""
        length, first = (self.length, self.first) if which is None else (self.length[which], self.first[which])
        return pieces(length + beyond, first, self.M)

    def stepped(self, batch: Batch, which: np.ndarray) -> np.ndarray:
        """States of the windows `which` at the steps that are wanted, (len(which), R, STATE)."""
        out = self._buffer(len(which), batch.wanted.shape[1])
        if self._releases:
            return run_own(batch, self._releases, self.run_of[which], out)
        return run_batch(batch, threads_left(len(which), self.workers), out=out)

    def counted(self, which: np.ndarray, upto: np.ndarray) -> np.ndarray:
        """Sample values of the windows `which` that count among their first `upto` samples, (len(which),)."""
        return 3 * np.maximum(np.sum(self.valid[which] & (np.arange(self.M) < upto[:, None]), axis=1), 1)

    def batch(
        self, models, tilt: np.ndarray, corrections: np.ndarray, which: np.ndarray, sensor: Sensor, length
    ) -> Batch:
        """Windows `which` as one batch. models: one a run; tilt (runs,) [rad]; corrections (len(which), STATES)."""
        arrays = [a[which] for a in self.prepared(models, tilt, sensor)]
        body, P, props, effects, Lambda, W, upright, place, release, release_memory, yaw, plate = arrays
        if plate_of(models[0]) is not None:
            plate = plate + self._carried[which]
        state, memory = np.empty_like(release), np.empty_like(release_memory)
        pressed = np.zeros(P.shape[:2]) + self._pressed[which]
        standing_starts(Lambda, W, corrections, body, P, props, effects, pressed, upright, place, plate, state, memory)
        memory[:, :, col.YAW] = memory[:, :, col.ANCHORED] * yaw[:, None]
        state[:, col.TIME] = state[:, col.ORIGIN] = self.time[which] * sensor.clock
        first = self.first[which]
        state[first], memory[first] = release[first], release_memory[first]
        # As many steps for each row of a sample, none longer than STEP; but for rounding of the quotient.
        per_sample = self.ROWS_PER_SAMPLE * math.ceil(self.refine / self.rate / STEP / self.ROWS_PER_SAMPLE - 1e-9)
        wanted = self.wanted(length, per_sample)
        return Batch(body, P, props, memory, effects, state, sensor.clock / self.rate / per_sample, wanted)

    def wanted(self, length: np.ndarray, per_sample: int) -> np.ndarray:
        """The steps whose states are kept, -1 where there are none, (windows, R); the last answer is kept."""
        key = (per_sample, length.tobytes())
        if self._wanted is None or self._wanted[0] != key:
            rows = np.arange(int(length.max()) * self.ROWS_PER_SAMPLE + 1) * (per_sample // self.ROWS_PER_SAMPLE)
            self._wanted = (key, np.where(rows <= length[:, None] * per_sample, rows, -1).astype(np.int64))
        return self._wanted[1]

    def carry(self, models, tilt: np.ndarray, corrections: np.ndarray) -> bool:
        """Let the plate and the dents under each window begin as the window before it left them; whether there are any.

        Among a user's own effects dents begin where the window begins.
        """
        plate = plate_of(models[0])
        if plate is None and not leaves_dents(models[0]):
            return False
        sensor = sensor_of(models[0])
        batch = self.batch(models, tilt, corrections, np.arange(self.B), sensor, self.length)
        batch = replace(batch, wanted=batch.wanted[np.arange(self.B), self.length * self.ROWS_PER_SAMPLE][:, None])
        follows = np.flatnonzero((self.stop[:-1] == self.start[1:]) & (self.run_of[:-1] == self.run_of[1:])) + 1
        if self._releases:
            ends = self.stepped(batch, np.arange(self.B))
        else:
            ends, _, memory = run_batch(batch, threads_left(self.B, self.workers), full=True)
            self._pressed = np.zeros(memory.shape[::2])
            self._pressed[follows] = np.nan_to_num(memory[follows - 1, 0, :, col.XI_LARGEST])
        if plate is not None:
            began = self.prepared(models, tilt, sensor)[-1]
            self._carried[follows] = np.nan_to_num(ends[follows - 1, 0, col.PLATE] - began[follows])
        return True

    def simulate(self, models, tilt: np.ndarray, corrections: np.ndarray, which=None, upto=None) -> np.ndarray:
        """Modelled records at the samples of the windows `which` (default all), (len(which), M, 3) [rad/s]."""
        which = np.arange(self.B) if which is None else np.asarray(which)
        length = self.length[which] if upto is None else np.minimum(upto, self.length[which])
        s = sensor_of(models[0])
        batch = self.batch(models, tilt, corrections, which, s, length)
        states = self.stepped(batch, which)
        step = 1 / self.rate / self.ROWS_PER_SAMPLE
        follows = np.zeros(len(which), bool)
        slow = None
        if np.isfinite(s.bandwidth):
            slow = filter_coefficients(step, s.bandwidth, s.damping)
            same_run = self.run_of[which[:-1]] == self.run_of[which[1:]]
            follows[1:] = (self.stop[which[:-1]] == self.start[which[1:]]) & same_run
        return records(
            states, s.matrix(), filter_coefficients(step, self.bandwidth), slow, follows, length, self.M,
            self.ROWS_PER_SAMPLE, self.time[which], 1 / self.rate, s.bias, s.drift, s.range, s.softness,
        )  # fmt: skip

    def _buffer(self, B: int, R: int) -> np.ndarray:
        """Memory for the rows of a batch, kept from call to call (fresh pages cost as much as the simulation)."""
        if B * R > len(self._rows):
            self._rows = np.empty((B * R, col.STATE))
        return self._rows[: B * R].reshape(B, R, col.STATE)

    def residual(self, models, tilt: np.ndarray, corrections: np.ndarray, which=None, upto=None) -> np.ndarray:
        """(measured - modelled) / sigma, (len(which), M, 3); zero where a sample does not count."""
        r = self.simulate(models, tilt, corrections, which, upto)
        for rows, n in self.pieces(which):
            own = rows if which is None else which[rows]
            np.subtract(self.measured[own, :n], r[rows, :n], out=r[rows, :n])
            r[rows, :n] *= self._weight[own, :n]
        if upto is not None:
            r *= (np.arange(self.M) < upto[:, None])[:, :, None]
        return r


def series(
    experiment: Experiment, runs, shortest: float, longest: float, end: float, sensor: Sensor | None = None, **options
) -> Series:
    """Cut the runs into windows of `shortest` to `longest` s up to `end` s; the first ends 45 ms after the impact."""
    cuts = []
    for run, whole in zip(runs, unclipped(experiment, runs), strict=True):
        gyro = gyro_of(experiment)
        w = true_rates(whole, run.t, gyro.sample_rate, gyro.bandwidth, sensor or Sensor())
        until = float(main_impacts(run.t, run.crv).times[0]) + 0.045
        cuts.append(cut(w, gyro.sample_rate, shortest, longest, until, end))
    return Series(experiment, tuple(runs), tuple(cuts), **options)
