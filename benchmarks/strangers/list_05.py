"""A fifth list of strangers: mistakes and correct variants in the manner of physics engines and finite elements.

Engines put bodies to sleep, damp them a little, limit their rates, take the rates in plate axes and lift what overlaps;
finite elements count in millimetres and tonnes. Mistakes and variants were written down, and published, before any of
them was judged.
"""

from __future__ import annotations

from strangers.controls import SECOND, SLIDES, E, Variant
from strangers.list_01 import Mistake
from strangers.list_04 import EULER, FOUND, MOVED, UNSTARTED

MADE = "    made = np.array([getattr(points, k) for k in PROPERTIES])\n"
FORCES = '    F = np.array([[*c["F_T"], c["F_N"]] for c in found])\n'
TRIAL = "    F_T = trial_force(u_t, s, v_slide, K_T, C_T)\n"
CONE = "cone(F_N, sliding and anchored, mu_0, mu)"
SUMS = "resultants(Lambda, r, F, block.mass, block.g)"
TAKEN = "h, J = problem.step, problem.block.inertia"
ROWS = "np.array([row[k] for row in kept]) for k in shown"
STEP = "        return advanced(problem, started(problem))\n"

OF_PARAMETERS = (
    Mistake("inertia about the middle of the base", ("G1",), "width**2 + depth**2])",
            "width**2 + depth**2]) + mass * height**2 / 4 * np.diag([1, 1, 0])", False),
    Mistake("points relative to the middle of the base", ("G2",), "delta_long - height / 2", "delta_long", False,
            (("np.full(4, -height / 2)", "np.zeros(4)"),)),
    Mistake("heights of the feet row by row", ("G2",), "delta_long - height / 2",
            "delta_long[[0, 1, 3, 2]] - height / 2", False),
    Mistake("rates less the first sample", ("M1",), "np.degrees(W)", "np.degrees(W - W[0])", False),
)  # fmt: skip

OF_POINTS = (
    Mistake("levers for small angles", ("K1",), "r = P @ Lambda.T",
            "r = P + np.cross([Lambda[2, 1] - Lambda[1, 2], Lambda[0, 2] - Lambda[2, 0],"
            " Lambda[1, 0] - Lambda[0, 1]], P) / 2"),
    Mistake("dampers shared by the feet that touch", ("N1",), MADE,
            MADE + "    made[1] /= max(1, np.sum(xi >= 0))\n"),
    Mistake("the deepest foot alone carries", ("N1", "N2"), MOVED,
            MOVED + "    xi = np.where(xi == xi.max(), xi, -1)\n"),
    Mistake("cone by the size of a normal force that would pull", ("T6", "T2"), CONE,
            CONE.replace("F_N", "abs(K_N * xi + C_N * xi_rate)")),
    Mistake("cone by the normal force of the step before", ("T6", "T2", "T3"), CONE, CONE.replace("F_N", "F_cone"),
            more=(("C_T, mu_0, mu):\n", "C_T, mu_0, mu, F_before=None):\n"),
                  (TRIAL, TRIAL + "    F_cone = F_N if F_before is None else F_before\n"),
                  ("sliding_force(F_T, F_N, mu)\n        s", "sliding_force(F_T, F_cone, mu)\n        s"),
                  ("*made[:, i],", '*made[:, i], None if memory.get("F") is None else memory["F"][i, 2],'))),
    Mistake("anchors turn with the block", ("T5", "T1"), 'memory["s"][i]',
            '(Lambda @ memory.get("Lambda", Lambda).T @ [*memory["s"][i], 0])[:2]'),
    Mistake("damper outside the cone", ("T1", "T2", "T3"), TRIAL, TRIAL.replace("C_T)", "0.0)"),
            more=(('"F_T": F_T, "s"', '"F_T": F_T - C_T * v_slide, "s"'),
                  ("anchor_after(F_T, u_t, v_slide, K_T, C_T)\n    ",
                   "anchor_after(F_T, u_t, v_slide, K_T, 0.0)\n    "))),
    Mistake("sliding force along the friction of the step before", ("T3",), FORCES,
            FORCES + '    old = memory.get("F")\n'
            "    for i, c in enumerate(found if old is not None else []):\n"
            '        if c["sliding"] and old[i, :2].any():\n'
            "            F[i, :2] = old[i, :2] * np.hypot(*F[i, :2]) / np.hypot(*old[i, :2])\n"),
)  # fmt: skip

OF_BODIES = (
    Mistake("levers in body axes, forces in plate axes", ("A2",), SUMS, SUMS.replace("r,", "points.P,")),
    Mistake("levers to the surface of the plate", ("A2",), SUMS,
            SUMS.replace("r,", "r + np.outer(np.maximum(xi, 0), [0, 0, 1]),")),
    Mistake("principal moments in order of size", ("I2", "I5"), TAKEN,
            TAKEN.replace("problem.block.inertia", "np.diag(np.linalg.eigvalsh(problem.block.inertia))")),
    Mistake("rotation to first order below a ten-thousandth", ("I3",), "if angle == 0:", "if angle < 1e-4:"),
    Mistake("the new moment turned back, too", ("I5",), "E.T @ half + h / 2 * T_next",
            "E.T @ (half + h / 2 * T_next)"),
    Mistake("velocities predicted by the weight alone", ("S1",), "v + h * a, W + h * A, E",
            "v + h * np.array([0, 0, -9.81]), W + h * A, E"),
    Mistake("velocities below a micrometre a second are rest", ("I4",), "v + h / 2 * (a + a_next)  # I4",
            "v + h / 2 * (a + a_next)\n    v_next = np.where(np.abs(v_next) < 1e-6, 0.0, v_next)"),
    Mistake("a thousandth of the rates lost each second", ("I5",), "W + np.linalg.solve(J, gain)",
            "(W + np.linalg.solve(J, gain)) * (1 - 1e-3 * h)"),
    Mistake("rates never above seven a second", ("I5",), "W + np.linalg.solve(J, gain)",
            "np.clip(W + np.linalg.solve(J, gain), -7, 7)"),
)  # fmt: skip

OF_RUNS = (
    Mistake("a step that is a number in the code", ("S2", "I1"), TAKEN, TAKEN.replace("problem.step", "1e-5")),
    Mistake("rates handed out in plate axes", ("S2", "M1"), ROWS,
            ROWS.replace("row[k] for", 'row["Lambda"] @ row[k] if k == "W" else row[k] for')),
    Mistake("rates of the start taken for plate rates", ("S2", "I3", "K1"), UNSTARTED,
            '    state["W"] = state["Lambda"].T @ state["W"]\n' + UNSTARTED),
    Mistake("what overlaps at the start is lifted", ("S2", "K1"), UNSTARTED,
            '    lowest = (state["x"] + problem.points.P @ state["Lambda"].T)[:, 2].min()\n'
            '    state["x"] = state["x"] - [0, 0, min(lowest, 0)]\n' + UNSTARTED),
    Mistake("who slid at the end of the run before", ("S2", "T6"), UNSTARTED,
            '    state["sliding"] = state["sliding"] | LEFT.get(len(state["s"]), False)\n' + UNSTARTED,
            more=(("def started(", "LEFT = {}\n\n\ndef started("),
                  ("        shown = (", '        LEFT[len(state["s"])] = state["sliding"]\n        shown = ('))),
    Mistake("no more than eight feet", ("A1", "N1", "S2"), FORCES, FORCES + "    F[8:] = 0\n"),
    Mistake("rows at the step above", ("S2",), "np.rint(", "np.ceil(-1e-9 + "),
    Mistake("contacts shown a step late", ("S2", "T5"), ROWS,
            ROWS.replace("row[k] for", 'row.get("late", row[k]) if k == "anchored" else row[k] for'),
            more=(('"F": F, **memory}', '"F": F, "late": state["anchored"], **memory}'),)),
)  # fmt: skip

MISTAKES = OF_PARAMETERS + OF_POINTS + OF_BODIES + OF_RUNS

AVERAGE_ACCELERATION = """\
    A = spun(W, T)
    v_n, W_n = v + h * a, W + h * A
    for _ in range(4):
        x_n, Lambda_n = x + h / 2 * (v + v_n), turned(Lambda, h / 2 * (W + W_n))
        a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        v_n, W_n = v + h / 2 * (a + a_n), W + h / 2 * (A + spun(W_n, T_n))
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
ADAMS_BASHFORTH = """\
    now = v, W, a, spun(W, T)
    v_0, W_0, a_0, A_0 = state.get("before", now)
    x, Lambda = x + h / 2 * (3 * v - v_0), turned(Lambda, h / 2 * (3 * W - W_0))
    v, W = v + h / 2 * (3 * a - a_0), W + h / 2 * (3 * now[3] - A_0)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    memory = memory | {"before": now}
"""
SCHEMES = {"average acceleration": AVERAGE_ACCELERATION, "Adams-Bashforth": ADAMS_BASHFORTH}

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("no gyroscopic moment at the end of the step", EULER, "spun(W_n, T_n)", "np.linalg.solve(J, T_n)"),
     "average acceleration"),
    (Mistake("every pass turns what the pass before has turned", ("I3",), "turned(Lambda, h / 2 * (W + W_n))",
             "turned(Lambda_n, h / 2 * (W + W_n))", more=(("W_n = v + h * a, W + h * A\n",
             "W_n, Lambda_n = v + h * a, W + h * A, Lambda\n"),)), "average acceleration"),
    (Mistake("the loads before added, not taken away", ("I4", "A1"), "3 * a - a_0", "3 * a + a_0"), "Adams-Bashforth"),
    (Mistake("turned by twice the rates less those before", ("I3",), "3 * W - W_0", "2 * W - W_0"), "Adams-Bashforth"),
)  # fmt: skip

TONNES = '''def in_tonnes(problem):
    """Millimetres, tonnes, seconds, newtons."""
    from dataclasses import replace

    block, points, start = problem.block, problem.points, problem.start
    block = replace(block, mass=block.mass / 1e3, inertia=block.inertia * 1e3, g=block.g * 1e3)
    softer = {k: getattr(points, k) / 1e3 for k in ("K_N", "C_N", "K_T", "C_T")}
    longer = {k: getattr(start, k) for k in ("x", "v", "s", "a", "T")}
    start = replace(start, **{k: a if a is None else a * 1e3 for k, a in longer.items()})
    return replace(problem, block=block, points=replace(points, P=points.P * 1e3, **softer), start=start)


class Backend:
'''
OTHER_AXES = '''AXES = rotation_less_identity(np.array([0.4, -0.7, 1.1])) + np.eye(3)


def in_other_axes(problem):
    """Body axes along another block's edges, say of a drawing."""
    from dataclasses import replace

    block, points, start = problem.block, problem.points, problem.start
    block = replace(block, inertia=AXES.T @ block.inertia @ AXES)
    turned = {"W": start.W @ AXES, "T": None if start.T is None else start.T @ AXES}
    start = replace(start, Lambda=start.Lambda @ AXES, **turned)
    return replace(problem, block=block, points=replace(points, P=points.P @ AXES), start=start)


def in_the_blocks_axes(state):
    """The same in the axes that were given."""
    return state | {"Lambda": state["Lambda"] @ AXES.T, "W": AXES @ state["W"], "T": AXES @ state["T"]}


class Backend:
'''
IN_PYTHON = (
    Variant(
        "other axes of the body inside",
        (
            ("class Backend:\n", OTHER_AXES),
            ("        state, kept = started(problem), []\n",
             "        problem = in_other_axes(problem)\n        state, kept = started(problem), []\n"),
            ("kept.append(state)", "kept.append(in_the_blocks_axes(state))"),
            (STEP, "        problem = in_other_axes(problem)\n"
             "        return in_the_blocks_axes(advanced(problem, started(problem)))\n"),
        ),
    ),
    Variant(
        "millimetres and tonnes",
        (
            ("class Backend:\n", TONNES),
            ("        state, kept = started(problem), []\n",
             "        problem = in_tonnes(problem)\n        state, kept = started(problem), []\n"),
            (ROWS, ROWS.replace("row[k] for", 'row[k] / 1e3 if k == "x" else row[k] for')),
            (STEP, "        problem = in_tonnes(problem)\n        found = advanced(problem, started(problem))\n"
             '        return {k: a / 1e3 if k in ("x", "v", "s", "a", "T") else a for k, a in found.items()}\n'),
        ),
    ),
    Variant(
        "feet sorted along a slanting line, and handed out as they came",
        (
            (MOVED, "order = np.argsort(points.P @ [1.0, 0.37, 0.0])\n    "
             + MOVED.replace("points.P", "points.P[order]")),
            (MADE, MADE.replace("PROPERTIES])", "PROPERTIES])[:, order]")),
            ('memory["s"][i]', 'memory["s"][order[i]]'),
            ('memory["anchored"][i]', 'memory["anchored"][order[i]]'),
            ('memory["sliding"][i]', 'memory["sliding"][order[i]]'),
            (FOUND, "back = np.argsort(order)\n"
             "    kept = {k: np.array([c[name] for c in found])[back] for k, name in keys.items()}\n"
             "    return force / block.mass, T, F[back], kept"),
        ),
    ),
    Variant(
        "exponential by the tangent of half the angle",
        ((E, "t = np.tan(angle / 2)\n    b = t / angle * H\n    return 2 / (1 + t * t) * (b + b @ b)"),),
    ),
    Variant(
        "inertia turned into plate axes every step",
        (
            ("    A = np.linalg.solve(J, T - np.cross(W, J @ W))\n",
             "    J_plate, w = Lambda @ J @ Lambda.T, Lambda @ W\n"
             "    A = Lambda.T @ np.linalg.solve(J_plate, Lambda @ T - np.cross(w, J_plate @ w))\n"),
            (SECOND,
             '    before = state["Lambda"]\n'
             '    v, _ = second_half(state["v"], state["W"], state["a"], state["T"], a, T, h, J, E)\n'
             '    L = before @ J @ before.T @ (before @ state["W"]) + h / 2 * (before @ state["T"] + Lambda @ T)\n'
             "    W = Lambda.T @ np.linalg.solve(Lambda @ J @ Lambda.T, L)\n    return {"),
        ),
    ),
    Variant(
        "stretch and velocity in space, projected on the plane of a normal",
        (
            (TRIAL,
             "    n = np.array([0.0, 0.0, 1.0])\n"
             "    stretch, slip = np.append(u_t - s, -xi), np.append(v_slide, -xi_rate)\n"
             "    stretch, slip = stretch - (stretch @ n) * n, slip - (slip @ n) * n\n"
             "    F_T = (-K_T * stretch - C_T * slip)[:2]\n"),
        ),
    ),
    Variant(
        "a plastic multiplier, squares compared",
        (
            ("return np.hypot(*F_trial) <= limit", "return F_trial @ F_trial <= limit * limit"),
            (SLIDES,
             "        n, way = F_T / np.hypot(*F_T), (np.hypot(*F_T) - mu * F_N) / K_T\n"
             "        F_T, s = F_T - K_T * way * n, s - way * n\n"),
        ),
    ),
    Variant(
        "the middle of the base is what is kept, not the centre of mass",
        (
            ("    x, _, Lambda, v_p, W_p, E = first_half(*(state",
             "    c = np.array([0.01, -0.02, -0.344])\n"
             '    state = state | {"x": state["y"] - state["Lambda"] @ c if "y" in state else state["x"]}\n'
             "    x, _, Lambda, v_p, W_p, E = first_half(*(state"),
            ("    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n",
             "    y = x + Lambda @ c\n    x = y - Lambda @ c\n"
             '    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n    memory["y"] = y\n'),
        ),
    ),
    Variant("turned by the mean of the rates and the predicted ones",
            (("Theta = h * W + h * h / 2 * A", "Theta = h / 2 * (W + (W + h * A))"),)),
)  # fmt: skip
IN_C = (
    Variant(
        "C, cross products without cancellation, by fused multiply-add",
        (
            ("static void cross(",
             "static real apart(real b, real c, real d, real e) { /* b c - d e, Kahan */\n"
             "    real de = d * e, lost = fma(-d, e, de);\n    return fma(b, c, -de) + lost;\n}\nstatic void cross("),
            ("d[0] = b[1] * c[2] - b[2] * c[1], d[1] = b[2] * c[0] - b[0] * c[2], d[2] = b[0] * c[1] - b[1] * c[0];",
             "d[0] = apart(b[1], c[2], b[2], c[1]), d[1] = apart(b[2], c[0], b[0], c[2]), "
             "d[2] = apart(b[0], c[1], b[1], c[0]);"),
        ),
    ),
    Variant("C, fifteen digits", (('printf("%.17g", (double)*b)', 'printf("%.15g", (double)*b)'),)),
)  # fmt: skip

#: What is handed out with too few digits speaks of no rule: it fails, and is told as a matter of format.
FORMATS = (
    Variant("rows in single precision",
            (("row[k] for row in kept", "np.asarray(row[k], np.float32) for row in kept"),)),
    Variant("rows of nine digits",
            ((ROWS, ROWS.replace("row[k] for", "np.vectorize(lambda x: float(f'{x:.9g}'))(row[k]) for")),)),
    Variant("rows of twelve digits",
            ((ROWS, ROWS.replace("row[k] for", "np.vectorize(lambda x: float(f'{x:.12g}'))(row[k]) for")),)),
)  # fmt: skip
