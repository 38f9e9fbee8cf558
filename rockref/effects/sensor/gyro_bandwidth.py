"""A gyroscope that is slow."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.prior import Prior
from rockref.model.errors import InputError

# decided: the damping of a second-order Butterworth filter, the flattest; data sheets give the bandwidth only.
DAMPING = 1.0 / math.sqrt(2.0)
#: Noise-to-signal power of the regularised inverse filter. Decided: the white noise of a gyroscope is some 1e-3 of
#: the clatter's amplitude, 1e-6 of its power, in the band that matters; above that band the inverse is cut.
REGULARISATION = 1e-3


def natural_frequency(bandwidth: float, damping: float = DAMPING) -> float:
    """Return the undamped angular frequency, rad/s, of a second-order low-pass whose -3 dB point is `bandwidth` Hz.

    Raises InputError E-RANGE if bandwidth or damping is not positive.
    """
    if bandwidth <= 0.0 or damping <= 0.0:
        cure = "Give positive numbers."
        raise InputError("E-RANGE", "arguments bandwidth, damping", f"{bandwidth:g} Hz and {damping:g}", cure)
    # |H|^2 = 1/((1 - r^2)^2 + (2 d r)^2) = 1/2 is a quadratic in r^2, with r = frequency/natural frequency. Of its root
    # b + sqrt(b^2 + 1) the sum loses its digits where b is far below zero; the quotient does not.
    b = 1.0 - 2.0 * damping**2
    root = b + math.sqrt(b * b + 1.0) if b > 0 else 1.0 / (math.sqrt(b * b + 1.0) - b)
    return 2.0 * math.pi * bandwidth / math.sqrt(root)


def undo_low_pass(crv: np.ndarray, rate: float, filters: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Return the true rates (..., N, 3) [rad/s] of a record behind second-order low-passes, sampled at `rate` Hz.

    Zero-phase Wiener inverse conj(H)/(|H|^2 + r) on the mirrored record: it shifts nothing and ends above the band.
    filters : bandwidth [Hz] and damping of each.
    """
    n = crv.shape[-2]
    pad = min(n - 1, fast_pad(n, int(rate / 2)))
    start = 2 * crv[..., :1, :] - crv[..., pad:0:-1, :]
    end = 2 * crv[..., -1:, :] - crv[..., -2 : -pad - 2 : -1, :]
    # The transform sees the mirrored ends side by side: where they jumped, all rows would ring at half the rate.
    meeting = (start[..., :1, :] + end[..., -1:, :]) / 2
    inward = np.sin(np.pi * np.arange(1, pad + 1) / (2 * pad + 2))[:, None] ** 2
    start, end = meeting + inward * (start - meeting), meeting + inward[::-1] * (end - meeting)
    whole = np.concatenate([start, crv, end], axis=-2)
    total = whole.shape[-2]
    s = 2j * np.pi * np.fft.rfftfreq(total, 1 / rate)
    H = np.ones(s.shape)
    for bandwidth, damping in filters:
        omega = natural_frequency(bandwidth, damping)
        H = H * omega**2 / (s * s + 2 * damping * omega * s + omega**2)
    G = np.conj(H) / (np.abs(H) ** 2 + REGULARISATION) * (1 + REGULARISATION)
    return np.fft.irfft(np.fft.rfft(whole, axis=-2) * G[:, None], total, axis=-2)[..., pad : pad + n, :]


def fast_pad(n: int, pad: int) -> int:
    """Return the least length of the ends, `pad` or more, with which n and both of them have a fast transform."""
    from scipy.fft import next_fast_len

    total = next_fast_len(n + 2 * pad, real=True)
    while (total - n) % 2:
        total = next_fast_len(total + 1, real=True)
    return (total - n) // 2


def even_step(t: np.ndarray) -> float:
    """Return the spacing [s] of even instants t (N,) [s]. Raises InputError (E-STEP) where they are not even."""
    step = (t[-1] - t[0]) / (len(t) - 1)
    if np.max(np.abs(np.diff(t) - step)) > 0.1 * step:
        cure = "Choose an output rate that divides the number of steps a second."
        raise InputError("E-STEP", f"effect {GyroBandwidth.id}", "needs rows at even spacing", cure)
    return step


@dataclass(frozen=True)
class GyroBandwidth(Effect):
    """A second-order low-pass, -3 dB at `frequency`; slow motion is late by 2 damping/omega.

    With damping 1/sqrt(2), by default, it is Butterworth's filter; far above one it is one of first order.
    Exact for rates that are straight between samples; settled on the first sample, so that one row alone stays as it
    is. The rows must be evenly spaced.
    It comes on top of the bandwidth that an experiment's file states. `delay` shows all axes later by that much more,
    as digital filters and buses do; cubic between rows, the first row held before it. No fit looks for a delay: from a
    clock whose zero is not the release it cannot be told at all, and hardly from a tilt (1.4 mrad move the first main
    impact of Table 3.1 by 12 ms).
    """

    id = "gyro_bandwidth"
    question = "sensor"
    quantities = {
        "frequency": Quantity("Hz", math.inf, 5.0, 500.0, 40.0, "any", "at which half the power passes", POSITIVE),
        "damping": Quantity(
            "1", DAMPING, 0.5, 5.0, DAMPING, "any", "of the filter; far above one, of first order", POSITIVE
        ),
        "delay": Quantity("s", 0.0, 0.0, 0.02, 0.0, "+", "by which all is late, beside the low-pass", 0.0, 1.0),
    }
    switches = ("frequency", "delay")
    priors = {"damping": Prior("shape"), "delay": Prior("fixed")}
    sentence = "The sensor's own filter smooths the steps of an impact and shows everything a little late."
    equation = (
        r"H(s) = e^{-\tau s}\,\omega^2/(s^2 + 2\zeta\omega s + \omega^2),\quad "
        r"\omega = 2\pi f/\sqrt{1 - 2\zeta^2 + \sqrt{(1 - 2\zeta^2)^2 + 1}}"
    )
    source = (
        "S. Butterworth (1930), On the theory of filter amplifiers, Experimental Wireless 7:536-541 (order two); a "
        "journal of that time: no DOI"
    )
    confounder = "hertzian_contact"
    experiment = "Knock the sensor alone on a table and look at the rise of the step; or log a second, faster sensor."

    frequency: float = math.inf
    damping: float = DAMPING
    delay: float = 0.0

    def sensor(self, t, crv):
        if self.is_absent() or len(t) < 2:
            return crv
        smooth = self.smoothed(np.asarray(t), crv) if math.isfinite(self.frequency) else crv
        if self.delay == 0.0:
            return smooth
        from scipy.interpolate import CubicSpline

        t = np.asarray(t, float)
        return CubicSpline(t, smooth, axis=-2)(np.maximum(t - self.delay, t[0]))

    def undo(self, t, crv):
        """Return the low-pass by its regularised inverse, the delay by earlier instants of the rows. Raises as
        `smoothed`."""
        if self.is_absent() or len(t) < 2:
            return t, crv
        t = np.asarray(t, float)
        if math.isfinite(self.frequency):
            crv = undo_low_pass(crv, 1 / even_step(t), ((self.frequency, self.damping),))
        return t - self.delay, crv

    def smoothed(self, t, crv):
        """Return the rates (..., N, 3) [rad/s] at even t (N,) [s] after the low-pass. Raises InputError (E-STEP)."""
        from scipy.signal import cont2discrete, lfilter, lfilter_zi

        step = even_step(t)
        omega = natural_frequency(self.frequency, self.damping)
        analog = ([omega**2], [1, 2 * self.damping * omega, omega**2])
        numerator, denominator, _ = cont2discrete(analog, step, method="foh")
        numerator = np.squeeze(numerator)
        settled = lfilter_zi(numerator, denominator)[:, None] * crv[..., :1, :]
        return lfilter(numerator, denominator, crv, axis=-2, zi=settled)[0]
