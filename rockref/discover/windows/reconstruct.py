"""From a gyroscope record to what it says of the block at any instant: rates, attitude, and what follows from them."""

from __future__ import annotations

import math

import numpy as np

from rockref.discover.listening.attitude import attitudes as attitudes
from rockref.engines.on_disk import on_disk

#: Half width of the quadratic through the rates at a window's start [s]; decided: 17 ms of noise are averaged, and the
#: clatter between two corner impacts (20 to 40 ms) is still a parabola.
HALF_WIDTH = 8e-3


def smoothed_over(rate: float) -> int:
    """Samples within HALF_WIDTH of one, itself among them; a quadratic through them leaves two at least."""
    return 2 * max(2, round(HALF_WIDTH * rate)) + 1


def local_rates(crv: np.ndarray, rate: float) -> np.ndarray:
    """Rates by a quadratic through the samples within HALF_WIDTH, (N, 3) -> (N, 3); rate [Hz]: of the samples."""
    from scipy.signal import savgol_filter

    return savgol_filter(crv, smoothed_over(rate), 2, axis=0)


def roughness(crv: np.ndarray, rate: float) -> np.ndarray:
    """How far the record is from a local quadratic, (N,) [rad/s]: small in the free flights between corner impacts."""
    from scipy.ndimage import uniform_filter1d

    rest = np.sum((crv - local_rates(crv, rate)) ** 2, axis=1)
    return np.sqrt(uniform_filter1d(rest, smoothed_over(rate), mode="nearest"))


@on_disk(nogil=True)
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


@on_disk(nogil=True)
def plate_motion(Lambda, W, P, feet, dt, mass, g, bounce, pitch):
    """Motion of a plate on a spring under the block at every sample of a record, (N, 4): sinking q [m] and its rate,
    pitch phi [rad] and its rate.

    The block stands on its lowest point, which moves with the plate; so the plate feels -m dv_z/dt of the centre of
    mass there, v_z against the plate, and the weight: M q'' = -m a_z - k q - c q' and J phi'' = m g y_0 - m (g + a_z) y
    - k_p phi - c_p phi', with a_z + q'' + y phi'' in the place of a_z. feet : (n,) where each point stands, y [m];
    mass [kg]; bounce, pitch : mass or inertia of the plate, stiffness and damping; an inertia of 0: it does not pitch.
    Steps are a sixteenth of a sample, or so short that no swing of the plate runs away.
    """
    n = Lambda.shape[0]
    out = np.zeros((n, 4))
    q, rate, phi, turn, before, y_before, y_0 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    fastest = bounce[1] / bounce[0]
    if pitch[0] > 0.0:
        fastest = max(fastest, pitch[1] / pitch[0])
    fine, total = max(16, math.ceil(dt * math.sqrt(fastest))), mass + bounce[0]
    h = dt / fine
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
        y = feet[at]
        if k == 0:
            before, y_before, y_0 = v, y, y
        push = -mass * (v - before + turn * (y - y_before)) / fine
        before, y_before = v, y
        for _ in range(fine):
            force = push - h * (bounce[1] * q + bounce[2] * rate)
            if pitch[0] == 0.0:
                rate += force / total
            else:
                moment = y * push + h * (mass * g * (y_0 - y) - pitch[1] * phi - pitch[2] * turn)
                lever, inertia = mass * y, pitch[0] + mass * y * y
                det = total * inertia - lever * lever
                rate += (inertia * force - lever * moment) / det
                turn += (total * moment - lever * force) / det
            q += h * rate
            phi += h * turn
        out[k] = q, rate, phi, turn
    return out


def moved_by(begun: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Corrections (B, 5), as those of `standing_starts`, that make other starts of these, but for a turn about body Z.

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
