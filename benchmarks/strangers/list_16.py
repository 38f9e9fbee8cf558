"""A sixteenth list of strangers: slips of indices, values that are stale, and caches that are kept too long.

Somebody ports the block to another language: entries read across the diagonal, arguments in another order, loops that
write one component, sums that are not set back, what the first run left in a cache, early exits; integrators by places
alone, by Nyström's formulas, by three stages, by a corrector of third order. Mistakes and variants were written down,
and published, before any of them was judged; that the integrators converge to the law was looked at before, without
the judge.
"""

from __future__ import annotations

from strangers.controls import SOLVED, SUM, Variant
from strangers.list_01 import FIRST, N1, T3, E, Mistake
from strangers.list_04 import EULER, FOUND, MOVED, UNSTARTED
from strangers.list_05 import CONE, FORCES, ROWS, STEP, TAKEN
from strangers.list_07 import AFTER, KEPT, ONE_STEP, SLIDES
from strangers.list_12 import GAIN, KICK, PLACE, RATE
from strangers.list_14 import BACK, LOADS, STRETCH, TIED

LEVERS = "    r = P @ Lambda.T\n"
TRIAL = "    F_T = trial_force(u_t, s, v_slide, K_T, C_T)\n"
NORMAL = "    F_N = normal_force(xi, xi_rate, K_N, C_N)\n"
MOMENT = "    moment = np.cross(r, F).sum(axis=0)\n"
SUMS = "    force, _, T = resultants(Lambda, r, F, block.mass, block.g)\n"
STEPS = "def advanced(problem, state):\n"
STARTED = "        state |= memory\n    return state\n"
#: New feet, but the first that touches, take over the anchor of the one asked before.
TAKEN_OVER = """    tied, s_last = dict(memory), None
    tied["s"], tied["anchored"] = np.array(memory["s"]), np.array(memory["anchored"])
    for i in np.flatnonzero(xi >= 0):
        if not memory["anchored"][i] and s_last is not None:
            tied["s"][i], tied["anchored"][i] = s_last, True
        s_last = tied["s"][i] if tied["anchored"][i] else u[i, :2]
    tied["sliding"] = np.array(memory["sliding"]) & np.array(memory["anchored"])
    memory = tied
"""
KEPT_LEVERS = """    r = memory.get("r", r)
    u = x + r
    rate = v + np.cross(Lambda @ W, r)
    xi, xi_rate, v_slide = -u[:, 2], -rate[:, 2], rate[:, :2]
"""
OVERWRITTEN = """    moment = np.zeros(3)
    for (a, b, c), (f, g_, k) in zip(r, F):
        a = b * k - c * g_
        b = c * f - a * k
        c = a * g_ - b * f
        moment = moment + [a, b, c]
"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("the height for the depth in the third moment", ("G1",), "width**2 + depth**2])", "width**2 + height**2])",
            False),
    Mistake("inner feet raised by the least of the outer heights", ("G2",), "np.full(4, -height / 2)",
            "np.full(4, delta_long.min() - height / 2)", False),
    Mistake("a decrement taken for a damping ratio", ("P2",), "2 * beta * np.sqrt",
            "2 * beta / np.hypot(2 * np.pi, beta) * np.sqrt", False),
    Mistake("rates below a hundredth of a degree are none", ("M1",), "np.degrees(W)",
            "np.degrees(W) * (np.abs(np.degrees(W)) >= 0.01)", False),
    # Points.
    Mistake("an entry of the attitude read across the diagonal", ("K1",), LEVERS,
            "    L = np.array(Lambda)\n    L[1, 2] = Lambda[2, 1]\n    r = P @ L.T\n"),
    Mistake("the rate about Y with the other sign in the velocities", ("K1",), RATE,
            RATE.replace("Lambda @ W", "Lambda @ (W * [1, -1, 1])")),
    Mistake("levers of the first evaluation are kept", ("K1", "S1"), MOVED, MOVED + KEPT_LEVERS, True,
            ((FOUND, FOUND + ' | {"r": r}'),)),
    Mistake("normal damper by the rate of the step before", ("N1", "K1", "S1"), MOVED,
            MOVED + '    xi_rate, now = memory.get("rate", xi_rate), xi_rate\n', True,
            ((FOUND, FOUND + ' | {"rate": now}'),)),
    Mistake("no force where the damper takes half of it", ("N1",), N1,
            "max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 and K_N * xi + 2 * C_N * xi_rate >= 0 else 0.0"),
    Mistake("a normal force grows by fifty newtons a step at most", ("N1", "S1"), FORCES,
            FORCES + '    if memory.get("F") is not None:\n'
            '        F[:, 2] = np.minimum(F[:, 2], memory["F"][:, 2] + 50.0)\n'),
    Mistake("a foot deeper than thirty micrometres is below the plate, and none", ("N1", "N2"), N1,
            N1.replace("xi >= 0", "0 <= xi < 3e-5")),
    Mistake("a new foot takes over the anchor of the one asked before", ("T5", "T1"), MOVED, MOVED + TAKEN_OVER),
    Mistake("y of a new anchor is not written", ("T5",), TIED,
            "return s if anchored and xi >= 0 else np.array([u_t[0], s[1]])"),
    Mistake("stiffness and damper of friction exchanged in the call", ("T1",), TRIAL,
            TRIAL.replace("K_T, C_T", "C_T, K_T")),
    Mistake("the vertical rate for that along y in the damper of friction", ("T1", "K1"), TRIAL,
            TRIAL.replace("v_slide", "np.array([v_slide[0], -xi_rate])")),
    Mistake("friction sees the feet where they were a step before", ("T1", "S1", "K1"), "            u[i, :2],\n",
            '            memory.get("u", u)[i, :2],\n', True, ((FOUND, FOUND + ' | {"u": u}'),)),
    Mistake("the coefficient is not squared with the rest", ("T2", "T6"), SLIDES, "slides = F_T @ F_T > limit * F_N"),
    Mistake("the step of touching is never one of sliding", ("T2",), SLIDES,
            "slides = bool(anchored and not sticks(F_T, limit))"),
    Mistake("dynamic coefficient for a foot that rises", ("T6",), CONE,
            "cone(F_N, sliding and anchored or xi_rate < 0, mu_0, mu)"),
    Mistake("sliding force never more than what stops the foot in a step", ("T3",),
            "F_T = sliding_force(F_T, F_N, mu)",
            "F_T = sliding_force(F_T, min(F_N, 54 / 8 * np.hypot(*v_slide) / 1e-5), mu)"),
    Mistake("x and y of the velocity exchanged where the anchor is moved", ("T4",), AFTER,
            AFTER.replace("v_slide", "v_slide[::-1]")),
    Mistake("an anchor moves where the foot leaves it only", ("T4",), AFTER,
            AFTER.replace("\n", " if (u_t - s) @ v_slide > 0 else s\n")),
    # The body.
    Mistake("no loads where no foot touches", ("A1",), "    force = F.sum(axis=0) - [0, 0, mass * g]\n",
            "    force = F.sum(axis=0) - np.array([0, 0, mass * g]) * F.any()\n"),
    Mistake("the sum of forces is not set back before the next step", ("A1", "S1"), SUMS,
            SUMS + '    force = force + (0 if memory.get("a") is None else block.mass * memory["a"])\n'),
    Mistake("the lever overwritten while its moment is made", ("A2",), MOMENT, OVERWRITTEN),
    Mistake("no moment by the friction of feet that slide", ("A2", "A3"), LOADS,
            'T = T - Lambda.T @ np.cross(r, F * np.outer([c["sliding"] for c in found], [1, 1, 0])).sum(axis=0)\n    '
            + LOADS),
    Mistake("y of the moment with the other sign where it is turned back", ("A3", "A2"), BACK,
            BACK.replace("@ moment", "@ (moment * [1, -1, 1])")),
    Mistake("velocity turned into body axes where it moves the place", ("I1",), PLACE,
            PLACE.replace("h * v", "h * Lambda.T @ v")),
    Mistake("inertia of the first run is kept", ("I2", "I5", "S2"), TAKEN,
            "h, J = problem.step, (kept or kept.append(problem.block.inertia) or kept)[0]", True,
            ((STEPS, "def advanced(problem, state, kept=[]):\n"),)),
    Mistake("y and z exchanged in the matrix of the turn", ("I3",), "x, y, z = Theta", "x, z, y = Theta"),
    Mistake("turns below a nanoradian are left out", ("I3",), "    if angle == 0:\n        return H\n",
            "    if angle < 1e-9:\n        return 0 * H\n"),
    Mistake("y of the velocity by the acceleration along x", ("I4",), KICK,
            KICK.replace("(a + a_next)", "(a + a_next)[[0, 0, 2]]")),
    Mistake("the gyroscopic moment once more beside the turned momentum", ("I5",), GAIN,
            GAIN.replace("  # I5", " - h * np.cross(W, J @ W)")),
    Mistake("the new moment in plate axes in the gain of the rates", ("I5", "A3"), FIRST,
            FIRST.replace("a, T, h", "a, Lambda @ T, h")),
    Mistake("forces evaluated twice, the second time with what the first left", ("S1", "T6", "T2"), ONE_STEP,
            ONE_STEP + "    " + ONE_STEP.replace("state,", "state | memory,")),
    # The run.
    Mistake("velocity of the start set back by half a step", ("S2", "I4", "I1", "K1"), STARTED,
            STARTED.replace("    return",
                            '    state["v"] = state["v"] - problem.step / 2 * state["a"]\n    return')),
    Mistake("feet that are tied at the start count as sliding", ("S2", "T6"), UNSTARTED,
            '    state["sliding"] = np.array(state["anchored"])\n' + UNSTARTED),
)  # fmt: skip

#: What dwindles with the step, and is no mistake in another integrator.
OF_THE_STEP = (
    "normal damper by the rate of the step before", "friction sees the feet where they were a step before",
    "a normal force grows by fifty newtons a step at most", "velocity of the start set back by half a step",
)  # fmt: skip

NYSTROEM = """\
    A = spun(W, T)
    half = x + h / 2 * v + h * h / 8 * a, turned(Lambda, h / 2 * W + h * h / 8 * A)
    W_2 = W + h / 2 * A
    a_2, T_2, _, _ = evaluate(problem, state, *half, v + h / 2 * a, W_2)
    A_2 = spun(W_2, T_2)
    W_3 = W + h / 2 * A_2
    a_3, T_3, _, _ = evaluate(problem, state, *half, v + h / 2 * a_2, W_3)
    A_3 = spun(W_3, T_3)
    whole = x + h * v + h * h / 2 * a_3, turned(Lambda, h * W + h * h / 2 * A_3)
    W_4 = W + h * A_3
    a_4, T_4, _, _ = evaluate(problem, state, *whole, v + h * a_3, W_4)
    x = x + h * v + h * h / 6 * (a + a_2 + a_3)
    Lambda = turned(Lambda, h * W + h * h / 6 * (A + A_2 + A_3))
    v = v + h / 6 * (a + 2 * a_2 + 2 * a_3 + a_4)
    W = W + h / 6 * (A + 2 * A_2 + 2 * A_3 + spun(W_4, T_4))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
BOGACKI_SHAMPINE = """\
    A = spun(W, T)
    v_2, W_2 = v + h / 2 * a, W + h / 2 * A
    a_2, T_2, _, _ = evaluate(problem, state, x + h / 2 * v, turned(Lambda, h / 2 * W), v_2, W_2)
    A_2 = spun(W_2, T_2)
    v_3, W_3 = v + 3 * h / 4 * a_2, W + 3 * h / 4 * A_2
    a_3, T_3, _, _ = evaluate(problem, state, x + 3 * h / 4 * v_2, turned(Lambda, 3 * h / 4 * W_2), v_3, W_3)
    x, Lambda = x + h / 9 * (2 * v + 3 * v_2 + 4 * v_3), turned(Lambda, h / 9 * (2 * W + 3 * W_2 + 4 * W_3))
    v, W = v + h / 9 * (2 * a + 3 * a_2 + 4 * a_3), W + h / 9 * (2 * A + 3 * A_2 + 4 * spun(W_3, T_3))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
PLACES_ALONE = """\
    A = spun(W, T)
    x_0, Theta_0 = state.get("before", (x - h * v + h * h / 2 * a, h * W - h * h / 2 * A))
    x_n, Theta = 2 * x - x_0 + h * h * a, Theta_0 + h * h * A
    Lambda_n = turned(Lambda, Theta)
    W_p = Theta / h + h / 2 * A
    a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, (x_n - x) / h + h / 2 * a, W_p)
    v, W = (x_n - x) / h + h / 2 * a_n, Theta / h + h / 2 * spun(W_p, T_n)
    memory = memory | {"before": (x, Theta)}
    x, Lambda, a, T = x_n, Lambda_n, a_n, T_n
"""
ADAMS_MOULTON = """\
    now = v, W, a, spun(W, T)
    v_0, W_0, a_0, A_0 = state.get("before", now)
    v_p, W_p = v + h / 2 * (3 * a - a_0), W + h / 2 * (3 * now[3] - A_0)
    at = x + h / 2 * (3 * v - v_0), turned(Lambda, h / 2 * (3 * W - W_0))
    a_p, T_p, _, _ = evaluate(problem, state, *at, v_p, W_p)
    x, Lambda = x + h / 12 * (5 * v_p + 8 * v - v_0), turned(Lambda, h / 12 * (5 * W_p + 8 * W - W_0))
    v, W = v + h / 12 * (5 * a_p + 8 * a - a_0), W + h / 12 * (5 * spun(W_p, T_p) + 8 * now[3] - A_0)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    memory = memory | {"before": now}
"""
SCHEMES = {
    "Nyström": NYSTROEM, "Bogacki-Shampine": BOGACKI_SHAMPINE, "places alone": PLACES_ALONE,
    "Adams-Moulton": ADAMS_MOULTON,
}  # fmt: skip

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("the sum of the four accelerations over five", ("I4", "A1"), "v + h / 6 * (a", "v + h / 5 * (a"),
     "Nyström"),
    (Mistake("no gyroscopic moment in the first of four", EULER, "W + h / 6 * (A +",
             "W + h / 6 * (np.linalg.solve(J, state['T']) +"), "Nyström"),
    (Mistake("half of the turn by the rates", ("I3",), "turned(Lambda, h * W + h * h / 6",
             "turned(Lambda, h / 2 * W + h * h / 6"), "Nyström"),
    (Mistake("a ninth lost in the turn", ("I3",), "2 * W + 3 * W_2 + 4 * W_3", "2 * W + 3 * W_2 + 3 * W_3"),
     "Bogacki-Shampine"),
    (Mistake("a ninth lost in the way", ("I1", "S2"), "2 * v + 3 * v_2 + 4 * v_3", "2 * v + 3 * v_2 + 3 * v_3"),
     "Bogacki-Shampine"),
    (Mistake("the moment of the last stage in plate axes", ("A3", "I5", "I2"), "4 * spun(W_3, T_3)",
             "4 * spun(W_3, Lambda @ T_3)"), "Bogacki-Shampine"),
    (Mistake("the difference of two places over two steps", ("I4", "K1", "S1"), "v, W = (x_n - x) / h",
             "v, W = (x_n - x) / (2 * h)", more=(("Lambda_n, (x_n - x) / h", "Lambda_n, (x_n - x) / (2 * h)"),)),
     "places alone"),
    (Mistake("the place before the start is the start", ("S2", "I1", "I4"), "(x - h * v + h * h / 2 * a, h * W",
             "(x, h * W"), "places alone"),
    (Mistake("increment of the turn grows by half", (*EULER, "I3"), "Theta_0 + h * h * A", "Theta_0 + h * h / 2 * A"),
     "places alone"),
    (Mistake("the loads of the step before with the other sign", ("I4", "A1"), "8 * a - a_0)", "8 * a + a_0)"),
     "Adams-Moulton"),
    (Mistake("the rates of the step before with the other sign", ("I3",), "8 * W - W_0", "8 * W + W_0"),
     "Adams-Moulton"),
    (Mistake("no gyroscopic moment in the corrector", EULER, "5 * spun(W_p, T_p)", "5 * np.linalg.solve(J, T_p)"),
     "Adams-Moulton"),
)  # fmt: skip

PADE = """    H = H / 256
    near = np.linalg.solve(np.eye(3) - H / 2 + H @ H / 10 - H @ H @ H / 120, H + H @ H @ H / 60)
    for _ in range(8):
        near = 2 * near + near @ near
    return near
"""
OF_TWO_BY_TWO = """    c, k = np.cos(angle / 2), np.sin(angle / 2) / angle
    U = np.array([[c - 1j * k * z, -k * (y + 1j * x)], [k * (y - 1j * x), c + 1j * k * z]])
    pauli = np.array([[[0, 1], [1, 0]], [[0, -1j], [1j, 0]], [[1, 0], [0, -1]]])
    return np.array([[np.trace(p @ U @ q @ U.conj().T).real / 2 for q in pauli] for p in pauli]) - np.eye(3)
"""
ADJUGATE = """def solved(J, b):
    \"\"\"By the cofactors.\"\"\"
    adjugate = np.array([np.cross(J[1], J[2]), np.cross(J[2], J[0]), np.cross(J[0], J[1])]).T
    return adjugate @ b / (J[0] @ adjugate[:, 0])


def first_half("""
LONG = """def length(a, b):
    \"\"\"Scaled by the larger component.\"\"\"
    large, small = max(abs(a), abs(b)), min(abs(a), abs(b))
    return large * np.sqrt(1 + (small / large) ** 2) if large > 0 else 0.0


def sticks("""
QUARTER = '''QUARTER = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


def of_plate(values, Q):
    """Vectors of the plate in axes that are turned about the height by a quarter."""
    made = dict(values)
    for key in ("x", "v", "a", "F"):
        made[key] = None if values[key] is None else values[key] @ Q.T
    return made | {"Lambda": Q @ values["Lambda"], "s": values["s"] @ Q[:2, :2].T}


def across(problem):
    """The problem in those axes."""
    from dataclasses import replace

    start = {k: getattr(problem.start, k) for k in ("x", "v", "a", "F", "Lambda", "s")}
    return replace(problem, start=replace(problem.start, **of_plate(start, QUARTER)))


class Backend:
'''
LOOP = """        state, kept = started(problem), []
        for count in range(wanted[-1] + 1):
            if count == wanted[len(kept)]:
                kept.append(state)
            if count < wanted[-1]:
                state = advanced(problem, state)
"""
GENERATED = """        import itertools

        def states():
            state = started(problem)
            while True:
                yield state
                state = advanced(problem, state)

        asked = set(wanted.tolist())
        kept = [s for i, s in enumerate(itertools.islice(states(), int(wanted[-1]) + 1)) if i in asked]
"""
IN_PYTHON = (
    Variant("exponential by Padé's quotient and squares", (("    return " + E + "\n", PADE),)),
    Variant("exponential by complex numbers, two by two", (("    return " + E + "\n", OF_TWO_BY_TWO),)),
    Variant("moment turned back by solving with the attitude",
            ((BACK, "return force, moment, np.linalg.solve(Lambda, moment)"),)),
    Variant("steps a second in place of a step",
            ((PLACE, "n = 1 / h\n    x_next = x + (v + a / (2 * n)) / n"),
             (KICK, "n = 1 / h\n    v_next = v + (a + a_next) / (2 * n)"))),
    Variant("springs and dampers of friction as matrices",
            ((STRETCH, "return -(np.diag([K_T, K_T]) @ (u_t - s)) - np.diag([C_T, C_T]) @ v_slide"),)),
    Variant("flags of sliding as bits of a number",
            ((FOUND, f"kept = {KEPT}\n"
              '    kept["sliding"] = sum(int(b) << i for i, b in enumerate(kept["sliding"]))\n'
              "    return force / block.mass, T, F, kept"),
             ('memory["sliding"][i]',
              'bool(memory["sliding"] >> i & 1) if isinstance(memory["sliding"], int) else memory["sliding"][i]'),
             (STEP, "        made, n = advanced(problem, started(problem)), len(problem.points.P)\n"
              '        return made | {"sliding": np.array([bool(made["sliding"] >> i & 1) for i in range(n)])}\n'))),
    Variant("inertia solved for by its cofactors",
            (("def first_half(", ADJUGATE), (SOLVED, SOLVED.replace("np.linalg.solve", "solved")),
             ("W + np.linalg.solve(J, gain)", "W + solved(J, gain)"))),
    Variant("steps by a generator", ((LOOP, GENERATED),)),
    Variant("length scaled by the larger component",
            (("def sticks(", LONG), ("np.hypot(*F_trial) <= limit", "length(*F_trial) <= limit"),
             (T3, T3.replace("np.hypot", "length")))),
    Variant("inertia and moments as shares of the third moment",
            ((SOLVED, "np.linalg.solve(J / J[2, 2], T / J[2, 2] - np.cross(W, J / J[2, 2] @ W))"),)),
    Variant("plate axes turned by a quarter inside",
            (("class Backend:\n", QUARTER),
             ("        state, kept = started(problem), []\n",
              "        problem = across(problem)\n        state, kept = started(problem), []\n"),
             ("kept.append(state)", "kept.append(of_plate(state, QUARTER.T))"),
             (STEP, "        problem = across(problem)\n"
              "        return of_plate(advanced(problem, started(problem)), QUARTER.T)\n"))),
    Variant("sums by the mean of the feet and their number",
            ((SUM, "    n = len(F)\n    force = n * (F.mean(axis=0) - [0, 0, mass * g / n])\n"
              "    moment = n * np.cross(r, F).mean(axis=0)\n"),)),
    Variant("rows in columns that were there before",
            ((ROWS, ROWS.replace("np.array([row[k] for row in kept])",
                                 "np.asfortranarray([row[k] for row in kept])")),)),
)  # fmt: skip
