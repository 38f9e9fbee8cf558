"""One contact point: where it is, how hard the plate pushes back, and friction with radial return.

Every array has the contact points in its second-last axis (vectors) or last axis (scalars): u (..., n, 3), xi (..., n).
Tangential vectors have two components, x and y of the plate. Source: "Contact non-linearities", (3.5) and (3.6).
"""

from typing import NamedTuple

import numpy as np

from rockref.model.rotation import apply, apply_to_points, cross

PRECISIONS = (np.float32, np.float64, np.longdouble)
#: Zero in each precision, as an array: NumPy meets it twice as fast as Python's.
ZERO = {np.dtype(real): np.zeros((), real) for real in PRECISIONS}
#: Sums of two squares above it are rounded like any other number, in each precision.
LEAST_SQUARE = {np.dtype(real): np.array(np.finfo(real).tiny / np.finfo(real).eps) for real in PRECISIONS}


class Kinematics(NamedTuple):
    """Where the n points are and how they move, relative to the plate: r, u, u_rate (..., n, 3); xi, xi_rate (..., n);
    v_slide (..., n, 2)."""

    r: np.ndarray
    u: np.ndarray
    u_rate: np.ndarray
    xi: np.ndarray
    xi_rate: np.ndarray
    v_slide: np.ndarray


def point_kinematics(x, Lambda, v, W, P, radius=None, plate=None) -> Kinematics:
    """Rule K1: position u, penetration xi = -z, its rate -v_z and sliding velocity (x, y) of every contact point.

    Parameters
    ----------
    x, v : (..., 3) position [m] and velocity [m/s] of the centre of mass, plate axes.
    Lambda : (..., 3, 3) rotation, body to plate.  W : (..., 3) angular velocity in body axes [rad/s].
    P : (..., n, 3) contact points in body axes [m].
    radius : (..., n) foot radius [m], or None for the point feet of the source. A round foot is a sphere centred
        `radius` above its point on the body axis; the contact point is the lowest point of the sphere.
    plate : None for the fixed plate of the source, or its displacement and velocity, two (..., 3) [m, m/s], and, where
        it turns, its small turn about the origin and the rate of that, two (..., 3) [rad, rad/s].

    Returns
    -------
    Kinematics
        with the lever arm r from the centre of mass, in plate axes.

    Source: "Contact non-linearities" (penetration, its rate, sliding velocity of each node).
    """
    if radius is None:
        r = apply_to_points(Lambda, P)
    else:
        centre = P.copy(order="K")
        centre[..., 2] += radius
        r = apply_to_points(Lambda, centre)
        r[..., 2] -= radius
    omega = apply(Lambda, W)
    u = x[..., None, :] + r
    u_rate = v[..., None, :] + cross(omega[..., None, :], r)
    if plate is not None:
        u = u - plate[0][..., None, :]
        u_rate = u_rate - plate[1][..., None, :]
        if len(plate) > 2:
            rise, rise_rate = lifted(plate[2], u), lifted(plate[3], u)
            u[..., 2] -= rise
            u_rate[..., 2] -= rise_rate
    return Kinematics(r, u, u_rate, -u[..., 2], -u_rate[..., 2], u_rate[..., :2])


def lifted(turn: np.ndarray, u: np.ndarray) -> np.ndarray:
    """Return how far a small turn (..., 3) [rad] about the origin lifts the plate under points u (..., n, 3), (..., n)
    [m].

    A rate of turn [rad/s] gives the speed [m/s]. Its slope under a sliding point, some microradians, is left out.
    """
    return turn[..., None, 0] * u[..., 1] - turn[..., None, 1] * u[..., 0]


def kelvin_voigt(xi: np.ndarray, xi_rate: np.ndarray, K_N: np.ndarray, C_N: np.ndarray) -> np.ndarray:
    """Rule N1: Kelvin-Voigt normal force without tension [N], for xi >= 0. All (..., n). Source: (3.5a).

    The excerpt has lost the sign of relation in "if xi 0"; xi >= 0 is what (3.5b), xi < 0, leaves.
    """
    F = K_N * xi + C_N * xi_rate
    return np.maximum(F, ZERO[F.dtype])  # (3.5a)


def altered_normal_force(k: Kinematics, points, effects) -> np.ndarray:
    """Apply rules N1 and N2 with effects: they change spring and damper before the no-tension cut, which is made once,
    last.

    effects : pairs of effect and memory  ->  (..., n) [N]. Without a change the bits are those of `kelvin_voigt`.
    """
    F = points.K_N * k.xi + points.C_N * k.xi_rate
    for effect, m in effects:
        F = effect.normal_force(F, k, points, m)
    return open_gap(k.xi, np.maximum(F, 0))


def open_gap(xi: np.ndarray, F_N: np.ndarray) -> np.ndarray:
    """Rule N2: no normal force [N] where the point is above the plate, xi [m] < 0. All (..., n). Source: (3.5b)."""
    return F_N * (xi >= ZERO[xi.dtype])  # (3.5b)


def touch(xi: np.ndarray, u_t: np.ndarray, s: np.ndarray, had_anchor: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rule T5: a point above the plate has no anchor; one that touches gets its anchor where it is.

    Parameters
    ----------
    xi : (..., n) penetration [m].  u_t : (..., n, 2) position in the plate [m].
    s : (..., n, 2) anchor of the last step [m].  had_anchor : (..., n) bool, whether it is valid.

    Returns
    -------
    s : (..., n, 2) anchor for the trial.  touching : (..., n) bool.

    Decided (the source is silent): the anchor dies with the contact and is born at the next touching point.
    """
    touching = xi >= ZERO[xi.dtype]
    keep = touching & had_anchor
    return np.where(keep[..., None], s, u_t), touching


def trial_force(u_t: np.ndarray, s: np.ndarray, v_slide: np.ndarray, K_T: np.ndarray, C_T: np.ndarray) -> np.ndarray:
    """Rule T1: trial friction force of sticking [N], (..., n, 2): spring to the anchor s, and damper."""
    return K_T[..., None] * (s - u_t) - C_T[..., None] * v_slide  # "a trial friction force", before (3.6)


def threshold(F_N: np.ndarray, was_sliding: np.ndarray, mu_0: np.ndarray, mu: np.ndarray) -> np.ndarray:
    """Rule T6: the Coulomb threshold [N]: mu_0 F_N for a point that was sticking, mu F_N for one that was sliding.

    All (..., n). Decided: the source has mu_0 = mu in Table 3.1 and does not say which one ends a slide.
    """
    return np.where(was_sliding, mu, mu_0) * F_N  # (3.6)


def norm(F: np.ndarray) -> np.ndarray:
    """Return length of plane vectors, (..., n, 2) -> (..., n).

    Where the sum of squares leaves the normal numbers the larger component is taken out first: otherwise a force of
    1e-170 N has length zero and passes the test of the cone although it is outside.
    """
    squares = F * F
    squares = squares[..., 0] + squares[..., 1]
    small = squares < LEAST_SQUARE[F.dtype]
    size = np.sqrt(squares)
    if np.count_nonzero(small):
        x, y = F[..., 0], F[..., 1]
        largest = np.maximum(np.abs(x), np.abs(y))
        unit = np.where(largest > 0, largest, 1)
        size = np.where(small, largest * np.sqrt((x / unit) * (x / unit) + (y / unit) * (y / unit)), size)
    return size


def sticks(size: np.ndarray, limit: np.ndarray) -> np.ndarray:
    """Rule T2: sticking holds while the trial force, of this size, is inside the cone. All (..., n). Source: (3.6a).

    The excerpt prints "if v_slide = 0: F_T > mu_0 F_N"; it is read as the limit up to which a point sticks, as the text
    has it: a point slides "if this trial force exceeds Coulomb's sliding threshold".
    """
    return size <= limit  # (3.6a)


def radial_return(F_trial: np.ndarray, size: np.ndarray, stick: np.ndarray, mu_F_N: np.ndarray) -> np.ndarray:
    """Rule T3: friction force [N], (..., n, 2): the trial force where it sticks, else mu F_N along the trial force.

    `size` is the length of the trial force and `mu_F_N` the sliding force, both (..., n). A point above the plate has
    F_N = 0 and so no friction. Source: (3.6b).

    The excerpt prints (3.6b) along the sliding velocity, -mu F_N v_slide / |v_slide|, and says that it is computed by
    "a similar radial return mapping", which shortens the trial force. Decided: the return is the law; in an established
    slide both point the same way, and where a slide begins or turns they differ.
    """
    one = stick.astype(size.dtype)
    scale = np.divide(mu_F_N, size, out=one, where=~stick)
    return scale[..., None] * F_trial  # (3.6b)


def move_anchor(
    F_T: np.ndarray,
    u_t: np.ndarray,
    s: np.ndarray,
    v_slide: np.ndarray,
    stick: np.ndarray,
    K_T: np.ndarray,
    C_T: np.ndarray,
) -> np.ndarray:
    """Rule T4: after sliding the anchor moves so that -K_T (u - s) - C_T v_slide = F_T; sticking leaves it alone.

    F_T, u_t, s, v_slide : (..., n, 2); stick, K_T, C_T : (..., n)  ->  s (..., n, 2) [m].
    Source: "both the friction force amplitude and the contact point position are updated".
    """
    slid = u_t + (F_T + C_T[..., None] * v_slide) / K_T[..., None]
    return np.where(stick[..., None], s, slid)


def share_of_first(xi: np.ndarray, xi_rate: np.ndarray, h: float) -> np.ndarray:
    """Return the factor (..., n) on the first force of a contact, in the step of h [s] in which it begins; else 1.

    A damped foot that touches is pushed with C_N xi_rate at once (3.5a). The step gives such a force the weight h/2
    there, and h/2 in the next one (rules I4, I5), whenever in the step it began: the speed after an impact then depends
    on where the steps fall, by a part of the order h. The point came down the way h xi_rate in this step, and xi of it
    in contact: with the weight h xi / (h xi_rate) there, what is left is of the order h^2.
    """
    way = h * xi_rate
    begins = (xi >= ZERO[xi.dtype]) & (xi < way)
    one = np.ones_like(xi)
    return np.where(begins, 0.5 + xi / np.where(begins, way, one), one)


def roll_anchor(s: np.ndarray, radius: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """Round feet only: the anchor rolls along, so that u - s follows the material velocity at the contact.

    The lowest point of a sphere that turns by `turn` (..., 3) [rad, plate axes] moves by radius * turn x e_z more
    than the material there. s : (..., n, 2) [m]; radius : (..., n) [m]. Zero radius leaves s as it is.
    """
    rolled = s.copy(order="K")
    rolled[..., 0] += radius * turn[..., None, 1]
    rolled[..., 1] -= radius * turn[..., None, 0]
    return rolled
