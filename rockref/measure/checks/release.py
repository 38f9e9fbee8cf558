"""Whether a record can be that of the release it is said to be: length, start, units, axes, signs, first impact."""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.signals.noise import LEAST_WINDOWS, window_samples
from rockref.measure.signals.running import half_width, running_mean
from rockref.measure.signals.signal import Signal, rocking_rate, rocking_time
from rockref.model.errors import InputError

# decided: a gyroscope that saturates early shows a tenth of the rate, nothing thrice of it; a unit is off by 57.
RATE_MARGIN = (0.1, 3.0)
# decided: a loose mass or a slow wire delays the first impact by a fifth; more is another release.
TIME_MARGIN = 0.3
# decided: the first swing is looked at for a little longer than the block needs.
FIRST_SWING = 1.3
# decided: a block that creeps has come to a hundredth of its later rate when its first swing should be half over, a
# tenth of it in the first third. A wire that lets go slowly leaves it three times as much of both.
RESTING, CREEPING = 0.01, 0.1
# decided: 2 deg/s; a hand that lets go gives the block 1 deg/s, and the zero of a gyroscope is off by less. In the
# first twentieth of its swing the block itself comes to a fiftieth of the rate.
MOVING, BEGINNING = 0.05, 0.05
# In simulated records the rates add up to the stated tilt to 0.02 of it. decided: a gyroscope's scale or a tilt that is
# off by a tenth is told; by 0.4, it is another range of the gyroscope.
TURNED_OFF, TURNED_WRONG = 0.1, 0.4
# decided: rates about Y and Z may stay below a fiftieth of the first swing's rate.
HIDDEN = 0.02
# decided: a gyroscope's scale and drift are off by a tenth of the tipping angle at most; beyond 1.3 of it there is no
# way back.
FALLEN = 1.3


def inside_the_tipping_angle(signal: Signal) -> np.ndarray:
    """Return which samples, (N,) bool, come before the block is beyond its tipping angle for the first time."""
    return np.logical_and.accumulate(np.abs(signal.tilts) <= FALLEN * signal.alpha)


def samples_before_a_fall(signal: Signal) -> int:
    """Return how many samples come before the block falls over.

    The tilt is the release's less the integral of wx. The fall begins where it last leaves the tipping angle for good;
    all samples, where it does not, or where it does so before a first impact could be (another unit, another sign).
    """
    tilt = np.abs(signal.tilts)
    beyond = np.flatnonzero(tilt > FALLEN * signal.alpha)
    if not len(beyond):
        return len(tilt)
    inside = np.flatnonzero(tilt[: beyond[0]] <= signal.alpha)
    last = int(inside[-1]) + 1 if len(inside) else 0
    return last if signal.t[last] > signal.duration * (1.0 + TIME_MARGIN) else len(tilt)


def length_needed(signal: Signal) -> float:
    """Return how long a record has to be, s: its first impact is in it, and can be seen."""
    # decided: a twentieth of a second after the impact its drop can be seen.
    return signal.duration * (1.0 + TIME_MARGIN) + 0.05


def check_length(signal: Signal) -> list[Notice]:
    """Refuse a record that ends before its first impact, or has too few samples (E-SHORT)."""
    needed = length_needed(signal)
    if signal.t[-1] < needed:
        what = f"the record ends at {signal.t[-1]:.3g} s; the first impact is expected at {signal.duration:.3g} s"
        cure = f"Record for at least {needed:.2g} s, or check width and height."
        raise InputError("E-SHORT", signal.path, what, cure)
    least = LEAST_WINDOWS * window_samples(signal.step)
    if len(signal.t) < least:
        what = f"{len(signal.t)} samples, where {least} are needed to tell motion from noise"
        raise InputError("E-SHORT", signal.path, what, "Record for longer, or more samples a second.")
    return []


def check_alive(signal: Signal) -> list[Notice]:
    """Refuse a main rate that is the same all the time (E-STILL); remark on another one (W-CONSTANT)."""
    still = [axis for axis in range(3) if not np.ptp(signal.crv[:, axis]) > 0.0]
    if 0 in still:
        what = f"all values are {signal.crv[0, 0] / DEGREE:g} deg/s"
        raise InputError("E-STILL", signal.column(0), what, "Check the channel of the logger.")
    # What stays within a coarse step of the resolution is not dead.
    if signal.gyro.resolution > HIDDEN * signal.rate:
        return []
    cure = "Check the channel of the logger, and the unit of the column."
    return [Notice("W-CONSTANT", signal.column(axis), "all values are the same", cure) for axis in still]


def check_release(signal: Signal) -> list[Notice]:
    """Refuse a block that is still at rest when its first swing should be half over (E-RELEASE), whatever the unit.

    One that creeps from the first sample on was released, and something holds it back: a wire that lingers.
    """
    t, crv, duration = signal.t, signal.crv, signal.duration
    first, before, early = (
        crv[(t > low * duration) & (t <= high * duration)] for low, high in ((-1.0, 0.05), (0.15, 0.3), (0.3, 0.5))
    )
    if not len(early) or not len(before):
        return []
    if not len(first):  # the record begins late
        first = crv[:1]
    # A single wild sample must not pass for the size of the motion.
    size = float(np.percentile(np.abs(crv), 99.0, axis=0).max())
    reached = np.abs(early.mean(axis=0)).max()
    # Creep is told from a bias by its growth: of a block that was at rest until 0.3 of the time nothing has changed.
    change, later = (np.abs(x.mean(axis=0) - first.mean(axis=0)).max() for x in (before, early))
    creeps = reached > RESTING * size and change > CREEPING * later
    # Below a step of the resolution a creep cannot be seen.
    least = max(0.05 * size, 0.0)
    hidden = reached <= signal.gyro.resolution and signal.gyro.resolution > least
    # A linear arc has sinh(0.4 x)/sinh(x), about a fifth at x = 2.3, of its final rate there.
    if reached < least and not creeps and not hidden:
        what = f"the block hardly moves until {0.5 * duration:.2g} s"
        raise InputError("E-RELEASE", signal.path, what, "Time is counted from the release: shift the column.")
    return []


def check_unit(signal: Signal) -> list[Notice]:
    """Refuse rates whose unit is not that of their name, by the size of the whole record (E-RADIANS, E-DEGREES)."""
    # decided: one sample in fifty may be wild.
    peak = float(np.percentile(np.abs(signal.crv).max(axis=1), 98.0))
    low, high = RATE_MARGIN
    if not np.ptp(signal.crv[:, 0]) > 0.0:
        return []  # a dead channel has no unit
    if not low < peak / signal.rate < high and any(
        low < peak / signal.rate * factor < high for factor in (DEGREE, 1.0 / DEGREE)
    ):
        check_first_swing(signal)
    return []


def check_first_swing(signal: Signal) -> list[Notice]:
    """Refuse a first swing of another size, on another axis, or of another sign.

    Raises InputError: E-RADIANS, E-DEGREES, E-RATE-SIZE, E-AXES, E-SIGN.
    """
    t, crv = signal.t, signal.crv
    before = t <= 0.9 * signal.duration
    turned = crv[before].sum(axis=0) * signal.step
    main = int(np.argmax(np.abs(turned)))
    column = signal.column(main)
    _check_unit(signal, main)
    if main != 0:
        cure = f"Name that column {signal.names[0]}: X is the rocking axis, Y the other horizontal one, Z the long one."
        what = f"the block rocks about this axis (it turns by {turned[main]:.3g} rad), not about X"
        raise InputError("E-AXES", column, what, cure)
    if turned[0] * signal.sign < 0.0:
        way = "positive" if signal.sign > 0 else "negative"
        what = f"the first swing is {'negative' if signal.sign > 0 else 'positive'}, and must be {way} in this posture"
        raise InputError("E-SIGN", column, what, "Turn the sign of X (and of Y), or correct block_turned_deg.")
    return []


def _peak(signal: Signal, axis: int, duration: float) -> float:
    """Return the largest rate about an axis in a first swing of `duration` s, rad/s."""
    smooth = running_mean(signal.crv[:, axis], half_width(signal.t, 0.009 * min(1.0, signal.scale)))
    return float(np.abs(smooth[signal.t <= FIRST_SWING * duration]).max())


def _check_unit(signal: Signal, axis: int) -> None:
    """Refuse a first swing about the axis whose size is not that of the block (E-RADIANS, E-DEGREES, E-RATE-SIZE)."""
    where, name = signal.column(axis), signal.names[axis]
    peak = _peak(signal, axis, signal.duration)
    ratio = peak / signal.rate
    low, high = RATE_MARGIN
    if low < ratio < high:
        return
    expected = f"where {signal.rate / DEGREE:.3g} deg/s are expected"
    if signal.width > signal.height and signal.tilt < math.atan2(signal.height, signal.width):
        # It takes longer than this one: what it reaches is looked for in its own first swing.
        reached = _peak(signal, axis, rocking_time(signal.tilt, signal.height, signal.width))
        if low < reached / rocking_rate(signal.tilt, signal.height, signal.width) < high:
            what = f"the first swing reaches {reached / DEGREE:.3g} deg/s, {expected}"
            cure = "A block that is as high as this one is wide reaches that: exchange width_m and height_m."
            raise InputError("E-RATE-SIZE", where, what, cure)
    what = f"the first swing reaches {peak / DEGREE:.3g} deg/s, {expected}"
    # A name that says deg_s over values in rad/s makes the rates 57 times too small, and the other way round.
    other = "If not, check release tilt, width and height."
    if low < ratio / DEGREE < high and name.endswith("_deg_s"):
        cure = f"If the values are in rad/s, name the column {name[:2]}_rad_s. {other}"
        raise InputError("E-RADIANS", where, what, cure)
    if low < ratio * DEGREE < high and name.endswith("_rad_s"):
        cure = f"If the values are in deg/s, name the column {name[:2]}_deg_s. {other}"
        raise InputError("E-DEGREES", where, what, cure)
    cure = "Check the unit of the column, the release tilt, width and height, and that time starts at the release."
    raise InputError("E-RATE-SIZE", where, what, cure)


def check_rest(signal: Signal) -> list[Notice]:
    """Remark on a block that moves when it is let go: the mean rates of the beginning (W-MOVING)."""
    rates = signal.crv[signal.t <= BEGINNING * signal.duration]
    if not len(rates):
        return []
    cure = "Count time from the release; what the gyroscope shows of a block at rest is its zero: subtract it."
    # decided: five standard deviations of a mean are not noise; a value may be rounded by half a step, the same each
    # time.
    most = MOVING * signal.rate + 5.0 * signal.gyro.noise / math.sqrt(len(rates)) + 0.5 * signal.gyro.resolution
    return [
        Notice("W-MOVING", signal.column(axis), f"{rate / DEGREE:.3g} deg/s at the release, not at rest", cure)
        for axis, rate in enumerate(rates.mean(axis=0))
        if abs(rate) > most
    ]


def check_first_impact(signal: Signal) -> list[Notice]:
    """Remark on a first main impact at another time than a block of this size allows (W-FIRST-IMPACT)."""
    impacts, duration = signal.impacts, signal.duration
    # A sample or two are no other time.
    if len(impacts) and abs(impacts.times[0] - duration) <= TIME_MARGIN * duration + 2.0 * signal.step:
        return []
    found = f"the first main impact is at {impacts.times[0]:.3f} s" if len(impacts) else "there is no main impact"
    what = f"{found}; {duration:.3f} s is expected of a block of this size from this tilt"
    cure = "Check release tilt, width and height, and the start of time."
    return [Notice("W-FIRST-IMPACT", signal.path, what, cure)]


def check_turned(signal: Signal) -> list[Notice]:
    """Remark where the rates do not add up to the release tilt until the first main impact (W-TILT-OFF).

    Raises InputError E-RATE-SIZE where they are far off it at the expected time: that is a scale.
    """
    impacts = signal.impacts
    if not len(impacts) or abs(impacts.times[0] - signal.duration) > TIME_MARGIN * signal.duration + 2.0 * signal.step:
        return []
    turned = signal.sign * float(np.interp(impacts.times[0], signal.t, signal.turned))
    off = turned / signal.tilt
    # An impact is known to two samples, in which the block turns on.
    if abs(off - 1.0) < TURNED_OFF + 2.0 * signal.step * signal.rate / signal.tilt:
        return []
    what = f"until upright the rates add up to {turned:.4g} rad, and the release tilt is {signal.tilt:.4g} rad"
    if signal.t[0] < signal.step and not 1.0 - TURNED_WRONG < off < 1.0 / (1.0 - TURNED_WRONG):
        cure = f"The rates are {off:.3g} times those of a block that falls in this time: check the gyroscope's range."
        raise InputError("E-RATE-SIZE", signal.column(0), what, cure)
    cure = "One of them is off: check the tilt, and the scale and range of the gyroscope."
    return [Notice("W-TILT-OFF", signal.column(0), what, cure)]
