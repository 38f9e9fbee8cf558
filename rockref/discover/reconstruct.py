"""From a gyroscope record to the state of the block at any instant: rates, attitude, and the pivot that carries it."""

from __future__ import annotations

import numba
import numpy as np

from rockref.effects.sensor.gyro_bandwidth import natural_frequency

#: Noise-to-signal power of the regularised inverse filter. Decided: the white noise of a gyroscope is some 1e-3 of
#: the clatter's amplitude, 1e-6 of its power, in the band that matters; above that band the inverse is cut.
REGULARISATION = 1e-3
#: Half width of the quadratic through the rates at a window's start [samples]; decided: 17 ms of noise are averaged,
#: and the clatter between two corner impacts (20 to 40 ms) is still a parabola.
HALF_WIDTH = 8


def undo_low_pass(crv: np.ndarray, rate: float, filters: tuple[tuple[float, float], ...]) -> np.ndarray:
    """True rates from a record behind second-order low-passes, (N, 3) -> (N, 3) [rad/s].

    Zero-phase Wiener inverse conj(H) / (|H|^2 + r) on the mirrored record; rate [Hz];
    filters: bandwidth [Hz] and damping of each.
    """
    n = len(crv)
    pad = min(n - 1, int(rate / 2))
    start = 2 * crv[0] - crv[pad:0:-1]
    end = 2 * crv[-1] - crv[-2 : -pad - 2 : -1]
    whole = np.concatenate([start, crv, end])
    s = 2j * np.pi * np.fft.rfftfreq(len(whole), 1 / rate)
    H = np.ones_like(s)
    for bandwidth, damping in filters:
        omega = natural_frequency(bandwidth, damping)
        H = H * omega**2 / (s * s + 2 * damping * omega * s + omega**2)
    G = np.conj(H) / (np.abs(H) ** 2 + REGULARISATION) * (1 + REGULARISATION)
    return np.fft.irfft(np.fft.rfft(whole, axis=0) * G[:, None], len(whole), axis=0)[pad : pad + n]


@numba.njit(cache=True, nogil=True)
def attitudes(Lambda_0, W, dt):
    """Rotation at every sample, (N, 3, 3), by integrating the rates W (N, 3) [rad/s] from Lambda_0 at the first one.

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


def local_rates(crv: np.ndarray) -> np.ndarray:
    """Rates by a quadratic through 2 HALF_WIDTH + 1 samples, (N, 3) -> (N, 3)."""
    from scipy.signal import savgol_filter

    return savgol_filter(crv, 2 * HALF_WIDTH + 1, 2, axis=0)


def roughness(crv: np.ndarray) -> np.ndarray:
    """How far the record is from a local quadratic, (N,) [rad/s]: small in the free flights between corner impacts."""
    from scipy.ndimage import uniform_filter1d

    rest = np.sum((crv - local_rates(crv)) ** 2, axis=1)
    return np.sqrt(uniform_filter1d(rest, 2 * HALF_WIDTH + 1, mode="nearest"))


@numba.njit(cache=True, nogil=True)
def yaw_since_touch(Lambda, W, P, starts, dt, most):
    """Turn about the vertical on the carrying point since it touched, (w,) [rad], at the samples `starts` (w,).

    Lambda : (N, 3, 3), W : (N, 3) of a whole record; P (n, 3); the turn stays within +-most [rad], beyond which the
    point slips in spin. A point touches since it is the lowest.
    """
    out = np.zeros(len(starts))
    pivots = np.empty(Lambda.shape[0], np.int64)
    for k in range(Lambda.shape[0]):
        lowest = 1e9
        for i in range(P.shape[0]):
            z = Lambda[k, 2, 0] * P[i, 0] + Lambda[k, 2, 1] * P[i, 1] + Lambda[k, 2, 2] * P[i, 2]
            if z < lowest:
                pivots[k], lowest = i, z
    for a in range(len(starts)):
        begin = starts[a]
        while begin > 0 and pivots[begin - 1] == pivots[starts[a]]:
            begin -= 1
        for k in range(begin, starts[a]):
            rate = Lambda[k, 2, 0] * W[k, 0] + Lambda[k, 2, 1] * W[k, 1] + Lambda[k, 2, 2] * W[k, 2]
            out[a] = min(max(out[a] + rate * dt, -most), most)
    return out


@numba.njit(cache=True, nogil=True)
def plate_motion(Lambda, W, P, dt, mass, plate_mass, stiffness, damping):
    """Sinking q [m] and its rate [m/s] of a plate on a spring under the block, (N, 2), at every sample of a record.

    The block stands on its lowest point, which moves with the plate; so the plate feels -m dv_z/dt of the centre of
    mass: (M + m) q'' = -m a_z - k q - c q', a_z against the plate. masses [kg], stiffness [N/m], damping [N s/m].
    """
    n = Lambda.shape[0]
    out = np.zeros((n, 2))
    q, rate, before = 0.0, 0.0, 0.0
    fine, total = 16, mass + plate_mass
    for k in range(n):
        lowest, at = 1e9, 0
        for i in range(P.shape[0]):
            z = Lambda[k, 2, 0] * P[i, 0] + Lambda[k, 2, 1] * P[i, 1] + Lambda[k, 2, 2] * P[i, 2]
            if z < lowest:
                lowest, at = z, i
        # v_G = -omega x r, of which the vertical part is -(L (W x P))_z.
        cx = W[k, 1] * P[at, 2] - W[k, 2] * P[at, 1]
        cy = W[k, 2] * P[at, 0] - W[k, 0] * P[at, 2]
        cz = W[k, 0] * P[at, 1] - W[k, 1] * P[at, 0]
        v = -(Lambda[k, 2, 0] * cx + Lambda[k, 2, 1] * cy + Lambda[k, 2, 2] * cz)
        push = -mass * (v - before) / total if k else 0.0
        before = v
        for _ in range(fine):
            rate += push / fine - dt / fine * (stiffness * q + damping * rate) / total
            q += dt / fine * rate
        out[k, 0], out[k, 1] = q, rate
    return out


@numba.njit(cache=True, nogil=True)
def _solve3(A, b):
    d = (
        A[0, 0] * (A[1, 1] * A[2, 2] - A[1, 2] * A[2, 1])
        - A[0, 1] * (A[1, 0] * A[2, 2] - A[1, 2] * A[2, 0])
        + A[0, 2] * (A[1, 0] * A[2, 1] - A[1, 1] * A[2, 0])
    )
    out = np.empty(3)
    for k in range(3):
        B = A.copy()
        B[:, k] = b
        out[k] = (
            B[0, 0] * (B[1, 1] * B[2, 2] - B[1, 2] * B[2, 1])
            - B[0, 1] * (B[1, 0] * B[2, 2] - B[1, 2] * B[2, 0])
            + B[0, 2] * (B[1, 0] * B[2, 1] - B[1, 1] * B[2, 0])
        ) / d
    return out


@numba.njit(cache=True, nogil=True)
def _skew(r):
    return np.array([[0.0, -r[2], r[1]], [r[2], 0.0, -r[0]], [-r[1], r[0], 0.0]])


@numba.njit(cache=True, nogil=True)
def corner_starts(Lambda, W, corrections, body, P, props, upright, place, state, memory, loads):
    """Start states of B windows on the corner that carries the block, quasi-statically.

    Lambda : (B, 3, 3), W : (B, 3) reconstructed attitude and rates; corrections : (B, 5) tilt and roll [rad, body
    axes], rates [rad/s]. body (B, BODY), P (B, n, 3), props (B, n, PROPS) as in the compiled step; upright : (B, 3, 3)
    orientation and place : (B, 3) position of the standing block, which place the corner on the plate [m];
    loads : (B, 3) further acceleration that acts like gravity [m/s2]. Fills state (B, STATE) and memory (B, n, MEMORY).

    The lowest point is the pivot. The block turns rigidly about it, which gives velocity and acceleration of the
    centre of mass and the force at the pivot; penetration and anchor are set so that the springs carry this force.
    """
    for b in range(Lambda.shape[0]):
        a, c = corrections[b, 0], corrections[b, 1]
        hat = np.array([[0.0, 0.0, c], [0.0, 0.0, -a], [-c, a, 0.0]])
        L = Lambda[b] @ (np.eye(3) + hat + hat @ hat / 2)
        w_body = W[b] + corrections[b, 2:5]
        n = P.shape[1]
        pivot, lowest = 0, 1e9
        for i in range(n):
            z = L[2, 0] * P[b, i, 0] + L[2, 1] * P[b, i, 1] + L[2, 2] * (P[b, i, 2] + props[b, i, 6]) - props[b, i, 6]
            if z < lowest:
                pivot, lowest = i, z
        centre = P[b, pivot].copy()
        radius = props[b, pivot, 6]
        centre[2] += radius
        r = L @ centre
        r[2] -= radius
        mass, g = body[b, 0], body[b, 1]
        J = body[b, 2:11].copy().reshape(3, 3)
        inertia = L @ J @ L.T
        omega = L @ w_body
        R, S = _skew(r), _skew(omega)
        gravity = np.array([-loads[b, 0], -loads[b, 1], g - loads[b, 2]])
        # a_G = -(domega x r) - omega x (omega x r);  F = m (a_G + g e_z);  I domega + omega x I omega = r x F
        A = inertia - mass * (R @ R)
        Orr = S @ (S @ r)
        rhs = -(S @ (inertia @ omega)) + mass * (R @ (gravity - Orr))
        domega = _solve3(A, rhs)
        acceleration = R @ domega - Orr
        F = mass * (acceleration + gravity)
        K_N, K_T, mu = props[b, pivot, 0], props[b, pivot, 1], props[b, pivot, 5]
        xi = max(F[2], 0.0) / K_N
        size, limit = np.sqrt(F[0] ** 2 + F[1] ** 2), mu * max(F[2], 0.0)
        scale = 1.0 if size <= limit or size == 0 else limit / size
        foot = upright[b] @ P[b, pivot] + place[b]
        v = R @ omega  # the pivot is at rest: v = -omega x r = r x omega
        x0, y0 = foot[0], foot[1]
        state[b, :] = 0.0
        state[b, 0], state[b, 1], state[b, 2] = x0 - r[0], y0 - r[1], -r[2] - xi
        state[b, 3:6] = v
        for j in range(3):
            for k in range(3):
                state[b, 6 + 3 * j + k] = L[j, k]
        state[b, 15:18] = w_body
        memory[b, :, :] = 0.0
        if F[2] > 0:
            memory[b, pivot, 0] = x0 + scale * F[0] / K_T
            memory[b, pivot, 1] = y0 + scale * F[1] / K_T
            memory[b, pivot, 2] = 1.0
            memory[b, pivot, 3] = 0.0 if scale == 1.0 else 1.0


def moved_by(begun: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Corrections (B, 5), as those of `corner_starts`, that make other starts of these, but for a turn about body Z.

    Starts are attitudes (B, 3, 3) and rates (B, 3) [rad/s] that differ a little.
    """
    turned = np.einsum("bji,bjk->bik", begun[0], other[0])
    tilt, roll = (turned[:, 2, 1] - turned[:, 1, 2]) / 2, (turned[:, 0, 2] - turned[:, 2, 0]) / 2
    return np.concatenate([np.stack([tilt, roll], axis=1), other[1] - begun[1]], axis=1)


def standing_place(P, upright, x, Lambda):
    """Where the block stands when it comes upright on the point that carries it at release, (3,) [m], z = 0."""
    r = P @ Lambda.T
    pivot = int(np.argmin(r[:, 2]))
    place = x + r[pivot] - upright @ P[pivot]
    place[2] = 0.0
    return place
