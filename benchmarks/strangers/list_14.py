"""A fourteenth list of strangers: mistakes in other formulas, and in nine integrators of other trades.

Integrators of molecular dynamics, of rigid tops and of compressible flow; springs that harden, friction that is weaker
across, levers that are rounded, moments that damp. Mistakes and variants were written down, and published, before any
of them was judged; that the integrators converge to the law was looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import SOLVED, SUM, TURNED, E, Variant
from strangers.list_01 import N1, T3, Mistake
from strangers.list_04 import EULER, UNSTARTED
from strangers.list_05 import ROWS, SUMS, TRIAL
from strangers.list_07 import AFTER
from strangers.list_12 import INCREMENT, KICK, MOMENT, PLACE, RATE, SUMMED
from strangers.list_13 import DEPTH

BACK = "return force, moment, Lambda.T @ moment"
LOADS = "return force / block.mass, T, F,"
STRETCH = "return -K_T * (u_t - s) - C_T * v_slide"
TIED = "return s if anchored and xi >= 0 else u_t"
YAW = """c, s = Lambda[0, 0], Lambda[1, 0]
    yaw = np.array([[c, -s, 0], [s, c, 0], [0, 0, np.hypot(c, s)]]) / np.hypot(c, s)
    return force, moment, yaw.T @ moment"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("the weight for the mass in the inertia", ("G1",), "mass / 12 *", "9.81 * mass / 12 *", False),
    Mistake("outer feet moved inwards, inner ones at the corners", ("G2",), "np.column_stack([corners, delta_long",
            "np.column_stack([corners * inwards, delta_long", False,
            (("np.column_stack([corners * inwards, np.full", "np.column_stack([corners, np.full"),)),
    Mistake("the root of the stiffness alone in the damping", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K) * mass", False),
    Mistake("a gyroscope that is mounted head down", ("M1",), "np.degrees(W)", "np.degrees(W) * [1, -1, -1]", False),
    # Points.
    Mistake("velocities of feet as if the block stood upright", ("K1",), RATE, "rate = v + np.cross(W, P)"),
    Mistake("penetration as if the block stood upright", ("K1",), DEPTH,
            DEPTH.replace("-u[:, 2]", "-x[2] - P[:, 2]")),
    Mistake("the spin about the height twice in the velocities", ("K1",), RATE,
            "rate = v + np.cross(Lambda @ (W * [1, 1, 2]), r)"),
    Mistake("a spring that hardens", ("N1",), N1, N1.replace("K_N * xi", "K_N * xi * (1 + 1e4 * xi)")),
    Mistake("half of the normal damper in rebound", ("N1",), N1,
            N1.replace("C_N * xi_rate", "C_N * xi_rate * (1.0 if xi_rate >= 0 else 0.5)")),
    Mistake("a foot that touches pushes by a newton at least", ("N1",), N1, N1.replace("0.0) if", "1.0) if")),
    Mistake("the damper acts from five micrometres above the plate on", ("N2",), N1,
            N1.replace("else 0.0", "else max(C_N * xi_rate, 0.0) * (xi > -5e-6)")),
    Mistake("a foot that touches anew near its old anchor keeps it", ("T5",), TIED,
            "return s if (anchored or np.hypot(*(u_t - s)) < 1e-3) and xi >= 0 else u_t"),
    Mistake("anchors are carried along by the block", ("T5", "T1"), 'memory["s"][i]',
            'memory["s"][i] + (x - memory.get("x", x))[:2]'),
    Mistake("friction is damped while a foot sinks only", ("T1",), TRIAL,
            TRIAL.replace("C_T)", "C_T if xi_rate >= 0 else 0.0)")),
    Mistake("the spring of friction acts along x alone", ("T1",), STRETCH,
            "return -K_T * (u_t - s) * [1, 0] - C_T * v_slide"),
    Mistake("sticks while the spring by itself is inside the cone", ("T2",), "slides = not sticks(F_T, limit)",
            "slides = not sticks(-K_T * (u_t - s), limit)"),
    Mistake("the square of the trial force below the threshold", ("T2",), "np.hypot(*F_trial) <= limit",
            "F_trial @ F_trial <= limit"),
    Mistake("a foot that slid lowers the threshold of the next one", ("T6",), 'memory["sliding"][i]',
            'memory["sliding"][i] or memory["sliding"][i - 1]'),
    Mistake("friction across is a tenth weaker than along", ("T3",), "return " + T3, f"return {T3} * [1.0, 0.9]"),
    Mistake("a tenth of the damper beside the sliding force", ("T3",), "F_T = sliding_force(F_T, F_N, mu)",
            "F_T = sliding_force(F_T, F_N, mu) - 0.1 * C_T * v_slide"),
    Mistake("an anchor moves by a micrometre or not at all", ("T4",), AFTER,
            AFTER + "        s = s if np.hypot(*(s - trace['s_trial'])) > 1e-6 else trace['s_trial']\n"),
    Mistake("an anchor moves twice its way", ("T4",), AFTER, AFTER.replace("K_T, C_T)", "K_T, C_T) * 2 - s")),
    # The body.
    Mistake("velocity reckoned in axes that turn", ("A1", "I4"), LOADS,
            "return force / block.mass - np.cross(Lambda @ W, v), T, F,"),
    Mistake("the weight leans by a thousandth", ("A1",), SUMMED, SUMMED.replace("[0, 0,", "[1e-3 * mass * g, 0,")),
    Mistake("levers in tenths of a millimetre", ("A2",), MOMENT, MOMENT.replace("(r,", "(np.round(r, 4),")),
    Mistake("levers of half a height for all feet", ("A2",), SUMS,
            SUMS.replace("r,", "np.column_stack([r[:, :2], np.full(len(r), -0.344)]),")),
    Mistake("moment turned back about the height alone", ("A3",), BACK, YAW),
    Mistake("a moment against the turn, in proportion to the rates", ("A2", "A3", "I5"), LOADS,
            "return force / block.mass, T - 0.05 * W, F,"),
    Mistake("no acceleration sideways in the place", ("I1",), PLACE, PLACE.replace("/ 2 * a", "/ 2 * a * [0, 0, 1]")),
    Mistake("gyroscopic moment twice in the increment", ("I2",), INCREMENT,
            "Theta = h * W + h * h / 2 * (2 * A - np.linalg.solve(J, T))"),
    Mistake("a sign in the matrix of the turn", ("I3",), "[[0, -z, y]", "[[0, -z, -y]"),
    Mistake("the sine of the turn by two terms of its series", ("I3",), "np.sin(angle) / angle * H",
            "(1 - angle * angle / 6) * H"),
    Mistake("velocity sideways by the new acceleration alone", ("I4",), KICK,
            KICK.replace("(a + a_next)", "(np.array([a_next[0], a_next[1], a[2]]) + a_next)")),
    Mistake("momentum turned back to first order", ("I5",), "E.T @ half", "(E.T - E) / 2 @ half"),
    Mistake("rates predicted half-way, velocities whole", ("S1",), "v + h * a, W + h * A, E",
            "v + h * a, W + h / 2 * A, E"),
    # The run.
    Mistake("the last row is the one before", ("S2",), ROWS,
            ROWS.replace("in kept", "in [*kept[:-1], *kept[-2:][:1]]")),
    Mistake("velocities of the start in single precision", ("S2", "K1", "I1"), UNSTARTED,
            '    state["v"] = np.float32(state["v"]).astype(float)\n' + UNSTARTED),
    Mistake("no spin about the height at the start", ("S2", "K1", "I3"), UNSTARTED,
            '    state["W"] = state["W"] * [1, 1, 0]\n' + UNSTARTED),
)  # fmt: skip

RALSTON = """\
    A = spun(W, T)
    v_1, W_1 = v + 2 / 3 * h * a, W + 2 / 3 * h * A
    a_1, T_1, _, _ = evaluate(problem, state, x + 2 / 3 * h * v, turned(Lambda, 2 / 3 * h * W), v_1, W_1)
    x, Lambda = x + h / 4 * (v + 3 * v_1), turned(Lambda, h / 4 * (W + 3 * W_1))
    v, W = v + h / 4 * (a + 3 * a_1), W + h / 4 * (A + 3 * spun(W_1, T_1))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
IMPLICIT_MIDPOINT = """\
    v_m, W_m, a_m, T_m = v, W, a, T
    for _ in range(6):
        v_m, W_m = v + h / 2 * a_m, W + h / 2 * spun(W_m, T_m)
        x_m, Lambda_m = x + h / 2 * v_m, turned(Lambda, h / 2 * W_m)
        a_m, T_m, _, memory = evaluate(problem, state, x_m, Lambda_m, v_m, W_m)
    x, Lambda = x + h * v_m, turned(Lambda, h * W_m)
    v, W = v + h * a_m, W + h * spun(W_m, T_m)
    a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)
"""
PLATE_MOMENTUM = """\
    L = Lambda @ (J @ W + h / 2 * T)
    v = v + h / 2 * a
    halfway = turned(Lambda, h / 2 * np.linalg.solve(J, Lambda.T @ L))
    x, Lambda = x + h * v, turned(Lambda, h * np.linalg.solve(J, halfway.T @ L))
    W = np.linalg.solve(J, Lambda.T @ L)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    L = L + h / 2 * Lambda @ T
    v, W = v + h / 2 * a, np.linalg.solve(J, Lambda.T @ L)
"""
HALVES = """\
    memory = state
    for _ in range(2):
        v, W = v + h / 2 * a, W + h / 2 * spun(W, T)
        x, Lambda = x + h / 2 * v, turned(Lambda, h / 2 * W)
        a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)
"""
BEEMAN = """\
    A = spun(W, T)
    a_0, A_0 = state.get("before", (a, A))
    x, Lambda = x + h * v + h * h / 6 * (4 * a - a_0), turned(Lambda, h * W + h * h / 6 * (4 * A - A_0))
    v_p, W_p = v + h / 2 * (3 * a - a_0), W + h / 2 * (3 * A - A_0)
    a_n, T_n, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)
    v, W = v + h / 6 * (2 * a_n + 5 * a - a_0), W + h / 6 * (2 * spun(W_p, T_n) + 5 * A - A_0)
    memory = memory | {"before": (a, A)}
    a, T = a_n, T_n
"""
SHU_OSHER = """\
    A = spun(W, T)
    v_1, W_1 = v + h * a, W + h * A
    a_1, T_1, _, _ = evaluate(problem, state, x + h * v, turned(Lambda, h * W), v_1, W_1)
    A_1 = spun(W_1, T_1)
    v_2, W_2 = v + h / 4 * (a + a_1), W + h / 4 * (A + A_1)
    middle = x + h / 4 * (v + v_1), turned(Lambda, h / 4 * (W + W_1))
    a_2, T_2, _, _ = evaluate(problem, state, *middle, v_2, W_2)
    x, Lambda = x + h / 6 * (v + v_1 + 4 * v_2), turned(Lambda, h / 6 * (W + W_1 + 4 * W_2))
    v, W = v + h / 6 * (a + a_1 + 4 * a_2), W + h / 6 * (A + A_1 + 4 * spun(W_2, T_2))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
SPLIT_TOP = """\
    D, Q = np.linalg.eigh(J)
    Q = Q * np.linalg.det(Q)
    v, p, R = v + h / 2 * a, Q.T @ (J @ W + h / 2 * T), Lambda @ Q
    for axis, share in ((0, 0.5), (1, 0.5), (2, 1.0), (1, 0.5), (0, 0.5)):
        turn = np.eye(3) + rotation_less_identity(share * h * p[axis] / D[axis] * np.eye(3)[axis])
        p, R = turn.T @ p, R @ turn
    x, Lambda, W = x + h * v, R @ Q.T, Q @ (p / D)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    v, W = v + h / 2 * a, Q @ ((p + h / 2 * Q.T @ T) / D)
"""
QUATERNION = """\
    from scipy.spatial.transform import Rotation

    v, W = v + h * a, W + h * spun(W, T)
    x, q = x + h * v, Rotation.from_matrix(Lambda).as_quat()
    b, w = q[:3], q[3]
    q = q + h / 2 * np.array([*(w * W + np.cross(b, W)), -b @ W])
    Lambda = Rotation.from_quat(q / np.sqrt(q @ q)).as_matrix()
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
PREDICT_CORRECT = """\
    now = v, W, a, spun(W, T)
    v_0, W_0, a_0, A_0 = state.get("before", now)
    v_p, W_p = v + h / 2 * (3 * a - a_0), W + h / 2 * (3 * now[3] - A_0)
    at = x + h / 2 * (3 * v - v_0), turned(Lambda, h / 2 * (3 * W - W_0))
    a_p, T_p, _, _ = evaluate(problem, state, *at, v_p, W_p)
    x, Lambda = x + h / 2 * (v + v_p), turned(Lambda, h / 2 * (W + W_p))
    v, W = v + h / 2 * (a + a_p), W + h / 2 * (now[3] + spun(W_p, T_p))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    memory = memory | {"before": now}
"""
SCHEMES = {
    "Ralston": RALSTON, "implicit midpoint": IMPLICIT_MIDPOINT, "momentum in plate axes": PLATE_MOMENTUM,
    "two halves of symplectic Euler": HALVES, "Beeman": BEEMAN, "Shu-Osher": SHU_OSHER, "a top by axes": SPLIT_TOP,
    "quaternion and Euler": QUATERNION, "predictor and corrector": PREDICT_CORRECT,
}  # fmt: skip

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("weights of the turn that do not add up", ("I3",), "h / 4 * (W + 3 * W_1)", "h / 4 * (W + 2 * W_1)"),
     "Ralston"),
    (Mistake("the first of two kicks forgotten", ("I4", "A1"), "h / 4 * (a + 3 * a_1)", "h / 4 * (3 * a_1)"),
     "Ralston"),
    (Mistake("no gyroscopic moment in the middle", EULER, "W + h * spun(W_m, T_m)", "W + h * np.linalg.solve(J, T_m)"),
     "implicit midpoint"),
    (Mistake("the whole turn from the middle on", ("I3",), "turned(Lambda, h * W_m)", "turned(Lambda_m, h * W_m)"),
     "implicit midpoint"),
    (Mistake("moment in body axes added to the momentum in plate axes", ("A3", "I5"), "L + h / 2 * Lambda @ T",
             "L + h / 2 * T"), "momentum in plate axes"),
    (Mistake("momentum in plate axes taken for that in body axes", ("I5", "I2"),
             "    W = np.linalg.solve(J, Lambda.T @ L)\n", "    W = np.linalg.solve(J, L)\n",
             more=(("v + h / 2 * a, np.linalg.solve(J, Lambda.T @ L)", "v + h / 2 * a, np.linalg.solve(J, L)"),)),
     "momentum in plate axes"),
    (Mistake("each half turned by a whole step", ("I3",), "turned(Lambda, h / 2 * W)", "turned(Lambda, h * W)"),
     "two halves of symplectic Euler"),
    (Mistake("the step before added with the other sign", ("I4", "A1"), "5 * a - a_0)", "5 * a + a_0)"), "Beeman"),
    (Mistake("a one for the four in the gain of the rates", EULER, "(A + A_1 + 4 * spun", "(A + A_1 + spun"),
     "Shu-Osher"),
    (Mistake("momentum turned along with the body", EULER, "p, R = turn.T @ p", "p, R = turn @ p"), "a top by axes"),
    (Mistake("half of the turns about two axes", ("I3", *EULER), "(2, 1.0), (1, 0.5), (0, 0.5))", "(2, 1.0))"),
     "a top by axes"),
    (Mistake("the vector of a quaternion multiplied in the other order", ("I3",), "np.cross(b, W)", "np.cross(W, b)"),
     "quaternion and Euler"),
    (Mistake("a quaternion without the half", ("I3",), "q + h / 2 *", "q + h *"), "quaternion and Euler"),
    (Mistake("corrected by the sum of both, not by their mean", ("I4", "A1"), "h / 2 * (a + a_p)", "h * (a + a_p)"),
     "predictor and corrector"),
)  # fmt: skip

IN_PYTHON = (
    Variant("compensated sums",
            ((SUM, "    import math\n\n    arms = np.cross(r, F)\n"
              "    force = np.array([math.fsum(column) for column in F.T]) - [0, 0, mass * g]\n"
              "    moment = np.array([math.fsum(column) for column in arms.T])\n"),)),
    Variant("the weight as a further foot, at the centre of mass",
            ((SUM, "    F, r = np.vstack([F, [0, 0, -mass * g]]), np.vstack([r, np.zeros(3)])\n"
              "    force, moment = F.sum(axis=0), np.cross(r, F).sum(axis=0)\n"),)),
    Variant("moment by the skew matrices of the levers",
            (("moment = np.cross(r, F).sum(axis=0)",
              "moment = sum(np.array([[0, -c, b], [c, 0, -a], [-b, a, 0]]) @ f for (a, b, c), f in zip(r, F))"),)),
    Variant("a turn by two half turns",
            (("    angle = np.sqrt(x * x + y * y + z * z)\n",
              "    H, angle = H / 2, np.sqrt(x * x + y * y + z * z) / 2\n"),
             ("return H\n    " + E, "return 2 * H\n    half = " + E.removeprefix("return ")
              + "\n    return 2 * half + half @ half"))),
    Variant("the whole rotation multiplied", ((TURNED, "Lambda_next = Lambda @ (np.eye(3) + E)"),)),
    Variant("sliding force by complex numbers",
            (("return " + T3, "z = complex(*F_trial)\n    z = mu * F_N * z / abs(z)\n"
              "    return np.array([z.real, z.imag])"),)),
    Variant("no tension by half of the sum and its size",
            ((N1, "0.5 * ((f := K_N * xi + C_N * xi_rate) + abs(f)) if xi >= 0 else 0.0"),)),
    Variant("Euler's equations along the principal axes",
            ((SOLVED, "(axes := np.linalg.eigh(J))[1] @ ((axes[1].T @ (T - np.cross(W, J @ W))) / axes[0])"),)),
    Variant("velocity of the turn in body axes, then turned", ((RATE, "rate = v + np.cross(W, P) @ Lambda.T"),)),
    Variant("increment of the rates and of their gain", ((INCREMENT, "Theta = h * (W + h / 2 * A)"),)),
)  # fmt: skip
