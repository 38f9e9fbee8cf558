"""A twentieth list of strangers: what somebody writes who ports the block from the paper to arrays.

The release posture by hand, products element by element, one component for its neighbour, values of the step before,
what is lumped, averaged or scaled, truth of a number for its sign, half of a program in other units; integrators of
numerical libraries. Mistakes and variants were written down, and published, before any of them was judged; that the
integrators converge to the law was looked at before, without the judge.
"""

from __future__ import annotations

from strangers.controls import GAIN, SUM, TURNED, E, Variant
from strangers.list_01 import N1, SPEED, T3, Mistake
from strangers.list_04 import EULER, FOUND, UNSTARTED
from strangers.list_05 import MADE, ROWS, TRIAL
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP
from strangers.list_12 import INCREMENT, KICK, MOMENT, PLACE, RATE, SUMMED
from strangers.list_13 import DEPTH
from strangers.list_14 import BACK, STRETCH
from strangers.list_16 import LEVERS, NORMAL, STARTED
from strangers.list_17 import ALL, LAST, MOMENTS, STAGES
from strangers.list_18 import CORNERS, STICKS
from strangers.list_19 import CHOSEN, PREDICTED, SLIDING_ROW

RELEASED = "    def kinematics(self, x, Lambda, v, W, P):\n"
RELEASE = '''    def release(self, mass, g, P, K_N, theta_0):
        """R1."""
        tilt = np.eye(3) + rotation_less_identity([-theta_0, 0, 0])
        lowest = []
        for side in (P[:, 0] > 0, P[:, 0] < 0):
            heights = np.where(side, P @ tilt[2], np.inf)
            lowest.append(np.argmin(heights))
        i, j = lowest
        load, phi = mass * g / 2, 0.0
        for _ in range(30):
            Lambda = tilt + tilt @ rotation_less_identity([0, phi, 0])
            gap = Lambda[2] @ (P[i] - P[j]) - load / K_N[j] + load / K_N[i]
            phi -= gap / (Lambda[2] @ np.cross([0, 1, 0], P[i] - P[j]))
        return {"x": np.array([0, 0, -load / K_N[i] - Lambda[2] @ P[i]]), "Lambda": Lambda}

'''
BY_EULER_RATES = """np.degrees(euler_rates(W, Lambda))"""
EULER_RATES = '''def euler_rates(W, Lambda):
    """Rates of Euler's angles, about X, Y and Z in turn."""
    from scipy.spatial.transform import Rotation

    a, b, _ = Rotation.from_matrix(Lambda).as_euler("xyz").T
    p, q, r = np.transpose(W)
    turn = np.sin(a) * q + np.cos(a) * r
    return np.column_stack([p + np.tan(b) * turn, np.cos(a) * q - np.sin(a) * r, turn / np.cos(b)])


PROPERTIES = ('''
BY_EULER_ANGLES = """from scipy.spatial.transform import Rotation

    angles = Rotation.from_matrix(Lambda).as_euler("xyz")
    Lambda_next = Rotation.from_euler("xyz", angles + Theta).as_matrix()"""
BY_QUATERNIONS = """from scipy.spatial.transform import Rotation

    x1, y1, z1, w1 = Rotation.from_matrix(Lambda).as_quat()
    x2, y2, z2, w2 = Rotation.from_rotvec(Theta).as_quat()
    q = [w1 * x2 + x1 * w2 + y1 * z2 - z1 * y2, w1 * y2 - x1 * z2 + y1 * w2 - z1 * x2,
         w1 * z2 + x1 * y2 - y1 * x2 + z1 * w2, w1 * w2 - x1 * x2 - y1 * y2 - z1 * z2]
    Lambda_next = Rotation.from_quat(q).as_matrix()"""

MISTAKES = (
    # What follows from the parameters, the release, and the channel.
    Mistake("radii of gyration for their squares in the inertia", ("G1",), MOMENTS, f"np.sqrt({MOMENTS})", False),
    Mistake("a product of inertia as about a corner", ("G1",), f"mass / 12 * np.diag({MOMENTS})",
            f"mass / 12 * np.diag({MOMENTS})"
            " - mass / 4 * width * depth * np.array([[0, 1, 0], [1, 0, 0], [0, 0, 0]])", False),
    Mistake("corners in the order of two loops", ("G2",), CORNERS,
            CORNERS.replace("(-1, -1), (1, -1)]", "(1, -1), (-1, -1)]"), False),
    Mistake("distance on the diagonal in millimetres", ("G2",), "1 - delta_diag /", "1 - 1e-3 * delta_diag /", False),
    Mistake("heights of the outer feet counted from the least of them", ("G2",), "delta_long - height / 2",
            "np.asarray(delta_long) - np.min(delta_long) - height / 2", False),
    Mistake("a bedding modulus for the stiffness", ("P1",), "K_N, K_T = np.full(8, K_N),",
            "K_N, K_T = np.full(8, K_N * width * depth / 8),", False),
    Mistake("damping by the stiffness of all feet together", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K.sum() * mass)",
            False),
    Mistake("angles of friction for coefficients", ("P3", "T6"), "np.repeat([mu_ext, mu_int], 4)",
            "np.tan(np.repeat([mu_ext, mu_int], 4))", False),
    Mistake("a release on rigid feet", ("R1",), RELEASED,
            RELEASE.replace("load, phi = mass * g / 2,", "load, phi = 0.0,") + RELEASED, False),
    Mistake("a release tilted to the other side", ("R1",), RELEASED, RELEASE.replace("-theta_0", "theta_0") + RELEASED,
            False),
    Mistake("a release whose turns are exchanged", ("R1",), RELEASED,
            RELEASE.replace("[0, phi, 0])\n", "[0, phi, 0])\n            Lambda = (np.eye(3) + rotation_less_identity("
                            "[0, phi, 0])) @ tilt\n") + RELEASED, False),
    Mistake("a release whose pivots are found before the block is tilted", ("R1",), RELEASED,
            RELEASE.replace("P @ tilt[2]", "P[:, 2]") + RELEASED, False),
    Mistake("a release where each pivot carries the whole weight", ("R1",), RELEASED,
            RELEASE.replace("mass * g / 2", "mass * g") + RELEASED, False),
    Mistake("rates of Euler's angles for those of the body", ("M1",), "np.degrees(W)", BY_EULER_RATES, False,
            (("PROPERTIES = (", EULER_RATES),)),
    Mistake("rates less their mean", ("M1",), "np.degrees(W)", "np.degrees(W - np.mean(W, axis=0))", False),
    # Points.
    Mistake("the sinking of the centre twice in the rate of penetration", ("K1",), DEPTH,
            DEPTH.replace("-rate[:, 2],", "-rate[:, 2] - v[2],")),
    Mistake("x of the velocity of the turn without its height", ("K1",), RATE,
            RATE + "\n    rate[:, 0] -= (Lambda @ W)[1] * r[:, 2]"),
    Mistake("the second axis of the block the wrong way round in the levers", ("K1",), LEVERS,
            "    r = (P * [1, -1, 1]) @ Lambda.T\n"),
    Mistake("y of the places without its lever", ("K1",), "    u = x + r\n", "    u = x + r * [1, 0, 1]\n"),
    Mistake("inner feet take over the velocities of the outer ones", ("K1",), RATE,
            RATE + "\n    rate[4:] = rate[: len(rate[4:])]"),
    Mistake("levers divided by the cosine of the lean", ("K1",), LEVERS, "    r = P @ Lambda.T / Lambda[2, 2]\n"),
    Mistake("a foot that does not move has no normal force", ("N1",), N1,
            N1.replace("xi >= 0", "xi >= 0 and xi_rate")),
    Mistake("the spring in kilonewtons beside a damper in newtons", ("N1",), N1,
            N1.replace("K_N * xi", "1e-3 * K_N * xi")),
    Mistake("constants of the feet read from the last to the first", ("N1", "T1", "T6", "T3"), MADE,
            MADE + "    made = made[:, ::-1]\n"),
    Mistake("the square of the penetration in the spring", ("N1",), N1, N1.replace("K_N * xi", "1e5 * K_N * xi**2")),
    Mistake("normal damper by the mean rate of all feet", ("N1",), "            xi[i],\n            xi_rate[i],",
            "            xi[i],\n            xi_rate.mean(),"),
    Mistake("an open foot is dragged at", ("N2", "T5", "T1"), '"F_T": np.zeros(2), "s": s, "touching": False',
            '"F_T": -1e-3 * C_T * np.asarray(v_slide), "s": s, "touching": False'),
    Mistake("a plate that ends fifteen centimetres from the origin", ("N2", "N1", "K1"), NORMAL,
            "    xi = xi if np.abs(u_t).max() < 0.15 else -1.0\n" + NORMAL),
    Mistake("x of the stretch for both components", ("T1",), STRETCH, STRETCH.replace("(u_t - s)", "(u_t - s)[0]")),
    Mistake("no damper of friction in the step of touching", ("T1",), TRIAL,
            TRIAL.replace("C_T)", "C_T if anchored else 0.0)")),
    Mistake("half of the damper of friction", ("T1",), STRETCH, STRETCH.replace("C_T * v_slide", "C_T / 2 * v_slide")),
    Mistake("the spring of friction in half precision", ("T1",), STRETCH,
            STRETCH.replace("-K_T * (u_t - s)", "np.float16(-K_T * (u_t - s)).astype(float)")),
    Mistake("x alone is held to the threshold", ("T2",), STICKS, "abs(F_trial[0]) <= limit"),
    Mistake("length of the whole force is held to the threshold", ("T2",), "sticks(F_T, limit)",
            "sticks([np.hypot(*F_T), F_N], limit)"),
    Mistake("a foot slides with the other foot of its corner", ("T6", "S2"), SLIDING_ROW,
            '(memory["sliding"][i] or memory["sliding"][i - len(r) // 2])'),
    Mistake("two steps of sliding until the dynamic coefficient holds", ("T6", "S2"), SLIDING_ROW,
            '(memory["sliding"][i] and memory.get("late", memory["sliding"])[i])', True,
            ((FOUND, FOUND + ' | {"late": memory["sliding"]}'),)),
    Mistake("direction divided by the square of the length", ("T3",), "return " + T3,
            "return mu * F_N / (F_trial @ F_trial) * F_trial"),
    Mistake("trial force by the ratio of the coefficients for the sliding force", ("T3",),
            "sliding_force(F_T, F_N, mu)\n", "F_T * mu / mu_0\n"),
    Mistake("force of sliding made anew of the moved anchor, without its damper", ("T3", "T1"), AFTER,
            AFTER + "        F_T = -K_T * (u_t - s)\n"),
    Mistake("y of the force with the other sign where the anchor is moved", ("T4",), AFTER,
            AFTER.replace("(F_T,", "(F_T * [1, -1],")),
    Mistake("an anchor is moved from where it was, not from the foot", ("T4",), AFTER, AFTER.replace("u_t,", "s,")),
    Mistake("the anchor of a new foot that slides at once is not moved", ("T4", "T5"), AFTER,
            AFTER.replace("        s =", "        s = s if not anchored else")),
    Mistake("a new anchor in single precision", ("T5",), CHOSEN,
            "return s if anchored and xi >= 0 else np.float32(u_t).astype(float)"),
    Mistake("anchors read from the last foot to the first", ("T5", "S2"), 'memory["s"][i]', 'memory["s"][-1 - i]'),
    Mistake("the static coefficient for the force, the dynamic one for the flag", ("T2", "T6"), '"sliding": slides',
            '"sliding": not sticks(trace["F_trial"], mu * F_N)'),
    # The body.
    Mistake("the weight upwards", ("A1",), SUMMED, SUMMED.replace("- [0, 0,", "+ [0, 0,")),
    Mistake("the mean of the forces for their sum", ("A1",), SUMMED, SUMMED.replace("F.sum(", "F.mean(")),
    Mistake("inner feet left out of the sum of forces", ("A1",), SUMMED, SUMMED.replace("F.sum(", "F[:4].sum(")),
    Mistake("x and y of the levers exchanged in the moment", ("A2",), MOMENT,
            MOMENT.replace("(r,", "(r[:, [1, 0, 2]],")),
    Mistake("products element by element for the moment", ("A2",), MOMENT, "moment = (r * F).sum(axis=0)"),
    Mistake("friction at half of its lever", ("A2",), MOMENT,
            "moment = np.cross(r, F * [0, 0, 1]).sum(axis=0) + np.cross(r / 2, F * [1, 1, 0]).sum(axis=0)"),
    Mistake("an entry of the attitude read across the diagonal where the moment is turned back", ("A3",), BACK,
            "L = np.array(Lambda)\n    L[0, 1] = Lambda[1, 0]\n    return force, moment, L.T @ moment"),
    Mistake("moment turned back as by a small turn", ("A3",), BACK,
            "return force, moment, (np.eye(3) + (Lambda.T - Lambda) / 2) @ moment"),
    # The step.
    Mistake("y of the place moved by x of the velocity", ("I1",), PLACE,
            PLACE.replace("h * v +", "h * v[[0, 0, 2]] +")),
    Mistake("no weight in the place", ("I1",), PLACE, PLACE.replace("* a  #", "* (a + [0, 0, 9.81])  #")),
    Mistake("no acceleration about the height in the increment", ("I2",), INCREMENT,
            INCREMENT.replace("* A", "* A * [1, 1, 0]")),
    Mistake("x and y of the gyroscopic moment exchanged", ("I2", "S1"), SPEED,
            "np.linalg.solve(J, T - np.cross(W, J @ W)[[1, 0, 2]])"),
    Mistake("inertia lumped by its rows", ("I2", "S1"), SPEED, "(T - np.cross(W, J @ W)) / J.sum(axis=1)"),
    Mistake("turns added to Euler's angles", ("I3",), TURNED, BY_EULER_ANGLES),
    Mistake("a sign in the product of quaternions", ("I3",), TURNED, BY_QUATERNIONS),
    Mistake("the third column of the attitude left as it was", ("I3",), TURNED,
            TURNED + "\n    Lambda_next[:, 2] = np.asarray(Lambda)[:, 2]"),
    Mistake("attitude turned by the increment of the step before", ("I3", "S1"), ONE_STEP,
            'Lambda = state["Lambda"] @ (np.eye(3) + state.get("E", E))\n    ' + ONE_STEP, True,
            ((ADVANCED, '"F": F, "E": E, **memory}'),)),
    Mistake("the difference of both accelerations in the velocity", ("I4",), KICK, KICK.replace("(a +", "(a -")),
    Mistake("a velocity that changes its sign is none", ("I4",), KICK,
            KICK + "\n    v_next = np.where(v * v_next < 0, 0.0, v_next)"),
    Mistake("x and y of the gain of the rates exchanged", ("I5",), GAIN, "W + np.linalg.solve(J, gain)[[1, 0, 2]]"),
    Mistake("the gyroscopic moment of the old rates in place of the turn", ("I5",), GAIN,
            "W + h * np.linalg.solve(J, (T + T_next) / 2 - np.cross(W, J @ W))"),
    Mistake("forces at a place that is predicted without acceleration", ("S1",), ONE_STEP,
            ONE_STEP.replace("x, Lambda,", 'state["x"] + h * state["v"], Lambda,')),
    Mistake("sideways velocities not predicted", ("S1",), PREDICTED, "v + h * a * [0, 0, 1], W + h * A, E"),
    # The run.
    Mistake("rows spread evenly from the first step to the last", ("S2",),
            "np.rint(np.arange(rows) / (problem.output_rate * problem.step)).astype(int)",
            "np.rint(np.linspace(0, last, rows)).astype(int)"),
    Mistake("the place of the base is handed out", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row[k] + row["Lambda"][:, 2] * problem.points.P[:, 2].min() if k == "x" '
                                       'else row[k] for')),
    Mistake("forces handed out in kilonewtons", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row[k] / 1000 if k == "F" else row[k] for')),
    Mistake("feet that push are handed out as those that touch", ("S2", "T5"), ROWS,
            ROWS.replace("row[k] for", 'row["F"][:, 2] > 0 if k == "anchored" else row[k] for')),
    Mistake("loads that a start brings are set to nought", ("S2",), STARTED,
            STARTED.replace("    return", "    else:\n        state |= {k: 0 * state[k] for k in 'aTF'}\n    return")),
    Mistake("flags of sliding of the start taken for those of sticking", ("S2", "T6"), UNSTARTED,
            '    state["sliding"] = ~np.array(state["sliding"], bool)\n' + UNSTARTED),
    Mistake("anchors of the start taken for stretches", ("S2", "T5", "T1"), UNSTARTED,
            '    feet = state["x"] + problem.points.P @ state["Lambda"].T\n'
            '    state["s"] = feet[:, :2] + state["s"]\n' + UNSTARTED),
    Mistake("the first loads as if the block were at rest", ("S2", "S1"),
            '*(state[k] for k in ("x", "Lambda", "v", "W"))', 'state["x"], state["Lambda"], *np.zeros((2, 3))'),
    Mistake("rates handed out as the mean of a row and the one before", ("S2",), ROWS,
            ROWS.replace("row[k] for row in kept", '(row[k] + kept[max(i - 1, 0)][k]) / 2 if k == "W" else row[k] '
                                                   "for i, row in enumerate(kept)")),
)  # fmt: skip

#: What dwindles with the step, and is no mistake in another integrator.
OF_THE_STEP = (
    "no damper of friction in the step of touching", "the anchor of a new foot that slides at once is not moved",
    "two steps of sliding until the dynamic coefficient holds",
    "rates handed out as the mean of a row and the one before",
)  # fmt: skip

GILL = f"""\
    root = np.sqrt(2)
    rates = [(v, W, a, spun(W, T))]
    for row in ((1 / 2,), ((root - 1) / 2, (2 - root) / 2), (0.0, -root / 2, 1 + root / 2)):
{STAGES}\
    weights = (1 / 6, (2 - root) / 6, (2 + root) / 6, 1 / 6)
    mean = [sum(c * k for c, k in zip(weights, ks, strict=True)) for ks in zip(*rates, strict=True)]
{LAST}"""
MERSON = f"""\
    rates = [(v, W, a, spun(W, T))]
    for row in ((1 / 3,), (1 / 6, 1 / 6), (1 / 8, 0.0, 3 / 8), (1 / 2, 0.0, -3 / 2, 2.0)):
{STAGES}\
    mean = [(k[0] + 4 * k[3] + k[4]) / 6 for k in zip(*rates, strict=True)]
{LAST}"""
ALEXANDER = f"""\
    share, done = 1 - np.sqrt(1 / 2), []
    for row in ((), (1 - share,)):
        rate = v, W, a, spun(W, T)
        for _ in range(6):
            rates = zip(*done, rate, strict=True)
            ways = [h * sum(c * k for c, k in zip((*row, share), ks, strict=True)) for ks in rates]
            at = x + ways[0], turned(Lambda, ways[1]), v + ways[2], W + ways[3]
            a_n, T_n, _, _ = evaluate(problem, state, *at)
            rate = at[2], at[3], a_n, spun(at[3], T_n)
        done.append(rate)
    mean = [(1 - share) * k[0] + share * k[1] for k in zip(*done, strict=True)]
{LAST}"""
LINEAR = """\
    S = spun(W, T)
    a_n, A_n = a, S
    for _ in range(5):
        x_n, v_n = x + h * v + h * h * (a / 3 + a_n / 6), v + h / 2 * (a + a_n)
        Lambda_n, W_n = turned(Lambda, h * W + h * h * (S / 3 + A_n / 6)), W + h / 2 * (S + A_n)
        a_n, T_n, F, memory = evaluate(problem, state, x_n, Lambda_n, v_n, W_n)
        A_n = spun(W_n, T_n)
    x, Lambda, v, W, a, T = x_n, Lambda_n, v_n, W_n, a_n, T_n
"""
SCHEMES = {"Gill": GILL, "Merson": MERSON, "Alexander": ALEXANDER, "linear acceleration": LINEAR}

#: Mistakes in the steps of these integrators, each with its own.
OF_STEPS = (
    (Mistake("the moment left in plate axes in the stages", ("A3", "I5", "I2"), "spun(at[3], T_n)",
             "spun(at[3], at[1] @ T_n)"), "Gill"),
    (Mistake("the last stage left out of the mean", ALL, "root) / 6, 1 / 6)", "root) / 6, 0.0)"), "Gill"),
    (Mistake("the mean turn on the plate's side", ("I3",), "turned(Lambda, h * mean[1])",
             "Lambda + rotation_less_identity(h * mean[1]) @ Lambda"), "Gill"),
    (Mistake("three times the fourth rate, not four times", ALL, "4 * k[3]", "3 * k[3]"), "Merson"),
    (Mistake("gyroscopic moment of the stages with the other sign", EULER, "spun(at[3], T_n)",
             "np.linalg.solve(J, T_n + np.cross(at[3], J @ at[3]))"), "Merson"),
    (Mistake("the place by half of the mean velocity", ("I1", "S2"), "x + h * mean[0]", "x + h / 2 * mean[0]"),
     "Merson"),
    (Mistake("both stages with the weight of the second", ALL, "(1 - share) * k[0]", "share * k[0]"), "Alexander"),
    (Mistake("the diagonal of the inertia in the stages", EULER, "spun(at[3], T_n)",
             "(T_n - np.cross(at[3], J @ at[3])) / np.diag(J)"), "Alexander"),
    (Mistake("half of the mean acceleration in the velocity", ("I4", "A1"), "h * mean[2]", "h / 2 * mean[2]"),
     "Alexander"),
    (Mistake("no gyroscopic moment at the end of the step", EULER, "A_n = spun(W_n, T_n)",
             "A_n = np.linalg.solve(J, T_n)"), "linear acceleration"),
    (Mistake("the old angular acceleration twice in the rates", ("I5", "I2"), "W + h / 2 * (S + A_n)", "W + h * S"),
     "linear acceleration"),
    (Mistake("half of the rates in the turn", ("I3",), "turned(Lambda, h * W +", "turned(Lambda, h / 2 * W +"),
     "linear acceleration"),
)  # fmt: skip

SANDWICH = """    from scipy.spatial.transform import Rotation

    *q, w = Rotation.from_matrix(Lambda).as_quat()
    aside = 2 * np.cross(q, P)
    r = P + w * aside + np.cross(q, aside)
"""
PACKED = """flat = np.concatenate([x, v, Lambda.ravel(), W, a, T, F.ravel()])
    x, v, Lambda, W, a, T, F = np.split(flat, np.cumsum([3, 3, 9, 3, 3, 3]))
    made = {"x": x, "v": v, "Lambda": Lambda.reshape(3, 3), "W": W, "a": a, "T": T, "F": F.reshape(-1, 3)}
    return made | memory
"""
AS_SETS = """touches = {i for i, c in enumerate(found) if c["touching"]}
    slides = {i for i in touches if found[i]["sliding"]}
    kept = {"s": np.array([c["s"] for c in found])}
    for name, members in {"anchored": touches, "sliding": slides}.items():
        kept[name] = np.array([i in members for i in range(len(r))])
    return force / block.mass, T, F, kept"""
MADE_STEP = 'return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}\n'
IN_PYTHON = (
    Variant("velocities of the feet by the velocity at the plate's origin",
            ((RATE, "turn = Lambda @ W\n    rate = v - np.cross(turn, x) + np.cross(turn, u)"),)),
    Variant("levers between a quaternion and its conjugate", ((LEVERS, SANDWICH),)),
    Variant("exponential by sine and cosine of half the angle, one factor taken out",
            ((E, "half = np.sin(angle / 2) / angle\n    return 2 * half * (np.cos(angle / 2) * H + half * (H @ H))"),)),
    Variant("sum of forces as the last of running sums",
            ((SUMMED, SUMMED.replace("sum(axis=0)", "cumsum(axis=0)[-1]")),)),
    Variant("moments by the work of three virtual turns",
            ((MOMENT, "moment = np.array([(np.cross(e, r) * F).sum() for e in np.eye(3)])"),)),
    Variant("damping by the stiffness and the time of a swing",
            (("2 * beta * np.sqrt(K * mass)", "2 * beta * K / np.sqrt(K / mass)"),)),
    Variant("inertia by the density, and cubes of the sides",
            ((f"mass / 12 * np.diag({MOMENTS})",
              "mass / (width * depth * height) / 12 * np.diag([width * (depth**3 * height + depth * height**3),"
              " depth * (width**3 * height + width * height**3), height * (width**3 * depth + width * depth**3)])"),)),
    Variant("the state of a body as one vector, packed and unpacked at each step", ((MADE_STEP, PACKED),)),
    Variant("who touches and who slides as sets of numbers", ((FOUND, AS_SETS),)),
    Variant("corners by a product of signs, sorted by their angle",
            ((CORNERS, "np.array(sorted(itertools.product((0.5, -0.5), repeat=2), key=lambda c: np.arctan2(c[1], c[0])"
              " % (2 * np.pi))) * [width, depth]"),
             ("PROPERTIES = (", "import itertools\n\nPROPERTIES = ("))),
    Variant("instants by fractions of whole numbers",
            (('"t": wanted * problem.step', '"t": [float(Fraction(int(n)) * Fraction(problem.step)) for n in wanted]'),
             ("PROPERTIES = (", "from fractions import Fraction\n\nPROPERTIES = ("))),
    Variant("stretch counted from the foot to its anchor",
            ((STRETCH, "return K_T * (np.asarray(s) - u_t) + C_T * -np.asarray(v_slide)"),)),
    Variant("heights counted from a plate that lies a quarter of a metre up",
            (("    u = x + r\n", "    high = x + [0, 0, 0.25] + r\n    u = high - [0, 0, 0.25]\n"),
             (DEPTH, DEPTH.replace("-u[:, 2],", "0.25 - high[:, 2],")))),
    Variant("loads of a step as impulses, halves of both added at last",
            ((KICK, "v_next = v + (a * (h / 2) + a_next * (h / 2))"),)),
    Variant("the moment of each foot in its own body axes, levers from the points",
            ((SUM, "    force = F.sum(axis=0) - [0, 0, mass * g]\n    moment = np.cross(r, F).sum(axis=0)\n"
              "    P, pushed = np.asarray(r) @ Lambda, np.asarray(F) @ Lambda\n"),
             (BACK, "return force, moment, sum(np.cross(p, f) for p, f in zip(P, pushed, strict=True))"))),
)  # fmt: skip
IN_C = (
    Variant("the C text, vectorised without a check of errors, strict about infinities",
            flags=("-O3", "-ftree-vectorize", "-fno-math-errno", "-fsigned-zeros")),
    Variant("the C text, as rounding may change while it runs", flags=("-O2", "-frounding-math", "-fno-builtin")),
)  # fmt: skip
