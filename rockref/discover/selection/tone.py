"""A line in the spectrum of the innovations: where an effect that oscillates starts."""

from __future__ import annotations

import numpy as np

from rockref.discover.fit.fitter import FittedModel, Fitter

#: Where a line is looked for [Hz] (decided: slower than the first is rocking itself, faster than the last is ringing).
BAND = (4.0, 120.0)
#: Innovations count no further than this many noise widths: a line shows in all samples, an impact in few.
CLIPPED = 4.0
#: Fineness of the frequencies, in parts of what the length of the records resolves (decided: a Gauss-Newton step
#: follows a tone that turns by less than a quarter over a record).
FINE = 4


def tone(fitter: Fitter, h: FittedModel) -> float:
    """Return the frequency [Hz] at which the innovations of h, smoothed as they were evaluated, have the clearest line.

    The power at each frequency is compared with that of its neighbourhood, run by run and axis by axis.
    """
    assert h.r is not None
    listener = fitter.problem.listener
    n = h.r.shape[1]
    thinned = max(1, round(listener.valid.shape[1] / n))
    rate = listener.gyro.sample_rate / thinned
    r = np.clip(h.r, -CLIPPED, CLIPPED) * np.hanning(n)[:, None]
    power = np.abs(np.fft.rfft(r, FINE * n, axis=1)) ** 2
    f = np.fft.rfftfreq(FINE * n, 1 / rate)
    from scipy.ndimage import median_filter

    background = median_filter(power, (1, 16 * FINE + 1, 1), mode="nearest")
    clear = (power / np.maximum(background, 1e-12)).sum(axis=(0, 2))
    inside = (f >= BAND[0]) & (f <= BAND[1])
    return float(f[inside][np.argmax(clear[inside])])
