"""Correct variants of the two tutorial backends: other ways to write the same law, which the judge must not reject.

Each is a change of text in `examples/backend_numpy.py`, or of text or compiler options of the tutorial in C.
`python benchmarks/strangers --controls` judges them, with their pieces and by runs: those in C by all layers, the
trajectories among them, those in Python by all but the trajectories.
"""

from __future__ import annotations

from typing import NamedTuple


class Variant(NamedTuple):
    """says; changes: pairs of old and new text; flags: options of the C compiler."""

    says: str
    changes: tuple[tuple[str, str], ...] = ()
    flags: tuple[str, ...] = ()


N1 = "return max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0"
T3 = "return mu * F_N / np.hypot(*F_trial) * F_trial"
E = "return np.sin(angle) / angle * H + 2 * (np.sin(angle / 2) / angle) ** 2 * H @ H"
SOLVED = "np.linalg.solve(J, T - np.cross(W, J @ W))"
GAIN = "W + np.linalg.solve(J, gain)"
TURNED = "Lambda_next = Lambda + Lambda @ E"
SUM = "    force = F.sum(axis=0) - [0, 0, mass * g]\n    moment = np.cross(r, F).sum(axis=0)\n"
SECOND = '    v, W = second_half(state["v"], state["W"], state["a"], state["T"], a, T, h, J, E)\n    return {'
SLIDES = "        F_T = sliding_force(F_T, F_N, mu)\n        s = anchor_after(F_T, u_t, v_slide, K_T, C_T)\n"
FROM_MATRIX = """def quaternion(L):
    w = np.sqrt(max(1 + L[0, 0] + L[1, 1] + L[2, 2], 0)) / 2
    return np.array([w, L[2, 1] - L[1, 2], L[0, 2] - L[2, 0], L[1, 0] - L[0, 1]]) / [1, 4 * w, 4 * w, 4 * w]


def matrix(q):
    w, x, y, z = q / np.sqrt(q @ q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def turned(L, Theta):
    p, angle = quaternion(L), np.sqrt(Theta @ Theta)
    b = np.sin(angle / 2) / angle * Theta if angle > 0 else Theta / 2
    w = np.cos(angle / 2)
    return matrix(np.array([p[0] * w - p[1:] @ b, *(p[0] * b + w * p[1:] + np.cross(p[1:], b))]))


def first_half("""

IN_PYTHON = (
    Variant(
        "forces and moments summed in an order that is drawn anew each step",
        (
            (
                SUM,
                """\
    order = np.random.default_rng().permutation(len(F))
    r, F = r[order], F[order]
"""
                + SUM,
            ),
        ),
    ),
    Variant(
        "direction of sliding by atan2, cosine and sine",
        (
            (
                T3,
                """\
direction = np.arctan2(F_trial[1], F_trial[0])
    return mu * F_N * np.array([np.cos(direction), np.sin(direction)])""",
            ),
        ),
    ),
    Variant(
        "sqrt(x*x + y*y) for a length",
        (
            ("np.hypot(*F_trial) <= limit", "np.sqrt(F_trial @ F_trial) <= limit"),
            (T3, "return mu * F_N / np.sqrt(F_trial @ F_trial) * F_trial"),
        ),
    ),
    Variant(
        "complex numbers for the plane of the plate",
        (
            (
                T3,
                """\
F = complex(*F_trial)
    F = mu * F_N * F / abs(F)
    return np.array([F.real, F.imag])""",
            ),
        ),
    ),
    Variant(
        "sliding force as a share of the trial force",
        ((T3, "return F_trial * min(1.0, mu * F_N / np.hypot(*F_trial))"),),
    ),
    Variant(
        "anchor moved by what the force lost",
        (
            (
                SLIDES,
                """\
        F_star, F_T = F_T, sliding_force(F_T, F_N, mu)
        s = s + (F_T - F_star) / K_T
""",
            ),
        ),
    ),
    Variant(
        "> for >= at zero penetration",
        (
            (N1, N1.replace(">=", ">")),
            ("touching = bool(xi >= 0)", "touching = bool(xi > 0)"),
            ("s if anchored and xi >= 0", "s if anchored and xi > 0"),
        ),
    ),
    Variant(
        "normal force by clip",
        ((N1, "return float(np.clip(K_N * xi + C_N * xi_rate, 0.0, None)) if xi >= 0 else 0.0"),),
    ),
    Variant(
        "trial force with its terms exchanged",
        (("return -K_T * (u_t - s) - C_T * v_slide", "return K_T * (s - u_t) - v_slide * C_T"),),
    ),
    Variant(
        "trial force by places times stiffness",
        (("return -K_T * (u_t - s) - C_T * v_slide", "return -(C_T * v_slide + K_T * u_t - K_T * s)"),),
    ),
    Variant("levers by einsum", (("r = P @ Lambda.T", 'r = np.einsum("ij,nj->ni", Lambda, P)'),)),
    Variant(
        "velocity of the turn by a matrix",
        (
            (
                "rate = v + np.cross(Lambda @ W, r)",
                """\
x_, y_, z_ = Lambda @ W
    rate = v + r @ np.array([[0, z_, -y_], [-z_, 0, x_], [y_, -x_, 0]])""",
            ),
        ),
    ),
    Variant(
        "velocity of the turn in body axes, then turned",
        (("rate = v + np.cross(Lambda @ W, r)", "rate = v + np.cross(W, P) @ Lambda.T"),),
    ),
    Variant(
        "weight as an acceleration",
        (("return force / block.mass, T, F", "return F.sum(axis=0) / block.mass - [0, 0, block.g], T, F"),),
    ),
    Variant(
        "sums without rounding (fsum)",
        (
            ("import numpy as np\n", "import math\n\nimport numpy as np\n"),
            (
                SUM,
                """\
    force = np.array([math.fsum(c) for c in F.T]) - [0, 0, mass * g]
    moment = np.array([math.fsum(c) for c in np.cross(r, F).T])
""",
            ),
        ),
    ),
    Variant(
        "moment in body axes from the start",
        (
            (
                "return force / block.mass, T, F",
                "return force / block.mass, np.cross(points.P, F @ Lambda).sum(axis=0), F",
            ),
        ),
    ),
    Variant(
        "moment turned foot by foot", (("moment, Lambda.T @ moment", "moment, (np.cross(r, F) @ Lambda).sum(axis=0)"),)
    ),
    Variant(
        "inverse of the inertia",
        ((SOLVED, "np.linalg.inv(J) @ (T - np.cross(W, J @ W))"), (GAIN, "W + np.linalg.inv(J) @ gain")),
    ),
    Variant(
        "principal axes of the inertia",
        (
            (
                "import numpy as np\n",
                """\
import numpy as np


def solved(J, b):
    moments, axes = np.linalg.eigh(J)
    return axes @ ((axes.T @ b) / moments)
""",
            ),
            (SOLVED, "solved(J, T - np.cross(W, J @ W))"),
            (GAIN, "W + solved(J, gain)"),
        ),
    ),
    Variant("gyroscopic moment with its factors exchanged", ((SOLVED, "np.linalg.solve(J, T + np.cross(J @ W, W))"),)),
    Variant("Horner's form of the place", (("x + h * v + h * h / 2 * a", "x + h * (v + 0.5 * h * a)"),)),
    Variant("mean of the accelerations", (("v + h / 2 * (a + a_next)", "v + h * (0.5 * a + 0.5 * a_next)"),)),
    Variant(
        "rates by the whole momentum, not by its gain",
        (
            ("gain = h / 2 * T + E.T @ half + h / 2 * T_next", "gain = half + E.T @ half + h / 2 * T_next"),
            (GAIN, "np.linalg.solve(J, gain)"),
        ),
    ),
    Variant(
        "momentum in plate axes, never made orthogonal again",
        (
            (
                SECOND,
                """\
    v, _ = second_half(state["v"], state["W"], state["a"], state["T"], a, T, h, J, E)
    L = state.get("L", state["Lambda"] @ (J @ state["W"])) + h / 2 * (state["Lambda"] @ state["T"] + Lambda @ T)
    W = np.linalg.solve(J, Lambda.T @ L)
    return {"L": L, """,
            ),
        ),
    ),
    Variant(
        "a quaternion rebuilt from the matrix every step",
        (("def first_half(", FROM_MATRIX), (TURNED, "Lambda_next = turned(Lambda, Theta)")),
    ),
    Variant(
        "exponential by 1 - cos", ((E, "return np.sin(angle) / angle * H + (1 - np.cos(angle)) / angle**2 * H @ H"),)
    ),
    Variant(
        "exponential by a series",
        (
            (
                E,
                """\
term, total = H, H
    for k in range(2, 40):
        term = term @ H / k
        total = total + term
    return total""",
            ),
        ),
    ),
    Variant(
        "exponential by the unit axis",
        ((E, "return np.sin(angle) * (H / angle) + 2 * np.sin(angle / 2) ** 2 * (H / angle) @ (H / angle)"),),
    ),
    Variant(
        "exponential by a quaternion of half the angle",
        (
            (
                E,
                """\
w, b = np.cos(angle / 2), np.sin(angle / 2) / angle * H
    return 2 * w * b + 2 * b @ b""",
            ),
        ),
    ),
    Variant(
        "pose made orthogonal by a singular value decomposition",
        (
            (
                TURNED,
                """\
U, _, V = np.linalg.svd(Lambda + Lambda @ E)
    Lambda_next = U @ V""",
            ),
        ),
    ),
    Variant("rotation as a whole matrix, the one added first", ((TURNED, "Lambda_next = Lambda @ (np.eye(3) + E)"),)),
    Variant(
        "damping by the frequency",
        (("return 2 * beta * np.sqrt(K * mass)", "return 2 * beta * mass * np.sqrt(K / mass)"),),
    ),
    Variant(
        "points by unit diagonals", (("corners * inwards", "corners - delta_diag * corners / np.hypot(*corners[0])"),)
    ),
    Variant("degrees by two steps", (("np.degrees(W)", "W * 180 / np.pi"),)),
    Variant(
        "the anchor of an open foot is no number",
        (
            (
                "return s if anchored and xi >= 0 else u_t",
                "return s if anchored and xi >= 0 else u_t if xi >= 0 else NONE",
            ),
            ("PROPERTIES = (", "NONE = np.full(2, np.nan)\nPROPERTIES = ("),
        ),
    ),
    Variant(
        "< for <= at the cone; no trial force sticks",
        (("return np.hypot(*F_trial) <= limit", "return np.hypot(*F_trial) < limit or not F_trial.any()"),),
    ),
    Variant(
        "flags as 0 and 1",
        (
            ("touching = bool(xi >= 0)", "touching = int(xi >= 0)"),
            ("slides = not sticks(F_T, limit)", "slides = int(not sticks(F_T, limit))"),
        ),
    ),
    Variant(
        "instants as they are asked for",
        (('"t": wanted * problem.step', '"t": np.arange(rows) / problem.output_rate'),),
    ),
    Variant(
        "sliding force by taking the excess away",
        ((T3, "return F_trial - (np.hypot(*F_trial) - mu * F_N) / np.hypot(*F_trial) * F_trial"),),
    ),
    Variant(
        "exponential of a matrix by a library",
        ((E, "from scipy.linalg import expm\n\n    return expm(H) - np.eye(3)"),),
    ),
)
