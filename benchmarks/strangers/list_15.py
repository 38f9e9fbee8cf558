"""A fifteenth list of strangers: simulators that are differentiated, and integrators that look back or repeat.

Maxima and switches that are smoothed, sliding friction that falls with the speed, levers by Euler's angles, floors and
limits on velocities, rates that wrap round; integrators that are implicit, that damp, that act on the group of turns,
or choose their own steps. Mistakes and variants were written down, and published, before any of them was judged; that
the integrators converge to the law was looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import SUM, TURNED, E, Variant
from strangers.list_01 import N1, SPEED, T3, Mistake
from strangers.list_04 import EULER, FOUND, MOVED, UNSTARTED
from strangers.list_05 import CONE, FORCES, ROWS, STEP, SUMS, TAKEN, TRIAL
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP, SLIDES
from strangers.list_12 import GAIN, INCREMENT, KICK, PLACE, RATE, SUMMED
from strangers.list_14 import BACK, LOADS, STRETCH, TIED

LEVERS = "    r = P @ Lambda.T\n"
BY_ANGLES = """    from scipy.spatial.transform import Rotation

    angles = Rotation.from_matrix(Lambda).as_euler("xyz")
    r = P @ Rotation.from_euler("XYZ", angles).as_matrix().T
"""
TIE = "    s = anchor_before(xi, u_t, s, anchored)\n"
SLIDING = "F_T = sliding_force(F_T, F_N, mu)"
NO_YAW = """c, s = Lambda[0, 0], Lambda[1, 0]
    yaw = np.array([[c, -s, 0], [s, c, 0], [0, 0, np.hypot(c, s)]]) / np.hypot(c, s)
    return force, moment, (yaw.T @ Lambda).T @ moment"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("square of the sum for the sum of squares in the inertia", ("G1",), "[depth**2 + height**2,",
            "[(depth + height) ** 2,", False),
    Mistake("distance on the diagonal shared evenly by both sides", ("G2",), "corners * inwards",
            "corners - np.sign(corners) * delta_diag / np.sqrt(2)", False),
    Mistake("damping ratio as a loss of energy", ("P2",), "2 * beta * np.sqrt", "(1 - (1 - beta) ** 2) * np.sqrt",
            False),
    Mistake("rates that wrap round at two hundred degrees", ("M1",), "np.degrees(W)",
            "np.remainder(np.degrees(W) + 200, 400) - 200", False),
    # Points.
    Mistake("levers by Euler's angles in the other order", ("K1",), LEVERS, BY_ANGLES),
    Mistake("velocity of the turn about the height alone", ("K1",), RATE,
            RATE.replace("Lambda @ W", "(Lambda @ W) * [0, 0, 1]")),
    Mistake("penetration less a hundredth of that of the shallowest foot", ("K1", "N1"), MOVED,
            MOVED + "    xi = np.where(xi >= 0, xi - 0.01 * xi[xi >= 0].min(initial=1.0), xi)\n"),
    Mistake("a smooth maximum", ("N1",), N1, N1.replace("max(K_N * xi + C_N * xi_rate, 0.0)",
            "np.logaddexp(0.0, K_N * xi + C_N * xi_rate)")),
    Mistake("damper that fades in over five micrometres", ("N1",), N1,
            N1.replace("C_N * xi_rate", "C_N * xi_rate * min(xi / 5e-6, 1.0)")),
    Mistake("a spring that gives way", ("N1",), N1, N1.replace("K_N * xi", "K_N * 1e-4 * np.tanh(xi / 1e-4)")),
    Mistake("a force that dies away above the plate", ("N2",), N1, N1.replace("else 0.0", "else np.exp(xi / 1e-6)")),
    Mistake("a new foot is tied to where it crossed the plate", ("T5",), TIE,
            TIE + "    if not anchored and xi > 0 and xi_rate > 0:\n        s = u_t - v_slide * xi / xi_rate\n"),
    Mistake("a foot that is stretched by five micrometres is tied anew", ("T5",), TIED,
            "return s if anchored and xi >= 0 and np.hypot(*(u_t - s)) < 5e-6 else u_t"),
    Mistake("a tenth of the stretch acts across", ("T1",), STRETCH,
            "return -K_T * ((u_t - s) + 0.1 * (u_t - s)[::-1]) - C_T * v_slide"),
    Mistake("damper of friction in proportion to the normal force", ("T1",), TRIAL,
            TRIAL.replace("C_T)", "C_T * F_N / 1e3)")),
    Mistake("friction of sticking that bends towards the cone", ("T1", "T2", "T3"), "    return " + T3 + "\n",
            "    return " + T3 + "\n\n\ndef bent(F, limit):\n    size = np.hypot(*F)\n"
            "    return F if size == 0 or limit == 0 else limit * np.tanh(size / limit) / size * F\n", True,
            ((SLIDES, SLIDES + "\n    F_T = F_T if slides else bent(F_T, limit)"),)),
    Mistake("who sticks sticks up to a tenth above the cone", ("T6", "T2"), SLIDES,
            SLIDES.replace("limit)", "limit if sliding else 1.1 * limit)")),
    Mistake("coefficient that falls with the speed", ("T6",), CONE,
            "F_N * (mu + (mu_0 - mu) * np.exp(-(v_slide @ v_slide) / 1e-6))"),
    Mistake("sliding force turned by a degree", ("T3",), "return " + T3,
            f"F = {T3}\n    return F + np.radians(1.0) * np.array([-F[1], F[0]])"),
    Mistake("sliding force along the mean of force and velocity", ("T3",), SLIDING,
            "F_T = sliding_force(F_T - np.hypot(*F_T) * v_slide / max(np.hypot(*v_slide), 1e-300), F_N, mu)"),
    Mistake("anchor moved along the old stretch", ("T4",), AFTER,
            "        d = s - u_t\n        s = u_t + mu * F_N / K_T * d / max(np.hypot(*d), 1e-300)\n"),
    Mistake("anchor that lags by a tenth", ("T4",), AFTER, AFTER + "        s = s + 0.1 * (trace['s_trial'] - s)\n"),
    # The body.
    Mistake("normal forces along the height of the block", ("A1",), SUMMED,
            "force = F.sum(axis=0) * [1, 1, 0] + Lambda[:, 2] * F[:, 2].sum() - [0, 0, mass * g]"),
    Mistake("the standard gravity for what is close to it", ("A1",), SUMMED,
            SUMMED.replace("mass * g", "mass * (9.80665 if abs(g - 9.8) < 0.1 else g)")),
    Mistake("centre of mass a millimetre above the middle", ("A2",), SUMS,
            SUMS.replace("r,", "r - 1e-3 * Lambda[:, 2],")),
    Mistake("rolling that is resisted", ("A2", "A3"), LOADS,
            "return force / block.mass, T - 1e-3 * F[:, 2].sum() * W / max(np.sqrt(W @ W), 1e-300), F,"),
    Mistake("moment turned back without the turn about the height", ("A3",), BACK, NO_YAW),
    Mistake("a hall a metre wide", ("I1",), PLACE, PLACE.replace("  # I1", "")
            + "\n    x_next = np.array([*np.clip(x_next[:2], -0.5, 0.5), x_next[2]])"),
    Mistake("increment by the gyroscopic moment alone", ("I2",), INCREMENT,
            "Theta = h * W - h * h / 2 * np.linalg.solve(J, np.cross(W, J @ W))"),
    Mistake("the square of the turn with the other sign", ("I3",), "angle * H + 2 *", "angle * H - 2 *"),
    Mistake("no faster than a quarter of a metre a second", ("I4",), KICK,
            KICK.replace("  # I4", "")
            + "\n    v_next = v_next * min(1, 0.25 / max(np.sqrt(v_next @ v_next), 1e-300))"),
    Mistake("momentum turned back by the mean increment of the new rates", ("I5",), GAIN,
            GAIN.replace("E.T @ half", "rotation_less_identity(-h / 2 * (W + np.linalg.solve(J, half))) @ half")),
    Mistake("sinking is not predicted, sliding is", ("S1",), ONE_STEP,
            ONE_STEP.replace("v_p,", 'np.array([*v_p[:2], state["v"][2]]),')),
    # The run.
    Mistake("who slides is forgotten where a row is kept", ("S2", "T6"), "                kept.append(state)\n",
            "                kept.append(state)\n"
            '                state = state | {"sliding": np.zeros_like(state["sliding"])}\n'),
    Mistake("velocity of the start in body axes", ("S2", "I1", "K1"), UNSTARTED,
            '    state["v"] = state["Lambda"] @ state["v"]\n' + UNSTARTED),
    Mistake("a step of whole microseconds", ("S2", "I1"), TAKEN,
            TAKEN.replace("problem.step", "np.round(problem.step, 6)")),
)  # fmt: skip

BACKWARD_EULER = """\
    v_n, W_n = v, W
    for _ in range(5):
        x_n, Lambda_n = x + h * v_n, turned(Lambda, h * W_n)
        a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        v_n, W_n = v + h * a_n, W + h * spun(W_n, T_n)
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
DAMPED_NEWMARK = """\
    b, c, A = 0.3025, 0.6, spun(W, T)
    a_n, A_n = a, A
    for _ in range(5):
        v_n, W_n = v + h * ((1 - c) * a + c * a_n), W + h * ((1 - c) * A + c * A_n)
        x_n = x + h * v + h * h * ((0.5 - b) * a + b * a_n)
        Lambda_n = turned(Lambda, h * W + h * h * ((0.5 - b) * A + b * A_n))
        a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        A_n = spun(W_n, T_n)
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
STAGGERED = """\
    v_h, W_h = state.get("half", (v - h / 2 * a, W - h / 2 * spun(W, T)))
    v_h, W_h = v_h + h * a, W_h + h * spun(W, T)
    x, Lambda = x + h * v_h, turned(Lambda, h * W_h)
    W_p = W_h + h / 2 * spun(W, T)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v_h + h / 2 * a, W_p)
    v, W = v_h + h / 2 * a, W_h + h / 2 * spun(W_p, T)
    memory = memory | {"half": (v_h, W_h)}
"""
ON_THE_GROUP = """\
    A = spun(W, T)
    x_2, v_2, W_2 = x + h / 3 * v, v + h / 3 * a, W + h / 3 * A
    a_2, T_2, _, _ = evaluate(problem, state, x_2, turned(Lambda, h / 3 * W), v_2, W_2)
    x_3, v_3, W_3 = x + 2 * h / 3 * v_2, v + 2 * h / 3 * a_2, W + 2 * h / 3 * spun(W_2, T_2)
    a_3, T_3, _, _ = evaluate(problem, state, x_3, turned(Lambda, 2 * h / 3 * W_2), v_3, W_3)
    x, Lambda = x + h / 4 * (v + 3 * v_3), turned(turned(Lambda, h / 3 * W), h * (3 / 4 * W_3 - W / 12))
    v, W = v + h / 4 * (a + 3 * a_3), W + h / 4 * (A + 3 * spun(W_3, T_3))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
BACKWARD_DIFFERENCES = """\
    new = "before" not in state
    x_b, v_b, W_b, Theta_b = (x, v, W, np.zeros(3)) if new else state["before"]
    d, e = (0.0, h) if new else (1 / 3, 2 / 3 * h)
    v_n, W_n = v, W
    for _ in range(5):
        x_n, Theta = x + d * (x - x_b) + e * v_n, d * Theta_b + e * W_n
        Lambda_n = turned(Lambda, Theta)
        a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        v_n, W_n = v + d * (v - v_b) + e * a_n, W + d * (W - W_b) + e * spun(W_n, T_n)
    memory = memory | {"before": (x, v, W, Theta)}
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
OWN_STEPS = """\
    memory, left, part = state, h, h
    while left > 1e-9 * h:
        part = min(part, left)
        A = spun(W, T)
        v_1, W_1 = v + part * a, W + part * A
        a_1, T_1, _, _ = evaluate(problem, memory, x + part * v, turned(Lambda, part * W), v_1, W_1)
        A_1 = spun(W_1, T_1)
        if part > h / 4 and part * max(np.abs(a_1 - a).max(), np.abs(A_1 - A).max()) > 1e-5:
            part = part / 2
            continue
        x, Lambda = x + part / 2 * (v + v_1), turned(Lambda, part / 2 * (W + W_1))
        v, W, left = v + part / 2 * (a + a_1), W + part / 2 * (A + A_1), left - part
        a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)
"""
SCHEMES = {
    "backward Euler": BACKWARD_EULER, "Newmark, damped": DAMPED_NEWMARK, "velocities at half steps": STAGGERED,
    "Runge-Kutta on the group": ON_THE_GROUP, "backward differences": BACKWARD_DIFFERENCES,
    "steps of its own": OWN_STEPS,
}  # fmt: skip

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("the old rates in the gyroscopic moment, twice", EULER, "h * spun(W_n, T_n)", "h * spun(2 * W, T_n)"),
     "backward Euler"),
    (Mistake("turned by the old rates as well", ("I3",), "turned(Lambda, h * W_n)",
             "turned(turned(Lambda, h / 2 * W), h * W_n)"), "backward Euler"),
    (Mistake("weights of the accelerations that do not add up", ("I4", "A1"), "(1 - c) * a + c", "(1 - b) * a + c"),
     "Newmark, damped"),
    (Mistake("weights of the gain of the rates that do not add up", EULER, "(1 - c) * A + c", "(1 - b) * A + c"),
     "Newmark, damped"),
    (Mistake("rates at half steps kicked backwards", EULER, "W_h + h * spun(W, T)", "W_h - h * spun(W, T)"),
     "velocities at half steps"),
    (Mistake("velocities at half steps kicked by half", ("I4", "A1"), "v_h + h * a, W_h", "v_h + h / 2 * a, W_h"),
     "velocities at half steps"),
    (Mistake("the twelfth added", ("I3",), "3 / 4 * W_3 - W / 12", "3 / 4 * W_3 + W / 12"), "Runge-Kutta on the group"),
    (Mistake("no gyroscopic moment in the last stage", EULER, "(A + 3 * spun(W_3, T_3))",
             "(A + 3 * np.linalg.solve(J, T_3))"),
     "Runge-Kutta on the group"),
    (Mistake("the turn before with the other sign", ("I3",), "d * Theta_b + e", "-d * Theta_b + e"),
     "backward differences"),
    (Mistake("the place without what was before", ("I1", "I4", "S2"), "x + d * (x - x_b) + e", "x + e"),
     "backward differences"),
    (Mistake("what is left is not turned", ("I3",), "turned(Lambda, part / 2 * (W + W_1))",
             "turned(Lambda, (part if part == h else part / 2) / 2 * (W + W_1))"), "steps of its own"),
    (Mistake("a step that is refused moves the block all the same", ("I1", "S2", "I4"),
             "            part = part / 2\n", "            x, part = x + part * v, part / 2\n"), "steps of its own"),
)  # fmt: skip

AS_OBJECT = """\
        from types import SimpleNamespace

        shown = ("W", "x", "Lambda", "F", "anchored")
        return SimpleNamespace(t=wanted * problem.step, **{k: np.array([row[k] for row in kept]) for k in shown})
"""
HANDED_OUT = """\
        shown = ("W", "x", "Lambda", "F", "anchored")
        return {"t": wanted * problem.step, **{k: np.array([row[k] for row in kept]) for k in shown}}
"""
DOWNWARDS = '''DOWN = np.diag([1.0, -1.0, -1.0])


def seen_from_below(problem):
    """Axes of the block turned about X: Y to the other side, Z downwards."""
    from dataclasses import replace

    block, points, start = problem.block, problem.points, problem.start
    start = replace(start, Lambda=start.Lambda @ DOWN, W=start.W @ DOWN, T=None if start.T is None else start.T @ DOWN)
    block = replace(block, inertia=DOWN @ block.inertia @ DOWN)
    return replace(problem, block=block, points=replace(points, P=points.P @ DOWN), start=start)


def from_above(state):
    """The same in the axes that were given."""
    return state | {"Lambda": state["Lambda"] @ DOWN, "W": state["W"] @ DOWN, "T": state["T"] @ DOWN}


class Backend:
'''
IN_PYTHON = (
    Variant("rows as an object with attributes", ((HANDED_OUT, AS_OBJECT),)),
    Variant("rows as lists of lists", ((ROWS, ROWS.replace("np.array([row[k] for row in kept])",
            "np.array([row[k] for row in kept]).tolist()")),)),
    Variant("flags of contact are not handed out", ((', "F", "anchored")', ', "F")'),)),
    Variant("axes of the body that point downwards",
            (("class Backend:\n", DOWNWARDS),
             ("        state, kept = started(problem), []\n",
              "        problem = seen_from_below(problem)\n        state, kept = started(problem), []\n"),
             ("kept.append(state)", "kept.append(from_above(state))"),
             (STEP, "        problem = seen_from_below(problem)\n"
              "        return from_above(advanced(problem, started(problem)))\n"))),
    Variant("velocities of the feet by a complex step",
            ((RATE, "e = 1e-40j\n    w = Lambda @ W\n    spin = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]],"
              " [-w[1], w[0], 0]])\n    rate = ((x + e * v) + P @ (Lambda + e * spin @ Lambda).T).imag / e.imag"),)),
    Variant("normal force as the middle of three",
            ((N1, "sorted((0.0, K_N * xi + C_N * xi_rate, np.inf))[1] if xi >= 0 else 0.0"),)),
    Variant("exponential by two reflections",
            (("    return " + E.removeprefix("return "),
              "    n = H @ np.eye(3)[np.argmin(np.abs(Theta))]\n    n = n / np.sqrt(n @ n)\n"
              "    m = np.cos(angle / 2) * n + np.sin(angle / 2) / angle * H @ n\n"
              "    d = m - n if angle > 1e-3 else -2 * np.sin(angle / 4) ** 2 * n + np.sin(angle / 2) / angle * H @ n\n"
              "    # (I - 2 m m')(I - 2 n n') - I, with m = n + d\n"
              "    first = np.eye(3) - 2 * np.outer(n, n)\n"
              "    return -2 * (np.outer(d, n) + np.outer(n, d) + np.outer(d, d)) @ first"),)),
    Variant("time counted in steps",
            ((PLACE, "q, p = h * v, h * h * a\n    x_next = x + (q + p / 2)"),
             (KICK, "v_next = (h * v + (h * h * a + h * h * a_next) / 2) / h"))),
    Variant("flags kept as numbers of floating point",
            ((ADVANCED, '"F": F, **{k: np.asarray(m, float) for k, m in memory.items()}}'),
             ('memory["anchored"][i]', 'memory["anchored"][i] > 0.5'),
             ('memory["sliding"][i]', 'memory["sliding"][i] > 0.5'),
             (ROWS, ROWS.replace("row[k] for", 'np.asarray(row[k]) > 0.5 if k == "anchored" else row[k] for')))),
    Variant("feet in pairs: their sum at the middle, their difference as a couple",
            ((SUM, "    n = len(F) // 2 * 2\n    f, g_, a, b = F[0:n:2], F[1:n:2], r[0:n:2], r[1:n:2]\n"
              "    force = (f + g_).sum(axis=0) + F[n:].sum(axis=0) - [0, 0, mass * g]\n"
              "    moment = (np.cross((a + b) / 2, f + g_) + np.cross((a - b) / 2, f - g_)).sum(axis=0)\n"
              "    moment = moment + np.cross(r[n:], F[n:]).sum(axis=0)\n"),)),
    Variant("accelerations by one step of refinement",
            ((SPEED, "(J_inv := np.linalg.inv(J)) @ (b := T - np.cross(W, J @ W)) + J_inv @ (b - J @ (J_inv @ b))"),)),
    Variant("impulses of the feet in place of forces",
            ((FORCES, FORCES + "    F = F * problem.step\n"),
             (SUMS, SUMS.replace("block.g", "block.g * problem.step")),
             (FOUND, FOUND.replace("block.mass, T, F,", "block.mass / h, T / h, F / h,").replace("return ",
              "h = problem.step\n    return ")))),
    Variant("every place as the mean over the feet, less that of their levers",
            ((MOVED, MOVED + "    u = u - (u - r).mean(axis=0) + x\n"),)),
    Variant("the third axis of the block across the other two",
            ((TURNED, TURNED + "\n    X, Y, _ = Lambda_next.T\n"
              "    Lambda_next = np.column_stack([X, Y, np.cross(X, Y)])"),)),
    Variant("no trace of what lies between",
            ((', "trace": trace}\n    F_T', "}\n    F_T"), ('"sliding": slides, "trace": trace', '"sliding": slides'))),
)  # fmt: skip
