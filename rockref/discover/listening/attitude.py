"""From body rates to attitudes, compiled."""

from __future__ import annotations

import numpy as np

from rockref.engines.on_disk import on_disk


@on_disk(nogil=True)
def attitudes(Lambda_0, W, dt):
    """Return rotation at every sample, (N, 3, 3), by integrating the rates W (N, 3) [rad/s] from Lambda_0 at the first
    one.

    Each interval turns by the mean of its end rates and the commutator term of fourth order.
    """
    n = W.shape[0]
    out = np.empty((n, 3, 3))
    L = Lambda_0.copy()
    out[0] = L
    for i in range(1, n):
        ax, ay, az = W[i - 1, 0], W[i - 1, 1], W[i - 1, 2]
        bx, by, bz = W[i, 0], W[i, 1], W[i, 2]
        k = dt * dt / 12
        tx = dt / 2 * (ax + bx) + k * (ay * bz - az * by)
        ty = dt / 2 * (ay + by) + k * (az * bx - ax * bz)
        tz = dt / 2 * (az + bz) + k * (ax * by - ay * bx)
        t = tx * tx + ty * ty + tz * tz
        s, c = 1 - t / 6 + t * t / 120, 0.5 - t / 24 + t * t / 720
        for j in range(3):
            m0, m1, m2 = L[j, 0], L[j, 1], L[j, 2]
            b0, b1, b2 = m1 * tz - m2 * ty, m2 * tx - m0 * tz, m0 * ty - m1 * tx
            d0, d1, d2 = b1 * tz - b2 * ty, b2 * tx - b0 * tz, b0 * ty - b1 * tx
            L[j, 0], L[j, 1], L[j, 2] = m0 + s * b0 + c * d0, m1 + s * b1 + c * d1, m2 + s * b2 + c * d2
        out[i] = L
    return out
