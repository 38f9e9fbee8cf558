"""Artificial motion that needs no download: two pulses, and noise by seed in a stated envelope. All along x."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError

# decided: two periods from its middle a Ricker pulse is below 1e-15 of its peak.
RICKER_REACH = 2.0


def one_sine(peak: float, period: float, dt: float) -> BaseMotion:
    """Return one full sine, a(t) = peak sin(2 pi t/T) for 0 <= t <= T.

    peak [m/s2]; period T [s]; dt [s], which has to divide T into whole steps. Amplitude of its Fourier transform:
    2 peak w_p |sin(w T/2)|/|w_p^2 - w^2|, w_p = 2 pi/T. Source: Zhang and Makris (2001), doi
    10.1061/(ASCE)0733-9399(2001)127:5(473). Raises InputError E-RANGE.
    """
    n = _steps(period, dt, "period")
    a = peak * np.sin(2.0 * np.pi * np.arange(n + 1) / n)
    a[-1] = 0.0
    return _along_x(a, dt, f"one_sine_{peak:g}_{period:g}")


def ricker(peak: float, period: float, dt: float) -> BaseMotion:
    """Return a Ricker pulse, a(t) = peak (1 - 2 s^2) exp(-s^2), s = pi (t - 2 T)/T, for 0 <= t <= 4 T.

    peak [m/s2]; period T [s], where its spectrum is largest; dt [s]. Amplitude of its Fourier transform:
    peak (2/sqrt(pi)) f^2 T^3 exp(-(f T)^2). Source: Ricker, Geophysics 18 (1953), doi 10.1190/1.1437843. Raises
    InputError E-RANGE.
    """
    n = _steps(2.0 * RICKER_REACH * period, dt, "four periods")
    s2 = (np.pi * (np.arange(n + 1) * dt / period - RICKER_REACH)) ** 2
    return _along_x(peak * (1.0 - 2.0 * s2) * np.exp(-s2), dt, f"ricker_{peak:g}_{period:g}")


def white_noise(seed: int, density: float, duration: float, dt: float, window: Any = None) -> BaseMotion:
    """Return Gaussian white noise up to half the sample rate, times an envelope.

    seed : of NumPy's default generator;  density : one-sided power G [(m/s2)^2/Hz], so that a sample has the variance
    G/(2 dt);  duration, dt [s];  window : function of times (n,) [s], such as `envelope(...)`

    Straight lines between samples lower the power at f by sinc^4(f dt). Raises InputError E-RANGE.
    """
    n = _steps(duration, dt, "duration")
    a = math.sqrt(_positive(density, "density") / (2.0 * dt)) * np.random.default_rng(seed).standard_normal(n + 1)
    return _along_x(_windowed(a, dt, window), dt, f"white_{seed}")


def kanai_tajimi(
    seed: int,
    density: float,
    duration: float,
    dt: float,
    *,
    ground: float = 2.5,
    damping: float = 0.6,
    low_cut: float = 0.0,
    window: Any = None,
) -> BaseMotion:
    """Return Gaussian noise with the spectrum of Kanai and Tajimi, times an envelope.

    Parameters
    ----------
    seed : of NumPy's default generator
    density : one-sided power G_0 of the rock [(m/s2)^2/Hz]
    duration, dt : [s]
    ground, damping : frequency [Hz] and damping ratio of the ground; decided: 2.5 Hz (5 pi rad/s) and 0.6, the firm
        ground of the literature
    low_cut : frequency [Hz] of a second filter of the same damping, which takes slow motion away (Clough and Penzien);
        0 leaves it, and the velocity then drifts
    window : function of times (n,) [s], such as `envelope(...)`

    Sources: Lin and Yong, Journal of Engineering Mechanics 113 (1987), doi
    10.1061/(ASCE)0733-9399(1987)113:8(1119), for the spectrum of Kanai (1957) and Tajimi (1960); Clough and Penzien,
    Dynamics of Structures (1975), for the second filter. Raises InputError E-RANGE.
    """
    n = _steps(duration, dt, "duration") + 1
    white = np.random.default_rng(seed).standard_normal(n) * math.sqrt(_positive(density, "density") / (2.0 * dt))
    gain = np.sqrt(kanai_tajimi_density(np.fft.rfftfreq(n, dt), 1.0, ground, damping, low_cut))
    return _along_x(_windowed(np.fft.irfft(gain * np.fft.rfft(white), n), dt, window), dt, f"kanai_tajimi_{seed}")


def kanai_tajimi_density(f: Any, density: float, ground: float, damping: float, low_cut: float = 0.0) -> np.ndarray:
    """Return the one-sided power at frequencies f [Hz]: G_0 (1 + 4 d^2 r^2)/[(1 - r^2)^2 + 4 d^2 r^2], r = f/ground.

    With a low cut times r_c^4/[(1 - r_c^2)^2 + 4 d^2 r_c^2], r_c = f/low_cut. Raises InputError E-RANGE.
    """
    d2 = 4.0 * _positive(damping, "damping") ** 2
    r2 = (np.asarray(f, float) / _positive(ground, "ground")) ** 2
    power = density * (1.0 + d2 * r2) / ((1.0 - r2) ** 2 + d2 * r2)
    if low_cut:
        c2 = (np.asarray(f, float) / _positive(low_cut, "low_cut")) ** 2
        power = power * c2**2 / ((1.0 - c2) ** 2 + d2 * c2)
    return power


def envelope(rise: float, strong: float, decay: float) -> Any:
    """Return an envelope as a function of time: (t/rise)^2, then one for `strong` seconds, then exp(-decay (t - end)).

    rise, strong [s]; decay [1/s]. Source: Jennings, Housner and Tsai, Simulated earthquake motions, California
    Institute of Technology (1968). Raises InputError E-RANGE.
    """
    _positive(rise, "rise"), _positive(decay, "decay")
    end = rise + strong

    def window(t: np.ndarray) -> np.ndarray:
        falling = np.exp(-decay * np.maximum(t - end, 0.0))
        return np.where(t < rise, (t / rise) ** 2, falling)

    return window


def _windowed(a: np.ndarray, dt: float, window: Any) -> np.ndarray:
    return a if window is None else a * window(dt * np.arange(len(a)))


def _along_x(a: np.ndarray, dt: float, name: str) -> BaseMotion:
    return BaseMotion(t_0=0.0, dt=dt, a=np.column_stack([a, np.zeros((len(a), 2))]), name=name)


def _steps(time: float, dt: float, what: str) -> int:
    n = round(_positive(time, what) / _positive(dt, "dt"))
    # A division may be off in its last digits.
    if n < 2 or abs(n * dt - time) > 1e-9 * time:
        raise InputError("E-RANGE", what, f"{time:g} s is no whole number of steps of {dt:g} s", "Choose another step.")
    return n


def _positive(value: float, what: str) -> float:
    if not (value > 0.0 and math.isfinite(value)):
        raise InputError("E-RANGE", what, f"is {value!r}", "Give a positive number.")
    return value
