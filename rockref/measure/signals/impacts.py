"""Main impacts: the instants at which the block passes through upright, from the rates alone.

Between two apexes the rate about the main axis grows to a cusp and falls again. It grows until the feet of the other
side touch; there it loses a few per cent within some milliseconds, and does not change sign. That sharp drop is the
main impact. The feet do not touch all at once: two or three drops may follow one another within 20 ms. The instant is
the middle of the one that follows the largest rate, for model and data alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.running import half_width, running_mean, sample_step
from rockref.model.errors import InputError

# decided: a swing whose rate stays below a twentieth of the largest is late rocking with no cusp above the clatter.
LEAST_SHARE = 0.05
# decided: long enough to average out the clatter (period 20 to 100 ms, 0.5 deg/s), short enough to keep the cusp.
COARSE_WINDOW = 0.009
# decided: three samples at 1 kHz; halves the noise and leaves a drop of 3 ms steep.
FINE_WINDOW = 0.002
# decided: the cusp of the smooth rate is at most this far from the cusp of the rate itself.
SEARCH = 0.012
# decided: a contact lasts 1.5 ms (half period of 13 kg on 6e7 N/m), and the gyroscope's 300 Hz add 2 ms. If the rate
# goes on to fall at the slope of the free motion, half way down is up to 0.7 ms late; model and data alike.
DROP_WINDOW = 0.004
# decided: an impact takes three per cent (1 - 1.5 sin^2 of the slenderness, Housner 1963); where less than one is lost
# in 5 ms the top is flat, cut off by the range of the gyroscope, and its middle is taken with a drop of zero.
FLAT = 0.01


@dataclass(frozen=True, eq=False)
class Impacts:
    """Main impacts of a run, in order of time; arrays of shape (M,).

    Attributes: ``times`` s, finer than a sample; ``signs`` +1 or -1, of the rate about the main axis; ``peaks`` rad/s,
    the largest rate just before; ``drops`` rad/s, how much is lost at once (positive); ``samples``, index of the peak.
    """

    times: np.ndarray
    signs: np.ndarray
    peaks: np.ndarray
    drops: np.ndarray
    samples: np.ndarray

    def __len__(self) -> int:
        return len(self.times)


def main_impacts(t: np.ndarray, crv: np.ndarray, *, least_rate: float | None = None) -> Impacts:
    """Return the main impacts of a run with times t (N,) s and body rates crv (N, 3) rad/s.

    Swings that stay below `least_rate` rad/s (default: a twentieth of the largest rate) are not looked at.
    Raises InputError E-SIGNAL for arrays of other shapes, or too short to look at.
    """
    t, crv = checked_signal(t, crv)
    wx = crv[:, 0]
    smooth = running_mean(wx, half_width(t, COARSE_WINDOW))
    least = LEAST_SHARE * float(np.abs(smooth).max()) if least_rate is None else least_rate
    fine = running_mean(wx, half_width(t, FINE_WINDOW))
    found = [
        impact
        for first, last, sign in swings(smooth, least)
        if (impact := _impact(t, sign * fine, sign * smooth, first, last, sign)) is not None
    ]
    columns = list(zip(*found, strict=True)) if found else [()] * 5
    times, signs, peaks, drops, samples = columns
    return Impacts(
        np.array(times, dtype=np.float64),
        np.array(signs, dtype=np.int64),
        np.array(peaks, dtype=np.float64),
        np.array(drops, dtype=np.float64),
        np.array(samples, dtype=np.int64),
    )


def checked_signal(t: np.ndarray, crv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return t (N,) and crv (N, 3) as float64. Raises InputError E-SIGNAL if they are not that, or not finite."""
    t, crv = np.asarray(t, dtype=np.float64), np.asarray(crv, dtype=np.float64)
    if t.ndim != 1 or crv.shape != (len(t), 3) or len(t) < 8:
        what = f"shapes {t.shape} and {crv.shape}"
        raise InputError("E-SIGNAL", "arguments t, crv", what, "Give (N,) and (N, 3) with at least 8 samples.")
    if not (np.isfinite(t).all() and np.isfinite(crv).all()):
        raise InputError("E-SIGNAL", "arguments t, crv", "a value is not finite", "Cut the run before it.")
    return t, crv


def swings(smooth: np.ndarray, least: float) -> list[tuple[int, int, int]]:
    """Return (first, last, sign) of every stretch between apexes in which |smooth| exceeds `least`.

    A new swing begins only when the rate has gone beyond `least` on the other side, so that clatter about the apex
    does not make one. `first` and `last` are sample indices, `last` exclusive.
    """
    marked = np.flatnonzero(np.abs(smooth) > least)
    if not len(marked):
        return []
    signs = np.sign(smooth[marked]).astype(np.int64)
    turns = np.flatnonzero(np.diff(signs)) + 1
    # The apex lies where the rate crosses zero between the last mark of one swing and the first of the next.
    apexes = [_crossing(smooth, marked[k - 1], marked[k]) for k in turns]
    bounds = [0, *apexes, len(smooth)]
    heads = [0, *turns]
    return [(bounds[i], bounds[i + 1], int(signs[head])) for i, head in enumerate(heads)]


def _crossing(x: np.ndarray, before: int, after: int) -> int:
    """Return the index after the middle one of the sign changes of x between two samples of opposite sign."""
    changes = np.flatnonzero(np.diff(np.sign(x[before : after + 1])) != 0)
    return int(before + changes[len(changes) // 2] + 1)


def _impact(
    t: np.ndarray, fine: np.ndarray, smooth: np.ndarray, first: int, last: int, sign: int
) -> tuple[float, int, float, float, int] | None:
    """Return time, sign, peak, drop, sample of the impact of one swing, whose rates are positive here."""
    step = sample_step(t)
    coarse = first + int(np.argmax(smooth[first:last]))
    reach = max(2, round(SEARCH / step))
    # A rate that only falls since the record began is a block thrown back at its release: nothing grew to a cusp.
    if coarse < reach:
        return None
    # A peak at the end of the record is where the record was cut, not where the block fell.
    if coarse + reach >= len(t):
        return None
    low = max(first, coarse - reach)
    peak = low + int(np.argmax(fine[low : coarse + reach]))
    stop = min(peak + max(3, round(DROP_WINDOW / step)) + 1, len(t))
    bottom = peak + int(np.argmin(fine[peak:stop]))
    if fine[peak] - fine[bottom] < FLAT * fine[peak]:
        # The peak itself may lie beyond the swing: the cusp of the rate is up to 12 ms from that of the smooth rate.
        flat = first + np.flatnonzero(fine[first : max(last, peak + 1)] >= (1.0 - FLAT) * fine[peak])
        if flat[-1] + reach >= len(t):
            return None
        return 0.5 * float(t[flat[0]] + t[flat[-1]]), sign, float(fine[peak]), 0.0, int((flat[0] + flat[-1]) // 2)
    middle = 0.5 * (fine[peak] + fine[bottom])
    after = peak + int(np.argmax(fine[peak : bottom + 1] <= middle))
    fraction = (fine[after - 1] - middle) / (fine[after - 1] - fine[after])
    time = float(t[after - 1] + fraction * (t[after] - t[after - 1]))
    return time, sign, float(fine[peak]), float(fine[peak] - fine[bottom]), peak
