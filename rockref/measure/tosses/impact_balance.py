"""What tosses say without a contact model: flight arcs, and the balance of momenta over the first impact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.measure.tosses.flight import MOST, Poses, Starts, ballistic_starts, flight_frames, lowest

#: Fewest frames of an arc for its curvature, and of a flight between two impacts for its velocities (decided).
ARC, BETWEEN = 8, 4
#: Residuals beyond so many robust standard deviations are left out, in so many rounds. Decided: gross errors only; at
#: four deviations the fast spins go first, and with them what is measured (of the public tosses' centre a tenth).
OUTLIER, ROUNDS = 12.0, 4
#: Least range of P_2 over the impacts from which its slope is read (decided).
LEAST_TURN = 0.3
#: Frames at either side of a contact that are not used, since the tracker's median filter smears them.
GUARD = 1


@dataclass(frozen=True)
class Measured:
    """Values with standard errors by name, how many tosses gave them, and the scatter that is left [its unit]."""

    values: dict[str, tuple[float, float, str]]
    tosses: int
    scatter: float

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers."""
        rows = {k: {"value": float(v), "se": float(s), "unit": u} for k, (v, s, u) in self.values.items()}
        return {"values": rows, "tosses": self.tosses, "scatter": float(self.scatter)}


def flight_arcs(poses: Poses, used: np.ndarray) -> Measured:
    """Return gravity (3), drag and the centre of mass from the parabolas of the tracked point, by linear least squares.

    x_t + Lambda c = a + b t + g t^2/2 - d v t^2/2: every arc has its own a and b; g, d [1/s] and c, the centre of mass
    from the tracked point in body axes [m], are common. poses : tracked, in the frame of the throw; used : (B,) frames.
    """
    rows, right, owner = [], [], []
    for i in np.flatnonzero(used >= ARC):
        n = int(used[i])
        t = poses.t[:n]
        velocity = (poses.x[i, n - 1] - poses.x[i, 0]) / t[-1]
        A = np.zeros((n, 3, 7))
        A[:, [0, 1, 2], [0, 1, 2]] = (t * t / 2)[:, None]
        A[:, :, 3] = -np.outer(t * t / 2, velocity)
        A[:, :, 4:] = -poses.Lambda[i, :n]
        Q, _ = np.linalg.qr(np.stack([np.ones(n), t], axis=-1))
        for j in range(3):
            rows.append(A[:, j] - Q @ (Q.T @ A[:, j]))
            right.append(poses.x[i, :n, j] - Q @ (Q.T @ poses.x[i, :n, j]))
            owner += [i] * n
    if len(rows) < 9:
        return Measured({}, 0, math.nan)
    A, y = np.concatenate(rows), np.concatenate(right)
    p, se, scatter, _ = robust(A, y, np.array(owner), lost=2 * len(rows))
    names = ("g_x", "g_y", "g_z", "drag", "centre_x", "centre_y", "centre_z")
    units = ("m/s2",) * 3 + ("1/s",) + ("m",) * 3
    return Measured(
        {k: (v, s, u) for k, v, s, u in zip(names, p, se, units, strict=True)}, len(rows) // 3, float(scatter)
    )


def robust(
    A: np.ndarray, y: np.ndarray, groups: np.ndarray, lost: int = 0
) -> tuple[np.ndarray, np.ndarray, float, np.ndarray]:
    """Fit by least squares with gross errors left out: values, standard errors, scatter, which rows were kept.

    groups : number of the toss of each row; the errors of one toss hang together, so that the standard errors are those
        of whole tosses (sandwich estimator).  lost : degrees of freedom that were taken out of the rows before.
    """
    keep = np.ones(len(y), bool)
    for _ in range(ROUNDS):
        p = np.linalg.lstsq(A[keep], y[keep], rcond=None)[0]
        r = y - A @ p
        keep = np.abs(r) < OUTLIER * 1.4826 * np.median(np.abs(r[keep])) + 1e-300
    p = np.linalg.lstsq(A[keep], y[keep], rcond=None)[0]
    r = y[keep] - A[keep] @ p
    scatter = float(np.sqrt((r * r).sum() / max(keep.sum() - A.shape[1] - lost * keep.mean(), 1)))
    scores = np.zeros((int(groups.max()) + 1, A.shape[1]))
    np.add.at(scores, groups[keep], A[keep] * r[:, None])
    bread = np.linalg.pinv(A[keep].T @ A[keep])
    se = np.sqrt(np.diag(bread @ (scores.T @ scores) @ bread))
    return p, se, scatter, keep


@dataclass(frozen=True)
class Impacts:
    """States just before and after the first impact at its middle, of the tracked point or the centre of mass.

    v_before, v_after (B, 3) [m/s]; L_before, L_after (B, 3, 3) attitudes; W_before, W_after (B, 3) body rates [rad/s];
    corner (B,) number of the point that struck; r (B, 3) its place from the origin of the poses, plate axes [m];
    height (B,) of that point over the plate [m];  which (B,) numbers of the tosses.
    """

    v_before: np.ndarray
    v_after: np.ndarray
    L_before: np.ndarray
    L_after: np.ndarray
    W_before: np.ndarray
    W_after: np.ndarray
    corner: np.ndarray
    r: np.ndarray
    height: np.ndarray
    which: np.ndarray


def first_impacts(poses: Poses, P: np.ndarray, inertia: np.ndarray, g: np.ndarray, clearance: float) -> Impacts:
    """Return first impacts with one corner only and enough flight before and after; P (n, 3) from the poses' origin.

    A contact may lie between two frames: then no frame is near the plate.
    """
    low = lowest(poses.x, poses.Lambda, P)
    near = (low < clearance) & poses.measured
    due = np.zeros_like(near)
    due[:, 1:] = 2 * low[:, 1:] - low[:, :-1] < clearance
    first = flight_frames(poses, P, clearance)
    which, spans = [], []
    for i in range(len(first)):
        f, n = int(first[i]), int(poses.frames[i])
        if f >= n or not (near[i, f] or due[i, f - 1]):  # still in flight where no more frames of it are used
            continue
        end = f
        while end < n and near[i, end]:
            end += 1
        second = end
        while second < n and not near[i, second]:
            second += 1
            if second > end + 1 and due[i, second - 1]:
                break
        if f >= BETWEEN + GUARD and second - end >= BETWEEN + GUARD and end - f <= 6:
            which.append(i)
            spans.append((f, end, second - GUARD))
    if not which:
        raise_none()
    index, span = np.array(which), np.array(spans)
    before = _segment(poses, index, np.zeros(len(index), int), np.minimum(span[:, 0], MOST))
    start = span[:, 1] + GUARD - 1
    after = _segment(poses, index, start, span[:, 2] - start)
    a = ballistic_starts(before, before.frames, g, inertia)
    b = ballistic_starts(after, after.frames, g, inertia)
    from rockref.model.rotation import exponential

    dt = poses.t[1]
    t = crossing(a, b, start * dt, g)
    t = np.clip(t, (span[:, 0] - 1) * dt, span[:, 1] * dt)
    since = t - start * dt
    L1 = a.Lambda @ exponential(a.W * t[:, None])
    L2 = b.Lambda @ exponential(b.W * since[:, None])
    v1, v2 = a.v + g * t[:, None], b.v + g * since[:, None]
    # The mean of two attitudes some tenths of a degree apart is an attitude to 1e-5.
    Lambda = (L1 + L2) / 2
    corner = (Lambda[:, 2, :] @ P.T).argmin(axis=1)
    r = (Lambda @ P[corner][..., None])[..., 0]
    height = a.x[:, 2] + a.v[:, 2] * t + g[2] * t * t / 2 + r[:, 2]
    return Impacts(v1, v2, L1, L2, a.W, b.W, corner, r, height, index)


def crossing(a: Starts, b: Starts, later: np.ndarray, g: np.ndarray) -> np.ndarray:
    """Return (B,) time at which the parabola before a contact, from zero, meets the one after it, from `later` (B,)
    [s].

    That is the mean time of the impulse, weighted by the force, however the contact pushes and however long.
    """
    apart = b.x - a.x - b.v * later[:, None] + g * (later**2 / 2)[:, None]
    change = b.v - a.v - g * later[:, None]
    return -np.sum(apart * change, axis=1) / np.sum(change**2, axis=1)


def raise_none() -> None:
    """Refuse tosses without a usable impact (E-SIZE)."""
    from rockref.model.errors import InputError

    raise InputError("E-SIZE", "tosses", "none has a first impact with flight on both sides", "Give more tosses.")


def _segment(poses: Poses, index: np.ndarray, start: np.ndarray, count: np.ndarray) -> Poses:
    n = int(count.max())
    at = np.minimum(start[:, None] + np.arange(n), (start + count - 1)[:, None])
    return poses._replace(
        t=poses.t[:n], x=poses.x[index[:, None], at], Lambda=poses.Lambda[index[:, None], at], frames=count,
        v=poses.v[index], W=poses.W[index],
    )  # fmt: skip


def impulse_balance(k: Impacts) -> Measured:
    """Return principal inertias over the mass (3) [m2] from L+ J W+ - L- J W- = m r x (v+ - v-), r the corner's
    lever."""
    A = k.L_after * k.W_after[:, None] - k.L_before * k.W_before[:, None]
    y = np.cross(k.r, k.v_after - k.v_before)
    p, se, scatter, keep = robust(A.reshape(-1, 3), y.ravel(), np.repeat(np.arange(len(y)), 3))
    names = ("inertia_xx", "inertia_yy", "inertia_zz")
    rows = {k_: (v, s, "m2") for k_, v, s in zip(names, p, se, strict=True)}
    return Measured(rows, len(k.which), scatter)


def corner_shape(k: Impacts, rest: float) -> Measured:
    """Return roughly, radius of a box's corners [m] and half the time of contact [s], from the drawn corner at the
    impulse.

    A sphere of radius rho that touches the three faces from inside ends rho (s - 1) above the sharp corner, s the sum
    of the slopes |L_zx| + |L_zy| + |L_zz|: 1.7 on a tip, 1 on a face. The parabola before the contact, drawn on to the
    mean time of the impulse, is deeper by the way of the corner in half the contact: height = rest - rho (s - 1) -
    tau u. rest : height of the drawn corners of a body that lies flat [m].

    A first guess, no measurement: on a tip the corner's effective mass is larger too, so that tau grows with s; radii
    of made tosses come out 2 mm wrong either way. Their sum at a corner, how deep the drawn corner is, holds.
    """
    s = np.sum(np.abs(k.L_before[:, 2] + k.L_after[:, 2]) / 2, axis=1)
    u = k.v_before + np.cross((k.L_before @ k.W_before[..., None])[..., 0], k.r)
    p, se, scatter, keep = robust(np.stack([1 - s, u[:, 2]], axis=1), k.height - rest, np.arange(len(s)))
    names = (("radius", "m"), ("half_contact_time", "s"))
    return Measured({n: (v, e, unit) for (n, unit), v, e in zip(names, p, se, strict=True)}, int(keep.sum()), scatter)


def corner_ratios(k: Impacts) -> Measured:
    """Return tangential over normal impulse where the corner keeps sliding, and restitution of the corner's normal
    speed.

    The restitution is that of the drawn corner: the median, and, where they differ, that of a corner of a face and that
    of a tip, linear in P_2 of the angle between the vertical and the corner's diagonal (0 and 1 on a cube).
    """
    dv = k.v_after - k.v_before
    u1 = k.v_before + np.cross((k.L_before @ k.W_before[..., None])[..., 0], k.r)
    u2 = k.v_after + np.cross((k.L_after @ k.W_after[..., None])[..., 0], k.r)
    ratio = np.hypot(dv[:, 0], dv[:, 1]) / dv[:, 2]
    speed = np.hypot(u2[:, 0], u2[:, 1])
    along = np.sum(u1[:, :2] * u2[:, :2], axis=1) / np.maximum(np.hypot(u1[:, 0], u1[:, 1]) * speed, 1e-9)
    # The corner slid throughout where it still moves the same way: within 30 degrees, faster than 0.2 m/s (decided).
    slid = (speed > 0.2) & (along > np.cos(np.pi / 6))
    restitution = -u2[:, 2] / u1[:, 2]
    values = {}
    for name, a in (("friction", ratio[slid]), ("restitution", restitution)):
        if len(a) > 4:
            spread = 1.4826 * np.median(np.abs(a - np.median(a)))
            values[name] = (float(np.median(a)), float(1.2533 * spread / np.sqrt(len(a))), "1")
    squares = np.sum(k.r**2, axis=1)
    tip = np.maximum(1.5 * k.r[:, 2] ** 2 / np.where(squares > 0, squares, 1.0) - 0.5, 0.0)
    if len(tip) > 4 and np.ptp(tip) > LEAST_TURN:
        p, se, _, _ = robust(np.stack([1 - tip, tip], axis=1), restitution, np.arange(len(tip)))
        for name, v, s in zip(("restitution_on_a_face", "restitution_on_a_tip"), p, se, strict=True):
            values[name] = (float(v), float(s), "1")
    return Measured(values, int(slid.sum()), float(np.std(ratio[slid])) if slid.any() else math.nan)


def energy_change(k: Impacts, inertia_over_mass: np.ndarray) -> np.ndarray:
    """Return (B,) kinetic energy after over before, less one, with principal inertias over the mass (3) [m2]."""
    before = np.sum(k.v_before**2, axis=1) + np.sum(inertia_over_mass * k.W_before**2, axis=1)
    after = np.sum(k.v_after**2, axis=1) + np.sum(inertia_over_mass * k.W_after**2, axis=1)
    return after / before - 1
