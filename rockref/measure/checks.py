"""Whether a record can be that of the release it is said to be: units, axes, signs, length, flat tops."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from rockref.measure.columns import DEGREE, RATES
from rockref.measure.faults import check_dropout, check_wild, wild_samples, without
from rockref.measure.noise import LEAST_WINDOWS, noise_floor, window_samples
from rockref.measure.notice import Notice
from rockref.measure.running import half_width, running_mean, sample_step
from rockref.measure.table import Table
from rockref.model.errors import InputError
from rockref.model.problem import GRAVITY

if TYPE_CHECKING:
    from rockref.measure.experiment import Experiment, Run

# decided: a gyroscope that saturates early shows a tenth of the rate, nothing thrice of it; a unit is off by 57.
RATE_MARGIN = (0.1, 3.0)
# decided: a loose mass or a slow wire delays the first impact by a fifth; more is another release.
TIME_MARGIN = 0.3
# decided: the first swing is looked at for a little longer than the block needs.
FIRST_SWING = 1.3
# decided: a block that creeps has come to a hundredth of its later rate when its first swing should be half over, a
# tenth of it in the first third (one with a wire that pulled with 6.7 N at first and for 0.4 s: to 3 %, 28 % of it).
RESTING, CREEPING = 0.01, 0.1
# decided: 2 deg/s; a hand that lets go gives the block 1 deg/s, and the zero of a gyroscope is off by less. In the
# first twentieth of its swing the block itself comes to a fiftieth of the rate.
MOVING, BEGINNING = 0.05, 0.05
# decided: a cusp stays within four noise widths of its top for about 4 ms; a flat top of 10 ms is no cusp. Fewer
# than four samples are no top: a cusp between two of them leaves both there.
FLAT_TOP, FLAT_SAMPLES = 0.010, 4
# How much rougher the rates about Z are than those about Y, after the first impact: 1.15 to 2.86 times in all runs of
# eleven practice experiments and sixty of the blind test, sensors askew included; decided: below 0.9 they are
# exchanged. It is so where turning about the height is easy: decided, three times as high as wide. A channel of less
# than five noise widths says nothing.
ROUGHER, SLENDER, HEARD = 0.9, 3.0, 5.0
# decided: clatter jumps by 6 deg/s in two samples and back in tens; a quarter of the first swing's rate is 9 deg/s.
SPIKE = 0.25
# decided: a gyroscope's scale and drift are off by a tenth of the tipping angle at most; beyond 1.3 of it there is no
# way back.
FALLEN = 1.3
# decided: noise of three times the data sheet is a disturbance, or another data sheet.
NOISE_MARGIN = 3.0
# decided: the axes of one gyroscope are alike within a factor of two or three; 57 is a unit.
UNIT_MARGIN = 10.0


def rocking_rate(tilt: float, width: float, height: float) -> float:
    """Return the rate, rad/s, at which a block let go at `tilt` rad reaches upright without loss (Housner 1963).

    width and height in m. The block turns about its edge: w^2 = 3g/(2R) (cos(alpha - tilt) - cos(alpha)).
    """
    radius, alpha = 0.5 * math.hypot(width, height), math.atan2(width, height)
    return math.sqrt(1.5 * GRAVITY / radius * (math.cos(alpha - tilt) - math.cos(alpha)))


def rocking_time(tilt: float, width: float, height: float) -> float:
    """Return the time, s, from the release at `tilt` rad to upright: cosh(p T) = alpha/(alpha - tilt), p^2 = 3g/(4R).

    width and height in m; linear in the angle (Housner 1963), which is enough for a slender block.
    """
    alpha = math.atan2(width, height)
    return math.acosh(alpha / (alpha - tilt)) / growth_rate(width, height)


def growth_rate(width: float, height: float) -> float:
    """Return p, 1/s, of a slender block on its edge: arcs grow as cosh(p t), p^2 = 3g/(4R) (Housner 1963).

    width and height in m; doi:10.1785/BSSA0530020403.
    """
    return math.sqrt(0.75 * GRAVITY / (0.5 * math.hypot(width, height)))


def tilts(t: np.ndarray, wx: np.ndarray, run: Run) -> np.ndarray:
    """Return the tilt, rad, after each sample of a release with rates wx (N,) rad/s: the release's less their integral.

    Positive on the side of the release, turned block or not.
    """
    assert run.release_tilt is not None
    return run.release_tilt - _sign(run) * np.cumsum(wx) * sample_step(t)


def check_release_run(t: np.ndarray, crv: np.ndarray, table: Table, run: Run, experiment: Experiment) -> list[Notice]:
    """Check times t (N,) s and body rates crv (N, 3) rad/s of a release against what the block must do.

    Returns notices (W-CONSTANT, W-MOVING, W-FIRST-IMPACT, W-AXES, W-FLAT-TOP, W-SATURATED,
    W-SPIKE, W-NOISE). Raises InputError: E-SHORT,
    E-STILL, E-RELEASE, E-AXES, E-SIGN, E-DEGREES, E-RADIANS, E-RATE-SIZE.
    """
    assert run.release_tilt is not None and experiment.gyro is not None
    where = str(table.path)
    expected = rocking_rate(run.release_tilt, experiment.width, experiment.height)
    duration = rocking_time(run.release_tilt, experiment.width, experiment.height)
    _check_length(t, duration, where)
    _check_alive(crv, table, where)
    names = [table.names[quantity] for quantity in RATES]
    _check_release(t, crv, duration, where)
    _check_first_swing(t, crv, names, expected, duration, where, sign=_sign(run))
    notices = [
        *_constant(crv, names, where),
        *_moving(t, crv, names, expected, duration, experiment.gyro.noise, where),
        *_first_impact(t, crv, duration, where),
        *_exchanged(t, crv, names, 1.1 * duration, experiment, where),
        *_flat_tops(t, crv, names, experiment.gyro.noise + experiment.gyro.resolution, where),
        *_at_range(crv, names, experiment.gyro.range, where),
        *_spikes(crv, names, expected, where),
        *_noisy(t, crv, names, math.hypot(experiment.gyro.noise, experiment.gyro.resolution), where),
    ]
    return notices


def check_faults(t: np.ndarray, crv: np.ndarray, table: Table, run: Run, experiment: Experiment) -> list[Notice]:
    """Refuse what only a fault of the logger explains, before it is taken for motion: E-SPIKE, E-DROPOUT.

    Short dropouts are returned as notices (W-DROPOUT). t (N,) s; crv (N, 3) rad/s. What comes after the block has
    fallen over is not looked at.
    """
    assert run.release_tilt is not None
    expected = rocking_rate(run.release_tilt, experiment.width, experiment.height)
    wild = wild_samples(crv, expected)
    calm = without(crv, wild)
    stands = samples_before_a_fall(t, calm, run, experiment)
    names = [table.names[quantity] for quantity in RATES]
    check_wild(t[:stands], crv[:stands], wild[:stands], names, table.path)
    inside = np.abs(tilts(t, calm[:, 0], run)) <= FALLEN * math.atan2(experiment.width, experiment.height)
    return check_dropout(t, crv, np.logical_and.accumulate(inside), expected, table.path)


def samples_before_a_fall(t: np.ndarray, crv: np.ndarray, run: Run, experiment: Experiment) -> int:
    """How many samples of a release, times t (N,) s and body rates crv (N, 3) rad/s, come before the block falls over.

    The tilt is the release's less the integral of wx. The fall begins where it last leaves the tipping angle for good;
    all samples, where it does not, or where it does so before a first impact could be (another unit, another sign).
    """
    assert run.release_tilt is not None
    alpha = math.atan2(experiment.width, experiment.height)
    duration = rocking_time(run.release_tilt, experiment.width, experiment.height)
    tilt = np.abs(tilts(t, crv[:, 0], run))
    beyond = np.flatnonzero(tilt > FALLEN * alpha)
    if not len(beyond):
        return len(t)
    inside = np.flatnonzero(tilt[: beyond[0]] <= alpha)
    last = int(inside[-1]) + 1 if len(inside) else 0
    return last if t[last] > duration * (1.0 + TIME_MARGIN) else len(t)


def _sign(run: Run) -> int:
    return -1 if abs(run.block_turned) > 0.5 * math.pi else 1


def _check_length(t: np.ndarray, duration: float, where: str) -> None:
    # decided: a twentieth of a second after the impact its drop can be seen.
    needed = duration * (1.0 + TIME_MARGIN) + 0.05
    if t[-1] < needed:
        what = f"the record ends at {t[-1]:.3g} s; the first impact is expected at {duration:.3g} s"
        raise InputError("E-SHORT", where, what, f"Record for at least {needed:.2g} s, or check width and height.")
    least = LEAST_WINDOWS * window_samples(sample_step(t))
    if len(t) < least:
        what = f"{len(t)} samples, where {least} are needed to tell motion from noise"
        raise InputError("E-SHORT", where, what, "Record for longer, or more samples a second.")


def _check_alive(crv: np.ndarray, table: Table, where: str) -> None:
    if not np.ptp(crv[:, 0]) > 0.0:
        what = f"all values are {crv[0, 0] / DEGREE:g} deg/s"
        raise InputError("E-STILL", f"{where}, column {table.names['wx']}", what, "Check the channel of the logger.")


def _check_first_swing(
    t: np.ndarray, crv: np.ndarray, names: list[str], expected: float, duration: float, where: str, *, sign: int
) -> None:
    """Refuse a first swing on another axis, of another sign, or of a size that only another unit explains."""
    swing = t <= FIRST_SWING * duration
    smooth = running_mean(crv, half_width(t, 0.009))[swing]
    peaks = np.abs(smooth).max(axis=0)
    before = t <= 0.9 * duration
    turned = crv[before].sum(axis=0) * sample_step(t)
    main = int(np.argmax(np.abs(turned)))
    ratio = float(peaks[main]) / expected
    column = f"{where}, column {names[main]}"
    _check_unit(ratio, float(peaks[main]), expected, column, names[main])
    if main != 0:
        cure = f"Name that column {names[0]}: X is the rocking axis, Y the other horizontal one, Z the long one."
        what = f"the block rocks about this axis (it turns by {turned[main]:.3g} rad), not about X"
        raise InputError("E-AXES", column, what, cure)
    if turned[0] * sign < 0.0:
        way = "positive" if sign > 0 else "negative"
        what = f"the first swing is {'negative' if sign > 0 else 'positive'}, and must be {way} in this posture"
        raise InputError("E-SIGN", column, what, "Turn the sign of X (and of Y), or correct block_turned_deg.")


def _check_unit(ratio: float, peak: float, expected: float, where: str, name: str) -> None:
    if RATE_MARGIN[0] < ratio < RATE_MARGIN[1]:
        return
    what = f"the first swing reaches {peak / DEGREE:.3g} deg/s, where {expected / DEGREE:.3g} deg/s are expected"
    low, high = RATE_MARGIN
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


def _check_release(t: np.ndarray, crv: np.ndarray, duration: float, where: str) -> None:
    """Refuse a block that is still at rest when its first swing should be half over, whatever the axis or unit.

    One that creeps from the first sample on was released, and something holds it back: a wire that lingers.
    """
    first, before, early = (
        crv[(t > low * duration) & (t <= high * duration)] for low, high in ((-1.0, 0.05), (0.15, 0.3), (0.3, 0.5))
    )
    if not len(early) or not len(before):
        return
    if not len(first):  # the record begins late
        first = crv[:1]
    # A single wild sample must not pass for the size of the motion.
    size = float(np.percentile(np.abs(crv), 99.0, axis=0).max())
    reached = np.abs(early.mean(axis=0)).max()
    # Creep is told from a bias by its growth: of a block that was at rest until 0.3 of the time nothing has grown.
    grown, later = (np.abs(x.mean(axis=0) - first.mean(axis=0)).max() for x in (before, early))
    creeps = reached > RESTING * size and grown > CREEPING * later
    # A linear arc has sinh(0.4 x)/sinh(x), about a fifth at x = 2.3, of its final rate there.
    if reached < 0.05 * size and not creeps:
        what = f"the block hardly moves until {0.5 * duration:.2g} s"
        raise InputError("E-RELEASE", where, what, "Time is counted from the release: shift the column.")


def _constant(crv: np.ndarray, names: list[str], where: str) -> list[Notice]:
    cure = "Check the channel of the logger, and the unit of the column."
    return [
        Notice("W-CONSTANT", f"{where}, column {names[axis]}", "all values are the same", cure)
        for axis in (1, 2)
        if not np.ptp(crv[:, axis]) > 0.0
    ]


def _moving(
    t: np.ndarray, crv: np.ndarray, names: list[str], expected: float, duration: float, noise: float, where: str
) -> list[Notice]:
    """Look whether the block is at rest when it is let go: the mean rates of the beginning, noise rad/s a sample."""
    rates = crv[t <= BEGINNING * duration]
    if not len(rates):
        return []
    cure = "Count time from the release; what the gyroscope shows of a block at rest is its zero: subtract it."
    # decided: five standard deviations of a mean are not noise.
    most = MOVING * expected + 5.0 * noise / math.sqrt(len(rates))
    return [
        Notice("W-MOVING", f"{where}, column {name}", f"{rate / DEGREE:.3g} deg/s at the release, not at rest", cure)
        for name, rate in zip(names, rates.mean(axis=0), strict=True)
        if abs(rate) > most
    ]


def _first_impact(t: np.ndarray, crv: np.ndarray, duration: float, where: str) -> list[Notice]:
    from rockref.measure.impacts import main_impacts

    impacts = main_impacts(t, crv)
    if len(impacts) and abs(impacts.times[0] / duration - 1.0) <= TIME_MARGIN:
        return []
    found = f"the first main impact is at {impacts.times[0]:.3f} s" if len(impacts) else "there is no main impact"
    what = f"{found}; {duration:.3f} s is expected of a block of this size from this tilt"
    return [Notice("W-FIRST-IMPACT", where, what, "Check release tilt, width and height, and the start of time.")]


def _exchanged(
    t: np.ndarray, crv: np.ndarray, names: list[str], begin: float, experiment: Experiment, where: str
) -> list[Notice]:
    """Look whether the rates about Y and Z change places, from `begin` s on: the same clatter turns the block about its
    height in sharper corners than about Y, where its inertia is twenty times as large."""
    assert experiment.gyro is not None
    rates = crv[t > begin, 1:]
    if experiment.height < SLENDER * experiment.width or len(rates) < 2:
        return []
    size = rates.std(axis=0)
    if np.any(size <= HEARD * experiment.gyro.noise):
        return []
    rough = np.sqrt(np.mean(np.diff(rates, axis=0) ** 2, axis=0)) / size
    if rough[1] >= ROUGHER * rough[0]:
        return []
    what = f"{names[1]} jumps more than {names[2]}, and a slender block clatters most about its height"
    cure = "Check which axis is which: exchange the two names if the columns are exchanged."
    return [Notice("W-AXES", f"{where}, columns {names[1]} and {names[2]}", what, cure)]


def _flat_tops(t: np.ndarray, crv: np.ndarray, names: list[str], width: float, where: str) -> list[Notice]:
    """Look for stretches at the largest or smallest value that are longer than a cusp can be."""
    notices = []
    for axis, name in enumerate(names):
        for side, word in ((1.0, "top"), (-1.0, "bottom")):
            x = side * crv[:, axis]
            limit = float(x.max())
            # Near the noise everything is flat, also about an offset.
            if limit - float(np.median(x)) < 20.0 * width:
                continue
            samples = _longest(x >= limit - 4.0 * width)
            longest = samples * sample_step(t)
            if longest > FLAT_TOP and samples >= FLAT_SAMPLES:
                what = f"a flat {word} of {1e3 * longest:.0f} ms at {side * limit / DEGREE:.4g} deg/s"
                cure = "The gyroscope seems to saturate there: give range_deg_s, or use a larger range."
                notices.append(Notice("W-FLAT-TOP", f"{where}, column {name}", what, cure))
    return notices


def _longest(mask: np.ndarray) -> int:
    """Return the length of the longest stretch of True."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], mask.astype(np.int8), [0]))))
    return int((edges[1::2] - edges[::2]).max(initial=0))


def _at_range(crv: np.ndarray, names: list[str], limit: float | None, where: str) -> list[Notice]:
    if limit is None:
        return []
    cure = "Use a gyroscope of a larger range, or keep the stretches out of the fit."
    notices = []
    for axis, name in enumerate(names):
        count = int((np.abs(crv[:, axis]) >= limit * (1.0 - 1e-9)).sum())
        if count:
            what = f"{count} samples are at the stated range of {limit / DEGREE:g} deg/s"
            notices.append(Notice("W-SATURATED", f"{where}, column {name}", what, cure))
    return notices


def _spikes(crv: np.ndarray, names: list[str], expected: float, where: str) -> list[Notice]:
    """Look for single samples that stand out from both neighbours by more than any impact can make them."""
    notices = []
    for axis, name in enumerate(names):
        left, right = crv[1:-1, axis] - crv[:-2, axis], crv[1:-1, axis] - crv[2:, axis]
        rows = np.flatnonzero((left * right > 0.0) & (np.minimum(np.abs(left), np.abs(right)) > SPIKE * expected))
        if len(rows):
            value = crv[rows[0] + 1, axis] / DEGREE
            what = f"{len(rows)} single samples stand out, the first with {value:.4g} deg/s in row {rows[0] + 2}"
            cure = "No impact does that: look for a fault of the logger, or for another unit of the column."
            notices.append(Notice("W-SPIKE", f"{where}, column {name}", what, cure))
    return notices


def _noisy(t: np.ndarray, crv: np.ndarray, names: list[str], stated: float, where: str) -> list[Notice]:
    sigma = noise_floor(t, crv).sigma
    notices = []
    for axis, name in enumerate(names):
        if not sigma[axis] > NOISE_MARGIN * stated > 0.0:
            continue
        what = f"the noise is {sigma[axis] / DEGREE:.3g} deg/s, and {stated / DEGREE:.3g} deg/s is stated"
        cure = "The stated noise weighs the comparison: correct the data sheet, or look for a disturbance."
        others = float(np.delete(sigma, axis).max())
        if sigma[axis] > UNIT_MARGIN * others > 0.0:
            cure = f"The other columns have {others / DEGREE:.3g} deg/s: check the unit of this one."
        notices.append(Notice("W-NOISE", f"{where}, column {name}", what, cure))
    return notices
