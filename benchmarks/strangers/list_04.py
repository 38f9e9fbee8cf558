"""A fourth list of strangers: mistakes and correct variants in the manner of other languages and integrators.

Arrays stored by columns, constants of single precision, positions of feet that are kept from one step to the next,
feet summed in another order, steps made of others. The mistakes were written down, and published, before any of them
was judged; so were the variants, which have to pass.
"""

from __future__ import annotations

from strangers.controls import SECOND, SUM, E, Variant
from strangers.list_01 import Mistake

N1 = "max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0"
MOVED = "r, u, xi, xi_rate, v_slide = point_motion(x, Lambda, v, W, points.P)\n"
FOUND = "return force / block.mass, T, F, {k: np.array([c[name] for c in found]) for k, name in keys.items()}"
RESULTANTS = "resultants(Lambda, r, F, block.mass, block.g)\n"
UNSTARTED = '    if state["a"] is None:\n'

OF_PARAMETERS = (
    Mistake("internal points numbered from another corner", ("G2",), "corners * inwards",
            "np.roll(corners, 1, axis=0) * inwards", False),
    Mistake("a quarter of the mass for each damper", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K * mass / 4)", False),
    Mistake("gyroscope with its Y axis turned round", ("M1",), "np.degrees(W)", "np.degrees(W) * [1, -1, 1]", False),
)  # fmt: skip

OF_POINTS = (
    Mistake("velocities of feet by differences of their places", ("K1", "S1"), MOVED,
            MOVED + '    if "u" in memory:\n        rate = (u - memory["u"]) / problem.step\n'
            "        xi_rate, v_slide = -rate[:, 2], rate[:, :2]\n", more=((FOUND, FOUND + ' | {"u": u}'),)),
    Mistake("sliding velocity in body axes", ("K1",), "rate[:, :2]", "(rate @ Lambda)[:, :2]"),
    Mistake("rate of penetration by the turn alone", ("K1",), "-rate[:, 2], rate", "-(rate - v)[:, 2], rate"),
    Mistake("damper in proportion to the penetration", ("N1",), N1, N1.replace("xi_rate", "xi_rate * xi / 1e-5")),
    Mistake("spring that begins softly", ("N1",), N1, N1.replace("K_N * xi", "K_N * xi * xi / (xi + 1e-7)")),
    Mistake("feet pull by a newton within a micrometre", ("N2",), N1,
            N1.replace("else 0.0", "else -1.0 * (xi > -1e-6)")),
    Mistake("anchor given up where no force is left", ("T5",), "anchor_before(xi, u_t, s, anchored)\n",
            "anchor_before(xi, u_t, s, anchored and F_N > 0)\n"),
    Mistake("no damper in a foot that slid", ("T1",), "trial_force(u_t, s, v_slide, K_T, C_T)\n",
            "trial_force(u_t, s, v_slide, K_T, 0.0 if sliding and anchored else C_T)\n"),
    Mistake("dynamic coefficient for feet that move", ("T6",), "cone(F_N, sliding and anchored, mu_0, mu)",
            "cone(F_N, sliding and anchored or np.hypot(*v_slide) > 1e-3, mu_0, mu)"),
    Mistake("anchor moved half of its way", ("T4",), "s = anchor_after(F_T, u_t, v_slide, K_T, C_T)",
            "s = (s + anchor_after(F_T, u_t, v_slide, K_T, C_T)) / 2"),
)  # fmt: skip

OF_BODIES = (
    Mistake("weight in single precision", ("A1",), "[0, 0, mass * g]", "[0, 0, np.float32(mass) * np.float32(g)]"),
    Mistake("a loop over the feet that ends one too early", ("A1",), "F.sum(axis=0) -", "F[:-1].sum(axis=0) -"),
    Mistake("a sign in the middle of the cross product", ("A2",), "np.cross(r, F).sum(axis=0)",
            "np.cross(r, F).sum(axis=0) * [1, -1, 1]"),
    Mistake("moment by the levers of the step before", ("A2", "S1"), RESULTANTS,
            'resultants(Lambda, memory.get("r", r), F, block.mass, block.g)\n',
            more=((FOUND, FOUND + ' | {"r": r}'),)),
    Mistake("exponential to the second order", ("I3",), E, "return H + H @ H / 2"),
    Mistake("rates predicted without the gyroscopic moment", ("S1",), "v + h * a, W + h * A, E",
            "v + h * a, W + h * np.linalg.solve(J, T), E"),
    Mistake("moment of the step before not turned back", ("I5",), "half = J @ W + h / 2 * T", "half = J @ W"),
)  # fmt: skip

OF_RUNS = (
    Mistake("attitude of the start read by columns", ("S2", "I3", "K1"), UNSTARTED,
            '    state["Lambda"] = state["Lambda"].T\n' + UNSTARTED),
    Mistake("anchors of the start read by columns", ("S2", "T5", "T1"), UNSTARTED,
            '    state["s"] = state["s"].reshape(2, -1).T\n' + UNSTARTED),
    Mistake("the first step is half a step", ("S2", "I1"), "h, J = problem.step,",
            'h, J = problem.step * (1 if "begun" in state else 0.5),',
            more=(('"F": F, **memory}', '"F": F, "begun": 1, **memory}'),)),
)  # fmt: skip

MISTAKES = OF_PARAMETERS + OF_POINTS + OF_BODIES + OF_RUNS

HEAD = '''def advanced(problem, state):
    """One step later."""
    h, J = problem.step, problem.block.inertia
    x, v, Lambda, W, a, T = (state[k] for k in ("x", "v", "Lambda", "W", "a", "T"))

    def spun(W, T):
        return np.linalg.solve(J, T - np.cross(W, J @ W))

    def turned(Lambda, Theta):
        return Lambda + Lambda @ rotation_less_identity(Theta)

'''
TAIL = '    return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}\n\n\n'
VERLET = """\
    v, W = v + h / 2 * a, W + h / 2 * spun(W, T)
    x, Lambda = x + h * v, turned(Lambda, h * W)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    v, W = v + h / 2 * a, W + h / 2 * spun(W, T)
"""
DRIFT_KICK_DRIFT = """\
    x, Lambda = x + h / 2 * v, turned(Lambda, h / 2 * W)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    v, W = v + h * a, W + h * spun(W + h / 2 * spun(W, T), T)
    x, Lambda = x + h / 2 * v, turned(Lambda, h / 2 * W)
    a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)
"""
HEUN = """\
    A = spun(W, T)
    v_1, W_1 = v + h * a, W + h * A
    a_1, T_1, _, _ = evaluate(problem, state, x + h * v, turned(Lambda, h * W), v_1, W_1)
    x, Lambda = x + h / 2 * (v + v_1), turned(Lambda, h / 2 * (W + W_1))
    v, W = v + h / 2 * (a + a_1), W + h / 2 * (A + spun(W_1, T_1))
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
RUNGE_KUTTA = """\
    rates = [(v, W, a, spun(W, T))]
    for share in (0.5, 0.5, 1.0):
        v_k, W_k, a_k, A_k = rates[-1]
        at = x + share * h * v_k, turned(Lambda, share * h * W_k), v + share * h * a_k, W + share * h * A_k
        a_n, T_n, _, _ = evaluate(problem, state, *at)
        rates.append((at[2], at[3], a_n, spun(at[3], T_n)))
    mean = [(k[0] + 2 * k[1] + 2 * k[2] + k[3]) / 6 for k in zip(*rates, strict=True)]
    x, Lambda = x + h * mean[0], turned(Lambda, h * mean[1])
    v, W = v + h * mean[2], W + h * mean[3]
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
"""
SCHEMES = {
    "velocity Verlet": VERLET, "drift-kick-drift": DRIFT_KICK_DRIFT, "Heun": HEUN, "Runge-Kutta": RUNGE_KUTTA
}  # fmt: skip
EULER = ("I2", "I5")

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("second kick without the gyroscopic moment", EULER, "a, W + h / 2 * spun(W, T)\n    return {",
             "a, W + h / 2 * np.linalg.solve(J, T)\n    return {"), "velocity Verlet"),
    (Mistake("turned before it is kicked, and by half", ("I3",), "turned(Lambda, h * W)", "turned(Lambda, h / 2 * W)"),
     "velocity Verlet"),
    (Mistake("second half of the turn forgotten", ("I3",), "    x, Lambda = x + h / 2 * v, turned(Lambda, h / 2 * W)\n"
             "    a, T, F, memory = evaluate(problem, memory", "    x = x + h / 2 * v\n"
             "    a, T, F, memory = evaluate(problem, memory"), "drift-kick-drift"),
    (Mistake("gyroscopic moment by rates with the other sign", EULER,
             "return np.linalg.solve(J, T - np.cross(W, J @ W))",
             "return np.linalg.solve(J, T - np.cross(W, J @ -W))"),
     "drift-kick-drift"),
    (Mistake("mean of the rates in plate axes", ("I3",), "turned(Lambda, h / 2 * (W + W_1))",
             "turned(Lambda, h / 2 * Lambda @ (W + W_1))"), "Heun"),
    (Mistake("weight of the second evaluation a third too large", ("I4", "A1"), "v + h / 2 * (a + a_1)",
             "v + h / 2 * (a + 4 / 3 * a_1)"), "Heun"),
    (Mistake("a two forgotten in the mean of four", ("I1", "I3", "I4", "I5", "S2"), "k[0] + 2 * k[1] + 2 * k[2]",
             "k[0] + 2 * k[1] + k[2]"), "Runge-Kutta"),
    (Mistake("turn multiplied from the plate's side", ("I3",), "Lambda + Lambda @ rotation_less_identity(Theta)",
             "Lambda + rotation_less_identity(Theta) @ Lambda"), "Runge-Kutta"),
)  # fmt: skip


def exchanged(source: str, step: str) -> str:
    """The tutorial's text with another step: lines that follow `HEAD`."""
    begin, end = source.index("def advanced(problem, state):"), source.index("class Backend:")
    return source[:begin] + HEAD + step + TAIL + source[end:]


#: Correct variants of the tutorials; the integrators of `SCHEMES` are correct, too, in the profile "scheme".
IN_PYTHON = (
    Variant(
        "feet summed by halves, and halves of halves",
        (
            (
                SUM,
                """\
    arms = np.cross(r, F)

    def halved(a):
        return a.sum(axis=0) if len(a) < 3 else halved(a[: len(a) // 2]) + halved(a[len(a) // 2 :])

    force, moment = halved(F) - [0, 0, mass * g], halved(arms)
""",
            ),
        ),
    ),
    Variant(
        "even feet summed first, then odd ones, the weight at the beginning",
        (
            (
                SUM,
                """\
    force, moment = np.array([0, 0, -mass * g]), np.zeros(3)
    for i in [*range(0, len(F), 2), *range(1, len(F), 2)]:
        force, moment = force + F[i], moment + np.cross(r[i], F[i])
""",
            ),
        ),
    ),
    Variant(
        "feet and attitude stored by columns",
        (
            (
                "r = P @ Lambda.T\n",
                'r = np.asfortranarray(np.asfortranarray(Lambda) @ np.asfortranarray(P.T)).T\n',
            ),
        ),
    ),
    Variant(
        "exponential by sinc",
        ((E, "return np.sinc(angle / np.pi) * H + np.sinc(angle / 2 / np.pi) ** 2 / 2 * H @ H"),),
    ),
    Variant(
        "turn by a rotation class of a library",
        ((E, "from scipy.spatial.transform import Rotation\n\n"
          "    return Rotation.from_rotvec(Theta).as_matrix() - np.eye(3)"),),
    ),
    Variant(
        "velocity by the linear momentum",
        (
            (SECOND, SECOND.removesuffix("    return {") + "    m = problem.block.mass\n"
             '    v = (m * state["v"] + h / 2 * (m * state["a"] + m * a)) / m\n    return {'),
        ),
    ),
    Variant(
        "constants for each kilogram, forces multiplied by the mass",
        (
            ("    found = [\n", "    made[:4] /= block.mass\n    found = [\n"),
            ('F = np.array([[*c["F_T"], c["F_N"]] for c in found])',
             'F = block.mass * np.array([[*c["F_T"], c["F_N"]] for c in found])'),
        ),
    ),
    Variant(
        "millimetres inside the contact law",
        (
            ("            xi[i],\n            xi_rate[i],\n            u[i, :2],\n            v_slide[i],\n"
             '            memory["s"][i],\n',
             "            1e3 * xi[i],\n            1e3 * xi_rate[i],\n            1e3 * u[i, :2],\n"
             '            1e3 * v_slide[i],\n            1e3 * memory["s"][i],\n'),
            ("    found = [\n", "    made[:4] /= 1e3\n    found = [\n"),
            (FOUND, "kept = {k: np.array([c[name] for c in found]) for k, name in keys.items()}\n"
             '    kept["s"] = kept["s"] / 1e3\n    return force / block.mass, T, F, kept'),
        ),
    ),
    Variant(
        "gravity added to the accelerations at the end of the sum",
        (
            ("force = F.sum(axis=0) - [0, 0, mass * g]", "force = mass * (F.sum(axis=0) / mass + [0, 0, -g])"),
        ),
    ),
    Variant(
        "Euler's equations by the rate of the momentum in plate axes",
        (
            ("A = np.linalg.solve(J, T - np.cross(W, J @ W))",
             "A = np.linalg.solve(J, Lambda.T @ (Lambda @ T - np.cross(Lambda @ W, Lambda @ (J @ W))))"),
        ),
    ),
)  # fmt: skip
IN_C = (
    Variant(
        "C, even feet summed first",
        (
            (
                "apply(L, W_, omega);\n    for (int i = 0; i < n; i++) {\n        apply(L, P",
                "apply(L, W_, omega);\n    for (int k = 0; k < n; k++) {\n"
                "        int i = k < (n + 1) / 2 ? 2 * k : 2 * (k - (n + 1) / 2) + 1;\n        apply(L, P",
            ),
        ),
    ),
    Variant(
        "C, forces and moments summed in extended doubles",
        (
            ("arm[3], force[3] = {0, 0, -mass * g}, moment[3] = {0, 0, 0};",
             "arm[3], moment[3];\n    long double sum[3] = {0, 0, -mass * g}, turn[3] = {0, 0, 0};"),
            ("force[j] += F[3 * i + j], moment[j] += arm[j];", "sum[j] += F[3 * i + j], turn[j] += arm[j];"),
            ("a[j] = force[j] / mass;", "a[j] = sum[j] / mass, moment[j] = turn[j];"),
        ),
    ),
)  # fmt: skip
