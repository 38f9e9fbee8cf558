"""A twelfth list of strangers: habits of other trades, brought along to the block.

Granular codes with Mindlin's spring, engines of games with their limits and their few directions, fixed-point numbers,
finite elements, and signs of those who look at the plate and not at the block. Mistakes and variants were written down,
and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import SUM, TURNED, E, Variant
from strangers.list_01 import N1, T3, Mistake
from strangers.list_02 import TRIAL as FORMULA
from strangers.list_02 import UNSTARTED
from strangers.list_05 import MADE, ROWS, TRIAL
from strangers.list_07 import AFTER
from strangers.list_10 import INSTANTS

NORMAL = "F_N = normal_force(xi, xi_rate, K_N, C_N)"
SUMMED = "force = F.sum(axis=0) - [0, 0, mass * g]"
MOMENT = "moment = np.cross(r, F).sum(axis=0)"
PLACE = "x_next = x + h * v + h * h / 2 * a  # I1"
INCREMENT = "Theta = h * W + h * h / 2 * A  # I2"
GAIN = "gain = h / 2 * T + E.T @ half + h / 2 * T_next  # I5"
KICK = "v_next = v + h / 2 * (a + a_next)  # I4"
RATE = "rate = v + np.cross(Lambda @ W, r)"
#: One of eight directions, the nearest to that of the trial force.
OF_EIGHT = """mu * F_N * np.array([np.cos(way), np.sin(way)])"""
TO_THE_CENTRE = """    memory = {
        "s": np.where(memory["anchored"][:, None], memory["s"], x[:2]),
        "sliding": memory["sliding"] & memory["anchored"],
        "anchored": np.ones(len(r), bool),
    }
"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("damping by the reduced mass of two bodies alike", ("P2",), "np.sqrt(K * mass)", "np.sqrt(K * mass / 2)",
            False),
    Mistake("distance on the diagonal taken for a share of it", ("G2",),
            "1 - delta_diag / (np.hypot(width, depth) / 2)", "1 - delta_diag", False),
    Mistake("rates as turns a minute", ("M1",), "np.degrees(W)", "30 / np.pi * W", False),
    # Points.
    Mistake("velocities in the middle of the overlap", ("K1",), RATE,
            "rate = v + np.cross(Lambda @ W, r + np.maximum(-u[:, 2:], 0) / 2 * [0, 0, 1])"),
    Mistake("normal damper by the whole speed of the foot", ("N1", "K1"), NORMAL,
            NORMAL.replace("xi_rate", "np.copysign(np.hypot(xi_rate, np.hypot(*v_slide)), xi_rate)")),
    Mistake("a foot that touched before is held by five newtons", ("N1",), NORMAL,
            NORMAL + "\n    F_N = max(K_N * xi + C_N * xi_rate, -5.0) if anchored and xi >= 0 else F_N"),
    Mistake("new feet are tied to below the centre of mass", ("T5",), MADE, MADE + TO_THE_CENTRE),
    Mistake("all feet begin as tied", ("T5", "S2"), UNSTARTED,
            '    state["anchored"] = np.ones_like(state["anchored"])\n' + UNSTARTED),
    Mistake("spring of friction by the root of the depth, after Mindlin", ("T1",), TRIAL,
            TRIAL.replace("K_T,", "K_T * np.sqrt(xi / 1e-5),")),
    Mistake("friction without its spring", ("T1",), FORMULA, "return -0.0 * K_T * (u_t - s) - C_T * v_slide"),
    Mistake("flags of sliding of the foot before", ("T6",), 'memory["sliding"][i]', 'memory["sliding"][i - 1]'),
    Mistake("a tenth of the cone kept as a reserve", ("T2", "T6"), "np.hypot(*F_trial) <= limit",
            "np.hypot(*F_trial) <= 0.9 * limit"),
    Mistake("direction of sliding among eight", ("T3",), "return " + T3,
            "way = np.round(np.arctan2(F_trial[1], F_trial[0]) / (np.pi / 4)) * (np.pi / 4)\n    return " + OF_EIGHT),
    Mistake("sliding force never more than half a kilonewton", ("T3",), "return " + T3,
            "return min(mu * F_N, 500.0) / np.hypot(*F_trial) * F_trial"),
    Mistake("anchor moved against the velocity", ("T4",), AFTER,
            "        s = u_t + (C_T * v_slide - mu * F_N * v_slide / max(np.hypot(*v_slide), 1e-300)) / K_T\n"),
    # The body.
    Mistake("the weight shared by the feet, carried by those that push", ("A1",), SUMMED,
            "force = F.sum(axis=0) - [0, 0, mass * g * max(np.count_nonzero(F[:, 2]), 1) / len(F)]"),
    Mistake("the sum of forces turned into body axes", ("A1",), SUMMED, "force = Lambda.T @ (F.sum(axis=0) - "
            "[0, 0, mass * g])"),
    Mistake("friction with the other sign in the moment", ("A2",), MOMENT,
            "moment = np.cross(r, F * [-1, -1, 1]).sum(axis=0)"),
    Mistake("moment turned back as if the block leaned a little", ("A3",), "moment, Lambda.T @ moment",
            "moment, moment - (Lambda - Lambda.T) @ moment / 2"),
    Mistake("places in whole nanometres", ("I1",), PLACE, "x_next = np.round(x + h * v + h * h / 2 * a, 9)"),
    Mistake("increment in plate axes, before its exponential", ("I2", "I3"), INCREMENT,
            "Theta = Lambda @ (h * W + h * h / 2 * A)"),
    Mistake("no turn about the height in the pose", ("I3", "I2"), "E = rotation_less_identity(Theta)\n"
            "    Lambda_next", "E = rotation_less_identity(Theta * [1, 1, 0])\n    Lambda_next"),
    Mistake("a ten-thousandth of the velocity lost in each step", ("I4",), KICK,
            "v_next = (1 - 1e-4) * v + h / 2 * (a + a_next)"),
    Mistake("gain of the momentum by thirds", ("I5",), GAIN,
            "gain = h / 3 * T + E.T @ half + 2 * h / 3 * T_next"),
    Mistake("velocities predicted two steps ahead", ("S1",), "v + h * a, W + h * A, E",
            "v + 2 * h * a, W + 2 * h * A, E"),
    # The run.
    Mistake("forces on the plate handed out", ("S2",), ROWS, ROWS.replace("row[k] for", '-row[k] if k == "F" else '
            "row[k] for")),
    Mistake("flags of sticking handed out", ("S2", "T5"), ROWS,
            ROWS.replace("row[k] for", 'row[k] & ~row["sliding"] if k == "anchored" else row[k] for')),
    Mistake("places handed out half a step early", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row[k] - problem.step / 2 * row["v"] if k == "x" else row[k] for')),
)  # fmt: skip

IN_PYTHON = (
    Variant("sums without any rounding",
            (("import numpy as np\n", "import math\n\nimport numpy as np\n"),
             (SUM, "    force = np.array([math.fsum(c) for c in F.T]) - [0, 0, mass * g]\n"
              "    moment = np.array([math.fsum(c) for c in np.cross(r, F).T])\n"))),
    Variant("exponential by the quaternion of half the angle",
            ((E, "w, A = np.cos(angle / 2), np.sin(angle / 2) / angle * H\n"
              "    return 2 * (w * A + A @ A)"),)),
    Variant("place by the mean of the velocity and the predicted one",
            ((PLACE, "x_next = x + h / 2 * (v + (v + h * a))"),)),
    Variant("gain of the velocity by the change of the acceleration",
            ((KICK, "v_next = v + h * (a + (a_next - a) / 2)"),)),
    Variant("velocities of the feet by the rate of the attitude",
            ((RATE, "p, q, w = W\n    rate = v + P @ (Lambda @ np.array([[0, -w, q], [w, 0, -p], [-q, p, 0]])).T"),)),
    Variant("inverse of the inertia multiplied",
            (("A = np.linalg.solve(J, T - np.cross(W, J @ W))", "A = np.linalg.inv(J) @ (T - np.cross(W, J @ W))"),
             ("W + np.linalg.solve(J, gain)", "W + np.linalg.inv(J) @ gain"))),
    Variant("sliding force as the trial force less what is too much",
            (("return " + T3, "size = np.hypot(*F_trial)\n    return F_trial - (size - mu * F_N) / size * F_trial"),)),
    Variant("momentum turned back by the increment of the other sign",
            ((GAIN, "gain = h / 2 * T + rotation_less_identity(-h * W - h * h / 2 * np.linalg.solve("
              "J, T - np.cross(W, J @ W))) @ half + h / 2 * T_next"),)),
    Variant("normal force by a cut at infinity",
            ((N1, "float(np.clip(K_N * xi + C_N * xi_rate, 0.0, np.inf)) if xi >= 0 else 0.0"),)),
    Variant("attitude by an identity added at last", ((TURNED, "Lambda_next = Lambda @ (E + np.eye(3))"),)),
    Variant("instants by whole steps, divided at last",
            ((INSTANTS, '"t": wanted / (1 / problem.step)'),)),
)  # fmt: skip
