"""Mistakes of somebody who ports the block, planted in the tutorial backend one at a time: the first list of strangers.

They were written down from the equations and the text of the tutorial alone, without the zoo's list at hand, and before
any of them was judged. Each is a change of text in `examples/backend_numpy.py`.
"""

from __future__ import annotations

from typing import NamedTuple


class Mistake(NamedTuple):
    """says; rules: the ones that may be named, the planted one first (more than one where the mistake lies between
    them); old, new: the change; in_runs: whether a run can show it (what is derived from parameters it is given); more:
    further changes that belong to it."""

    says: str
    rules: tuple[str, ...]
    old: str
    new: str
    in_runs: bool = True
    more: tuple[tuple[str, str], ...] = ()


N1 = "max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0"
T3 = "mu * F_N / np.hypot(*F_trial) * F_trial"
E = "np.sin(angle) / angle * H + 2 * (np.sin(angle / 2) / angle) ** 2 * H @ H"
SPEED = "np.linalg.solve(J, T - np.cross(W, J @ W))"
FIRST = 'x, Lambda, v_p, W_p)\n    v, W = second_half(state["v"], state["W"], state["a"], state["T"], a, T, h, J, E)'

MISTAKES = (
    # What follows from the parameters.
    Mistake("inertia of a rod about its end", ("G1",), "mass / 12 *", "mass / 3 *", False),
    Mistake(
        "width and depth exchanged in the inertia",
        ("G1",),
        "[depth**2 + height**2, width**2 + height**2,",
        "[width**2 + height**2, depth**2 + height**2,",
        False,
    ),
    Mistake(
        "corners numbered clockwise",
        ("G2",),
        "[(1, 1), (-1, 1), (-1, -1), (1, -1)]",
        "[(1, 1), (1, -1), (-1, -1), (-1, 1)]",
        False,
    ),
    Mistake(
        "internal points moved inwards along both sides, not along the diagonal",
        ("G2",),
        "corners * inwards",
        "corners - np.sign(corners) * delta_diag",
        False,
    ),
    Mistake(
        "distance on the diagonal over the whole diagonal",
        ("G2",),
        "(np.hypot(width, depth) / 2)",
        "np.hypot(width, depth)",
        False,
    ),
    Mistake("heights of the feet downwards", ("G2",), "delta_long - height / 2", "-delta_long - height / 2", False),
    Mistake("damping ratio without its two", ("P2",), "2 * beta * np.sqrt", "beta * np.sqrt", False),
    Mistake("damping by K / m", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K / mass)", False),
    Mistake(
        "mass shared by the feet",
        ("P2",),
        '"C_N": damping(beta, K_N, mass)',
        '"C_N": damping(beta, K_N, mass / 8)',
        False,
    ),
    Mistake(
        "tangential damper from the normal stiffness",
        ("P3", "P2"),
        '"C_T": damping(beta, K_T, mass)',
        '"C_T": damping(beta, K_N, mass)',
        False,
    ),
    Mistake("stiffness shared by the feet", ("P1",), "np.full(8, K_N)", "np.full(8, K_N / 8)", False),
    # Where the points are and how they move.
    Mistake("levers turned back instead of forth", ("K1",), "P @ Lambda.T", "P @ Lambda"),
    Mistake("body rates taken for plate rates", ("K1",), "np.cross(Lambda @ W, r)", "np.cross(W, r)"),
    Mistake("velocity of the turn left in body axes", ("K1",), "np.cross(Lambda @ W, r)", "np.cross(W, P)"),
    Mistake("velocity of the turn with the other sign", ("K1",), "np.cross(Lambda @ W, r)", "np.cross(r, Lambda @ W)"),
    Mistake(
        "rate of the gap for rate of penetration", ("K1", "N1"), "-rate[:, 2], rate[:, :2]", "rate[:, 2], rate[:, :2]"
    ),
    Mistake("penetration cut at zero", ("K1", "N2"), "-u[:, 2], -rate", "np.maximum(-u[:, 2], 0), -rate"),
    Mistake(
        "sliding velocity of the centre of mass",
        ("K1",),
        "rate[:, :2]",
        "np.broadcast_to(v[:2], (len(r), 2))",
    ),
    Mistake("places in single precision", ("K1",), "u = x + r", "u = (x + r).astype(np.float32).astype(float)"),
    Mistake("places relative to the centre of mass", ("K1",), "return r, u, -u[:, 2]", "return r, u - x, -u[:, 2]"),
    # Normal force.
    Mistake("damper in compression only", ("N1",), N1, "K_N * xi + max(C_N * xi_rate, 0.0) if xi >= 0 else 0.0"),
    Mistake("tension not cut", ("N1",), N1, "K_N * xi + C_N * xi_rate if xi >= 0 else 0.0"),
    Mistake("damper without sign", ("N1",), N1, N1.replace("C_N * xi_rate", "C_N * abs(xi_rate)")),
    Mistake("no force in rebound", ("N1",), N1, N1.replace("xi >= 0", "xi >= 0 and xi_rate >= 0")),
    Mistake("contact from one micrometre above the plate", ("N2",), N1, N1.replace("xi >= 0", "xi >= -1e-6")),
    Mistake("no contact below a tenth of a micrometre", ("N1", "N2"), N1, N1.replace("xi >= 0", "xi >= 1e-7")),
    # Anchors and the trial force.
    Mistake(
        "a new foot is tied to the origin",
        ("T5",),
        "s if anchored and xi >= 0 else u_t",
        "s if anchored and xi >= 0 else 0 * u_t",
    ),
    Mistake(
        "a foot that comes back keeps its old anchor",
        ("T5",),
        "anchor_before(xi, u_t, s, anchored)\n    trace",
        "anchor_before(xi, u_t, s, True)\n    trace",
    ),
    Mistake("contact is told by the force", ("T5", "N2"), "touching = bool(xi >= 0)", "touching = bool(F_N > 0)"),
    Mistake("no tangential damper", ("T1",), "-K_T * (u_t - s) - C_T * v_slide", "-K_T * (u_t - s)"),
    Mistake("tangential damper pushes", ("T1",), "- C_T * v_slide", "+ C_T * v_slide"),
    Mistake("anchor of the foot before", ("T5", "T1"), 'memory["s"][i]', 'memory["s"][i - 1]'),
    # The cone.
    Mistake("always the static coefficient", ("T6",), "(mu if was_sliding else mu_0)", "mu_0"),
    Mistake(
        "coefficients exchanged in the threshold",
        ("T6",),
        "(mu if was_sliding else mu_0)",
        "(mu_0 if was_sliding else mu)",
    ),
    Mistake("threshold by the spring alone", ("T6", "N1"), "cone(F_N, sliding", "cone(K_N * xi, sliding"),
    Mistake("one foot slides, all have slid", ("T6",), 'memory["sliding"][i]', 'memory["sliding"].any()'),
    Mistake(
        "each axis is held to the threshold", ("T2",), "np.hypot(*F_trial) <= limit", "np.abs(F_trial).max() <= limit"
    ),
    Mistake("a square is held to the threshold", ("T2",), "np.hypot(*F_trial) <= limit", "F_trial @ F_trial <= limit"),
    Mistake(
        "a tolerance of a millinewton", ("T2",), "np.hypot(*F_trial) <= limit", "np.hypot(*F_trial) <= limit + 1e-3"
    ),
    Mistake(
        "sliding force against the velocity", ("T3",), "sliding_force(F_T, F_N, mu)", "sliding_force(-v_slide, F_N, mu)"
    ),
    Mistake(
        "sliding with the static coefficient", ("T3",), "sliding_force(F_T, F_N, mu)", "sliding_force(F_T, F_N, mu_0)"
    ),
    Mistake(
        "the first sliding force at the threshold",
        ("T3",),
        "sliding_force(F_T, F_N, mu)",
        "sliding_force(F_T, limit, 1.0)",
    ),
    Mistake("direction by the sum of the components", ("T3",), T3, "mu * F_N / np.abs(F_trial).sum() * F_trial"),
    Mistake("a small number in the denominator", ("T3",), T3, "mu * F_N / (np.hypot(*F_trial) + 1e-6) * F_trial"),
    Mistake("anchor not moved", ("T4",), "s = anchor_after(F_T, u_t, v_slide, K_T, C_T)", "s = s + 0.0"),
    Mistake("anchor moved without the damper", ("T4",), "u_t + (F_T + C_T * v_slide) / K_T", "u_t + F_T / K_T"),
    Mistake("anchor moved to the foot", ("T4",), "u_t + (F_T + C_T * v_slide) / K_T", "u_t + 0.0"),
    Mistake(
        "anchor moved to the other side",
        ("T4",),
        "u_t + (F_T + C_T * v_slide) / K_T",
        "u_t - (F_T + C_T * v_slide) / K_T",
    ),
    # The body.
    Mistake("gravity a number in the code", ("A1",), "[0, 0, mass * g]", "[0, 0, mass * 9.81]"),
    Mistake("weight along the body's axis", ("A1",), "- [0, 0, mass * g]", "- Lambda @ [0, 0, mass * g]"),
    Mistake("moment with the other sign", ("A2",), "np.cross(r, F).sum", "np.cross(F, r).sum"),
    Mistake("friction left out of the moment", ("A2",), "np.cross(r, F).sum", "np.cross(r, F * [0, 0, 1]).sum"),
    Mistake(
        "levers from the plate's origin", ("A2",), "resultants(Lambda, r, F, block", "resultants(Lambda, u, F, block"
    ),
    Mistake("moment turned forth instead of back", ("A3",), "Lambda.T @ moment", "Lambda @ moment"),
    Mistake("moment left in plate axes", ("A3",), "moment, Lambda.T @ moment", "moment, moment"),
    # The integrator.
    Mistake("no acceleration in the position", ("I1",), "x + h * v + h * h / 2 * a", "x + h * v"),
    Mistake("acceleration without its half", ("I1",), "h * h / 2 * a  # I1", "h * h * a  # I1"),
    Mistake("no gyroscopic moment in the increment", ("I2",), SPEED, "np.linalg.solve(J, T)"),
    Mistake("gyroscopic moment with the other sign", ("I2",), SPEED, SPEED.replace("T - np", "T + np")),
    Mistake("products of inertia left out", ("I2",), SPEED, "(T - np.cross(W, J @ W)) / np.diag(J)"),
    Mistake("increment on the plate's side", ("I3",), "Lambda + Lambda @ E", "Lambda + E @ Lambda"),
    Mistake("rotation to first order", ("I3",), f"return {E}", "return H"),
    Mistake("half of the square missing", ("I3",), "H + 2 * (np.sin", "H + (np.sin"),
    Mistake("forces with the velocities of the step before", ("S1",), "v + h * a, W + h * A, E", "v, W, E"),
    Mistake("forces with half-step velocities", ("S1",), "v + h * a, W + h * A, E", "v + h / 2 * a, W + h / 2 * A, E"),
    Mistake(
        "forces at the new place in the old attitude",
        ("S1", "K1"),
        FIRST,
        FIRST.replace("x, Lambda", 'x, state["Lambda"]', 1),
    ),
    Mistake("velocity by the new acceleration alone", ("I4",), "h / 2 * (a + a_next)", "h * a_next"),
    Mistake("velocity by the old acceleration alone", ("I4",), "h / 2 * (a + a_next)", "h * a"),
    Mistake("momentum turned forth instead of back", ("I5",), "E.T @ half", "E @ half"),
    Mistake("momentum not turned", ("I5",), "E.T @ half + ", ""),
    Mistake("the old moment twice", ("I5",), "+ h / 2 * T_next", "+ h / 2 * T"),
    Mistake(
        "gain of the momentum in single precision",
        ("I5",),
        "np.linalg.solve(J, gain)",
        "np.linalg.solve(J, gain).astype(np.float32)",
    ),
    Mistake("the new loads twice", ("I4", "I5"), FIRST, FIRST.replace('state["a"], state["T"], a', "a, T, a")),
    # The run.
    Mistake(
        "constants in another order on the way to the law",
        ("N1", "T1"),
        'PROPERTIES = ("K_N", "C_N", "K_T", "C_T"',
        'PROPERTIES = ("K_N", "C_T", "K_T", "C_N"',
    ),
    Mistake("all feet have the constants of the first", ("N1", "T1", "T2", "T6", "T3"), "*made[:, i]", "*made[:, 0]"),
    Mistake("step in single precision", ("I1", "S2"), "h, J = problem.step,", "h, J = np.float32(problem.step),"),
    Mistake("rows one step late", ("S2",), "kept.append(state)", "kept.append(advanced(problem, state))"),
    Mistake("rows at the step below", ("S2",), "np.rint(", "np.floor("),
    Mistake(
        "the start not evaluated",
        ("S2",),
        "state |= memory\n",
        'state |= memory | {k: 0 * state[k] for k in ("a", "T")}\n',
    ),
    Mistake("the start's contacts forgotten", ("S2", "T5"), "        state |= memory\n", ""),
    # The channel.
    Mistake("rates in plate axes", ("M1",), "np.degrees(W)", 'np.degrees(np.einsum("nij,nj->ni", Lambda, W))', False),
    Mistake("57.3 for a radian", ("M1",), "np.degrees(W)", "57.3 * W", False),
    Mistake("rates in rad/s", ("M1",), '{"crv_deg_s": np.degrees(W)}', '{"crv_deg_s": W}', False),
)

#: Two of those that were written down turned out to be none: the anchor of an open foot is not read again, and a foot
#: that is open is never sliding. They have to pass.
HARMLESS = (
    Mistake(
        "anchor of a foot that lifts is kept", ("T5",), "s if anchored and xi >= 0 else u_t", "s if anchored else u_t"
    ),
    Mistake("a new foot is sliding because it once did", ("T6", "T5"), "sliding and anchored", "sliding"),
)
