"""When samples were taken: which are missing, and whether the time stamps or an even clock tell it.

A logger stamps a row when it is read or written, often to a whole millisecond, in bunches or late. The sampler behind
it is even, and nothing is missing as long as rows over duration agree. Only a step of the stamps that stays is a hole.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

# decided: an interval of one and a half samples may hide a lost one; a shorter one cannot.
LONG = 1.5
# decided: stamps that are late catch up within four times their delay, and within sixteen samples at least.
CATCH_UP, LEAST_AROUND = 4, 16
# decided: a lost sample shows as a step of one; half of the usual spread of stamps may hide a part of it.
SPREAD_SHARE = 0.5
# decided: where more than half of the intervals are within three tenths of a sample, their mean is the rate.
REGULAR, REGULAR_SHARE = 0.3, 0.5
# decided: stamps on a grid of three tenths of a sample make unlike intervals; over 48 it is a hundredth.
COARSE, STRETCH = 0.3, 48
# decided: one part in a hundred is another rate, as everywhere.
NEAR = 1e-2
# decided: the stamps of a clock of two per cent of a sample are as good as even ones.
EVEN = 0.02
# decided: a rounding is told from holes by its beat, which three long intervals show at least.
LEAST_BEATS = 3
# decided: a crystal is off by fifty parts in a million.
NEARER = 5e-5
# decided: a cubic over sixteen samples follows the free motion, and leaves twelve residuals.
WINDOW, DEGREE_OF_FIT = 16, 3
# decided: three standard errors say whether the rates follow the stamps or the even clock.
SURE = 3.0


def reference_rate(t: np.ndarray, stated: float) -> float:
    """Return the rate, Hz, at which stamps t (N,) s come where nothing is odd: between holes and stalls.

    The mean of the regular intervals; of stamps on a coarse grid, or of irregular ones, a median over stretches.
    """
    intervals = np.diff(t)
    mean = (len(t) - 1) / float(t[-1] - t[0])
    if bunch_length(t, mean) > 1:
        first = bunch_heads(t, mean)
        return 1.0 / float(np.median(np.diff(t[first]) / np.diff(first)))
    regular = np.abs(intervals * stated - 1.0) < REGULAR
    if regular.mean() > REGULAR_SHARE:
        rate = 1.0 / float(intervals[regular].mean())
        if abs(rate / stated - 1.0) < NEAR or quantum(t) * stated < COARSE:
            return rate
    apart = max(1, min(STRETCH, len(t) // 4))
    middle = float(np.median(t[apart:] - t[:-apart])) / apart
    return 1.0 / middle if middle > 0.0 else mean


def quantum(t: np.ndarray) -> float:
    """Return the step, s, of which all intervals of stamps t (N,) s are multiples; 0 where there is none."""
    intervals = np.abs(np.diff(t))
    some = intervals[intervals > 1e-9 * max(abs(float(t[-1])), 1e-300)]
    if not len(some):
        return 0.0
    # decided: stamps have six decimals at most that count; a microsecond is no rounding at any rate.
    for step in (0.1, 0.01, 0.005, 0.002, 1e-3, 5e-4, 2e-4, 1e-4, 5e-5, 2e-5, 1e-5, float(some.min())):
        if np.abs(some / step - np.rint(some / step)).max() < 1e-3:
            return step
    return 0.0


def missing_samples(t: np.ndarray, stated: float) -> np.ndarray:
    """Return how many samples are missing in each interval, (N - 1,) int, of stamps t (N,) s at `stated` Hz.

    Where the stamps step on by a sample and more, and do not come back, samples are missing. Steps that come as even as
    a beat are those of stamps on a grid.
    """
    missing = np.zeros(len(t) - 1, dtype=np.int64)
    rate = reference_rate(t, stated)
    rows = bunch_heads(t, rate) if bunch_length(t, rate) > 1 else np.arange(len(t))
    off = (t[rows] - t[0]) * rate - rows
    spread = _usual_spread(off)
    for row in np.flatnonzero(np.diff(off) >= LONG - 1.0):
        around = max(LEAST_AROUND, int(CATCH_UP * (off[row + 1] - off[row])))
        before, after = off[max(0, row - around + 1) : row + 1], off[row + 1 : row + 1 + around]
        missing[rows[row + 1] - 1] = max(0, round(float(after.min() - before.max()) + SPREAD_SHARE * spread))
    if _is_beat(t, missing, stated):
        missing[:] = 0
    return missing


def bunch_heads(t: np.ndarray, rate: float) -> np.ndarray:
    """Return the first row of each bunch, (B,) int, of stamps t (N,) s at `rate` Hz."""
    return np.flatnonzero(np.diff(t) * rate >= LONG) + 1


def _usual_spread(off: np.ndarray) -> float:
    """Return how far stamps, `off` (N,) samples beside an even clock, usually lie apart over sixteen rows."""
    count = len(off) // LEAST_AROUND
    if not count:
        return 0.0
    return min(1.0, float(np.median(np.ptp(off[: count * LEAST_AROUND].reshape(count, -1), axis=1))))


def _is_beat(t: np.ndarray, missing: np.ndarray, stated: float) -> bool:
    """Return whether stamps on a grid explain all long intervals, and as well as holes do."""
    if not missing.any():
        return False
    grid = quantum(t)
    whole, holed = (even_clock(t, numbers) for numbers in (np.arange(len(t)), numbers_of(missing)))
    rest = np.ptp(t - whole[0] - whole[1] * np.arange(len(t)))
    # decided: the line through rounded stamps leaves one grid step, and a quarter for the line's own error.
    if not 0.0 < rest <= 1.25 * grid:
        return False
    nearer = abs(1.0 / whole[1] / stated - 1.0) + NEARER < abs(1.0 / holed[1] / stated - 1.0)
    apart = np.diff(np.flatnonzero(missing))
    even = len(apart) + 1 >= LEAST_BEATS and np.ptp(apart) <= 1
    return bool(nearer or even)


def numbers_of(missing: np.ndarray) -> np.ndarray:
    """Return the sample number of each row, (N,) int, for so many missing in each interval, (N - 1,) int."""
    return np.arange(len(missing) + 1) + np.concatenate(([0], np.cumsum(missing)))


def even_clock(t: np.ndarray, numbers: np.ndarray) -> tuple[float, float]:
    """Return start and interval, s, of the even clock through stamps t (N,) s of samples `numbers` (N,).

    Stamps far from most are left out, and of rows that are read together the first one counts. Of the starts that the
    stamps allow the one nearest to zero is taken: the record begins at the release.
    """
    use = np.ones(len(t), dtype=bool)
    mean = (t[-1] - t[0]) / (numbers[-1] - numbers[0])
    # decided: two stamps in a hundred may be wild, and say nothing about the start; in bunches every row counts.
    margin = 2.0
    if bunch_length(t, 1.0 / mean) > 1:
        margin = 0.0
        use = np.isin(np.arange(len(t)), bunch_heads(t, 1.0 / mean))
    for _ in range(3):
        interval, start = np.polyfit(numbers[use], t[use], 1)
        off = t - (start + interval * numbers)
        far = np.abs(off - np.median(off[use]))
        # decided: six times the median distance is a stall; a tenth of a sample is none.
        kept = use & (far <= max(6.0 * float(np.median(far[use])), 0.1 * interval))
        if kept.sum() < 2 or np.array_equal(kept, use):
            break
        use = kept
    low, high = start + np.percentile(off, (margin, 100.0 - margin))
    return float(np.clip(0.0, low, high)), float(interval)


def follows_stamps(off: np.ndarray, rates: Sequence[np.ndarray]) -> bool | None:
    """Return whether rates, each (N,), were taken at their stamps, `off` (N,) intervals beside an even clock; None:
    unknown.

    Where a rate rises, a sample taken late is larger: what a cubic leaves of it is the slope times the delay. The share
    of the delay that shows is one for stamps that are true, and zero for those of the reader.
    """
    total = weight = 0.0
    size = min(WINDOW, len(off) // 2 * 2)
    if size < 2 * (DEGREE_OF_FIT + 1):
        return None
    place = np.linspace(-1.0, 1.0, size)
    basis, upper = np.linalg.qr(np.vander(place, DEGREE_OF_FIT + 1))
    slope_of = np.vander(place, DEGREE_OF_FIT) * np.arange(DEGREE_OF_FIT, 0, -1) * 2.0 / (size - 1)
    late = _windows(off, size)
    for rate in rates:
        rows = _windows(rate, size)
        found = np.linalg.solve(upper, basis.T @ rows.T)
        slopes = (slope_of @ found[:DEGREE_OF_FIT]).T
        rest, shift = (x - (x @ basis) @ basis.T for x in (rows, slopes * late))
        own = (rest * shift).sum(axis=1)
        square = (shift**2).sum(axis=1)
        share = np.divide(own, square, out=np.zeros_like(own), where=square > 0.0)
        left = ((rest - share[:, None] * shift) ** 2).sum(axis=1) / (size - DEGREE_OF_FIT - 2)
        # A signal without any rest is exact in digits; decided: a part in 1e9 of its size is rounding.
        noise = np.maximum(left, 1e-18 * float(np.mean(rows**2)) + 1e-300)
        total += float((own / noise).sum())
        weight += float((square / noise).sum())
    if not weight > 0.0:
        return None
    share, error = total / weight, SURE / np.sqrt(weight)
    if share - error > 0.5:
        return True
    return False if share + error < 0.5 else None


def _windows(x: np.ndarray, size: int) -> np.ndarray:
    """Return x (N,) in half-overlapping windows, (W, size)."""
    return np.lib.stride_tricks.sliding_window_view(x, size)[:: size // 2]


def bunch_length(t: np.ndarray, rate: float) -> int:
    """Return how many rows share a reading, by their stamps t (N,) s at `rate` Hz; 1 where rows come one by one."""
    breaks = np.flatnonzero(np.diff(t) * rate >= LONG)
    if len(breaks) < LEAST_BEATS:
        return 1
    lengths = np.diff(breaks)
    length = int(np.median(lengths))
    # Only where most bunches are alike, and their rows come in less than half of their time, they are bunches.
    inside = np.delete(np.diff(t), breaks)
    alike = float(np.mean(lengths == length)) > REGULAR_SHARE
    return length if length > 1 and alike and len(inside) and float(np.median(inside)) * rate < 0.5 else 1
