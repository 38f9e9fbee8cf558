"""When the first arc begins, and whether somebody set the block up again: what lies outside of one release."""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.records.notice import Notice
from rockref.measure.signals.signal import Signal, growth_rate, stretches

# decided: the arc is looked at in the middle of the swing, where it stands out of the noise and the feet are still.
FROM, TO = 0.4, 0.85
# In simulated records the arc begins within a hundredth of the swing of the release. decided: three times that.
LATE_SHARE, LATE_SAMPLES, SIGMAS = 0.03, 2.0, 6.0
# decided: rates within four widths for a tenth of a second, and for three times as long as about an apex, are those of
# a body at rest. A quarter of the release's tilt is far from upright.
STILL, STILL_TIME, APEXES, TILTED = 4.0, 0.1, 3.0, 0.25


def arc_start(signal: Signal, impact: float) -> tuple[float, float]:
    """Return when the arc A sinh(p (t - t0)) that ends at the first main `impact` s begins, s, and its error, s.

    NaN where there is no arc.
    """
    t, wx = signal.t, signal.crv[:, 0]
    p = growth_rate(signal.width, signal.height)
    rows = (t >= FROM * impact) & (t <= TO * impact)
    if rows.sum() < 8:
        return math.nan, math.nan
    basis = np.stack((np.sinh(p * t[rows]), np.cosh(p * t[rows])), axis=-1)
    (a, b), *_ = np.linalg.lstsq(basis, wx[rows], rcond=None)
    if not abs(b) < abs(a):
        return math.nan, math.nan
    share = b / a
    left = max(float(np.std(wx[rows] - basis @ (a, b))), signal.grain)
    along = np.array([share, -1.0]) / (a * p * (1.0 - share**2))
    error = left * math.sqrt(float(along @ np.linalg.inv(basis.T @ basis) @ along))
    delay = math.sqrt(2.0) / (2.0 * math.pi * signal.gyro.bandwidth)
    return -math.atanh(share) / p - delay, error


def check_start(signal: Signal) -> list[Notice]:
    """Remark on an arc that does not begin at zero (W-RELEASE): another start of time, or a start that moves."""
    impacts = signal.impacts
    if not len(impacts) or signal.t[0] > LATE_SAMPLES * signal.step:
        return []
    start, error = arc_start(signal, float(impacts.times[0]))
    if not abs(start) > LATE_SHARE * signal.duration + LATE_SAMPLES * signal.step + SIGMAS * error:
        return []
    when = f"{1e3 * abs(start):.3g} ms {'after' if start > 0.0 else 'before'} time zero"
    what = f"the block swings as one that is let go {when}"
    cure = "Count time from the release. If it is: the wire held on, something pulls, or the block was not at rest."
    return [Notice("W-RELEASE", signal.path, what, cure)]


def samples_before_setting_up(signal: Signal) -> tuple[int, float]:
    """Return how many samples come before somebody catches the block or sets it up, and when it rests tilted, s.

    A block that rests where its rates add up to a tilt is held; what counts ends with the main impact before. All
    samples and NaN where it never does.
    """
    t, crv = signal.t, signal.crv
    impacts = signal.impacts
    still = (np.abs(crv) < STILL * signal.grain).all(axis=1)
    # A hand that turns the block loses nothing at the largest rate.
    uprights = impacts.times[impacts.drops > 0.0]
    if not len(uprights) or not signal.grain > 0.0:
        return len(t), math.nan
    turned = signal.turned
    upright = np.interp(t, uprights, np.interp(uprights, t, turned))
    # About an apex the rate goes from one such width to the other at the slope of the swing.
    apex = 2.0 * STILL * signal.grain * signal.duration / signal.rate
    least = max(STILL_TIME * max(1.0, signal.scale), APEXES * apex)
    for first, last in stretches(still & (np.abs(turned - upright) > TILTED * signal.tilt)):
        before = uprights[uprights < t[first]]
        if (last - first) * signal.step > least and len(before):
            return int(np.searchsorted(t, before[-1])) + 1, float(t[first])
    return len(t), math.nan
