"""Three-vectors and finite rotations, in `+ - x /` only, so that every machine gives the same bits.

Shapes carry leading batch axes. NumPy's `@`, `sin` and `cos` are not used on purpose: their last bit depends on
the processor and on the linear-algebra library. The sums below do not: `add.reduce` adds fewer than eight numbers one
by one, in their order, wherever they lie in memory (a test holds it to the written-out sums).
"""

import numpy as np

from rockref.model.errors import InputError

#: Up to this squared angle [rad^2] the short series of `exp_minus_identity` is used. With |Theta|^2 <= 1e-4 its first
#: dropped terms are 1e-16 / 9! = 3e-22 and 1e-16 / 10! = 3e-23, below the rounding of float64 and of longdouble.
SHORT_SERIES_ANGLE_SQUARED = 1e-4

#: Terms of the long series, for angles up to 3.2 rad: (3.2^2)^18 / 37! = 1e-25 is the first dropped term.
LONG_SERIES_TERMS = 18

#: 1 / ((2k)(2k+1)) and 1 / ((2k+1)(2k+2)) for k = 1, 2, .., in each precision: the series then needs no division.
#: Python's own number is that of float64.
RECIPROCALS = {
    real: [(1 / real(2 * k * (2 * k + 1)), 1 / real((2 * k + 1) * (2 * k + 2))) for k in range(1, LONG_SERIES_TERMS)]
    for real in (float, np.float32, np.float64, np.longdouble)
}


def empty(batch: tuple[int, ...], core: tuple[int, ...], dtype) -> np.ndarray:
    """Return new array of shape `batch + core` whose batch axes vary fastest in memory.

    NumPy runs its inner loop along the axis that is contiguous; for a thousand blocks that must be the batch,
    not the three components. One block (no batch axes) gets an ordinary array.
    """
    if not batch:
        return np.empty(core, dtype)
    axes = tuple(range(len(core), len(core) + len(batch))) + tuple(range(len(core)))
    return np.empty(core + batch, dtype).transpose(axes)


def components(a: np.ndarray):
    """Return the components of three-vectors, to be unpacked: (..., 3) -> three views (...).

    Of a single vector they are numbers, with which NumPy works four times faster than with arrays of no axes.
    """
    return a if a.ndim == 1 else (a[..., 0], a[..., 1], a[..., 2])


def plain_components(a: np.ndarray):
    """Return the same; of a single vector in float64 Python's numbers, which have its bits and are three times faster
    again.

    For sums and products only: Python raises where it divides by zero.
    """
    return a.tolist() if a.ndim == 1 and a.dtype == np.float64 else components(a)


def somewhere(mask) -> bool:
    """Return whether a truth, or any of an array of them, holds."""
    return bool(np.count_nonzero(mask)) if isinstance(mask, np.ndarray) else bool(mask)


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return scalar product of three-vectors, (..., 3), (..., 3) -> (...), summed left to right."""
    a_x, a_y, a_z = components(a)
    b_x, b_y, b_z = components(b)
    return a_x * b_x + a_y * b_y + a_z * b_z


#: y z x and z x y: the components that multiply each other in a vector product.
NEXT, NEXT_BUT_ONE = np.array([1, 2, 0]), np.array([2, 0, 1])


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return vector product of three-vectors, (..., 3); the smaller of the two is broadcast over the other.

    Of two single vectors in plain numbers. Of more, where the components lie side by side in memory, as those of one
    block do, all three at once, in half the time; where the batch does, one after the other, so that it stays the
    fastest axis. The bits are the same.
    """
    if a.ndim == b.ndim == 1:
        a_x, a_y, a_z = plain_components(a)
        b_x, b_y, b_z = plain_components(b)
        return np.array((a_y * b_z - a_z * b_y, a_z * b_x - a_x * b_z, a_x * b_y - a_y * b_x))
    if a.flags.c_contiguous and b.flags.c_contiguous:
        return a.take(NEXT, -1) * b.take(NEXT_BUT_ONE, -1) - a.take(NEXT_BUT_ONE, -1) * b.take(NEXT, -1)
    a_x, a_y, a_z = components(a)
    b_x, b_y, b_z = components(b)
    c = np.empty_like(a if a.size >= b.size > 0 else b)
    c[..., 0] = a_y * b_z - a_z * b_y
    c[..., 1] = a_z * b_x - a_x * b_z
    c[..., 2] = a_x * b_y - a_y * b_x
    return c


#: Numbers from which vectors are turned a component at a time (decided: below it that takes longer).
MANY = 1000


def apply(A: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Return matrix times vector, (..., 3, 3), (..., 3) -> (..., 3), summed left to right.

    Of one matrix and many vectors a component at a time: the same bits, in a fifth of the time.
    """
    if A.ndim == 2 and a.size >= MANY:
        a_x, a_y, a_z = components(a)
        return np.stack([A_x * a_x + A_y * a_y + A_z * a_z for A_x, A_y, A_z in A], axis=-1)
    return np.add.reduce(A * a[..., None, :], axis=-1)


def apply_transposed(A: np.ndarray, a: np.ndarray) -> np.ndarray:
    """Return transposed matrix times vector, (..., 3, 3), (..., 3) -> (..., 3), summed left to right."""
    return np.add.reduce(A * a[..., None], axis=-2)


def apply_to_points(A: np.ndarray, P: np.ndarray) -> np.ndarray:
    """Return matrix times each of n vectors, (..., 3, 3), (..., n, 3) -> (..., n, 3), summed left to right."""
    return np.add.reduce(A[..., None, :, :] * P[..., None, :], axis=-1)


def product(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return matrix product, (..., 3, 3), (..., 3, 3) -> (..., 3, 3), summed left to right."""
    return np.add.reduce(A[..., None] * B[..., None, :, :], axis=-2)


def transposed(A: np.ndarray) -> np.ndarray:
    """Return the transposed matrix, (..., 3, 3)."""
    return A.swapaxes(-1, -2)


def inverse(A: np.ndarray) -> np.ndarray:
    """Return inverse of a regular 3x3 matrix by its cofactors, (..., 3, 3)."""
    cofactors = np.stack(
        [cross(A[..., 1, :], A[..., 2, :]), cross(A[..., 2, :], A[..., 0, :]), cross(A[..., 0, :], A[..., 1, :])],
        axis=-2,
    )
    determinant = dot(A[..., 0, :], cofactors[..., 0, :])
    return transposed(cofactors) / determinant[..., None, None]


def hat(a: np.ndarray) -> np.ndarray:
    """Return the skew matrix with hat(a) b = a x b, (..., 3) -> (..., 3, 3)."""
    a_x, a_y, a_z = a[..., 0], a[..., 1], a[..., 2]
    H = empty(a.shape[:-1], (3, 3), a.dtype)
    H[..., 0, 0], H[..., 0, 1], H[..., 0, 2] = 0, -a_z, a_y
    H[..., 1, 0], H[..., 1, 1], H[..., 1, 2] = a_z, 0, -a_x
    H[..., 2, 0], H[..., 2, 1], H[..., 2, 2] = -a_y, a_x, 0
    return H


def series_coefficients(t, terms: int) -> tuple:
    """Return sin(theta)/theta and (1 - cos(theta))/theta^2 as power series in t = theta^2, by Horner's rule.

    t : (...) array, or one number of NumPy's or Python's.

    sum_k (-t)^k / (2k+1)!  and  sum_k (-t)^k / (2k+2)!,  k = 0 .. terms-1.
    """
    real = t.dtype.type if hasattr(t, "dtype") else float
    s = c = real(1)
    for r_s, r_c in RECIPROCALS[real][terms - 2 :: -1]:
        s = 1 - t * s * r_s
        c = 1 - t * c * r_c
    return s, c / 2


def exp_minus_identity(Theta: np.ndarray) -> np.ndarray:
    """Return exp(hat(Theta)) - I by Rodrigues' formula, (..., 3) [rad] -> (..., 3, 3).

    The identity is left out because a step turns the block by some 1e-5 rad: added to I, the increment would lose
    five digits to rounding, and, with a constant rate, the same digits in every step. Angles up to pi.

    Raises
    ------
    InputError
        E-ANGLE, where |Theta| is above 3.2 rad: no step may turn the block that far.

    Source: O. Rodrigues (1840); in this form Simo & Wong (1991), Int. J. Numer. Methods Eng. 31:19-52.
    """
    x, y, z = plain_components(Theta)
    t = x * x + y * y + z * z
    s, c = series_coefficients(t, 4)
    if somewhere(t > SHORT_SERIES_ANGLE_SQUARED):
        if somewhere(t > 10.24):
            raise InputError(
                "E-ANGLE",
                "Theta",
                f"a step turns the block by {float(np.sqrt(np.max(t))):.3g} rad",
                "Use a smaller step or a smaller angular velocity.",
            )
        s_long, c_long = series_coefficients(t, LONG_SERIES_TERMS)
        s = np.where(t > SHORT_SERIES_ANGLE_SQUARED, s_long, s)
        c = np.where(t > SHORT_SERIES_ANGLE_SQUARED, c_long, c)
    # s hat(Theta) + c hat(Theta)^2, written out.
    sx, sy, sz = s * x, s * y, s * z
    xy, xz, yz = c * (x * y), c * (x * z), c * (y * z)
    E = empty(Theta.shape[:-1], (3, 3), Theta.dtype)
    E[..., 0, 0], E[..., 0, 1], E[..., 0, 2] = -c * (z * z + y * y), xy - sz, xz + sy
    E[..., 1, 0], E[..., 1, 1], E[..., 1, 2] = xy + sz, -c * (z * z + x * x), yz - sx
    E[..., 2, 0], E[..., 2, 1], E[..., 2, 2] = xz - sy, yz + sx, -c * (y * y + x * x)
    return E


def exponential(Theta: np.ndarray) -> np.ndarray:
    """Return rotation matrix exp(hat(Theta)), (..., 3) [rad] -> (..., 3, 3)."""
    return exp_minus_identity(Theta) + np.eye(3, dtype=Theta.dtype)


def logarithm(Lambda: np.ndarray) -> np.ndarray:
    """Return rotation vector of a rotation matrix, (..., 3, 3) -> (..., 3) [rad], |result| <= pi.

    For output and for comparisons, not for the step: it uses arctan2. Via the unit quaternion, whose largest
    component is taken first (Shepperd 1978, J. Guid. Control 1:223-224), so that no angle loses digits.
    """
    q = quaternion(Lambda)
    vector = q[..., 1:]
    size = np.sqrt(dot(vector, vector))
    safe = np.where(size > 0, size, 1)
    return np.where(size > 0, 2 * np.arctan2(size, q[..., 0]) / safe, 2)[..., None] * vector


def quaternion(Lambda: np.ndarray) -> np.ndarray:
    """Return unit quaternion (w, x, y, z), w >= 0, of a rotation matrix, (..., 3, 3) -> (..., 4)."""
    L = Lambda
    xx, yy, zz = L[..., 0, 0], L[..., 1, 1], L[..., 2, 2]
    ww, xx, yy, zz = 1 + xx + yy + zz, 1 + xx - yy - zz, 1 - xx + yy - zz, 1 - xx - yy + zz
    wx, wy, wz = L[..., 2, 1] - L[..., 1, 2], L[..., 0, 2] - L[..., 2, 0], L[..., 1, 0] - L[..., 0, 1]
    xy, xz, yz = L[..., 0, 1] + L[..., 1, 0], L[..., 0, 2] + L[..., 2, 0], L[..., 1, 2] + L[..., 2, 1]
    # Each row, and each column, is a multiple of q; that of the largest component loses no digits.
    rows = (ww, wx, wy, wz), (wx, xx, xy, xz), (wy, xy, yy, yz), (wz, xz, yz, zz)
    largest = np.argmax(np.stack([ww, xx, yy, zz], axis=-1), axis=-1)
    q = np.stack([np.choose(largest, row) for row in rows], axis=-1)
    q = q / np.sqrt(q[..., 0:1] ** 2 + q[..., 1:2] ** 2 + q[..., 2:3] ** 2 + q[..., 3:4] ** 2)
    return np.where(q[..., 0:1] < 0, -q, q)


def from_quaternion(q: np.ndarray) -> np.ndarray:
    """Return rotation matrix of a quaternion (w, x, y, z) of any length, (..., 4) -> (..., 3, 3)."""
    w, x, y, z = q[..., 0], q[..., 1], q[..., 2], q[..., 3]
    n = w * w + x * x + y * y + z * z
    L = np.empty(q.shape[:-1] + (3, 3), q.dtype)
    L[..., 0, 0], L[..., 0, 1], L[..., 0, 2] = (
        1 - 2 * (y * y + z * z) / n,
        2 * (x * y - w * z) / n,
        2 * (x * z + w * y) / n,
    )
    L[..., 1, 0], L[..., 1, 1], L[..., 1, 2] = (
        2 * (x * y + w * z) / n,
        1 - 2 * (x * x + z * z) / n,
        2 * (y * z - w * x) / n,
    )
    L[..., 2, 0], L[..., 2, 1], L[..., 2, 2] = (
        2 * (x * z - w * y) / n,
        2 * (y * z + w * x) / n,
        1 - 2 * (x * x + y * y) / n,
    )
    return L
