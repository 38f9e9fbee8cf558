"""Faults of the gyroscope that read as if something moved the block: a zero that shifts, a late channel, mains hum.

The block itself tells them. It stands upright at every main impact, so that each rate adds up to no angle from one to
the next; its feet shake all three channels at the same instants; and nothing of it keeps a phase at 50 or 60 Hz.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence

import numpy as np

from rockref.measure.reading.columns import DEGREE, RATES
from rockref.measure.records.notice import Notice
from rockref.measure.records.release import Experiment, Run, SensorFault
from rockref.measure.signals.activity import leakage
from rockref.measure.signals.arcs import turned_angle
from rockref.measure.signals.impacts import Impacts, main_impacts
from rockref.measure.signals.running import running_mean, sample_step
from rockref.measure.signals.signal import growth_rate, rocking_rate, rocking_time, side_of

ZERO, LAG, HUM = "zero", "lag", "hum"
# In simulated records of 40 blocks the rates about X, Y and Z add up, from impact to impact, to means of at most 0.004,
# 0.007 and 0.014 of the first swing's rate. decided: two and a half times that, and a tenth of a deg/s.
ZERO_SHARES, ZERO_LEAST, LEAST_ARCS = (0.0105, 0.0175, 0.035), 0.1 * DEGREE, 3
# decided: by what share of the change arcs may differ. Nothing keeps a block from turning about its height; such a turn
# is not alike from arc to arc. The last tenth of a second is rest where it is no more than twice the noise.
STEADY, AT_END, CALM = (0.5, 0.5, 0.15), 0.1, 2.0
# decided: lags of up to four samples are looked for; six tenths of one are none of the shape of a contact.
MOST_LAG, LEAST_LAG, SAME_LAG = 4, 0.6, 0.35
# decided: a late channel fits better by a third at its lag than at none; of one run alone, by six tenths, which one of
# 320 simulated records without a lag did.
# Of one run alone lags of more than two and a half samples are shocks that are alike by chance.
CLEARER, CLEARER_ALONE, MOST_ALONE = 1.3, 1.6, 2.5
# decided: steps of more than twice the noise, and samples of more than 2.5 ms, leave shocks that are alike by chance.
COARSE, SLOW = 2.0, 2.5e-3
# decided: mains of 50 and 60 Hz and their first harmonics, which are kept to 0.3 Hz.
MAINS, OFF_MAINS, MAINS_STEP = (50.0, 60.0, 100.0, 120.0), 0.3, 0.1
# decided: six windows of 50 Hz; a quartic follows the motion in them.
HUM_WINDOW, HUM_DEGREE = 0.12, 4
# In simulated records without hum a line stands out by at most 4.0 of its errors. decided: 6.5, and half of the noise.
HUM_SIGMAS, HUM_NOISE = 6.5, 0.5


def sensor_faults(experiment: Experiment, runs: Sequence[Run]) -> tuple[list[SensorFault], list[Notice]]:
    """Return the faults of the gyroscope that the runs show, and the remarks on them (W-ZERO, W-LAG, W-HUM)."""
    opened = [run for run in runs if run.t is not None and run.crv is not None and run.release_tilt is not None]
    faults = [fault for run in opened for fault in (*_zeros(run, experiment), *_hums(run, experiment))]
    gyro = experiment.gyro
    if gyro is not None and gyro.resolution <= COARSE * gyro.noise and 1.0 / gyro.sample_rate <= SLOW:
        faults += _lags(opened)
    return faults, [_remark(fault, experiment, runs) for fault in faults]


def _remark(fault: SensorFault, experiment: Experiment, runs: Sequence[Run]) -> Notice:
    file = next((run.file for run in runs if run.id == fault.run), "")
    where = f"{experiment.path / file}, rate {RATES[fault.axis]}"
    if fault.kind == ZERO:
        if not fault.place:
            what = f"the zero is off by {fault.size / DEGREE:.3g} deg/s throughout: arcs between uprights add up to it"
            return Notice("W-ZERO", where, what, "Subtract what the gyroscope shows while the block stands.")
        what = f"the zero changes by {fault.size / DEGREE:.3g} deg/s at {fault.place:.3g} s"
        return Notice("W-ZERO", where, what, "The block stands upright there as before: it is the sensor that shifted.")
    if fault.kind == LAG:
        late = "late" if fault.size > 0 else "early"
        what = f"comes {1e3 * abs(fault.size):.3g} ms {late} beside the other two"
        return Notice("W-LAG", where, what, "Feet shake all three at once: shift the column, or read all at one time.")
    what = f"hums with {fault.size / DEGREE:.3g} deg/s at {fault.place:.4g} Hz throughout"
    return Notice(
        "W-HUM", where, what, "The mains are in the signal, not in the block: shield it, or take the line out."
    )


def _zeros(run: Run, experiment: Experiment) -> list[SensorFault]:
    """Return the channels whose mean from impact to impact is another one than before the first impact."""
    assert run.t is not None and run.crv is not None and run.release_tilt is not None and experiment.gyro is not None
    t, crv, gyro = run.t, run.crv, experiment.gyro
    impacts = main_impacts(t, crv)
    if len(impacts) <= LEAST_ARCS:  # the last half of three arcs has two
        return []
    rate = rocking_rate(run.release_tilt, experiment.width, experiment.height)
    before = _zeros_before(run, experiment, impacts)
    spans = np.diff(impacts.times)
    # An impact is known to a sample or two, in which the block turns on.
    slack = 2.0 * sample_step(t) * rate / float(np.median(spans)) + gyro.noise + gyro.resolution
    end = crv[t > t[-1] - AT_END]
    calm = end.std(axis=0) < CALM * math.hypot(gyro.noise, gyro.resolution)
    found = []
    for axis in range(3):
        means = np.diff(np.interp(impacts.times, t, turned_angle(t, crv[:, axis]))) / spans
        at_end = float(end[:, axis].mean()) if calm[axis] else None
        least = ZERO_SHARES[axis] * rate + ZERO_LEAST + slack
        fault = _zero(means, before[axis], at_end, least, axis)
        if fault is not None:
            size, arc = fault
            found.append(SensorFault(ZERO, run.id, axis, size, float(impacts.times[arc]) if arc is not None else 0.0))
    return found


def _zero(
    means: np.ndarray, before: float, at_end: float | None, least: float, axis: int
) -> tuple[float, int | None] | None:
    """Return by how much a zero is off, rad/s, and the arc from which on, None for all; None where it is in order.

    means (K,) rad/s of the arcs, before them, and at the end where that is rest; `least` rad/s is seen.
    """
    level = float(np.median(means))
    # Arcs that add up to nothing after a start that moves: it was the block that moved.
    if axis != 2 and abs(level) <= 0.5 * least:
        return None
    last = means[len(means) // 2 :] - before
    change = float(np.median(last))
    if abs(change) <= least:
        # About its height a block turns on from arc to arc; upright it stands after each.
        alike = np.abs(means - level).max() <= STEADY[axis] * abs(level)
        stays = at_end is None or abs(at_end - level) <= 0.5 * abs(level)
        return (level, None) if axis != 2 and abs(level) > least and alike and stays else None
    # Clatter about an apex may pass for an impact: two such arcs turn the block away and back.
    if np.abs(last - change).max() > STEADY[axis] * abs(change):
        return None
    # A zero that has shifted stays so in a block that has come to rest.
    if at_end is not None and abs(at_end - before - change) > 0.5 * abs(change):
        return None
    after = np.abs(means - before) > 0.5 * abs(change)
    return change, int(np.argmax(after)) if after.any() else 0


def _zeros_before(run: Run, experiment: Experiment, impacts: Impacts) -> tuple[float, float, float]:
    """Return what each channel shows of a block at rest, rad/s: X at the release, Y and Z in the first swing."""
    assert run.t is not None and run.crv is not None and run.release_tilt is not None
    size = experiment.width, experiment.height
    rest = 0.05 * rocking_time(run.release_tilt, *size)
    at_rest = run.crv[run.t <= rest, 0]
    y, z = leakage(run.t, run.crv, impacts).offsets
    if not len(at_rest):
        return 0.0, float(y), float(z)
    # The block begins to move: its mean rate by then, for arcs that grow as cosh(p t).
    left = math.atan2(*size) - run.release_tilt
    drift = side_of(run) * left * (math.cosh(growth_rate(*size) * rest) - 1.0) / rest
    return float(at_rest.mean()) - drift, float(y), float(z)


def _lags(runs: Sequence[Run]) -> list[SensorFault]:
    """Return the channel that is late in at least half of the runs, by the same lag, if there is one."""
    found = []
    for run in runs:
        assert run.t is not None and run.crv is not None
        late = late_channel(run.crv, CLEARER if len(runs) > 1 else CLEARER_ALONE)
        if late is not None and (len(runs) > 1 or abs(late[1]) <= MOST_ALONE):
            found.append((late[0], late[1] * sample_step(run.t)))
    if not found or len(found) < max(1, 0.5 * len(runs)):
        return []
    axis, count = Counter(axis for axis, _ in found).most_common(1)[0]
    if count < min(2, len(runs)) or count < 0.8 * len(found):
        return []
    return [SensorFault(LAG, "", axis, float(np.median([lag for other, lag in found if other == axis])))]


def late_channel(crv: np.ndarray, clearer: float) -> tuple[int, float] | None:
    """Return the channel of crv (N, 3) that comes late beside the other two, and its lag in samples, or None."""
    shocks = np.abs(np.diff(crv, 2, axis=0))
    shocks = shocks - running_mean(shocks, 15)
    pairs = {(a, b): _lag(shocks[:, a], shocks[:, b]) for a, b in ((0, 1), (0, 2), (1, 2))}
    for axis in range(3):
        others = [other for other in range(3) if other != axis]
        lags = [pairs[min(axis, o), max(axis, o)][0] * (1.0 if o < axis else -1.0) for o in others]
        gain = min(pairs[min(axis, o), max(axis, o)][1] for o in others)
        together = abs(pairs[others[0], others[1]][0]) < SAME_LAG and abs(lags[0] - lags[1]) < SAME_LAG
        if together and min(map(abs, lags)) > LEAST_LAG and gain > clearer:
            return axis, float(np.mean(lags))
    return None


def _lag(a: np.ndarray, b: np.ndarray) -> tuple[float, float]:
    """Return by how many samples b (N,) follows a (N,), and how much better it fits there than without a lag."""
    n = len(a)
    if n < 4 * MOST_LAG:
        return 0.0, 1.0
    fits = np.array(
        [a[MOST_LAG : n - MOST_LAG] @ b[MOST_LAG + k : n - MOST_LAG + k] for k in range(-MOST_LAG, MOST_LAG + 1)]
    )
    best = int(fits.argmax())
    gain = float(fits[best]) / max(float(fits[MOST_LAG]), 1e-3 * abs(float(fits[best])), 1e-300)
    bend = fits[best - 1] - 2.0 * fits[best] + fits[best + 1] if 0 < best < 2 * MOST_LAG else 0.0
    part = 0.5 * float((fits[best - 1] - fits[best + 1]) / bend) if bend < 0.0 else 0.0
    return best - MOST_LAG + part, gain


def _hums(run: Run, experiment: Experiment) -> list[SensorFault]:
    """Return the channels with a line of the mains that keeps its phase throughout."""
    assert run.t is not None and run.crv is not None and experiment.gyro is not None
    step, noise = sample_step(run.t), experiment.gyro.noise
    size = max(24, round(HUM_WINDOW / step))
    if len(run.t) < 4 * size or not noise > 0.0:
        return []
    rows = np.lib.stride_tricks.sliding_window_view(np.arange(len(run.t)), size)[:: size // 2]
    basis, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, size), HUM_DEGREE + 1))
    rest = run.crv[rows] - np.einsum("sk,uk,wua->wsa", basis, basis, run.crv[rows], optimize=True)
    steps = np.arange(-OFF_MAINS, OFF_MAINS + 0.5 * MAINS_STEP, MAINS_STEP)
    found: dict[int, tuple[float, float, float]] = {}
    for frequency in [line + off for line in MAINS for off in steps if line < 0.4 / step]:
        waves = np.exp(-2j * math.pi * frequency * run.t[rows])
        waves = waves - (waves @ basis) @ basis.T
        for axis, (clear, size_) in enumerate(_lines(rest, waves, noise)):
            if clear > max(HUM_SIGMAS, found.get(axis, (0.0,))[0]) and size_ > HUM_NOISE * noise:
                found[axis] = (clear, size_, frequency)
    return [SensorFault(HUM, run.id, axis, size_, float(line)) for axis, (_, size_, line) in sorted(found.items())]


def _lines(rest: np.ndarray, waves: np.ndarray, noise: float) -> list[tuple[float, float]]:
    """Return for each axis how many errors a line stands out by, and its amplitude: a weighted mean over windows.

    rest : (W, S, 3) what is left of the motion in each window; waves : (W, S) complex, less what is motion.
    """
    power = (np.abs(waves) ** 2).sum(axis=1)
    found = []
    for axis in range(3):
        amplitude = 2.0 * (rest[:, :, axis] * waves).sum(axis=1) / power
        left = ((rest[:, :, axis] - (amplitude[:, None] * waves.conj()).real) ** 2).mean(axis=1)
        weight = 1.0 / np.maximum(left, (0.5 * noise) ** 2)
        mean = (weight * amplitude).sum() / weight.sum()
        spread = (weight * np.abs(amplitude - mean) ** 2).sum() / weight.sum()
        count = weight.sum() ** 2 / (weight**2).sum()
        found.append((float(np.abs(mean) / max(math.sqrt(spread / count), 1e-300)), float(np.abs(mean))))
    return found
