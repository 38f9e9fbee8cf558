"""A nineteenth list of strangers: what a program loses between two languages, and what was cut off for safety.

Feet counted from one, a library's other convention (sinc, quaternions, element by element), arrays that are overwritten
while they are read, values of the step before, caps that were meant as a guard, dead zones, single and half precision,
units, one axis for its neighbour; integrators of structural dynamics, and the oldest of the third order. Mistakes and
variants were written down, and published, before any of them was judged; that the integrators converge to the law was
looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import GAIN, SOLVED, TURNED, E, Variant
from strangers.list_01 import FIRST, N1, SPEED, T3, Mistake
from strangers.list_04 import EULER, FOUND, MOVED, UNSTARTED
from strangers.list_05 import CONE, MADE, ROWS, SUMS
from strangers.list_07 import ADVANCED, AFTER
from strangers.list_12 import INCREMENT, KICK, MOMENT, NORMAL, PLACE, SUMMED
from strangers.list_13 import DEPTH
from strangers.list_14 import BACK, STRETCH
from strangers.list_16 import LEVERS
from strangers.list_17 import ALL, HALF, LAST, MOMENTS, STAGES
from strangers.list_18 import CORNERS, KEPT_ROW, STICKS

PREDICTED = "v + h * a, W + h * A, E"
TIED = "anchor_before(xi, u_t, s, anchored)\n    trace"
CHOSEN = "return s if anchored and xi >= 0 else u_t"
SLIDING_ROW = 'memory["sliding"][i]'
MEAN_OF_RATES = """    rate = v + np.cross(Lambda @ (W + memory.get("W", W)) / 2, r)
    xi_rate, v_slide = -rate[:, 2], rate[:, :2]
"""
TO_THE_NEXT = """kept = {k: np.array([c[name] for c in found]) for k, name in keys.items()}
    slid = np.flatnonzero(kept["sliding"])
    moved, kept["s"][slid] = kept["s"][slid], np.asarray(memory["s"])[slid]
    kept["s"][np.minimum(slid + 1, len(r) - 1)] = moved
    return force / block.mass, T, F, kept"""
COLUMN_BY_COLUMN = """Lambda_next = np.array(Lambda, float)
    for j in range(3):
        Lambda_next[:, j] += Lambda_next @ E[:, j]"""
BY_QUATERNION = """from scipy.spatial.transform import Rotation

    q = Rotation.from_matrix(Lambda).as_quat()
    return force, moment, Rotation.from_quat(np.roll(q, 1)).inv().apply(moment)"""
LATE_FLAGS = """{"late": memory["sliding"]}"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("third moment of a round bar", ("G1",), "width**2 + depth**2])", "1.5 * width**2])", False),
    Mistake("inner feet on the middles of the sides", ("G2",), "corners * inwards",
            "(corners + np.roll(corners, -1, axis=0)) / 2 * inwards", False),
    Mistake("heights of the outer feet in whole tenths of a millimetre", ("G2",), "delta_long - height / 2",
            "np.round(delta_long, 4) - height / 2", False),
    Mistake("the damping ratio squared", ("P2",), "2 * beta * np", "2 * beta**2 * np", False),
    Mistake("the static coefficients a tenth above the dynamic ones", ("P3", "T6"), '"mu_0": mu', '"mu_0": 1.1 * mu',
            False),
    Mistake("the axis of the height first in the channel", ("M1",), "np.degrees(W)", "np.degrees(W)[:, [2, 0, 1]]",
            False),
    Mistake("a gyroscope that ends at a hundred degrees a second", ("M1",), "np.degrees(W)",
            "np.clip(np.degrees(W), -100, 100)", False),
    # Points.
    Mistake("feet counted from one", ("K1",), LEVERS,
            "    r = P[np.minimum(np.arange(len(P)) + 1, len(P) - 1)] @ Lambda.T\n"),
    Mistake("feet in the plane of the centre of mass", ("K1",), LEVERS, "    r = (P * [1, 1, 0]) @ Lambda.T\n"),
    Mistake("penetration without its sign", ("K1", "N2"), DEPTH, DEPTH.replace("-u[:, 2]", "np.abs(u[:, 2])")),
    Mistake("places of the feet in whole micrometres", ("K1",), "    u = x + r\n", "    u = np.round(x + r, 6)\n"),
    Mistake("x of the sliding velocity is that of the centre", ("K1",), DEPTH,
            DEPTH.replace("rate[:, :2]", "np.column_stack([np.full(len(r), v[0]), rate[:, 1]])")),
    Mistake("velocities of the feet by the mean of the rates now and before", ("K1", "S1"), MOVED,
            MOVED + MEAN_OF_RATES),
    Mistake("a normal force below a newton is none", ("N1",), NORMAL, NORMAL + "\n    F_N = F_N if F_N >= 1 else 0.0"),
    Mistake("the damper takes half of the spring at most", ("N1",), N1,
            N1.replace("C_N * xi_rate", "max(C_N * xi_rate, -K_N * xi / 2)")),
    Mistake("a second spring from ten micrometres on", ("N1",), N1,
            N1.replace("K_N * xi", "K_N * (xi + max(xi - 1e-5, 0.0))")),
    Mistake("constants of the feet in single precision", ("N1", "T1", "T6", "T3"), MADE,
            MADE + "    made = made.astype(np.float32).astype(float)\n"),
    Mistake("feet in the air are damped by a thousandth", ("N2",), N1,
            N1.replace("else 0.0", "else 1e-3 * C_N * xi_rate")),
    Mistake("a new anchor with the other sign", ("T5",), CHOSEN, "return s if anchored and xi >= 0 else -u_t"),
    Mistake("a new foot is tied to where it will be a step later", ("T5",), TIED,
            "anchor_before(xi, u_t, s, anchored)\n    s = s if anchored else s + 1e-5 * v_slide\n    trace"),
    Mistake("a foot that is struck is tied anew", ("T5",), TIED,
            "anchor_before(xi, u_t, s, anchored and xi_rate < 0.1)\n    trace"),
    Mistake("no anchors beyond the eighth foot", ("T5", "S2"), 'memory["anchored"][i]',
            'memory["anchored"][i] and i < 8'),
    Mistake("the stretch against the velocity, not along itself", ("T1",), STRETCH,
            "size = np.hypot(*(u_t - s)) / max(np.hypot(*v_slide), 1e-300)\n"
            "    return -(K_T * size + C_T) * np.asarray(v_slide)"),
    Mistake("the velocity along x in both dampers of friction", ("T1",), STRETCH,
            STRETCH.replace("C_T * v_slide", "C_T * v_slide[0]")),
    Mistake("a tenth of a micrometre of play in the spring of friction", ("T1",), STRETCH,
            STRETCH.replace("(u_t - s)", "np.sign(u_t - s) * np.maximum(np.abs(u_t - s) - 1e-7, 0)")),
    Mistake("the smaller component is held to the threshold", ("T2",), STICKS, "np.abs(F_trial).min() <= limit"),
    Mistake("a foot that moves back sticks", ("T2",), "slides = not sticks(F_T, limit)",
            "slides = not sticks(F_T, limit) and bool(F_T @ v_slide < 0)"),
    Mistake("threshold by the mean of the normal forces", ("T6", "T2"), CONE, CONE.replace("F_N", "F_mean"), True,
            (("C_T, mu_0, mu):\n", "C_T, mu_0, mu, F_mean):\n"),
             ("    found = [\n", "    pushed = [normal_force(xi[i], xi_rate[i], *made[:2, i]) for i in range(len(r))]\n"
              "    mean = sum(pushed) / max(1, np.sum(xi >= 0))\n    found = [\n"),
             ("*made[:, i],", "*made[:, i], mean,"),
             ("return contact_law(**q)", "return contact_law(**q, F_mean=normal_force(q['xi'], q['xi_rate'], q['K_N'],"
              " q['C_N']))"))),
    Mistake("flags of sliding a step late", ("T6", "S2"), SLIDING_ROW, 'memory.get("late", memory["sliding"])[i]', True,
            ((FOUND, FOUND + " | " + LATE_FLAGS),)),
    Mistake("the smaller of both coefficients for every foot", ("T6",), "(mu if was_sliding else mu_0)",
            "min(mu, mu_0)"),
    Mistake("x and y exchanged in the sliding force", ("T3",), "return " + T3, "return " + T3 + "[::-1]"),
    Mistake("what is above the threshold for the sliding force", ("T3",), "sliding_force(F_T, F_N, mu)\n        s",
            "F_T * (1 - limit / np.hypot(*F_T))\n        s"),
    Mistake("x and y of the force exchanged where the anchor is moved", ("T4",), AFTER,
            AFTER.replace("(F_T,", "(F_T[::-1],")),
    Mistake("an anchor moves by two tenths of a micrometre at most", ("T4",), AFTER,
            AFTER + "        s = trace['s_trial'] + np.clip(s - trace['s_trial'], -2e-7, 2e-7)\n"),
    Mistake("the anchor of a foot that slides is written to the next one", ("T4", "T5"), FOUND, TO_THE_NEXT),
    # The body.
    Mistake("y of the sum of forces is that along x", ("A1",), SUMMED, SUMMED.replace("axis=0)", "axis=0)[[0, 0, 2]]")),
    Mistake("the sum of forces in tenths of a newton", ("A1",), SUMMED,
            SUMMED.replace("F.sum(axis=0)", "np.round(F.sum(axis=0), 1)")),
    Mistake("forces of the feet taken for body axes in the sum", ("A1",), SUMMED,
            SUMMED.replace("F.sum", "(F @ Lambda.T).sum")),
    Mistake("levers in half precision in the moment", ("A2",), SUMS,
            SUMS.replace("r,", "r.astype(np.float16).astype(float),")),
    Mistake("the moment never above forty newton metres", ("A2",), MOMENT,
            "moment = np.clip(np.cross(r, F).sum(axis=0), -40, 40)"),
    Mistake("x and y of the moment exchanged where it is turned back", ("A3",), BACK, BACK + "[[1, 0, 2]]"),
    Mistake("moment turned back by a quaternion that has its scalar last", ("A3",), BACK, BY_QUATERNION),
    # The step.
    Mistake("half of the way of the velocity", ("I1",), PLACE, "x_next = x + h / 2 * v + h * h / 2 * a"),
    Mistake("the centre of mass never below half of a height", ("I1",), PLACE,
            PLACE.replace("  # I1", "\n    x_next = np.maximum(x_next, [-np.inf, -np.inf, 0.344])")),
    Mistake("place kept in single precision", ("I1",), PLACE,
            "x_next = (x + h * v + h * h / 2 * a).astype(np.float32).astype(float)"),
    Mistake("inverse of the inertia in single precision", ("I2", "S1"), SPEED,
            "np.linalg.inv(J).astype(np.float32).astype(float) @ (T - np.cross(W, J @ W))"),
    Mistake("the angular acceleration in plate axes in the increment", ("I2",), INCREMENT,
            INCREMENT.replace("2 * A", "2 * Lambda @ A")),
    Mistake("the square of the turn element by element", ("I3",), E, E.replace("H @ H", "H * H")),
    Mistake("sinc without its pi", ("I3",), E, E.replace("np.sin(angle) / angle * H", "np.sinc(angle) * H")),
    Mistake("attitude overwritten column by column while it is turned", ("I3",), TURNED, COLUMN_BY_COLUMN),
    Mistake("a step turns by a milliradian at most", ("I3", "I2"), "x, y, z = Theta",
            "x, y, z = np.clip(Theta, -1e-3, 1e-3)"),
    Mistake("velocity kept in single precision", ("I4",), KICK,
            "v_next = (v + h / 2 * (a + a_next)).astype(np.float32).astype(float)"),
    Mistake("the height's velocity by the old acceleration alone", ("I4",), KICK,
            KICK.replace("a_next)", "[a_next[0], a_next[1], a[2]])")),
    Mistake("the mean of the principal moments in the gain of the rates", ("I5",), GAIN,
            "W + gain / (np.trace(J) / 3)"),
    Mistake("momentum turned back by the increment of the step before", ("I5",), FIRST,
            FIRST.replace("h, J, E)", 'h, J, state.get("E", E))'), True, ((ADVANCED, '"F": F, "E": E, **memory}'),)),
    Mistake("rates for the momentum that is turned back", ("I5",), HALF, "half = W + h / 2 * T"),
    Mistake("no weight in the predicted velocity", ("S1",), PREDICTED, "v + h * (a + [0, 0, 9.81]), W + h * A, E"),
    Mistake("a step that is a number where the velocities are predicted", ("S1",), PREDICTED,
            "v + 1e-5 * a, W + 1e-5 * A, E"),
    # The run.
    Mistake("rate of the rows in whole hertz", ("S2",), "np.arange(rows) / (problem.output_rate *",
            "np.arange(rows) / (int(problem.output_rate) *"),
    Mistake("attitude handed out a step late", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row.get("late", row[k]) if k == "Lambda" else row[k] for'), True,
            ((ADVANCED, '"F": F, "late": state["Lambda"], **memory}'),)),
    Mistake("the last row is a step late", ("S2",), KEPT_ROW,
            KEPT_ROW.replace("(state)", "(advanced(problem, state) if len(kept) == rows - 1 else state)")),
    Mistake("forces handed out in body axes", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row[k] @ row["Lambda"] if k == "F" else row[k] for')),
    Mistake("anchors of the start counted from the centre of mass", ("S2", "T5", "T1"), UNSTARTED,
            '    state["s"] = state["s"] + state["x"][:2]\n' + UNSTARTED),
    Mistake("velocity of the start counted downwards", ("S2", "K1", "I1"), UNSTARTED,
            '    state["v"] = state["v"] * [1, 1, -1]\n' + UNSTARTED),
    Mistake("feet are tied anew where a row is kept", ("S2", "T5"), KEPT_ROW,
            KEPT_ROW + '                state = state | {"anchored": np.zeros_like(state["anchored"])}\n'),
)  # fmt: skip

#: What dwindles with the step, and is no mistake in another integrator.
OF_THE_STEP = (
    "velocities of the feet by the mean of the rates now and before", "flags of sliding a step late",
    "a new foot is tied to where it will be a step later", "attitude handed out a step late",
    "the last row is a step late",
)  # fmt: skip

KUTTA = f"""\
    rates = [(v, W, a, spun(W, T))]
    for row in ((1 / 2,), (-1.0, 2.0)):
{STAGES}\
    mean = [(k[0] + 4 * k[1] + k[2]) / 6 for k in zip(*rates, strict=True)]
{LAST}"""
GAUSS = f"""\
    root = np.sqrt(3) / 6
    rates = [(v, W, a, spun(W, T))] * 2
    for _ in range(8):
        made = []
        for row in ((1 / 4, 1 / 4 - root), (1 / 4 + root, 1 / 4)):
            ways = [h * sum(c * k for c, k in zip(row, ks, strict=True)) for ks in zip(*rates, strict=True)]
            at = x + ways[0], turned(Lambda, ways[1]), v + ways[2], W + ways[3]
            a_n, T_n, _, _ = evaluate(problem, state, *at)
            made.append((at[2], at[3], a_n, spun(at[3], T_n)))
        rates = made
    mean = [(k[0] + k[1]) / 2 for k in zip(*rates, strict=True)]
{LAST}"""
BATHE = """\
    a_1, A_1, S = a, spun(W, T), spun(W, T)
    for _ in range(5):
        v_1, W_1 = v + h / 4 * (a + a_1), W + h / 4 * (S + A_1)
        way, turn = h / 4 * (v + v_1), h / 4 * (W + W_1)
        a_1, T_1, _, half = evaluate(problem, state, x + way, turned(Lambda, turn), v_1, W_1)
        A_1 = spun(W_1, T_1)
    a_n, A_n = a_1, A_1
    for _ in range(5):
        v_n, W_n = (4 * v_1 - v + h * a_n) / 3, (4 * W_1 - W + h * A_n) / 3
        x_n, Lambda_n = x + (4 * way + h * v_n) / 3, turned(Lambda, (4 * turn + h * W_n) / 3)
        a_n, T_n, F, memory = evaluate(problem, half, x_n, Lambda_n, v_n, W_n)
        A_n = spun(W_n, T_n)
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
WILSON = """\
    k, S = 1.4 * h, spun(W, T)
    a_k, A_k = a, S
    for _ in range(5):
        x_k, v_k = x + k * v + k * k / 6 * (2 * a + a_k), v + k / 2 * (a + a_k)
        Lambda_k, W_k = turned(Lambda, k * W + k * k / 6 * (2 * S + A_k)), W + k / 2 * (S + A_k)
        a_k, T_k, _, _ = evaluate(problem, state, x_k, Lambda_k, v_k, W_k)
        A_k = spun(W_k, T_k)
    a_n, A_n = a + (a_k - a) / 1.4, S + (A_k - S) / 1.4
    x, Lambda = x + h * v + h * h / 6 * (2 * a + a_n), turned(Lambda, h * W + h * h / 6 * (2 * S + A_n))
    v, W = v + h / 2 * (a + a_n), W + h / 2 * (S + A_n)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
SCHEMES = {"Kutta": KUTTA, "Gauss": GAUSS, "Bathe": BATHE, "Wilson": WILSON}

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("the mean turn in degrees", ("I3",), "turned(Lambda, h * mean[1])",
             "turned(Lambda, np.degrees(h * mean[1]))"), "Kutta"),
    (Mistake("the sum of the accelerations over five, not six", ("I4", "A1"), "v + h * mean[2]",
             "v + h * mean[2] * 6 / 5"), "Kutta"),
    (Mistake("products of inertia left out of the gyroscopic moment of the stages", EULER, "spun(at[3], T_n)",
             "np.linalg.solve(J, T_n - np.cross(at[3], np.diag(J) * at[3]))"), "Kutta"),
    (Mistake("both stages with a weight of a third", ALL, "(k[0] + k[1]) / 2", "(k[0] + k[1]) / 3"), "Gauss"),
    (Mistake("moment of both stages turned back once more", ("A3", "I5", "I2"), "spun(at[3], T_n)",
             "spun(at[3], at[1].T @ T_n)"), "Gauss"),
    (Mistake("no weight in the stages", ("A1", "I4"), "at[3], a_n,", "at[3], a_n + [0, 0, 9.81],"), "Gauss"),
    (Mistake("three times the rates of the first half, not four times", ("I5", "I2"), "4 * W_1 - W", "3 * W_1 - W"),
     "Bathe"),
    (Mistake("half of the last velocity in the place of the second half", ("I1",), "h * v_n) / 3", "h / 2 * v_n) / 3"),
     "Bathe"),
    (Mistake("the turn of the first half not carried over", ("I3",), "(4 * turn + h * W_n) / 3", "h * W_n / 3"),
     "Bathe"),
    (Mistake("the old acceleration left out of the velocity", ("I4", "A1"), "h / 2 * (a + a_n)", "h / 2 * a_n"),
     "Wilson"),
    (Mistake("no gyroscopic moment where the step begins", EULER, "1.4 * h, spun(W, T)",
             "1.4 * h, np.linalg.solve(J, T)"), "Wilson"),
    (Mistake("the place of the longer step is kept", ("I1", "S2"), "x + h * v + h * h / 6 * (2 * a + a_n), turned",
             "x_k, turned"), "Wilson"),
)  # fmt: skip

CONJUGATE_GRADIENTS = '''def solved(J, b):
    """By conjugate gradients."""
    q, left = np.zeros(3), np.array(b, float)
    way = left
    for _ in range(9):
        if not left @ left > 0:
            break
        share = left @ left / (way @ J @ way)
        q, rest = q + share * way, left - share * (J @ way)
        left, way = rest, rest + rest @ rest / (left @ left) * way
    return q


def first_half('''
BY_CAYLEY = """S = np.tan(angle / 4) / angle * H
    half = np.linalg.solve(np.eye(3) - S, 2 * S)
    return 2 * half + half @ half"""
BY_OUTER_PRODUCT = """u = np.asarray(Theta) / angle
    return np.sin(angle) / angle * H - 2 * np.sin(angle / 2) ** 2 * (np.eye(3) - np.outer(u, u))"""
OF_SIX = """masses = np.block([[np.eye(3), np.zeros((3, 3))], [np.zeros((3, 3)), J]])
    both = np.linalg.solve(masses, [*(h / 2 * (a + a_next)), *gain])
    return v + both[:3], W + both[3:]"""
IN_PYTHON = (
    Variant("forces summed in body axes, turned forth at last",
            ((SUMMED, "force = Lambda @ (F @ Lambda).sum(axis=0) - [0, 0, mass * g]"),)),
    Variant("levers by a rotation class of a library",
            ((LEVERS, "    from scipy.spatial.transform import Rotation\n\n"
              "    r = Rotation.from_matrix(Lambda).apply(P)\n"),)),
    Variant("exponential by Cayley's transform of half the turn, stretched", ((E, BY_CAYLEY),)),
    Variant("exponential by the outer product of the axis", ((E, BY_OUTER_PRODUCT),)),
    Variant("place by the powers of the step",
            ((PLACE, "x_next = np.array([1, h, h * h / 2]) @ np.array([x, v, a])"),)),
    Variant("places of a foot counted from a mark on the table",
            (("    F_N = normal_force(xi, xi_rate, K_N, C_N)\n",
              "    u_t, s = u_t + MARK, s + MARK\n    F_N = normal_force(xi, xi_rate, K_N, C_N)\n"),
             ('"F_T": F_T, "s": s, "touching": True', '"F_T": F_T, "s": s - MARK, "touching": True'),
             ('{"F_N": F_N, "F_T": np.zeros(2), "s": s,', '{"F_N": F_N, "F_T": np.zeros(2), "s": s - MARK,'),
             ('trace = {"s_trial": s, "F_trial"', 'trace = {"s_trial": s - MARK, "F_trial"'),
             ("PROPERTIES = (", "MARK = np.array([0.05, -0.03])\nPROPERTIES = ("))),
    Variant("the angle of friction for its coefficient",
            (("(mu if was_sliding else mu_0) * F_N", "np.tan(np.arctan(mu if was_sliding else mu_0)) * F_N"),
             ("return " + T3, "return np.tan(np.arctan(mu)) * F_N / np.hypot(*F_trial) * F_trial"))),
    Variant("normal force by a step function",
            ((N1, "float(np.heaviside(xi, 1.0)) * max(K_N * xi + C_N * xi_rate, 0.0)"),)),
    Variant("inertia solved for by conjugate gradients",
            (("def first_half(", CONJUGATE_GRADIENTS), (SOLVED, SOLVED.replace("np.linalg.solve", "solved")),
             (GAIN, "W + solved(J, gain)"))),
    Variant("inertia by the second moments of the mass",
            (("mass / 12 * np.diag(" + MOMENTS + ")",
              "np.trace(S := mass / 12 * np.diag([width**2, depth**2, height**2])) * np.eye(3) - S"),)),
    Variant("corners by a complex number and its conjugate",
            ((CORNERS, "np.array([(z.real, z.imag) for c in [complex(width, depth) / 2]"
              " for z in (c, -c.conjugate(), -c, c.conjugate())])"),)),
    Variant("the four under the root", (("2 * beta * np.sqrt(K * mass)", "beta * np.sqrt(4 * K * mass)"),)),
    Variant("degrees by minutes of arc", (("np.degrees(W)", "np.asarray(W) * (10800 / np.pi) / 60"),)),
    Variant("the trial force projected on itself", ((STICKS, "F_trial @ F_trial <= limit * np.hypot(*F_trial)"),)),
    Variant("velocity and rates by one matrix of six", (("return v_next, " + GAIN, OF_SIX),)),
)  # fmt: skip
IN_C = (
    Variant("the C text, for size", flags=("-Os",)),
    Variant(
        "C, exponential by a series",
        (
            ("real first = t > 0 ? sin(size) / size : 1, second = t > 0 ? 2 * half * half / t : 0.5;",
             "real first = 1, second = 0.5, term = 1;\n    for (int k = 1; k < 24; k++)\n"
             "        term *= -t / (2 * k * (2 * k + 1)), first += term, second += term / (2 * k + 2);\n"
             "    (void)half;"),
        ),
    ),
)  # fmt: skip
