"""Whether each channel of a record is that of a gyroscope in order: which axis, range, flat tops, noise."""

from __future__ import annotations

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.signals.signal import Signal, stretches
from rockref.model.errors import InputError

# decided: a cusp of the block of Table 3.1 stays within four noise widths of its top for about 4 ms; a flat top of
# 10 ms is no cusp. Fewer than four samples are no top: a cusp between two of them leaves both there.
FLAT_TOP, FLAT_SAMPLES = 0.010, 4
# decided: a parabola is 1.4 times as long at least within four widths, whole steps of the resolution counted.
ROUND = 1.35
# How much rougher the rates about Z are than those about Y, over two milliseconds, after the first impact, noise taken
# off: 1.37 times or more in simulated records of 70 blocks more than five times as high as wide, 1.15 or more in eleven
# practice experiments; decided: below 0.85 they are exchanged. A block that is less slender clatters otherwise. A
# channel of less than five noise widths says nothing.
ROUGHER, SLENDER, HEARD, STRETCH = 0.85, 5.0, 5.0, 0.002
# decided: noise of three times the data sheet is a disturbance, or another data sheet.
NOISE_MARGIN = 3.0
# decided: the axes of one gyroscope are alike within a factor of two or three; 57 is a unit.
UNIT_MARGIN = 10.0
# decided: what neighbouring residuals have in common by half is motion that the cubic does not follow, or a hum.
WHITE = 0.5
# decided: a column in rad/s among others in deg/s has 57 times less noise; one gyroscope's axes are alike to a third.
ONE_GYRO = 1.35
# decided: a low-pass of a fifth of the sample rate leaves noise of which neighbours have little in common. A cubic
# leaves white noise of neighbours that have a fifth in common with the other sign; means of three rows have 0.3, and
# less than half of the noise.
WIDE_BAND, SHARED, LESS = 0.2, 0.1, 0.5


def check_axes(signal: Signal) -> list[Notice]:
    """Remark where the rates about Y and Z seem to have changed places (W-AXES).

    The same clatter turns the block about its height in sharper corners than about Y, where its inertia is twenty times
    as large.
    """
    apart = STRETCH * signal.scale
    rates = signal.crv[signal.t > 1.1 * signal.duration, 1:]
    lag = max(1, round(apart / signal.step))
    if signal.height < SLENDER * signal.width or signal.step > 1.5 * apart or len(rates) < 4 * lag:
        return []
    grain = signal.gyro.noise**2 + signal.gyro.resolution**2 / 12.0
    size = rates.var(axis=0) - grain
    change = np.mean((rates[lag:] - rates[:-lag]) ** 2, axis=0) - 2.0 * grain
    if np.any(size <= HEARD**2 * grain) or np.any(change <= 4.0 * grain):
        return []
    rough = np.sqrt(change / size)
    if rough[1] >= ROUGHER * rough[0]:
        return []
    _, y, z = signal.names
    what = f"{y} jumps more than {z}, and a slender block clatters most about its height"
    cure = "Check which axis is which: exchange the two names if the columns are exchanged."
    return [Notice("W-AXES", f"{signal.path}, columns {y} and {z}", what, cure)]


def check_flat_tops(signal: Signal) -> list[Notice]:
    """Remark on stretches at the largest or smallest value that are longer than a cusp can be (W-FLAT-TOP)."""
    width = 4.0 * signal.gyro.noise + signal.gyro.resolution
    notices = []
    for axis in range(3):
        for side, word in ((1.0, "top"), (-1.0, "bottom")):
            x = side * signal.crv[:, axis]
            limit = float(x.max())
            # Near the noise everything is flat, also about an offset.
            if limit - float(np.median(x)) < 5.0 * width:
                continue
            # Towards upright a rate grows by its size over the time of a swing: so long it stays within a width of its
            # cusp; one out of the plane has a smaller size.
            slope = min(signal.rate, limit - float(np.median(x))) / signal.duration
            least = FLAT_TOP * signal.scale + 2.0 * width / slope
            samples = _flat_samples(x, limit, width)
            # Out of the plane a block that is off the plate keeps its rate for a while, at one place and not again.
            again = axis == 0 or len(stretches(x >= limit - width)) > 1
            if samples * signal.step > least and samples >= FLAT_SAMPLES and again:
                what = f"a flat {word} of {1e3 * samples * signal.step:.0f} ms at {side * limit / DEGREE:.4g} deg/s"
                cure = "The gyroscope seems to saturate there: give range_deg_s, or use a larger range."
                notices.append(Notice("W-FLAT-TOP", signal.column(axis), what, cure))
    return notices


def _flat_samples(x: np.ndarray, limit: float, width: float) -> int:
    """Return how many samples the longest top of x (N,) has within `width` of its `limit`; 0 where it is round.

    Within four widths a round top is twice as long, and a cusp four times; a flat one is hardly longer.
    """
    first, last = max(stretches(x >= limit - width), key=lambda ends: ends[1] - ends[0])
    low = stretches(x >= limit - 4.0 * width)
    whole = next(b - a for a, b in low if a <= first and last <= b)
    return int(last - first) if whole <= ROUND * (last - first) else 0


def check_range(signal: Signal) -> list[Notice]:
    """Remark on samples at the stated range (W-SATURATED)."""
    limit = signal.gyro.range
    if limit is None:
        return []
    cure = "Use a gyroscope of a larger range, or keep the stretches out of the fit."
    counts = (np.abs(signal.crv) >= limit * (1.0 - 1e-9)).sum(axis=0)
    what = f"samples are at the stated range of {limit / DEGREE:g} deg/s"
    return [
        Notice("W-SATURATED", signal.column(axis), f"{count} {what}", cure)
        for axis, count in enumerate(counts)
        if count
    ]


def check_noise(signal: Signal) -> list[Notice]:
    """Remark on a channel that is noisier than stated (W-NOISE)."""
    stated, floor = signal.grain, signal.floor
    sigma = floor.sigma
    notices = []
    for axis in range(3):
        if not sigma[axis] > NOISE_MARGIN * stated > 0.0 or floor.whiteness[axis] > WHITE:
            continue
        what = f"the noise is {sigma[axis] / DEGREE:.3g} deg/s, and {stated / DEGREE:.3g} deg/s is stated"
        cure = "The stated noise weighs the comparison: correct the data sheet, or look for a disturbance."
        others = float(np.delete(sigma, axis).max())
        if sigma[axis] > UNIT_MARGIN * others > 0.0:
            cure = f"The other columns have {others / DEGREE:.3g} deg/s: check the unit of this one."
        notices.append(Notice("W-NOISE", signal.column(axis), what, cure))
    return notices


def check_smooth(signal: Signal) -> list[Notice]:
    """Remark on rows that were averaged or drawn between samples (W-SMOOTH): noise that neighbouring rows share."""
    if signal.gyro.bandwidth * signal.step < WIDE_BAND:
        return []  # the gyroscope's own low-pass may do so
    floor = signal.floor
    # Motion that the cubic does not follow is alike in neighbours, too; it only adds to the noise.
    if not (floor.whiteness > SHARED).all() or not (floor.sigma < LESS * signal.gyro.noise).all():
        return []
    what = f"neighbouring rows are alike, and scatter by {float(floor.sigma.mean()) / DEGREE:.2g} deg/s where"
    what += f" {signal.gyro.noise / DEGREE:.2g} deg/s are stated"
    cure = "The rows seem to be averaged, or drawn between samples: give what was measured, and its rate."
    return [Notice("W-SMOOTH", signal.path, what, cure)]


def check_one_unit(signal: Signal) -> list[Notice]:
    """Refuse a column whose noise says that its unit is not that of the other two (E-RADIANS, E-DEGREES)."""
    sigma = signal.floor.sigma
    for axis in range(3):
        others = np.delete(sigma, axis)
        if not others.min() > 0.0 or others.max() > ONE_GYRO * others.min() or not sigma[axis] > 0.0:
            continue
        ratio = float(others.mean() / sigma[axis])
        for code, times, other in (("E-RADIANS", ratio, "rad_s"), ("E-DEGREES", 1.0 / ratio, "deg_s")):
            if 1.0 / ONE_GYRO < times * DEGREE < ONE_GYRO and not signal.names[axis].endswith(other):
                what = f"its noise is {sigma[axis] / DEGREE:.2g} deg/s, and that of the other two"
                what += f" {others.mean() / DEGREE:.2g} deg/s, {max(ratio, 1.0 / ratio):.0f} times apart"
                cure = f"It seems to be in {other.replace('_', '/')}: name it {signal.names[axis][:2]}_{other}."
                raise InputError(code, signal.column(axis), what, cure)
    return []
