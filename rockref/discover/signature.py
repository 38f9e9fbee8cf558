"""What the misfit of the baseline looks like: on which axis, when, and with which frequency."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.discover.fit.least_squares import Fit, Point

AXES = ("main", "transverse", "longitudinal")
#: A misfit of the first swings, in the median over the runs, that is so many times that of the windows after them
#: belongs to the release (decided).
RELEASE = 1.5


def signature(fit: Fit, point: Point, final: Fit, best: Point) -> dict[str, Any]:
    """Shares of the residual power by axis and by stretch, and its frequency, before and after the best fit."""
    r = fit.residual(point.z, point.corrections)
    excess = np.maximum(np.sum(r**2, axis=(0, 1)) - fit.series.valid.sum(), 0.0)
    rest = final.residual(best.z, best.corrections)
    rest_excess = np.maximum(np.sum(rest**2, axis=(0, 1)) - final.series.valid.sum(), 0.0)
    first = fit.series.first
    mean = 2 * point.loss / fit.series.count
    r1 = r[first]
    spectrum = np.abs(np.fft.rfft(r1 - r1.mean(axis=1, keepdims=True), axis=1)) ** 2
    frequency = np.fft.rfftfreq(r1.shape[1], 1 / fit.series.rate)
    power = spectrum.sum(axis=(0, 2))
    # What belongs to the release shows in every run; a blow at any time may fall into the first swing of one.
    at_release, after = float(np.median(mean[first])), float(mean[~first].mean())
    phase = "release" if at_release > RELEASE * max(after, 1.0) else "impacts"
    return {
        "axis": AXES[int(np.argmax(excess))],
        "axis_shares": {a: float(e / max(excess.sum(), 1e-9)) for a, e in zip(AXES, excess, strict=True)},
        "remaining_axis_shares": {
            a: float(e / max(rest_excess.sum(), 1e-9)) for a, e in zip(AXES, rest_excess, strict=True)
        },
        "phase": phase,
        "loss_at_release": at_release,
        "loss_after": after,
        "frequency_hz": float(frequency[1 + int(np.argmax(power[1:]))]),
    }
