"""A seventeenth list of strangers: what slips to somebody who ports the block within a week.

Signs, factors of two, a constant for its neighbour, whole division, millimetres and degrees, arrays read by columns,
one foot that is forgotten, a value that is not written back, half a step; integrators from a text book of numerical
methods. Mistakes and variants were written down, and published, before any of them was judged; that the integrators
converge to the law was looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import SOLVED, SUM, TURNED, E, Variant
from strangers.list_01 import FIRST, N1, SPEED, T3, Mistake
from strangers.list_04 import EULER, UNSTARTED
from strangers.list_05 import CONE, FORCES, ROWS, SUMS, TRIAL
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP
from strangers.list_12 import GAIN, KICK, MOMENT, NORMAL, PLACE, RATE
from strangers.list_14 import STRETCH

LEVERS = "r = P @ Lambda.T\n"
SLIDING = "-u[:, 2], -rate[:, 2], rate[:, :2]"
TIED = "    s = anchor_before(xi, u_t, s, anchored)\n"
KEPT_ANCHOR = '"F_T": F_T, "s": s, "touching": True'
HALF = "half = J @ W + h / 2 * T"
TAKEN_STEP = '"W", "a", "T")), h, J)\n'
MOMENTS = "[depth**2 + height**2, width**2 + height**2, width**2 + depth**2]"
#: A skew matrix to first order, its columns of length one.
COLUMNS = """x, y, z = Theta
    Lambda_next = Lambda + Lambda @ np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    Lambda_next = Lambda_next / np.sqrt((Lambda_next**2).sum(axis=0))"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("moments of inertia moved on by one axis", ("G1",), MOMENTS,
            "[width**2 + depth**2, depth**2 + height**2, width**2 + height**2]", False),
    Mistake("half lengths by whole division", ("G2",), "[width / 2, depth / 2]", "[width // 2, depth // 2]", False),
    Mistake("the damping ratio under the root", ("P2",), "2 * beta * np.sqrt(K * mass)", "2 * np.sqrt(beta * K * mass)",
            False),
    Mistake("stiffness across for that along, and the reverse", ("P1",), "K_N, K_T = np.full(8, K_N), np.full(8, K_T)",
            "K_T, K_N = np.full(8, K_N), np.full(8, K_T)", False),
    Mistake("radians for degrees in the channel", ("M1",), "np.degrees(W)", "np.radians(W)", False),
    # Points.
    Mistake("levers taken away from the place of the centre", ("K1",), "u = x + r", "u = x - r"),
    Mistake("heights of the points counted downwards", ("K1",), LEVERS, "r = (P * [1, 1, -1]) @ Lambda.T\n"),
    Mistake("velocities of the feet without that of the centre", ("K1",), RATE, "rate = np.cross(Lambda @ W, r)"),
    Mistake("velocities of the feet in single precision", ("K1",), RATE,
            "rate = (v + np.cross(Lambda @ W, r)).astype(np.float32).astype(float)"),
    Mistake("rates in degrees in the velocities of the feet", ("K1",), RATE, RATE.replace("@ W", "@ np.degrees(W)")),
    Mistake("sliding velocity of the plate under the foot", ("K1", "T1"), SLIDING,
            "-u[:, 2], -rate[:, 2], -rate[:, :2]"),
    Mistake("normal damper by the constant along the plate", ("N1",), NORMAL, NORMAL.replace("C_N", "C_T")),
    Mistake("normal damper twice", ("N1",), N1, N1.replace("C_N *", "2 * C_N *")),
    Mistake("normal force in single precision", ("N1",), NORMAL,
            "F_N = float(np.float32(normal_force(xi, xi_rate, K_N, C_N)))"),
    Mistake("nobody asks whether a foot is open", ("N2",), N1, "max(K_N * xi + C_N * xi_rate, 0.0)"),
    Mistake("stiffnesses exchanged on the way to the law", ("N1", "T1"), '("K_N", "C_N", "K_T"',
            '("K_T", "C_N", "K_N"'),
    Mistake("normal damper of the first inner foot from the outer ones", ("N1",), "    found = [\n",
            "    made[1, len(r) // 2] = made[1, 0]\n    found = [\n"),
    Mistake("a foot that rises has no friction and no anchor", ("T5",), "touching = bool(xi >= 0)",
            "touching = bool(xi >= 0 and xi_rate >= 0)"),
    Mistake("the anchor of a new foot is not written back", ("T5",), TIED, "    old = s\n" + TIED, True,
            ((KEPT_ANCHOR, KEPT_ANCHOR.replace('"s": s', '"s": s if anchored or slides else old')),)),
    Mistake("spring of friction with the other sign", ("T1",), STRETCH, "return K_T * (u_t - s) - C_T * v_slide"),
    Mistake("normal damper in friction", ("T1",), TRIAL, TRIAL.replace("C_T", "C_N")),
    Mistake("sticking where the trial force is above the threshold", ("T2",), "np.hypot(*F_trial) <= limit",
            "np.hypot(*F_trial) > limit"),
    Mistake("static coefficient for feet that slide slowly", ("T6",), CONE,
            "cone(F_N, sliding and anchored and np.hypot(*v_slide) > 1e-3, mu_0, mu)"),
    Mistake("coefficients of the last outer foot from the inner ones", ("T6", "T3", "T2"), "    found = [\n",
            "    made[4:, len(r) // 2 - 1] = made[4:, -1]\n    found = [\n"),
    Mistake("sliding force with the other sign", ("T3",), T3, "-" + T3),
    Mistake("normal damper where the anchor is moved", ("T4",), AFTER, AFTER.replace("C_T", "C_N")),
    # The body.
    Mistake("the weight along Y of the plate", ("A1",), "[0, 0, mass * g]", "[0, mass * g, 0]"),
    Mistake("levers turned back in the moment alone", ("A2",), SUMS, SUMS.replace("r, F", "points.P @ Lambda, F")),
    Mistake("the mean of the moments for their sum", ("A2",), MOMENT, MOMENT.replace("sum", "mean")),
    Mistake("forces in body axes, levers in plate axes", ("A3", "A2"), "return force, moment, Lambda.T @ moment",
            "return force, moment, np.cross(r, F @ Lambda).sum(axis=0)"),
    Mistake("forces of the feet read by columns", ("A1", "A2"), SUMS, SUMS.replace("F,", "F.reshape(3, -1).T,")),
    Mistake("a loop over the feet that begins at the second", ("N1", "A1"), FORCES, FORCES + "    F[0] = 0\n"),
    # The step.
    Mistake("the step for its square in the place", ("I1",), PLACE, "x_next = x + h * v + h / 2 * a  # I1"),
    Mistake("half of the step for the pose, the whole for the velocities", ("I1", "I2", "I3", "S1"), TAKEN_STEP,
            TAKEN_STEP.replace("h, J", "h / 2, J"), True,
            ((ONE_STEP, 'v_p, W_p = 2 * v_p - state["v"], 2 * W_p - state["W"]\n    ' + ONE_STEP),)),
    Mistake("multiplied by the inertia, not divided", ("I2", "S1"), SPEED, "J @ (T - np.cross(W, J @ W))"),
    Mistake("increment read by columns, multiplied from the other side", ("I3",), TURNED,
            "Lambda_next = Lambda + E.T @ Lambda"),
    Mistake("half of the angle twice", ("I3",), "x, y, z = Theta", "x, y, z = np.asarray(Theta) / 2"),
    Mistake("the square of the turn not divided by that of the angle", ("I3",), E,
            "return np.sin(angle) / angle * H + 2 * np.sin(angle / 2) ** 2 * H @ H"),
    Mistake("turned to first order, columns of length one", ("I3",), TURNED, COLUMNS),
    Mistake("the whole step with both accelerations", ("I4",), KICK, KICK.replace("h / 2", "h")),
    Mistake("the old moment by the whole step", ("I5",), HALF, "half = J @ W + h * T", True,
            ((GAIN, GAIN.replace("h / 2 * T +", "h * T +")),)),
    Mistake("the old loads twice", ("I4", "I5"), FIRST,
            FIRST.replace("a, T, h", 'state["a"], state["T"], h')),
    Mistake("velocities predicted by the accelerations of the step before", ("S1",), ONE_STEP,
            'v_p = state["v"] + h * state.get("old", state["a"])\n    ' + ONE_STEP, True,
            ((ADVANCED, '"F": F, "old": state["a"], **memory}'),)),
    # The run.
    Mistake("rows begin an interval after the start", ("S2",), '"t": wanted * problem.step',
            '"t": wanted[1:] * problem.step', True, ((ROWS, ROWS.replace("in kept", "in kept[1:]")),)),
    Mistake("numbers of steps for instants", ("S2",), '"t": wanted * problem.step', '"t": wanted * 1.0'),
    Mistake("no foot is tied at the start", ("S2", "T5"), UNSTARTED,
            '    state["anchored"] = np.zeros_like(state["anchored"])\n' + UNSTARTED),
    Mistake("the place of the start is taken for that of the base", ("S2", "K1"), UNSTARTED,
            '    state["x"] = state["x"] + 0.344 * state["Lambda"][:, 2]\n' + UNSTARTED),
    Mistake("rates of the start taken for degrees", ("S2", "K1", "I3"), UNSTARTED,
            '    state["W"] = np.radians(state["W"])\n' + UNSTARTED),
)  # fmt: skip

STAGES = """\
        ways = [h * sum(c * k for c, k in zip(row, ks, strict=True)) for ks in zip(*rates, strict=True)]
        at = x + ways[0], turned(Lambda, ways[1]), v + ways[2], W + ways[3]
        a_n, T_n, _, _ = evaluate(problem, state, *at)
        rates.append((at[2], at[3], a_n, spun(at[3], T_n)))
"""
LAST = """\
    x, Lambda = x + h * mean[0], turned(Lambda, h * mean[1])
    v, W = v + h * mean[2], W + h * mean[3]
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
THREE_EIGHTHS = f"""\
    rates = [(v, W, a, spun(W, T))]
    for row in ((1 / 3,), (-1 / 3, 1.0), (1.0, -1.0, 1.0)):
{STAGES}\
    mean = [(k[0] + 3 * k[1] + 3 * k[2] + k[3]) / 8 for k in zip(*rates, strict=True)]
{LAST}"""
DORMAND_PRINCE = f"""\
    table = (
        (1 / 5,), (3 / 40, 9 / 40), (44 / 45, -56 / 15, 32 / 9),
        (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
        (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    )
    rates = [(v, W, a, spun(W, T))]
    for row in table:
{STAGES}\
    weights = (35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84)
    mean = [sum(c * k for c, k in zip(weights, ks, strict=True)) for ks in zip(*rates, strict=True)]
{LAST}"""
HILBER_HUGHES_TAYLOR = """\
    b, c, S = 0.3025, 0.6, spun(W, T)
    a_0, A_0 = state.get("used", (a, S))
    a_n, A_n = a_0, A_0
    for _ in range(5):
        v_n, W_n = v + h * ((1 - c) * a_0 + c * a_n), W + h * ((1 - c) * A_0 + c * A_n)
        x_n = x + h * v + h * h * ((0.5 - b) * a_0 + b * a_n)
        Lambda_n = turned(Lambda, h * W + h * h * ((0.5 - b) * A_0 + b * A_n))
        f_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        a_n, A_n = 0.9 * f_n + 0.1 * a, 0.9 * spun(W_n, T_n) + 0.1 * S
    memory = memory | {"used": (a_n, A_n)}
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, f_n, T_n
"""
OF_A_QUATERNION = """\
    from scipy.spatial.transform import Rotation

    def slope(q, W):
        return np.array([*(q[3] * W + np.cross(q[:3], W)), -q[:3] @ W]) / 2

    q = Rotation.from_matrix(Lambda).as_quat()
    rates = [(v, slope(q, W), a, spun(W, T))]
    for share in (0.5, 0.5, 1.0):
        x_n, q_n, v_n, W_n = (y + share * h * k for y, k in zip((x, q, v, W), rates[-1], strict=True))
        a_n, T_n, _, _ = evaluate(problem, state, x_n, Rotation.from_quat(q_n).as_matrix(), v_n, W_n)
        rates.append((v_n, slope(q_n, W_n), a_n, spun(W_n, T_n)))
    mean = [(k[0] + 2 * k[1] + 2 * k[2] + k[3]) / 6 for k in zip(*rates, strict=True)]
    x, q, v, W = (y + h * k for y, k in zip((x, q, v, W), mean, strict=True))
    Lambda = Rotation.from_quat(q).as_matrix()
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
SCHEMES = {
    "three eighths": THREE_EIGHTHS, "Dormand-Prince": DORMAND_PRINCE, "Hilber-Hughes-Taylor": HILBER_HUGHES_TAYLOR,
    "Runge-Kutta of a quaternion": OF_A_QUATERNION,
}  # fmt: skip

#: What the weights of all stages are wrong in.
ALL = ("I1", "I3", "I4", "I5", "S2")
#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("eight eighths over six", ALL, "3 * k[2] + k[3]) / 8", "3 * k[2] + k[3]) / 6"), "three eighths"),
    (Mistake("half of the mean turn", ("I3",), "turned(Lambda, h * mean[1])", "turned(Lambda, h / 2 * mean[1])"),
     "three eighths"),
    (Mistake("gyroscopic moment of the stages with the other sign", EULER, "a_n, spun(at[3], T_n)",
             "a_n, np.linalg.solve(J, T_n + np.cross(at[3], J @ at[3]))"), "three eighths"),
    (Mistake("a weight with the other sign", ALL, "-2187 / 6784", "2187 / 6784"), "Dormand-Prince"),
    (Mistake("no gyroscopic moment after the first stage", EULER, "a_n, spun(at[3], T_n)",
             "a_n, np.linalg.solve(J, T_n)"), "Dormand-Prince"),
    (Mistake("the mean of the moments left in plate axes", ("A3", "I5", "I2"), "spun(at[3], T_n)",
             "spun(at[3], at[1] @ T_n)"), "Dormand-Prince"),
    (Mistake("shares of both loads that do not add up", ("I4", "A1"), "0.9 * f_n + 0.1 * a", "0.9 * f_n + 0.2 * a"),
     "Hilber-Hughes-Taylor"),
    (Mistake("no gyroscopic moment in the new share", EULER, "0.9 * spun(W_n, T_n)", "0.9 * np.linalg.solve(J, T_n)"),
     "Hilber-Hughes-Taylor"),
    (Mistake("half of the turn by the old rates", ("I3",), "turned(Lambda, h * W + h * h * ((0.5",
             "turned(Lambda, h / 2 * W + h * h * ((0.5"), "Hilber-Hughes-Taylor"),
    (Mistake("slope of a quaternion without its half", ("I3",), "-q[:3] @ W]) / 2", "-q[:3] @ W])"),
     "Runge-Kutta of a quaternion"),
    (Mistake("slope of a quaternion that has its scalar first", ("I3",),
             "[*(q[3] * W + np.cross(q[:3], W)), -q[:3] @ W]", "[-q[1:] @ W, *(q[0] * W + np.cross(q[1:], W))]"),
     "Runge-Kutta of a quaternion"),
    (Mistake("slope of a quaternion by rates in plate axes", ("I3",), "np.cross(q[:3], W)", "np.cross(W, q[:3])"),
     "Runge-Kutta of a quaternion"),
)  # fmt: skip

TOUCHING_ALONE = """    found = [
        {"F_N": 0.0, "F_T": np.zeros(2), "s": u[i, :2], "touching": False, "sliding": False}
        if xi[i] < 0
        else contact_law(
"""
IN_PLACE = """    state = {k: None if value is None else np.array(value) for k, value in state.items()}
    if state["a"] is None:
"""
OVERWRITE = """    made = {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}
    for key, value in made.items():
        state[key][...] = value
    return state
"""
BY_POLAR_ANGLES = """angles = np.arctan2([depth, depth, -depth, -depth], [width, -width, -width, width])
    to = np.hypot(width, depth) / 2
    corners, inner = (q * np.column_stack([np.cos(angles), np.sin(angles)]) for q in (to, to - delta_diag))
"""
BY_TRIPLES = """    force = F.sum(axis=0) - [0, 0, mass * g]
    moment = np.cross(r, F).sum(axis=0)
    return force, moment, np.array([(np.cross(axis, r) * F).sum() for axis in Lambda.T])
"""
BY_EIGENVALUES = """w, Q = np.linalg.eigh(1j * H)
    return ((Q * np.expm1(-1j * w)) @ Q.conj().T).real"""
BY_ROTATION_VECTOR = """from scipy.spatial.transform import Rotation

    kept = Rotation.from_matrix(Lambda + Lambda @ E).as_rotvec()
    Lambda_next = Rotation.from_rotvec(kept).as_matrix()"""
POOL = """def evaluate(problem, memory, x, Lambda, v, W, pool=ThreadPoolExecutor(2)):
"""
FACTORS = '''def solved(J, b):
    """By an orthogonal factor and a triangle."""
    Q, R = np.linalg.qr(J)
    return np.linalg.solve(R, Q.T @ b)


def first_half('''
IN_PYTHON = (
    Variant("feet that touch alone are gone through", (("    found = [\n        contact_law(\n", TOUCHING_ALONE),)),
    Variant("exponential by the eigenvalues of the turn", ((E, BY_EIGENVALUES),)),
    Variant("a rotation vector is what is kept of the attitude", ((TURNED, BY_ROTATION_VECTOR),)),
    Variant("states overwritten in place, rows copied",
            ((UNSTARTED, IN_PLACE), ("                kept.append(state)\n",
              "                kept.append({k: np.array(value) for k, value in state.items()})\n"),
             ('    return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}\n', OVERWRITE))),
    Variant("kilonewtons",
            ((SUM, "    force = 1e3 * ((F / 1e3).sum(axis=0) - [0, 0, mass * g / 1e3])\n"
              "    moment = 1e3 * np.cross(r, F / 1e3).sum(axis=0)\n"),)),
    Variant("feet summed by the size of their forces",
            ((SUM, "    order = np.argsort(np.abs(F).sum(axis=1))\n    r, F = r[order], F[order]\n" + SUM),)),
    Variant("x and y written apart",
            ((STRETCH, "x, y = u_t[0] - s[0], u_t[1] - s[1]\n"
              "    return np.array([-(K_T * x + C_T * v_slide[0]), -(K_T * y + C_T * v_slide[1])])"),
             ("return np.hypot(*F_trial) <= limit",
              "return (F_trial[0] ** 2 + F_trial[1] ** 2) ** 0.5 <= limit"))),
    Variant("inertia by an orthogonal factor and a triangle",
            (("def first_half(", FACTORS), (SOLVED, SOLVED.replace("np.linalg.solve", "solved")),
             ("W + np.linalg.solve(J, gain)", "W + solved(J, gain)"))),
    Variant("moment about each axis of the block by a triple product",
            ((SUM + "    return force, moment, Lambda.T @ moment\n", BY_TRIPLES),)),
    Variant("feet by two threads",
            (("import numpy as np\n", "from concurrent.futures import ThreadPoolExecutor\n\nimport numpy as np\n"),
             ("def evaluate(problem, memory, x, Lambda, v, W):\n", POOL),
             ("    found = [\n        contact_law(\n",
              "    tasks = [\n        pool.submit(\n            contact_law,\n"),
             ("        for i in range(len(r))\n    ]\n",
              "        for i in range(len(r))\n    ]\n    found = [task.result() for task in tasks]\n"))),
    Variant("inertia by radii of gyration",
            (("mass / 12 * np.diag(" + MOMENTS + ")",
              "mass * np.diag((np.hypot([depth, width, width], [height, height, depth]) / np.sqrt(12)) ** 2)"),)),
    Variant("points by polar angles",
            (("corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * [width / 2, depth / 2]\n", BY_POLAR_ANGLES),
             ("    inwards = 1 - delta_diag / (np.hypot(width, depth) / 2)\n", ""), ("corners * inwards", "inner"))),
    Variant("momentum turned back by solving with the turn",
            (("E.T @ half", "np.linalg.solve(np.eye(3) + E, half) - half"),)),
)  # fmt: skip
IN_C = (
    Variant("the C text, registers of eighty bits", flags=("-O2", "-mfpmath=387")),
    Variant("the C text, lanes and no errors kept",
            flags=("-O3", "-march=native", "-fno-math-errno", "-ffp-contract=off")),
)  # fmt: skip
