"""What a gyroscope makes of the body rates: sensor effects, low-pass, sampling, noise, saturation, quantisation.

`expected` and `record` are the measured channel: everything that simulates a record goes through them.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from rockref.effects.base import Effect
from rockref.effects.catalogue import analogue, digital
from rockref.effects.sensor.gyro_bandwidth import DAMPING, natural_frequency
from rockref.measure.records.release import Gyro
from rockref.model.errors import InputError

# decided: at 2 kHz the signal between samples is a straight line to a thousandth over a contact of 1.5 ms.
COARSEST_STEP = 5e-4


def low_pass(crv: np.ndarray, step: float, bandwidth: float, damping: float = DAMPING) -> np.ndarray:
    """Return crv (..., N, 3) rad/s, sampled every `step` s, after a second-order low-pass of `bandwidth` Hz.

    Exact for a signal that is straight between samples (first-order hold). The filter starts settled on the first
    sample. It delays slow motion by 2 damping/natural frequency (0.75 ms at 300 Hz).
    Raises InputError E-STEP if the step is above 0.5 ms, E-RANGE if bandwidth or damping is not positive.
    """
    if not 0.0 < step <= COARSEST_STEP * (1.0 + 1e-6):
        cure = "Simulate with an output rate of 2 kHz or more, then let the gyroscope sample it."
        raise InputError("E-STEP", "argument step", f"{step:g} s between samples", cure)
    from scipy.signal import lfilter

    crv = np.asarray(crv, dtype=np.float64)
    numerator, denominator = _held_first_order(natural_frequency(bandwidth, damping), damping, step)
    # The state, in the transposed direct form, in which an input of one has given an output of one for ever.
    settled = np.cumsum((numerator - denominator)[:0:-1])[::-1]
    return lfilter(numerator, denominator, crv, axis=-2, zi=settled[:, np.newaxis] * crv[..., :1, :])[0]


@lru_cache(maxsize=64)
def _held_first_order(omega: float, damping: float, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return numerator and denominator (3,) in 1/z of omega^2/(s^2 + 2 damping omega s + omega^2) at `step` s.

    First-order hold, pole by pole: over one step, y' = p y + u with u straight takes y to
    y exp(p h) + (a - b) u_0 + b u_1, with a = (exp(p h) - 1)/p and b = (exp(p h) - 1 - p h)/(p^2 h).
    """
    # A double pole has no partial fractions; decided: a damping that is off by 1e-6 moves nothing that can be seen.
    split = cmath.sqrt(damping**2 - 1.0) if abs(damping - 1.0) > 1e-6 else cmath.sqrt(2e-6)
    poles = omega * np.array([-damping + split, -damping - split])
    residues = omega**2 / np.array([poles[0] - poles[1], poles[1] - poles[0]])
    turns = np.exp(poles * step)
    both, last = (turns - 1.0) / poles, (turns - 1.0 - poles * step) / (poles**2 * step)
    numerator = sum(residues[k] * np.polymul([last[k], both[k] - last[k]], [1.0, -turns[1 - k]]) for k in range(2))
    return np.real(numerator), np.real(np.poly(turns))


def sample(t: np.ndarray, crv: np.ndarray, times: np.ndarray) -> np.ndarray:
    """Return crv (..., M, 3) at `times` (M,) s of a signal with times t (N,) s and rates crv (..., N, 3).

    Cubic between samples; at a time that is in t, the sample itself. Raises InputError E-TIMES if a time lies outside.
    """
    t, crv, times = (np.asarray(a, dtype=np.float64) for a in (t, crv, times))
    # decided: a thousandth of a sample is rounding of the clock, not another instant.
    slack = 1e-3 * float(t[1] - t[0])
    if len(times) and (times.min() < t[0] - slack or times.max() > t[-1] + slack):
        what = f"times {times.min():g} to {times.max():g} s are asked of a signal from {t[0]:g} to {t[-1]:g} s"
        raise InputError("E-TIMES", "argument times", what, "Ask for times inside the signal.")
    near = np.clip(np.searchsorted(t, times), 1, len(t) - 1)
    near -= times - t[near - 1] < t[near] - times
    if np.abs(t[near] - times).max(initial=0.0) <= slack:
        return crv[..., near, :]
    from scipy.interpolate import CubicSpline

    return CubicSpline(t, crv, axis=-2)(np.clip(times, t[0], t[-1]))


def sample_times(start: float, end: float, rate: float) -> np.ndarray:
    """Return the instants start, start + 1/rate, ... up to `end` s, (M,) s, for a rate in Hz."""
    # A last sample that misses the end by rounding belongs to the record.
    count = int((end - start) * rate * (1.0 + 1e-12) + 1e-6) + 1
    return start + np.arange(count) / rate


def add_noise(crv: np.ndarray, noise: float, rng: np.random.Generator) -> np.ndarray:
    """Return crv of any shape, rad/s, with white noise of standard deviation `noise` rad/s from `rng`."""
    return np.asarray(crv) + noise * rng.standard_normal(np.shape(crv))


def saturate(crv: np.ndarray, limit: float | None) -> np.ndarray:
    """Return crv of any shape, rad/s, cut at plus and minus `limit` rad/s; None is no limit."""
    return np.asarray(crv) if limit is None else np.clip(crv, -limit, limit)


def quantise(crv: np.ndarray, resolution: float) -> np.ndarray:
    """Return crv of any shape rounded to multiples of `resolution` rad/s; zero leaves it as it is."""
    return np.asarray(crv) if resolution == 0.0 else np.rint(np.asarray(crv) / resolution) * resolution


def expected(t: np.ndarray, crv: np.ndarray, gyro: Gyro, effects: Iterable[Effect] = ()) -> np.ndarray:
    """Return what is there to be sampled, (..., N, 3) rad/s at t (N,) s, of the rates crv: without noise and limits.

    Misalignment, scale, the data sheet's low-pass, bandwidth and delay, bias and drift, clock. `t` is uniform, 2 kHz or
    finer. Raises InputError E-STEP.
    """
    if len(t) < 2:
        raise InputError("E-STEP", "argument t", "fewer than two samples", "Simulate for longer.")
    step = float(t[-1] - t[0]) / (len(t) - 1)
    return analogue(effects, t, crv, lambda rates: low_pass(rates, step, gyro.bandwidth))


def limited(t: np.ndarray, crv: np.ndarray, gyro: Gyro, effects: Iterable[Effect] = ()) -> np.ndarray:
    """Return samples crv (..., M, 3) rad/s at t (M,) s cut at the range of the effects and the data sheet."""
    return saturate(digital(effects, t, crv), gyro.range)


def record(
    t: np.ndarray, crv: np.ndarray, gyro: Gyro, rng: np.random.Generator | None = None, effects: Iterable[Effect] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """Return times (M,) s and rates (..., M, 3) rad/s as `gyro` would record the rates crv (..., N, 3) at t (N,) s.

    `t` is uniform, 2 kHz or finer; `effects` are those of the sensor. Without `rng` there is no noise, and no
    quantisation either: the expected record. Raises InputError E-STEP.
    """
    t, effects = np.asarray(t, dtype=np.float64), tuple(effects)
    smooth = expected(t, crv, gyro, effects)
    times = sample_times(float(t[0]), float(t[-1]), gyro.sample_rate)
    sampled = sample(t, smooth, times)
    if rng is None:
        return times, limited(times, sampled, gyro, effects)
    return times, quantise(limited(times, add_noise(sampled, gyro.noise, rng), gyro, effects), gyro.resolution)
