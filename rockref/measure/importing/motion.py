"""What a recording shows before anything is known of its axes and units: standing, release, first swing, main axis.

A block let go on its edge turns by A sinh(p (t - t0)), p^2 = 3g/4R, until its other feet touch (Housner 1963). Its
sides alone give p and the tipping angle alpha; the time T of the first swing gives the tilt, alpha (1 - 1/cosh(p T)),
whatever the unit of the rates. The angle that they add up to in that time is therefore a gauge of their unit.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from rockref.measure.importing.recording import Recording
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.running import half_width, running_mean, sample_step
from rockref.measure.signals.signal import growth_rate, stretches
from rockref.model.errors import InputError

# decided: in 50 ms a block that moves leaves the scatter of one that stands, and 25 samples at 500 Hz show it.
WINDOW = 0.05
# decided: rates within four noise widths of their mean in a window, for 0.15 s, are those of a block that stands.
CALM_SIGMAS, CALM_TIME = 4.0, 0.15
# decided: a slender block falls within two and a half seconds from any tilt that a wire can hold.
LONGEST_SWING = 2.5
# decided: the arc's beginning, up to a quarter of a second, as long as the angle is small against the tipping angle.
ARC = 0.25
# decided: a tenth of a sample at 1 kHz, and as many rounds as the slowest fit needs to find its place to a tenth of it.
FINE, ROUNDS = 1e-4, 20
# decided: motion of less than a quarter of the largest is handling, or the block being set up.
LEAST_TURN = 0.25
# decided: the first swing of a block is an arc to a hundredth of its power; a hand's motion is not to a tenth.
NO_ARC = 0.1
# decided: more of the standing than a second adds drift and what was left of setting up, and no accuracy.
STANDING = 1.0
# decided: a block that stands shows a tenth of its largest rate at most, a hand's tremor included.
MOVES = 0.1
# decided: the arc begins at most this much before the last calm moment, which noise may end too early or too late.
BEFORE = 0.2
# decided: an angle up to rest that differs from the first swing's by more than this has met a fall, or the range.
REST_AGREES = 0.1


@dataclass(frozen=True, eq=False)
class Motion:
    """The release in a recording, in the log's own unit and axes.

    Attributes
    ----------
    release : instant of the release on the recording's clock, s, the gyroscope's delay included
    standing : how long the block is seen to stand before it, s; 0 where the record begins at the release
    bias, noise : (3,) what the rates show at rest, and their scatter; zero and the record's calmest scatter where
        nothing stands
    impact : first main impact on the recording's clock, s
    main : the axis about which the block rocks
    turn : (3,) rates summed over time from release to first impact, s times the log's unit
    angle : angle of the release about the main axis, s times the log's unit: up to rest where the record shows it
    gauge : rad/s that one unit of the rates must be worth
    """

    recording: Recording = field(repr=False)
    release: float
    standing: float
    bias: np.ndarray
    noise: np.ndarray
    impact: float
    main: int
    turn: np.ndarray
    angle: float
    gauge: float


def find_motion(recording: Recording, width: float, height: float) -> Motion:
    """Return the release and the first swing of a block of `width` and `height` m in a recording.

    Raises InputError E-NO-RELEASE where no stretch of it looks like one.
    """
    t, chip = recording.t, recording.chip
    noise = _calmest(t, chip)
    calm = _calm_stretches(t, chip, noise)
    starts = [(first, last) for first, last in calm if t[last] + 0.1 < t[-1]]
    if not calm or calm[0][0] > half_width(t, WINDOW):
        starts.insert(0, (0, 0))
    found = [m for s in starts if (m := _motion_from(recording, s, calm, noise, width, height)) is not None]
    if not found and (0, 0) not in starts and (m := _motion_from(recording, (0, 0), [], noise, width, height)):
        found = [m]  # what never stands shows as calm what is only slower
    if not found:
        cure = "Record from before the release until the block stands again; check width and height."
        raise InputError("E-NO-RELEASE", recording.source, "no swing of a released block is found", cure)
    largest = max(abs(float(m.turn[m.main])) for m, _ in found)
    likely = [(m, misfit) for m, misfit in found if abs(m.turn[m.main]) >= LEAST_TURN * largest]
    # A record that begins in the middle of a motion may begin with the block being set up.
    stood = [pair for pair in likely if pair[0].standing > 0.0 and pair[1] < NO_ARC]
    return min(stood or likely, key=lambda pair: pair[1])[0]


def _calmest(t: np.ndarray, chip: np.ndarray) -> np.ndarray:
    """Return the scatter (3,) of the calmest tenth of a recording."""
    least = np.percentile(_scatter(t, chip), 5.0, axis=0)
    # Where a coarse gyroscope shows one and the same value, its step is the scatter.
    return np.maximum(least, 1e-4 * np.abs(chip).max(axis=0) + 1e-300)


def _scatter(t: np.ndarray, chip: np.ndarray) -> np.ndarray:
    """Return the standard deviation (N, 3) of the rates in a window about each sample."""
    half = half_width(t, WINDOW)
    centred = chip - chip.mean(axis=0)
    return np.sqrt(np.maximum(running_mean(centred**2, half) - running_mean(centred, half) ** 2, 0.0))


def _calm_stretches(t: np.ndarray, chip: np.ndarray, noise: np.ndarray) -> list[tuple[int, int]]:
    """Return (first, last) sample of every stretch in which all rates stand still within their scatter."""
    still = np.all(_scatter(t, chip) < CALM_SIGMAS * noise, axis=1)
    return [(int(a), int(b) - 1) for a, b in stretches(still) if t[b - 1] - t[a] >= CALM_TIME]


def _motion_from(
    recording: Recording,
    start: tuple[int, int],
    calm: list[tuple[int, int]],
    noise: np.ndarray,
    width: float,
    height: float,
) -> tuple[Motion, float] | None:
    """Return the motion after a calm stretch, and the share of its arc that is no arc; None where there is no swing."""
    t, chip = recording.t, recording.chip
    first, last = start
    stood = last > first
    rows = slice(max(first, int(np.searchsorted(t, t[last] - STANDING))), last + 1)
    bias = chip[rows].mean(axis=0) if stood else _bias_at_the_end(t, chip, calm)
    # Neighbours differ by noise alone, also where the zero still drifts after the block was set up.
    steps = np.sqrt(0.5 * np.mean(np.diff(chip[rows], axis=0) ** 2, axis=0)) if stood else noise
    scatter = np.minimum(chip[rows].std(axis=0), steps) if stood else noise
    # Where nothing stands, a hand may hold the block for longer.
    end = int(np.searchsorted(t, t[last] + LONGEST_SWING)) if stood else len(t)
    v = chip[last:end] - bias
    if len(v) < 16:
        return None
    main = int(np.argmax(np.abs(np.cumsum(v, axis=0)).max(axis=0)))
    order = [main, *(axis for axis in range(3) if axis != main)]
    impacts = main_impacts(t[last:end], v[:, order])
    swing = _first_arc(t[:end], chip[:end, main] - bias[main], t[last], impacts.times, growth_rate(width, height))
    if not stood and len(impacts) and (swing is None or swing[1] >= NO_ARC or swing[0] < t[0] + 0.5 * WINDOW):
        # The record begins at the release.
        swing = float(t[0]), 0.0, float(impacts.times[0])
    if swing is None or swing[2] - t[last] < 2.0 * WINDOW:
        return None
    if float(np.abs(chip[rows, main] - bias[main]).max()) > MOVES * float(np.abs(v[:, main]).max()):
        return None  # about the apex of a swing the rates are calm for a while, and not at rest
    release, misfit, impact = swing
    inside = (t >= release) & (t <= impact)
    if inside.sum() < 8:
        return None
    turn = (chip[inside] - bias).sum(axis=0) * sample_step(t)
    p = growth_rate(width, height)
    tilt = math.atan2(width, height) * (1.0 - 1.0 / math.cosh(p * (impact - release)))
    angle = _angle_to_rest(t, chip[:, main], release, last if stood else None, calm, float(turn[main]), bias[main])
    motion = Motion(
        recording,
        release,
        float(t[last] - t[first]) if stood else 0.0,
        bias,
        scatter,
        impact,
        main,
        turn,
        angle,
        tilt / abs(float(turn[main])),
    )
    return motion, misfit


def _bias_at_the_end(t: np.ndarray, chip: np.ndarray, calm: list[tuple[int, int]]) -> np.ndarray:
    """Return what the rates show (3,) where the block stands at the end of the record; zero where it does not."""
    if not calm or t[-1] - t[calm[-1][1]] > WINDOW:
        return np.zeros(3)
    return chip[calm[-1][0] : calm[-1][1] + 1].mean(axis=0)


def _release(t: np.ndarray, w: np.ndarray, impact: float, p: float) -> tuple[float, float]:
    """Return the instant at which the arc before an impact begins in w (N,), and the share of the swing that is no arc.

    A sinh(p (t - t0)) is a sinh(p t) + b cosh(p t), so that least squares give t0 at once. Only the arc is fitted: what
    a hand does to the block before its release moves nothing. The arc's first quarter of a second counts, and lies
    where the fit puts it: it is found anew until it rests. NaN and 1 where there is no arc.
    """
    last = impact - WINDOW
    begin, end, release = last - 0.5 * ARC, last, math.nan
    for _ in range(ROUNDS):
        rows = (t >= begin) & (t <= end)
        if rows.sum() < 8:
            return math.nan, 1.0
        middle = 0.5 * (begin + end)
        phase = p * (t[rows] - middle)
        a, b = np.linalg.lstsq(np.stack((np.sinh(phase), np.cosh(phase)), axis=1), w[rows], rcond=None)[0]
        if not abs(b) < abs(a):
            return math.nan, 1.0
        before, release = release, middle - math.atanh(b / a) / p
        if abs(release - before) < 0.1 * FINE:
            break
        begin, end = release, min(release + ARC, last)
    swing = (t >= release) & (t <= last)
    arc = np.sinh(p * (t[swing] - release))
    power = max(float(w[swing] @ w[swing]), 1e-300)
    return release, 1.0 - float(arc @ w[swing]) ** 2 / max(float(arc @ arc), 1e-300) / power


def _first_arc(
    t: np.ndarray, w: np.ndarray, start: float, impacts: np.ndarray, p: float
) -> tuple[float, float, float] | None:
    """Return release, misfit and impact of the first swing after `start` s that is an arc, and no small one.

    What comes before it is no impact: a hand that holds the block trembles and jolts. Where no swing is an arc, the one
    that is most like one is returned; None without any.
    """
    found = []
    for impact in impacts:
        release, misfit = _release(t, w, float(impact), p) if impact - start > 2.0 * WINDOW else (math.nan, 1.0)
        if math.isfinite(release) and release > start - BEFORE and impact - release > 2.0 * WINDOW:
            angle = abs(float(w[(t >= release) & (t <= impact)].sum()))
            found.append((release, misfit, float(impact), angle))
    arcs = [one for one in found if one[1] < NO_ARC] or sorted(found, key=lambda one: one[1])[:1]
    largest = max((one[3] for one in arcs), default=0.0)
    return next((one[:3] for one in arcs if one[3] >= LEAST_TURN * largest), None)


def _angle_to_rest(
    t: np.ndarray,
    w: np.ndarray,
    release: float,
    last: int | None,
    calm: list[tuple[int, int]],
    first_swing: float,
    bias: float,
) -> float:
    """Return the angle of the release: what the rates add up to until the block stands, or the first swing's.

    What the gyroscope shows at rest may drift from before the release to after the motion: a straight line between.
    """
    after = [(a, b) for a, b in calm if t[a] > release + 2.0 * WINDOW and (last is None or a > last)]
    if not after or t[-1] - t[after[-1][1]] > WINDOW:
        return first_swing
    a, b = after[-1]
    zero_after = float(w[a : b + 1].mean())
    zero = np.interp(t, (release, t[a]), (bias if last is not None else zero_after, zero_after))
    inside = (t >= release) & (t <= t[a])
    angle = float((w - zero)[inside].sum() * sample_step(t))
    return angle if abs(angle / first_swing - 1.0) < REST_AGREES else first_swing
