"""The law once more, number by number: the route by which the expected values are computed.

Written from the text of the rules and independent of `rockref.model`. Vectors are lists of three numbers, matrices
lists of three rows, and a number may be anything that knows + - * / and comparison: mpmath's with fifty digits,
`numpy.longdouble`, `fractions.Fraction`, plain floats, floats that round at random. Only roots and the circular
functions need a
helper `m` with `sqrt`, `hypot`, `sin`, `cos`. Slow on purpose: nothing is rearranged, no series is truncated.
"""

from __future__ import annotations

from typing import Any, NamedTuple

Number = Any
Vector = list
Matrix = list


def dot(a: Vector, b: Vector) -> Number:
    """Return scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Return vector product."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def apply(A: Matrix, b: Vector) -> Vector:
    """Return matrix times vector."""
    return [dot(row, b) for row in A]


def transposed(A: Matrix) -> Matrix:
    """Return the transposed matrix."""
    return [list(column) for column in zip(*A, strict=True)]


def product(A: Matrix, B: Matrix) -> Matrix:
    """Return matrix product."""
    columns = transposed(B)
    return [[dot(row, column) for column in columns] for row in A]


def solve(A: Matrix, b: Vector) -> Vector:
    """Return x with A x = b, by Cramer's rule; exact for a diagonal matrix up to one division."""
    if not any(A[i][j] for i in range(3) for j in range(3) if i != j):
        return [b[i] / A[i][i] for i in range(3)]
    c = [cross(A[1], A[2]), cross(A[2], A[0]), cross(A[0], A[1])]
    determinant = dot(A[0], c[0])
    return [(c[0][i] * b[0] + c[1][i] * b[1] + c[2][i] * b[2]) / determinant for i in range(3)]


# -- G and P: what follows from the parameters ---------------------------------------------------------------------


def cuboid_inertia(mass: Number, width: Number, depth: Number, height: Number) -> Matrix:
    """Apply G1: uniform cuboid about its centre, sides along X, Y, Z."""
    zero = mass - mass
    J = [zero, zero, zero]
    J[0] = mass * (depth * depth + height * height) / 12
    J[1] = mass * (width * width + height * height) / 12
    J[2] = mass * (width * width + depth * depth) / 12
    return [[J[0], zero, zero], [zero, J[1], zero], [zero, zero, J[2]]]


def contact_points(
    width: Number, depth: Number, height: Number, delta_long: list, delta_diag: Number, m
) -> list[Vector]:
    """Apply G2: 1ext..4ext at the corners, raised by delta_long; 1int..4int on the diagonals, delta_diag from the
    corner."""
    half = m.sqrt(width * width + depth * depth) / 2
    external, internal = [], []
    for (sign_x, sign_y), raised in zip(((1, 1), (-1, 1), (-1, -1), (1, -1)), delta_long, strict=True):
        corner = [sign_x * width / 2, sign_y * depth / 2]
        external.append([corner[0], corner[1], raised - height / 2])
        internal.append([corner[0] * (half - delta_diag) / half, corner[1] * (half - delta_diag) / half, -height / 2])
    return external + internal


def damping(beta: Number, K: Number, mass: Number, m) -> Number:
    """Apply P2: C = 2 beta sqrt(K m)."""
    return 2 * beta * m.sqrt(K * mass)  # (3.8)


def properties(mass, K_N, K_T, beta_int, beta_ext, mu_int, mu_ext, m) -> dict[str, list]:
    """Apply P1 to P3: K_N, K_T, C_N, C_T, mu_0, mu of the eight points, external ones first."""
    beta = 4 * [beta_ext] + 4 * [beta_int]
    mu = 4 * [mu_ext] + 4 * [mu_int]
    return {
        "K_N": 8 * [K_N],  # (3.7)
        "K_T": 8 * [K_T],  # (3.7)
        "C_N": [damping(b, K_N, mass, m) for b in beta],
        "C_T": [damping(b, K_T, mass, m) for b in beta],  # (3.9)
        "mu_0": mu,
        "mu": list(mu),
    }


# -- K, N, T: one contact point ------------------------------------------------------------------------------------


class Motion(NamedTuple):
    """K1 of one point: lever arm r, place u, penetration xi, its rate, sliding velocity."""

    r: Vector
    u: Vector
    xi: Number
    xi_rate: Number
    v_slide: list


def kinematics(x: Vector, Lambda: Matrix, v: Vector, W: Vector, P: Vector) -> Motion:
    """Apply K1: place and velocity of one body point; penetration is counted downwards from the plate."""
    r = apply(Lambda, P)
    turning = cross(apply(Lambda, W), r)
    u = [x[i] + r[i] for i in range(3)]
    velocity = [v[i] + turning[i] for i in range(3)]
    return Motion(r, u, -u[2], -velocity[2], velocity[:2])


class Point(NamedTuple):
    """What one contact point is made of."""

    K_N: Number
    C_N: Number
    K_T: Number
    C_T: Number
    mu_0: Number
    mu: Number


class Touch(NamedTuple):
    """What one contact point does: F_N, F_T, anchor s after the step, flags; s_trial, F_trial, threshold on the way."""

    F_N: Number
    F_T: list
    s: list
    touching: bool
    sliding: bool
    s_trial: list
    F_trial: list
    threshold: Number


def contact(xi, xi_rate, u_t, v_slide, s, anchored: bool, sliding: bool, point: Point, m) -> Touch:
    """Apply N1, N2, T1 to T6 for one point. u_t, v_slide, s are plane vectors."""
    zero = xi - xi
    if xi < 0:  # N2 (3.5b) and T5
        return Touch(zero, [zero, zero], list(u_t), False, False, list(u_t), [zero, zero], zero)
    F_N = point.K_N * xi + point.C_N * xi_rate  # N1 (3.5a)
    if F_N < 0:
        F_N = zero
    if not anchored:  # T5
        s, sliding = list(u_t), False
    F_trial = [-point.K_T * (u_t[i] - s[i]) - point.C_T * v_slide[i] for i in range(2)]  # T1
    size = m.hypot(F_trial[0], F_trial[1])
    threshold = (point.mu if sliding else point.mu_0) * F_N  # T6
    if size <= threshold:  # T2 (3.6a)
        return Touch(F_N, F_trial, list(s), True, False, list(s), F_trial, threshold)
    F_T = [point.mu * F_N * F_trial[i] / size for i in range(2)]  # T3 (3.6b)
    moved = [u_t[i] + (F_T[i] + point.C_T * v_slide[i]) / point.K_T for i in range(2)]  # T4
    return Touch(F_N, F_T, moved, True, True, list(s), F_trial, threshold)


# -- A: force and moment on the body -------------------------------------------------------------------------------


def resultants(Lambda: Matrix, r: list[Vector], F: list[Vector], mass: Number, g: Number):
    """Apply A1 to A3: force (plate axes, with the weight), moment about the centre of mass (plate axes), the same in
    body axes."""
    zero = mass - mass
    force, moment = [zero, zero, -mass * g], [zero, zero, zero]
    for lever, f in zip(r, F, strict=True):
        arm = cross(lever, f)
        force = [force[i] + f[i] for i in range(3)]
        moment = [moment[i] + arm[i] for i in range(3)]
    return force, moment, apply(transposed(Lambda), moment)


# -- I: the step ---------------------------------------------------------------------------------------------------


def exponential_minus_identity(Theta: Vector, m) -> Matrix:
    """Return exp(Theta^) - I, Rodrigues: sin(q)/q Theta^ + 2 sin(q/2)^2/q^2 Theta^ Theta^, q = |Theta|."""
    zero = Theta[0] - Theta[0]
    H = [[zero, -Theta[2], Theta[1]], [Theta[2], zero, -Theta[0]], [-Theta[1], Theta[0], zero]]
    square = dot(Theta, Theta)
    if not square:
        return H
    q = m.sqrt(square)
    first, second = m.sin(q) / q, 2 * m.sin(q / 2) * m.sin(q / 2) / square
    HH = product(H, H)
    return [[first * H[i][j] + second * HH[i][j] for j in range(3)] for i in range(3)]


def exponential(Theta: Vector, m) -> Matrix:
    """Return exp(Theta^)."""
    E = exponential_minus_identity(Theta, m)
    return [[E[i][j] + (1 if i == j else 0) for j in range(3)] for i in range(3)]


class Half(NamedTuple):
    """The step up to the force evaluation: I1 x, I2 Theta, I3 Lambda, the predicted velocities; E = exp - I, JW
    kept."""

    x: Vector
    Theta: Vector
    Lambda: Matrix
    v_predicted: Vector
    W_predicted: Vector
    E: Matrix
    JW: Vector


def first_half(x, v, Lambda, W, a, T, h, J: Matrix, m) -> Half:
    """Apply I1 to I3, and the velocities with which the contact forces at n+1 are evaluated."""
    JW = apply(J, W)
    gyroscopic = cross(W, JW)
    A = solve(J, [T[i] - gyroscopic[i] for i in range(3)])
    x_next = [x[i] + h * v[i] + h * h * a[i] / 2 for i in range(3)]  # I1
    Theta = [h * W[i] + h * h * A[i] / 2 for i in range(3)]  # I2
    E = exponential_minus_identity(Theta, m)
    turn = product(Lambda, E)
    Lambda_next = [[Lambda[i][j] + turn[i][j] for j in range(3)] for i in range(3)]  # I3
    v_predicted = [v[i] + h * a[i] for i in range(3)]
    W_predicted = [W[i] + h * A[i] for i in range(3)]
    return Half(x_next, Theta, Lambda_next, v_predicted, W_predicted, E, JW)


def second_half(v, a, T, a_next, T_next, h, J: Matrix, half: Half):
    """Apply I4 and I5: v and W at n+1."""
    v_next = [v[i] + h * (a[i] + a_next[i]) / 2 for i in range(3)]  # I4
    momentum = [half.JW[i] + h * T[i] / 2 for i in range(3)]
    turned = apply(transposed(half.E), momentum)
    JW_next = [momentum[i] + turned[i] + h * T_next[i] / 2 for i in range(3)]  # I5
    return v_next, solve(J, JW_next)


def channel(W: Vector, pi: Number) -> Vector:
    """Apply M1: crv in deg/s."""
    return [180 * w / pi for w in W]
