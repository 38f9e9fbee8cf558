"""From the rows of the compiled step to the records of a gyroscope, for many windows at once; compiled."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from rockref.effects.sensor.gyro_bandwidth import DAMPING, natural_frequency
from rockref.engines.on_disk import on_disk

#: What stands for a rate that is no number [rad/s]: far outside every record, so that the window counts as lost.
LOST = 1e3


@lru_cache(maxsize=256)
def filter_coefficients(
    step: float, bandwidth: float, damping: float = DAMPING
) -> tuple[float, float, float, float, float]:
    """b0, b1, b2, a1, a2 of the second-order low-pass of `rockref.measure.gyroscope.low_pass` (first-order hold)."""
    from scipy.signal import cont2discrete

    omega = natural_frequency(bandwidth, damping)
    b, a, _ = cont2discrete(([omega**2], [1.0, 2 * damping * omega, omega**2]), step, method="foh")
    b = np.squeeze(b)
    return float(b[0]), float(b[1]), float(b[2]), float(a[1]), float(a[2])


@on_disk(error_model="numpy")
def _filter(x, n, b0, b1, b2, a1, a2, x1, x2, y1, y2):
    for k in range(n):
        x0 = x[k]
        y0 = b0 * x0 + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2
        x[k] = y0
        x2, x1, y2, y1 = x1, x0, y1, y0
    return x1, x2, y1, y2


@on_disk(error_model="numpy", nogil=True)
def _records(states, A, fast, slow, has_slow, follows, length, per, start, dt, bias, drift, limit, softness, out):
    R, soft = states.shape[1], softness > 0 and limit < np.inf
    x = np.empty(R)
    memory = np.zeros((3, 4))
    for b in range(states.shape[0]):
        n = min(length[b] * per, R)
        for j in range(3):
            for k in range(n):
                w = A[j, 0] * states[b, k, 15] + A[j, 1] * states[b, k, 16] + A[j, 2] * states[b, k, 17]
                x[k] = w if abs(w) < LOST else LOST
            _filter(x, n, fast[0], fast[1], fast[2], fast[3], fast[4], x[0], x[0], x[0], x[0])
            if has_slow:
                if not follows[b]:
                    memory[j, :] = x[0]
                m0, m1, m2, m3 = _filter(
                    x,
                    n,
                    slow[0],
                    slow[1],
                    slow[2],
                    slow[3],
                    slow[4],
                    memory[j, 0],
                    memory[j, 1],
                    memory[j, 2],
                    memory[j, 3],
                )
                memory[j, 0], memory[j, 1], memory[j, 2], memory[j, 3] = m0, m1, m2, m3
            for k in range(length[b]):
                t = start[b] + k * dt
                y = x[k * per] + bias[j] + drift[j] * t
                hard = min(max(y, -limit), limit)
                out[b, k, j] = hard + softness * (limit * np.tanh(y / limit) - hard) if soft else hard


def records(
    states, matrix, fast, slow, follows, length, M, per, start, dt, bias, drift, limit, softness=0.0
) -> np.ndarray:
    """What the gyroscope shows of B windows, (B, M, 3) [rad/s].

    states (B, R, STATE) with `per` rows a sample; matrix (3, 3) scale and misalignment; fast, slow : coefficients of
    the gyroscope's filter and of a further one (or None), which runs on over windows that follow their predecessor;
    length (B,) samples; start (B,) [s] and dt [s] on the device's clock; bias, drift, limit (its range), softness as
    in `Sensor`.
    """
    out = np.zeros((states.shape[0], M, 3))
    has_slow = slow is not None
    _records(
        states, matrix, np.array(fast), np.array(slow if has_slow else fast), has_slow, follows, length, per,
        start, dt, np.asarray(bias, float), np.asarray(drift, float), float(limit), float(softness), out,
    )  # fmt: skip
    return out
