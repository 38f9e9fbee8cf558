"""An eighteenth list of strangers: branches that are rarely taken, brackets, and what is left in a buffer.

Whole division, arguments of the arc tangent, the other end of an array, one axis of one foot, a view in place of a
copy, half of an array written back, early exits, feet that touch and are not pressed, a static coefficient above the
dynamic one; integrators with stages that wait for one another, with three steps of memory, with extrapolation.
Mistakes and variants were written down, and published, before any of them was judged; that the integrators converge to
the law was looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import SECOND, SOLVED, SUM, E, Variant
from strangers.list_01 import N1, SPEED, T3, Mistake
from strangers.list_04 import EULER, FOUND, MOVED
from strangers.list_05 import CONE, MADE
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP, SLIDES
from strangers.list_12 import GAIN, INCREMENT, KICK, MOMENT, PLACE, RATE, SUMMED
from strangers.list_13 import DEPTH
from strangers.list_14 import BACK, STRETCH
from strangers.list_16 import LEVERS, STARTED
from strangers.list_17 import ALL

STICKS = "np.hypot(*F_trial) <= limit"
ANCHOR = "u_t + (F_T + C_T * v_slide) / K_T"
TRACED = '    trace |= {"F_trial": F_T, "threshold": limit}\n'
LOOKED = "    found = [\n"
BEGUN = "        state, kept = started(problem), []\n"
SHOWN = "        shown = ("
KEPT_ROW = "                kept.append(state)\n"
NEXT = "                state = advanced(problem, state)\n"
NEW_FEET = """    new = (xi >= 0) & ~np.array(memory["anchored"], bool)
    memory = memory | {
        "s": np.where(new[:, None], u[:1, :2], memory["s"]), "sliding": np.array(memory["sliding"], bool) & ~new,
        "anchored": np.array(memory["anchored"], bool) | new,
    }
"""
LENT = """    lent = np.array(memory.get("lent", np.zeros(len(xi), bool)))
    memory = memory | {"s": np.where(lent[:, None], u[:, :2], memory["s"])}
"""
LENT_ON = """ | {"lent": np.array([
        c["touching"] and not c["sliding"] and bool(lent[i] or not memory["anchored"][i]) for i, c in enumerate(found)
    ])}"""
SINCE_TOUCHED = """    touched = np.where(memory["anchored"], memory.get("touched", 0 * xi), xi) * (xi >= 0)
    xi = xi - touched
"""
HALF_WRITTEN = """kept = {k: np.array([c[name] for c in found]) for k, name in keys.items()}
    kept["s"][len(r) // 2 :] = np.asarray(memory["s"])[len(r) // 2 :]
    return force / block.mass, T, F, kept"""
OF_OLD_RATES = """    old = memory.get("v", v) + np.cross(Lambda @ memory.get("W", W), r[0])
    xi_rate[0], v_slide[0] = -old[2], old[:2]
"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("a minus in the third moment", ("G1",), "width**2 + depth**2])", "width**2 - depth**2])", False),
    Mistake("inner feet moved inwards along the width alone", ("G2",), "corners * inwards", "corners * [inwards, 1]",
            False),
    Mistake("heights of the outer feet from the last to the first", ("G2",), "delta_long - height / 2",
            "np.broadcast_to(delta_long, 4)[::-1] - height / 2", False),
    Mistake("an exponent of one half by whole division", ("P2",), "np.sqrt(K * mass)", "(K * mass) ** (1 // 2)", False),
    Mistake("tangential dampers of all feet by the outer ratio", ("P3", "P2"), '"C_T": damping(beta, K_T',
            '"C_T": damping(beta_ext, K_T', False),
    Mistake("degrees in single precision", ("M1",), "np.degrees(W)", "np.degrees(np.float32(W)).astype(float)", False),
    Mistake("the last sample is left in radians", ("M1",), "np.degrees(W)",
            "np.concatenate([np.degrees(W[:-1]), W[-1:]])", False),
    # Points.
    Mistake("y of the velocity of the turn with the other sign", ("K1",), RATE, RATE + " * [1, -1, 1]"),
    Mistake("y of the third lever with the other sign", ("K1",), LEVERS, LEVERS + "    r[2:3, 1] *= -1\n"),
    Mistake("x of the fifth velocity is that of the fourth", ("K1",), RATE, RATE + "\n    rate[4:5, 0] = rate[3:4, 0]"),
    Mistake("rate of penetration in millimetres a second", ("K1", "N1"), DEPTH,
            DEPTH.replace("-rate", "-1e3 * rate")),
    Mistake("levers overwritten by the places", ("K1", "A2"), "    u = x + r\n", "    u = r\n    u += x\n"),
    Mistake("a bracket round penetration and damper", ("N1",), N1,
            N1.replace("K_N * xi + C_N * xi_rate", "K_N * (xi + C_N * xi_rate)")),
    Mistake("penetration counted from the first step of contact", ("N1", "K1", "S1"), MOVED, MOVED + SINCE_TOUCHED,
            True, ((FOUND, FOUND + ' | {"touched": touched}'),)),
    Mistake("a new foot is tied to where the first foot is", ("T5", "T1"), MOVED, MOVED + NEW_FEET),
    Mistake("a foot that slid and opens is tied for a step more", ("T5",), '"touching": False, "sliding": False',
            '"touching": bool(sliding), "sliding": False', False),
    Mistake("a new anchor is a view of the place of its foot", ("T5", "T1"), MOVED, MOVED + LENT, True,
            ((FOUND, FOUND + LENT_ON),)),
    Mistake("anchors of the inner feet are not written back", ("T5", "T4"), "return " + FOUND.removeprefix("return "),
            HALF_WRITTEN),
    Mistake("damper of friction twice along y", ("T1",), STRETCH, STRETCH + " * [1, 2]"),
    Mistake("the last foot has no damper of friction", ("T1", "T4"), LOOKED, "    made[3, -1] = 0\n" + LOOKED),
    Mistake("sticking below the threshold, never at it", ("T2", "T3"), STICKS, STICKS.replace("<=", "<")),
    Mistake("a foot that is not pressed sticks", ("T2", "T3"), SLIDES,
            "slides = bool(F_N > 0 and not sticks(F_T, limit))"),
    Mistake("a foot that sticks above the dynamic threshold is cut to it", ("T2", "T3", "T6"), AFTER,
            AFTER + "    elif np.hypot(*F_T) > mu * F_N:\n        F_T = sliding_force(F_T, F_N, mu)\n"),
    Mistake("threshold in single precision", ("T6", "T2"), CONE, f"float(np.float32({CONE}))", False),
    Mistake("flags of sliding read from the last foot to the first", ("T6",), 'memory["sliding"][i]',
            'memory["sliding"][-1 - i]'),
    Mistake("arguments of the arc tangent exchanged", ("T3",), "return " + T3,
            "way = np.arctan2(F_trial[0], F_trial[1])\n    return mu * F_N * np.array([np.cos(way), np.sin(way)])"),
    Mistake("arc tangent of a quotient for the direction of sliding", ("T3",), "return " + T3,
            "way = np.arctan(F_trial[1] / F_trial[0])\n    return mu * F_N * np.array([np.cos(way), np.sin(way)])"),
    Mistake("sliding force in single precision", ("T3",), "return " + T3,
            f"return ({T3}).astype(np.float32).astype(float)"),
    Mistake("y of the damper with the other sign where the anchor is moved", ("T4",), ANCHOR,
            ANCHOR.replace("v_slide", "v_slide * [1, -1]")),
    Mistake("no bracket where the anchor is moved", ("T4",), ANCHOR, "u_t + F_T + C_T * v_slide / K_T"),
    Mistake("early exit where a foot is not pressed", ("T4", "T2", "T6"), TRACED, TRACED + "    if F_N == 0:\n"
            '        return {"F_N": F_N, "F_T": np.zeros(2), "s": s, "touching": True,\n'
            '                "sliding": bool(sliding and anchored), "trace": trace}\n'),
    # The body.
    Mistake("friction of the inner feet left out of the sum", ("A1",), SUMMED,
            "force = F.sum(axis=0) - [*F[len(F) // 2 :, :2].sum(axis=0), mass * g]"),
    Mistake("force over the weight, not over the mass", ("A1", "I4"), "force / block.mass",
            "force / (block.mass * block.g)"),
    Mistake("heights of the levers with the other sign in the moment", ("A2",), MOMENT,
            MOMENT.replace("(r,", "(r * [1, 1, -1],")),
    Mistake("levers of the foot before in the moment", ("A2",), MOMENT,
            MOMENT.replace("(r,", "(np.roll(r, 1, axis=0),")),
    Mistake("moments of the feet in whole newton metres", ("A2",), MOMENT,
            "moment = np.trunc(np.cross(r, F)).sum(axis=0)"),
    Mistake("forces of the feet before added where the moment is made", ("A2",), MOMENT,
            MOMENT.replace("F)", "F.cumsum(axis=0))")),
    Mistake("attitude in single precision where the moment is turned back", ("A3",), BACK,
            BACK.replace("Lambda.T", "np.float32(Lambda).T.astype(float)")),
    # The step.
    Mistake("a bracket too wide in the place", ("I1",), PLACE, "x_next = x + (h * v + h * h * a) / 2"),
    Mistake("place moved by the velocity of the step before", ("I1", "S1"), ONE_STEP,
            'x = x + h * (state.get("left", state["v"]) - state["v"])\n    ' + ONE_STEP, True,
            ((ADVANCED, '"F": F, "left": state["v"], **memory}'),)),
    Mistake("products of inertia left out of the gyroscopic moment", ("I2", "S1"), SPEED,
            SPEED.replace("J @ W", "np.diag(J) * W")),
    Mistake("a bracket in the increment", ("I2",), INCREMENT, "Theta = h * (W + h / 2) * A"),
    Mistake("sine of the angle in degrees", ("I3",), "np.sin(angle) / angle * H",
            "np.sin(np.degrees(angle)) / angle * H"),
    Mistake("one less a cosine in single precision", ("I3",), E,
            "return np.sin(angle) / angle * H + float(np.float32(1) - np.float32(np.cos(angle))) / angle**2 * H @ H"),
    Mistake("no turn is returned as a one, which is added", ("I3",), "        return H\n",
            "        return np.eye(3)\n"),
    Mistake("half of a step by whole division in the velocity", ("I4",), KICK, KICK.replace("h / 2", "1 // 2 * h")),
    Mistake("no bracket in the velocity", ("I4",), KICK, "v_next = v + h / 2 * a + a_next"),
    Mistake("rates turned back in place of the momentum", ("I5",), GAIN,
            GAIN.replace("E.T @ half", "J @ (E.T @ np.linalg.solve(J, half))")),
    Mistake("no correction while a foot slides", ("I4", "I5", "S1"), SECOND,
            SECOND.replace("    return {", '    if memory["sliding"].any():\n        v, W = v_p, W_p\n    return {')),
    Mistake("the first foot moves as a step before", ("S1", "K1"), MOVED, MOVED + OF_OLD_RATES),
    Mistake("rate about the height not predicted", ("S1",), "W + h * A, E", "W + h * A * [1, 1, 0], E"),
    # The run.
    Mistake("rows after the first are a step early", ("S2",), KEPT_ROW,
            KEPT_ROW.replace("(state", "(before if kept else state"), True,
            ((NEXT, NEXT.replace("state =", "before, state = state,")),)),
    Mistake("a row too many", ("S2",), "problem.output_rate + 1e-9)) + 1", "problem.output_rate + 1e-9)) + 2"),
    Mistake("moment of the start turned back once more", ("S2", "A3"), STARTED,
            STARTED.replace("    return", '    state["T"] = state["Lambda"].T @ state["T"]\n    return')),
    Mistake("anchors that the run before left", ("S2", "T5", "T1"), BEGUN,
            BEGUN + '        if len(getattr(self, "left", ())) == len(state["s"]):\n'
            '            state = state | {"s": self.left}\n', True,
            ((SHOWN, '        self.left = state["s"]\n' + SHOWN),)),
    Mistake("constants of the first run are kept", ("S2", "N1", "T1", "T6", "T3"), MADE,
            MADE + "    made = KEPT.setdefault(len(r), made).copy()\n", True,
            (('PROPERTIES = (', 'KEPT = {}\nPROPERTIES = ('),)),
)  # fmt: skip

#: What dwindles with the step, and is no mistake in another integrator.
OF_THE_STEP = (
    "penetration counted from the first step of contact", "one less a cosine in single precision",
    "the first foot moves as a step before", "rows after the first are a step early",
    "moment of the start turned back once more",
)  # fmt: skip

RADAU = """\
    rates = [(v, W, a, spun(W, T))] * 2
    for _ in range(6):
        made = []
        for row in ((5 / 12, -1 / 12), (3 / 4, 1 / 4)):
            ways = [h * sum(c * k for c, k in zip(row, ks, strict=True)) for ks in zip(*rates, strict=True)]
            at = x + ways[0], turned(Lambda, ways[1]), v + ways[2], W + ways[3]
            a_n, T_n, F, memory = evaluate(problem, state, *at)
            made.append((at[2], at[3], a_n, spun(at[3], T_n)))
        rates = made
    x, Lambda, v, W, a, T = *at, a_n, T_n
"""
EXTRAPOLATED = """\
    def slope(d):
        a_n, T_n, _, _ = evaluate(problem, state, x + d[0], turned(Lambda, d[1]), v + d[2], W + d[3])
        return np.array([v + d[2], W + d[3], a_n, spun(W + d[3], T_n)])

    found = []
    for n in (2, 4):
        k, before, now = h / n, np.zeros((4, 3)), h / n * np.array([v, W, a, spun(W, T)])
        for _ in range(n - 1):
            before, now = now, before + 2 * k * slope(now)
        found.append((before + now + k * slope(now)) / 2)
    way = (4 * found[1] - found[0]) / 3
    x, Lambda, v, W = x + way[0], turned(Lambda, way[1]), v + way[2], W + way[3]
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
GENERALISED_ALPHA = """\
    f, m = 0.9 / 1.9, 0.8 / 1.9
    c, b, S = 0.5 - m + f, (1 - m + f) ** 2 / 4, spun(W, T)
    a_0, A_0 = state.get("used", (a, S))
    a_n, A_n = a_0, A_0
    for _ in range(5):
        v_n, W_n = v + h * ((1 - c) * a_0 + c * a_n), W + h * ((1 - c) * A_0 + c * A_n)
        x_n = x + h * v + h * h * ((0.5 - b) * a_0 + b * a_n)
        Lambda_n = turned(Lambda, h * W + h * h * ((0.5 - b) * A_0 + b * A_n))
        f_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        a_n = ((1 - f) * f_n + f * a - m * a_0) / (1 - m)
        A_n = ((1 - f) * spun(W_n, T_n) + f * S - m * A_0) / (1 - m)
    memory = memory | {"used": (a_n, A_n)}
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, f_n, T_n
"""
THREE_STEPS = """\
    past = (*state.get("past", ()), (v, W, a, spun(W, T)))[-3:]
    weights = {1: (1.0,), 2: (-1 / 2, 3 / 2), 3: (5 / 12, -16 / 12, 23 / 12)}[len(past)]
    mean = [sum(c * k for c, k in zip(weights, ks, strict=True)) for ks in zip(*past, strict=True)]
    x, Lambda = x + h * mean[0], turned(Lambda, h * mean[1])
    v, W = v + h * mean[2], W + h * mean[3]
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    memory = memory | {"past": past}
"""
SCHEMES = {
    "Radau": RADAU, "extrapolated midpoints": EXTRAPOLATED, "generalised alpha": GENERALISED_ALPHA,
    "Adams-Bashforth of three steps": THREE_STEPS,
}  # fmt: skip

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("a third for a quarter in the last stage", ALL, "(3 / 4, 1 / 4)", "(3 / 4, 1 / 3)"), "Radau"),
    (Mistake("gyroscopic moment of both stages with the other sign", EULER, "a_n, spun(at[3], T_n)",
             "a_n, np.linalg.solve(J, T_n + np.cross(at[3], J @ at[3]))"), "Radau"),
    (Mistake("the turn of both stages by rates in plate axes", ("I3",), "turned(Lambda, ways[1])",
             "turned(Lambda, Lambda @ ways[1])"), "Radau"),
    (Mistake("the coarse result added, not taken away", ALL, "4 * found[1] - found[0]", "4 * found[1] + found[0]"),
     "extrapolated midpoints"),
    (Mistake("smoothed without its half", ALL, "k * slope(now)) / 2", "k * slope(now))"), "extrapolated midpoints"),
    (Mistake("moment in plate axes in the slopes", ("A3", "I5", "I2"), "spun(W + d[3], T_n)",
             "spun(W + d[3], Lambda @ T_n)"), "extrapolated midpoints"),
    (Mistake("share of the old acceleration not divided out", ("I4", "A1"), "m * a_0) / (1 - m)", "m * a_0)"),
     "generalised alpha"),
    (Mistake("share of the old angular acceleration with the other sign", (*EULER, "A2", "A3"), "- m * A_0",
             "+ m * A_0"),
     "generalised alpha"),
    (Mistake("half of the turn by the rates before", ("I3",), "turned(Lambda, h * W + h * h * ((0.5",
             "turned(Lambda, h / 2 * W + h * h * ((0.5"), "generalised alpha"),
    (Mistake("a weight of three steps with the other sign", ALL, "-16 / 12", "16 / 12"),
     "Adams-Bashforth of three steps"),
    (Mistake("no gyroscopic moment in what is remembered", EULER, "(v, W, a, spun(W, T))",
             "(v, W, a, np.linalg.solve(J, T))"),
     "Adams-Bashforth of three steps"),
    (Mistake("turned by the sum of the weights' sizes", ("I3",), "turned(Lambda, h * mean[1])",
             "turned(Lambda, h * sum(abs(c) for c in weights) * W)"), "Adams-Bashforth of three steps"),
)  # fmt: skip

ELIMINATION = '''def solved(J, b):
    """By elimination, row by row."""
    M = np.column_stack([J, b])
    for i in range(3):
        M[i] = M[i] / M[i, i]
        for k in {0, 1, 2} - {i}:
            M[k] = M[k] - M[k, i] * M[i]
    return M[:, 3]


def first_half('''
ONE_ARRAY = """rows = np.array([[*c["s"], c["touching"], c["sliding"]] for c in found])
    kept = {"s": rows[:, :2], "anchored": rows[:, 2] == 1, "sliding": rows[:, 3] == 1}
    return force / block.mass, T, F, kept"""
LONG_LAW = """    xi, xi_rate, u_t, v_slide, s, K_N, C_N, K_T, C_T, mu_0, mu = (
        np.array(q, np.longdouble) for q in (xi, xi_rate, u_t, v_slide, s, K_N, C_N, K_T, C_T, mu_0, mu)
    )
"""
ORDERED = """    half = len(F) // 2
    wrenches = np.column_stack([F, np.cross(r, F)])
    whole = wrenches[:half].sum(axis=0) + wrenches[half:].sum(axis=0)
    force, moment = whole[:3] - [0, 0, mass * g], whole[3:]
"""
CORNERS = "np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * [width / 2, depth / 2]"
IN_PYTHON = (
    Variant("microseconds in the place",
            ((PLACE, "x_next = x + (1e6 * h) * (1e-6 * v) + (1e6 * h) ** 2 / 2 * (1e-12 * a)"),)),
    Variant("inertia solved for by least squares",
            ((SOLVED, "np.linalg.lstsq(J, T - np.cross(W, J @ W), rcond=None)[0]"),
             ("np.linalg.solve(J, gain)", "np.linalg.lstsq(J, gain, rcond=None)[0]"))),
    Variant("inertia solved for by elimination",
            (("def first_half(", ELIMINATION), (SOLVED, SOLVED.replace("np.linalg.solve", "solved")),
             ("np.linalg.solve(J, gain)", "solved(J, gain)"))),
    Variant("force and moment as one vector of six, outer and inner feet apart", ((SUM, ORDERED),)),
    Variant("penetration by the third row of the attitude",
            ((DEPTH, "-(x[2] + P @ Lambda[2]), -(v[2] + np.cross(W, P) @ Lambda[2]), rate[:, :2]"),)),
    Variant("anchors and flags in one array of numbers", ((FOUND, ONE_ARRAY),)),
    Variant("every step is kept, rows are picked at last",
            (("            if count == wanted[len(kept)]:\n" + KEPT_ROW, "            kept.append(state)\n"),
             (SHOWN, "        kept = [kept[i] for i in wanted]\n" + SHOWN))),
    Variant("the law of a foot in extended precision",
            (("    F_N = normal_force(xi, xi_rate, K_N, C_N)\n",
              LONG_LAW + "    F_N = normal_force(xi, xi_rate, K_N, C_N)\n"),
             ('"F_T": F_T, "s": s, "touching": True', '"F_T": np.float64(F_T), "s": np.float64(s), "touching": True'),
             ('{"F_N": F_N, "F_T": np.zeros(2), "s": s,', '{"F_N": F_N, "F_T": np.zeros(2), "s": np.float64(s),'),
             ('return {"F_N": F_N, "F_T": np.float64', 'return {"F_N": float(F_N), "F_T": np.float64'),
             ('trace = {"s_trial": s, "F_trial"', 'trace = {"s_trial": np.float64(s), "F_trial"'),
             ('{"F_trial": F_T, "threshold": limit}', '{"F_trial": np.float64(F_T), "threshold": float(limit)}'))),
    Variant("a share of the threshold compared with one",
            ((STICKS, "np.hypot(*F_trial) / limit <= 1 if limit > 0 else not np.any(F_trial)"),)),
    Variant("degrees by whole turns", (("np.degrees(W)", "np.asarray(W) / (2 * np.pi) * 360"),)),
    Variant("levers and velocities turned in one product",
            ((LEVERS, "    r, swept = np.split(np.concatenate([P, np.cross(W, P)]) @ Lambda.T, 2)\n"),
             (RATE, "rate = v + swept"))),
    Variant("the flag of sliding picks the coefficient",
            (("(mu if was_sliding else mu_0)", "(mu_0, mu)[int(was_sliding)]"),)),
    Variant("the weight taken off in two halves",
            ((SUMMED, "force = np.array([0, 0, -mass * g / 2]) + F.sum(axis=0) - [0, 0, mass * g / 2]"),)),
    Variant("damping by logarithms",
            (("2 * beta * np.sqrt(K * mass)", "2 * beta * np.exp((np.log(K) + np.log(mass)) / 2)"),)),
    Variant("gyroscopic moment by a skew matrix",
            ((SOLVED, "np.linalg.solve(J, T - SKEW @ W @ (J @ W))"),
             ("PROPERTIES = (", "SKEW = -np.cross(np.eye(3)[:, None], np.eye(3))\nPROPERTIES = ("))),
    Variant("sides doubled at the corners, halved at last",
            ((CORNERS, "np.array([(width, depth), (-width, depth), (-width, -depth), (width, -depth)]) / 2"),)),
)  # fmt: skip
IN_C = (
    Variant("the C text, loops unrolled and fused",
            flags=("-O3", "-march=native", "-funroll-all-loops", "-ffp-contract=fast")),
)  # fmt: skip
