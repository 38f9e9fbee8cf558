"""The gyroscope of the blind test: from true body rates to a recorded table."""

from __future__ import annotations

import math

import numpy as np

from rockref.blind.simulator.compiled import kept
from rockref.blind.simulator.world import Sensor

#: Lines a second in which the simulator hands over its rates.
FINE = 10_000


@kept
def oscillator(u, out, frequency, ratio, dt):
    """Write the second-order low-pass (Hz, damping ratio) of u (N, 3) to out (N, 3), by the midpoint rule."""
    w = 2.0 * math.pi * frequency
    h = 0.5 * w * dt
    scale = 1.0 / (1.0 + 2.0 * ratio * h + h * h)
    for k in range(u.shape[1]):
        y, s = u[0, k], 0.0  # s: rate over w
        out[0, k] = y
        for i in range(1, u.shape[0]):
            middle = 0.5 * (u[i - 1, k] + u[i, k])
            s_middle = (s + h * (middle - y)) * scale
            y_middle = y + h * s_middle
            y, s = 2.0 * y_middle - y, 2.0 * s_middle - s
            out[i, k] = y


@kept
def follower(u, out, frequency, dt):
    """Write the first-order low-pass (Hz) of u (N, 3) to out (N, 3), midpoint rule."""
    h = math.pi * frequency * dt
    for k in range(u.shape[1]):
        y = u[0, k]
        out[0, k] = y
        for i in range(1, u.shape[0]):
            middle = (y + h * 0.5 * (u[i - 1, k] + u[i, k])) / (1.0 + h)
            y = 2.0 * middle - y
            out[i, k] = y


def low_pass(u: np.ndarray, frequency: float, order: int = 2, ratio: float = math.sqrt(0.5)) -> np.ndarray:
    """Filter u (N, 3), sampled FINE times a second, by a low-pass; -3 dB at `frequency` Hz for the default ratio."""
    out = np.empty_like(u)
    if order == 1:
        follower(u, out, frequency, 1.0 / FINE)
    else:
        oscillator(u, out, frequency, ratio, 1.0 / FINE)
    return out


def cubic(u: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Return u (N, 3) at fractional rows `at` (M,), by the cubic through the four nearest rows."""
    i = np.clip(np.floor(at).astype(int), 1, len(u) - 3)
    s = (at - i)[:, None]
    a, b, c, d = u[i - 1], u[i], u[i + 1], u[i + 2]
    return (
        -s * (s - 1) * (s - 2) / 6 * a
        + (s + 1) * (s - 1) * (s - 2) / 2 * b
        - (s + 1) * s * (s - 2) / 2 * c
        + (s + 1) * s * (s - 1) / 6 * d
    )


def seconds_needed(sensor: Sensor, seconds: float) -> float:
    """Return true time [s] that a record of `seconds` covers."""
    return true_time(sensor, np.array([seconds]))[0] + 0.005


def true_time(sensor: Sensor, t: np.ndarray) -> np.ndarray:
    """Return true time [s] of rows that the recorder dates t (N,) [s]."""
    return sensor.clock * t + 0.5 * sensor.clock_bend * t * t


def record(
    rates: np.ndarray, sensor: Sensor, seconds: float, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return the recorder's table, t (N,) [s] and rates (N, 3) [rad/s], of rates (M, 3) at FINE lines a second.

    Mounting, ringing of the mount, scale, low-pass, its own low-pass, clock, lost packets, bias and drift, noise,
    saturation, resolution.
    """
    u = rates @ sensor.turn.T
    if sensor.ring_gain:
        u = u + sensor.ring_gain * (low_pass(u, sensor.ring_frequency, ratio=0.02) - u)
    u = u * sensor.scale + sensor.cubic * u**3
    if sensor.bandwidth:
        u = low_pass(u, sensor.bandwidth, sensor.bandwidth_order)
    u = low_pass(u, sensor.low_pass)
    t = np.arange(round(seconds * sensor.sample_rate) + 1) / sensor.sample_rate
    u = cubic(u, true_time(sensor, t) * FINE)
    if sensor.lost_packets:
        u = _lose(u, sensor, rng)
    warm = 1.0 - np.exp(-t / sensor.warm_up) if sensor.warm_up else t
    u = u + sensor.bias + warm[:, None] * sensor.drift
    u = u + sensor.noise * rng.normal(size=u.shape)
    if sensor.range:
        u = sensor.range * np.tanh(u / sensor.range) if sensor.soft else np.clip(u, -sensor.range, sensor.range)
    return t, np.round(u / sensor.resolution) * sensor.resolution


def _lose(u: np.ndarray, sensor: Sensor, rng: np.random.Generator) -> np.ndarray:
    """Delay packets: the rows of a late packet repeat the packet before it."""
    out = u.copy()
    for first in range(sensor.packet, len(u) - sensor.packet + 1, sensor.packet):
        if rng.random() < sensor.lost_packets:
            out[first : first + sensor.packet] = u[first - sensor.packet : first]
    return out
