"""A twenty-first list of strangers: five hands.

A programmer of C, one of games, a user of Julia, a control engineer, a student who translates by hand: clamps and warm
starts, averages of a sum where the sum of averages was meant, filters of a signal, rounding to fixed digits, flags in
too few bits, one letter for another, half of a pair of values a step old; two further integrators. Mistakes and
variants were written down, and published, before any of them was judged; that the integrators converge to the law was
looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import SOLVED, SUM, TURNED, E, Variant
from strangers.list_01 import FIRST, N1, T3, Mistake
from strangers.list_04 import EULER, FOUND, UNSTARTED
from strangers.list_05 import FORCES, ROWS, TRIAL
from strangers.list_07 import ADVANCED, ONE_STEP, SLIDES
from strangers.list_12 import GAIN, INCREMENT, KICK, MOMENT, PLACE, RATE, SUMMED
from strangers.list_13 import DEPTH
from strangers.list_14 import BACK, LOADS, STRETCH
from strangers.list_16 import LEVERS
from strangers.list_17 import ALL, KEPT_ANCHOR, LAST, MOMENTS, STAGES
from strangers.list_18 import CORNERS, LOOKED
from strangers.list_20 import RELEASE, RELEASED

FOOT = '''def contact_law(xi, xi_rate, u_t, v_slide, s, anchored, sliding, K_N, C_N, K_T, C_T, mu_0, mu):
    """N1 to T6 for one point, in order. `trace` shows what lies between, and is optional."""
'''
SLIDING = "F_T = sliding_force(F_T, F_N, mu)\n"
RESULTANTS = "    force, _, T = resultants(Lambda, r, F, block.mass, block.g)\n"
#: Normal forces that may pull, as long as all of them together push.
PULLED_TOGETHER = """    loads = np.where(xi >= 0, made[0] * xi + made[1] * xi_rate, 0.0)
    if loads.sum() > 0:
        F[:, 2] = loads
"""
TO_THE_MEAN = """    new = (xi >= 0) & ~np.array(memory["anchored"], bool)
    if new.any():
        memory = memory | {
            "s": np.where(new[:, None], u[xi >= 0, :2].mean(axis=0), memory["s"]),
            "sliding": np.array(memory["sliding"], bool) & ~new, "anchored": np.array(memory["anchored"], bool) | new,
        }
"""
#: Feet that were inside their cones a step before stick, whatever their trial force.
TWICE_ASKED = """    true, over = made.copy(), memory.get("over", np.zeros(len(r), bool))
    made[4:] = np.where(over, made[4:], 1e9)
"""
OVER = """ | {"over": np.array([
        np.hypot(*c["trace"]["F_trial"]) > true[4 + int(memory["sliding"][i]), i] * c["F_N"]
        for i, c in enumerate(found)
    ])}"""
ALL_TOGETHER = """    free = [
        contact_law(xi[i], xi_rate[i], u[i, :2], v_slide[i], memory["s"][i], memory["anchored"][i],
                    memory["sliding"][i], *made[:4, i], 1e9, 1e9)
        for i in range(len(r))
    ]
    if np.hypot(*sum(c["F_T"] for c in free)) <= sum(made[4, i] * c["F_N"] for i, c in enumerate(free)):
        found = free
"""
MOVED_LATE = """kept = {k: np.array([c[name] for c in found]) for k, name in keys.items()}
    moved, late = kept["s"], memory.get("moved", memory["s"])
    kept["s"] = np.where(kept["sliding"][:, None], late, moved)
    return force / block.mass, T, F, kept | {"moved": moved}"""
BY_HALF = """from scipy.spatial.transform import Rotation

    half = Rotation.from_rotvec(Rotation.from_matrix(Lambda).as_rotvec() / 2)
    return force, moment, half.inv().apply(moment)"""
QUATERNION_ADDED = """from scipy.spatial.transform import Rotation

    *b, w = Rotation.from_matrix(Lambda).as_quat()
    q = np.array([*(b + (w * Theta + np.cross(b, Theta)) / 2), w - b @ Theta / 2])
    Lambda_next = (q @ q) * Rotation.from_quat(q).as_matrix()"""
BY_STOPPING = """    if np.any(memory["anchored"] & ~np.array(state["anchored"], bool)):
        v = v * [1, 1, 0]
"""
OF_OLD_ACCELERATION = """A = state.get("A", (W_p - state["W"]) / h)
    Lambda = state["Lambda"] + state["Lambda"] @ rotation_less_identity(h * state["W"] + h * h / 2 * A)
    """
RAW = "np.round(np.degrees(W) * 131) / 131"

MISTAKES = (
    # What follows from the parameters, the release, and the channel.
    Mistake("the third moment as the sum of the two others", ("G1",), MOMENTS,
            "[depth**2 + height**2, width**2 + height**2, width**2 + depth**2 + 2 * height**2]", False),
    Mistake("inertia of a sheet without height", ("G1",), MOMENTS, "[depth**2, width**2, width**2 + depth**2]", False),
    Mistake("inertia of a box of thin walls", ("G1",), "mass / 12 *", "mass / 18 *", False),
    Mistake("inner feet raised by the distance on the diagonal", ("G2",), "np.full(4, -height / 2)",
            "np.full(4, delta_diag - height / 2)", False),
    Mistake("the diagonal of a side for that of the base", ("G2",), "np.hypot(width, depth)", "np.hypot(width, height)",
            False),
    Mistake("corners counted from one of them", ("G2",), CORNERS, CORNERS + " + [width / 2, depth / 2]", False),
    Mistake("inner feet twice as stiff", ("P1",), "K_N, K_T = np.full(8, K_N),",
            "K_N, K_T = np.repeat([K_N, 2 * K_N], 4),", False),
    Mistake("the larger damping ratio for all feet", ("P2", "P3"), "np.repeat([beta_ext, beta_int], 4),",
            "np.full(8, max(beta_ext, beta_int)),", False),
    Mistake("the weight for the mass in the damping", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K * mass * 9.81)", False),
    Mistake("the root of the product of both coefficients", ("P3", "T6"), "np.repeat([mu_ext, mu_int], 4)",
            "np.full(8, np.sqrt(mu_ext * mu_int))", False),
    Mistake("a release tilted to first order", ("R1",), RELEASED,
            RELEASE.replace("np.eye(3) + rotation_less_identity([-theta_0, 0, 0])",
                            "np.array([[1, 0, 0], [0, 1, theta_0], [0, -theta_0, 1]])") + RELEASED, False),
    Mistake("a release whose angle is taken for degrees", ("R1",), RELEASED,
            RELEASE.replace("[-theta_0,", "[-np.radians(theta_0),") + RELEASED, False),
    Mistake("a release level, but not sunk in", ("R1",), RELEASED,
            RELEASE.replace("-load / K_N[i] - Lambda", "-Lambda") + RELEASED, False),
    Mistake("a release above the pivot, not above the origin", ("R1",), RELEASED,
            RELEASE.replace("np.array([0, 0,", "np.array([0, P[i, 1] - Lambda[1] @ P[i],") + RELEASED, False),
    Mistake("a mean of three samples", ("M1",), "np.degrees(W)",
            "np.degrees(W[np.clip(np.arange(len(W))[:, None] + [-1, 0, 1], 0, len(W) - 1)]).mean(axis=1)", False),
    Mistake("rates in whole counts of a gyroscope", ("M1",), "np.degrees(W)", RAW, False),
    Mistake("the channel a sample late", ("M1",), "np.degrees(W)",
            "np.degrees(np.asarray(W)[np.maximum(np.arange(len(W)) - 1, 0)])", False),
    # Points.
    Mistake("heights of the levers left in body axes", ("K1",), LEVERS, LEVERS + "    r[:, 2] = P[:, 2]\n"),
    Mistake("a letter in x of the velocity of the turn", ("K1",), RATE,
            RATE + "\n    rate[:, 0] += (Lambda @ W)[2] * (r[:, 1] - r[:, 2])"),
    Mistake("rate of penetration of the centre of mass alone", ("K1",), DEPTH,
            DEPTH.replace("-rate[:, 2],", "np.full(len(r), -v[2]),")),
    Mistake("half of the penetration", ("K1", "N1"), DEPTH, DEPTH.replace("-u[:, 2],", "-u[:, 2] / 2,")),
    Mistake("places for levers in the velocity of the turn", ("K1",), RATE, RATE.replace(", r)", ", u)")),
    Mistake("no normal damper below a millimetre a second", ("N1",), N1,
            N1.replace("C_N * xi_rate", "C_N * xi_rate * (abs(xi_rate) > 1e-3)")),
    Mistake("a tenth of the last normal force to start from", ("N1", "S1"), FORCES,
            FORCES + '    if memory.get("F") is not None:\n'
            '        F[:, 2] += 0.1 * np.asarray(memory["F"])[:, 2] * (xi >= 0)\n'),
    Mistake("normal springs shared by the feet that touch", ("N1",), LOOKED,
            "    made[0] /= max((xi >= 0).sum(), 1)\n" + LOOKED),
    Mistake("rate of penetration filtered by half of the one before", ("N1", "K1", "S1"), LOOKED,
            '    raw, xi_rate = xi_rate, (xi_rate + memory.get("raw", xi_rate)) / 2\n' + LOOKED, True,
            ((FOUND, FOUND + ' | {"raw": raw}'),)),
    Mistake("feet may pull while all of them together push", ("N1",), FORCES, FORCES + PULLED_TOGETHER),
    Mistake("a foot that rises cannot begin to touch", ("N2", "N1", "T5"), FOOT,
            FOOT + "    xi = xi if anchored or xi_rate >= 0 else -abs(xi) - 1e-300\n"),
    Mistake("the force of a foot that has opened dies away by halves", ("N2",), FORCES,
            FORCES + '    if memory.get("F") is not None:\n'
            '        F[:, 2] += 0.5 * np.asarray(memory["F"])[:, 2] * (xi < 0)\n'),
    Mistake("a foot that comes back to its anchor is tied anew", ("T5", "T1"),
            "anchored and xi >= 0 else u_t", "anchored and xi >= 0 and v_slide @ (u_t - s) >= 0 else u_t", True,
            (("def anchor_before(xi, u_t, s, anchored):", "def anchor_before(xi, u_t, s, anchored, v_slide):"),
             ("s = anchor_before(xi, u_t, s, anchored)\n", "s = anchor_before(xi, u_t, s, anchored, v_slide)\n"))),
    Mistake("a new foot is tied to the mean of those that touch", ("T5", "T1"), LOOKED, TO_THE_MEAN + LOOKED),
    Mistake("flags of touching in four bits", ("T5", "S2"), 'memory["anchored"][i],', 'memory["anchored"][i % 4],'),
    Mistake("x and y of an anchor exchanged where it is kept", ("T5", "T4"), KEPT_ANCHOR,
            KEPT_ANCHOR.replace('"s": s', '"s": s[::-1]')),
    Mistake("the square of the stretch in the spring of friction", ("T1",), STRETCH,
            STRETCH.replace("(u_t - s)", "(u_t - s) * np.hypot(*(u_t - s)) * 1e5")),
    Mistake("y of the damper of friction with the other sign", ("T1",), STRETCH,
            STRETCH.replace("C_T * v_slide", "C_T * v_slide * [1, -1]")),
    Mistake("the spring of friction in proportion to the normal force", ("T1",), TRIAL,
            TRIAL.replace("K_T,", "K_T * F_N / 100,")),
    Mistake("half of the spring of friction in a foot that slid", ("T1",), TRIAL,
            TRIAL.replace("K_T,", "K_T / 2 if sliding and anchored else K_T,")),
    Mistake("a foot slides if it is outside its cone twice running", ("T2", "T6", "S2"), LOOKED, TWICE_ASKED + LOOKED,
            True, ((FOUND, FOUND + OVER),)),
    Mistake("the sum of friction is held to the sum of the thresholds", ("T2",), FORCES, ALL_TOGETHER + FORCES),
    Mistake("who slides is told by the velocity, for the next step", ("T2", "T6"), '"sliding": slides',
            '"sliding": bool(np.hypot(*v_slide) > 1e-3)'),
    Mistake("inner feet have the dynamic coefficient alone", ("T6", "T2"), LOOKED,
            "    made[4, len(r) // 2 :] = made[5, len(r) // 2 :]\n" + LOOKED),
    Mistake("the product of both coefficients for a foot that slid", ("T6",), "(mu if was_sliding else mu_0)",
            "(mu * mu_0 if was_sliding else mu_0)"),
    Mistake("sliding force by the mean of both coefficients", ("T3",), SLIDING,
            SLIDING.replace("mu)", "(mu + mu_0) / 2)")),
    Mistake("sliding force against the velocity of a fast foot", ("T3",), SLIDING,
            SLIDING.replace("(F_T,", "(-v_slide if np.hypot(*v_slide) > 1e-2 else F_T,")),
    Mistake("y of the sliding force by Pythagoras, without its sign", ("T3",), "return " + T3,
            "x = mu * F_N / np.hypot(*F_trial) * F_trial[0]\n"
            "    return np.array([x, np.sqrt(max((mu * F_N) ** 2 - x * x, 0.0))])"),
    Mistake("an anchor is moved a step late", ("T4",), FOUND, MOVED_LATE),
    Mistake("x of the velocity for both where the anchor is moved", ("T4",), "(F_T + C_T * v_slide) / K_T",
            "(F_T + C_T * v_slide[0]) / K_T"),
    # The body.
    Mistake("accelerations as multiples of gravity", ("A1", "I4"), LOADS, LOADS.replace("mass,", "mass / block.g,")),
    Mistake("friction of feet that stick left out of the sum of forces", ("A1",), RESULTANTS,
            RESULTANTS + '    force = force - sum([*c["F_T"], 0.0] * np.array(not c["sliding"]) for c in found)\n'),
    Mistake("the sum of forces in single precision", ("A1",), SUMMED, SUMMED.replace("F.sum(", "np.float32(F).sum(")),
    Mistake("half of the moment", ("A2",), MOMENT, MOMENT + " / 2"),
    Mistake("the sum of the levers across the sum of the forces", ("A2",), MOMENT,
            "moment = np.cross(np.sum(r, axis=0), np.sum(F, axis=0)) / len(r)"),
    Mistake("x of the moment alone is turned back", ("A3",), BACK,
            "return force, moment, np.array([(Lambda.T @ moment)[0], moment[1], moment[2]])"),
    Mistake("moment turned back by half of the turn", ("A3",), BACK, BY_HALF),
    # The step.
    Mistake("the place turned about the origin by the rates", ("I1",), PLACE,
            PLACE.replace("h * v +", "h * (v + np.cross(W, x)) +")),
    Mistake("a loop over the place that begins at the second", ("I1",), PLACE,
            PLACE.replace("h * v + h * h / 2 * a", "(h * v + h * h / 2 * a) * [0, 1, 1]")),
    Mistake("no gyroscopic moment about the height", ("I2", "S1"), SOLVED,
            SOLVED.replace("np.cross(W, J @ W)", "np.cross(W, J @ W) * [1, 1, 0]")),
    Mistake("the angular acceleration of the step before in the increment", ("I2", "I3", "S1"), ONE_STEP,
            OF_OLD_ACCELERATION + ONE_STEP, True, ((ADVANCED, '"F": F, "A": (W_p - state["W"]) / h, **memory}'),)),
    Mistake("y and z of the increment exchanged", ("I2",), INCREMENT,
            INCREMENT.replace("h * W + h * h / 2 * A", "(h * W + h * h / 2 * A)[[0, 2, 1]]")),
    Mistake("a quaternion that is added to, and not kept at length one", ("I3",), TURNED, QUATERNION_ADDED),
    Mistake("turned the other way", ("I3",), TURNED, TURNED.replace("@ E", "@ E.T")),
    Mistake("velocity in whole micrometres a second", ("I4",), KICK,
            "v_next = np.round(v + h / 2 * (a + a_next), 6)"),
    Mistake("the sinking stops in the step of touching", ("I4", "S2"), '    return {"x": x, "v": v, "Lambda": Lambda',
            BY_STOPPING + '    return {"x": x, "v": v, "Lambda": Lambda'),
    Mistake("the predicted rates for the old ones in the momentum", ("I5", "S1"), FIRST,
            FIRST.replace('state["W"], state["a"]', 'W_p, state["a"]')),
    Mistake("a gain of the momentum below a millionth is none", ("I5",), GAIN,
            "gain = h / 2 * T + E.T @ half + h / 2 * T_next\n    gain = np.where(np.abs(gain) < 1e-6, 0.0, gain)"),
    Mistake("attitude without the angular acceleration where the forces are evaluated", ("S1", "K1"), ONE_STEP,
            "unsped = np.eye(3) + rotation_less_identity(h * state['W'])\n    "
            + ONE_STEP.replace("x, Lambda,", 'x, state["Lambda"] @ unsped,')),
    Mistake("velocities predicted by one and a half accelerations, less half of the one before", ("S1",), ONE_STEP,
            'v_p = v_p + h / 2 * (state["a"] - state.get("a_0", state["a"]))\n    ' + ONE_STEP, True,
            ((ADVANCED, '"F": F, "a_0": state["a"], **memory}'),)),
    # The run.
    Mistake("rates handed out in degrees", ("S2", "M1"), ROWS,
            ROWS.replace("row[k] for", 'np.degrees(row[k]) if k == "W" else row[k] for')),
    Mistake("places handed out in millimetres", ("S2",), ROWS,
            ROWS.replace("row[k] for", '1000 * row[k] if k == "x" else row[k] for')),
    Mistake("contacts handed out from the last foot to the first", ("S2", "T5"), ROWS,
            ROWS.replace("row[k] for", 'row[k][::-1] if k == "anchored" else row[k] for')),
    Mistake("anchors of the start taken for millimetres", ("S2", "T5", "T1"), UNSTARTED,
            '    state["s"] = state["s"] / 1000\n' + UNSTARTED),
    Mistake("accelerations of the start taken for forces", ("S2",), "        state |= memory\n    return state\n",
            '        state |= memory\n    else:\n        state["a"] = state["a"] / problem.block.mass\n'
            "    return state\n"),
)  # fmt: skip

#: What dwindles with the step, and is no mistake in another integrator.
OF_THE_STEP = (
    "rate of penetration filtered by half of the one before", "a foot slides if it is outside its cone twice running",
    "an anchor is moved a step late",
)  # fmt: skip

#: Planted in other integrators: every second one that runs show.
IN_STEPS = tuple(m for m in MISTAKES if m.in_runs)[::2]

HEUN_OF_THREE = f"""\
    rates = [(v, W, a, spun(W, T))]
    for row in ((1 / 3,), (0.0, 2 / 3)):
{STAGES}\
    mean = [(k[0] + 3 * k[2]) / 4 for k in zip(*rates, strict=True)]
{LAST}"""
BUSS = """\
    A = spun(W, T)
    x_n, v_p, W_p = x + h * v + h * h / 2 * a, v + h * a, W + h * A
    Lambda_n = turned(Lambda, h * W + h * h / 2 * A + h**3 / 12 * np.cross(A, W))
    a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_p, W_p)
    spin = Lambda @ (J @ W + h / 2 * T) + h / 2 * Lambda_n @ T_n
    v, W = v + h / 2 * (a + a_n), np.linalg.solve(J, Lambda_n.T @ spin)
    x, Lambda, a, T = x_n, Lambda_n, a_n, T_n
"""
SCHEMES = {"Heun, third order": HEUN_OF_THREE, "Buss": BUSS}

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("weights of the first and of the last stage exchanged", ALL, "k[0] + 3 * k[2]", "3 * k[0] + k[2]"),
     "Heun, third order"),
    (Mistake("no moment in the stages", ("A2", "A3", *EULER), "spun(at[3], T_n)", "spun(at[3], 0 * T_n)"),
     "Heun, third order"),
    (Mistake("the mean turn in plate axes", ("I3",), "turned(Lambda, h * mean[1])",
             "turned(Lambda, h * Lambda @ mean[1])"), "Heun, third order"),
    (Mistake("gyroscopic moment of the last stage by the rates before", EULER, "spun(at[3], T_n)",
             "np.linalg.solve(J, T_n - np.cross(W, J @ at[3]))"), "Heun, third order"),
    (Mistake("a twelfth of the square of the step for that of its cube", ("I3", "I2"), "h**3 / 12",
             "h**2 / 12"), "Buss"),
    (Mistake("the new moment turned forth by the old attitude", ("A3", "I5"), "h / 2 * Lambda_n @ T_n",
             "h / 2 * Lambda @ T_n"), "Buss"),
    (Mistake("momentum turned back by the old attitude", ("I5",), "Lambda_n.T @ spin", "Lambda.T @ spin"), "Buss"),
    (Mistake("the old acceleration taken away", ("I4", "A1"), "(a + a_n)", "(a_n - a)"), "Buss"),
)  # fmt: skip

TWIST = """w = Lambda @ W
    twist = np.array([[0, -w[2], w[1], v[0]], [w[2], 0, -w[0], v[1]], [-w[1], w[0], 0, v[2]]])
    rate = np.column_stack([r, np.ones(len(r))]) @ twist.T"""
BY_AXES = """u = np.asarray(Theta) / angle
    less = -2 * np.sin(angle / 2) ** 2
    return np.array([less * e + np.sin(angle) * np.cross(u, e) - less * (u @ e) * u for e in np.eye(3)]).T"""
AS_RECORDS = """rows = np.array(
        [(c["s"], c["touching"], c["sliding"]) for c in found],
        dtype=[("s", "f8", 2), ("anchored", "?"), ("sliding", "?")],
    )
    return force / block.mass, T, F, {k: rows[k] for k in rows.dtype.names}"""
ABOUT_THE_FIRST = """    force = F.sum(axis=0) - [0, 0, mass * g]
    moment = np.cross(r - r[0], F).sum(axis=0) + np.cross(r[0], F.sum(axis=0))
"""
COMPLEX_SUM = """    across = (F[:, 0] + 1j * F[:, 1]).sum()
    force = np.array([across.real, across.imag, F[:, 2].sum() - mass * g])
    moment = np.cross(r, F).sum(axis=0)
"""
BY_ANGLE = """slides = not np.arctan2(np.hypot(*F_T), F_N) <= np.arctan(mu if sliding and anchored else mu_0)"""
IN_PYTHON = (
    Variant("levers as a sum over the axes of the block",
            ((LEVERS, "    r = P[:, :1] * Lambda[:, 0] + P[:, 1:2] * Lambda[:, 1] + P[:, 2:] * Lambda[:, 2]\n"),)),
    Variant("velocities of the feet by a twist", ((RATE, TWIST),)),
    Variant("forces along the plate summed as complex numbers", ((SUM, COMPLEX_SUM),)),
    Variant("moments about the first foot, moved to the centre of mass", ((SUM, ABOUT_THE_FIRST),)),
    Variant("normal force by products with truth values",
            ((N1, "float(xi >= 0) * (K_N * xi + C_N * xi_rate > 0) * (K_N * xi + C_N * xi_rate)"),)),
    Variant("normal force as a product of two vectors",
            ((N1, N1.replace("K_N * xi + C_N * xi_rate", "np.dot([K_N, C_N], [xi, xi_rate])")),)),
    Variant("the stiffness taken out of the trial force",
            ((STRETCH, "return -K_T * ((u_t - s) + C_T / K_T * np.asarray(v_slide))"),)),
    Variant("an inverse root as a power",
            (("return " + T3, "return mu * F_N * (F_trial @ F_trial) ** -0.5 * F_trial"),)),
    Variant("the angle of the trial force held against that of friction", ((SLIDES, BY_ANGLE),)),
    Variant("exponential by turning each axis", ((E, BY_AXES),)),
    Variant("half of the step taken out of the place",
            ((PLACE, "x_next = x + h / 2 * (2 * np.asarray(v) + h * np.asarray(a))"),)),
    Variant("velocity by a trapezium of a library",
            ((KICK, "from scipy.integrate import trapezoid\n\n"
              "    v_next = v + trapezoid([a, a_next], dx=h, axis=0)"),)),
    Variant("inertia solved for by a pseudo-inverse",
            ((SOLVED, "np.linalg.pinv(J) @ (T - np.cross(W, J @ W))"),
             ("W + np.linalg.solve(J, gain)", "W + np.linalg.pinv(J) @ gain"))),
    Variant("places counted from that of the first foot", (("    u = x + r\n", "    u = (x + r[0]) + (r - r[0])\n"),)),
    Variant("memory of the feet as an array of records", ((FOUND, AS_RECORDS),)),
    Variant("corners by walking round",
            ((CORNERS, "np.cumsum([(1, 1), (-2, 0), (0, -2), (2, 0)], axis=0) * [width / 2, depth / 2]"),)),
    Variant("a root of the stiffness, and one of the mass",
            (("np.sqrt(K * mass)", "np.sqrt(K) * np.sqrt(mass)"),)),
    Variant("moment along each axis of the block",
            ((BACK, "return force, moment, np.array([axis @ moment for axis in Lambda.T])"),)),
)  # fmt: skip
IN_C = (
    Variant("the C text, quotients by reciprocals",
            flags=("-O3", "-freciprocal-math", "-fno-trapping-math", "-fno-signed-zeros")),
    Variant("the C text, sums in any order",
            flags=("-O3", "-fassociative-math", "-fno-trapping-math", "-fno-signed-zeros")),
)  # fmt: skip
