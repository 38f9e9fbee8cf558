"""An eleventh list of strangers: slips of those who derive the law once more, and of those who make it fast.

A length by a rule of thumb, turns that are added up as vectors, a share of the weight that is taken off, what is
predicted handed out as what is. Mistakes and variants were written down, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import SECOND, SUM, TURNED, E, Variant
from strangers.list_01 import FIRST, N1, T3, Mistake
from strangers.list_02 import TRIAL
from strangers.list_04 import MOVED
from strangers.list_05 import ROWS, SUMS
from strangers.list_06 import ANCHOR
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP

TIED = "s = anchor_before(xi, u_t, s, anchored)\n"
NORMAL = "F_N = normal_force(xi, xi_rate, K_N, C_N)"
STEPPED = "    x, _, Lambda, v_p, W_p, E = first_half("

MISTAKES = (
    # What follows from the parameters.
    Mistake("inertia of an ellipsoid", ("G1",), "mass / 12 *", "mass / 20 *", False),
    Mistake("outer feet raised by the mean of four heights", ("G2",), "delta_long - height / 2",
            "np.full(4, np.mean(delta_long)) - height / 2", False),
    Mistake("inner feet as stiff along the plate as across it", ("P1",), "np.full(8, K_T)",
            "np.repeat([K_T, K_N], 4)", False),
    # Points.
    Mistake("sliding velocity of the turn alone", ("K1",), "rate[:, :2]", "(rate - v)[:, :2]"),
    Mistake("levers turned back in the velocities alone", ("K1",), "np.cross(Lambda @ W, r)",
            "np.cross(Lambda @ W, P @ Lambda)"),
    Mistake("penetration half a step ahead of its time", ("K1", "S1"), MOVED,
            MOVED + "    xi = xi + problem.step / 2 * xi_rate\n"),
    Mistake("no normal damper in a foot that slid", ("N1",), NORMAL,
            NORMAL.replace("xi_rate", "0.0 if sliding and anchored else xi_rate")),
    Mistake("a share of the weight taken off each normal force", ("N1",), N1,
            N1.replace("K_N * xi +", "K_N * xi - 66.2 +")),
    Mistake("a new foot is tied so that it begins without friction", ("T5", "T1"), TIED,
            TIED + "    s = s if anchored else u_t + C_T * v_slide / K_T\n"),
    Mistake("who slides back to the anchor is tied anew", ("T5",), TIED,
            TIED + "    s = u_t if sliding and anchored and (u_t - s) @ v_slide < 0 else s\n"),
    Mistake("the spring of friction in series with one alike", ("T1",), TRIAL, TRIAL.replace("-K_T", "-K_T / 2")),
    Mistake("length by the larger component and half of the smaller", ("T2",), "np.hypot(*F_trial) <= limit",
            "np.abs(F_trial).max() + np.abs(F_trial).min() / 2 <= limit"),
    Mistake("who slid is forgotten unless all did", ("T6",), 'memory["sliding"][i]',
            'memory["sliding"][i] and bool(memory["sliding"][memory["anchored"]].all())'),
    Mistake("direction of sliding by the signs of the components", ("T3",), T3,
            "mu * F_N / np.sqrt(2) * np.sign(F_trial)"),
    # The body.
    Mistake("no weight in the first evaluation", ("A1", "S2"), SUMS,
            SUMS.replace("block.g", 'block.g * (memory.get("F") is not None)')),
    Mistake("friction counted twice in the sum", ("A1",), "force = F.sum(axis=0) -",
            "force = F.sum(axis=0) * [2, 2, 1] -"),
    Mistake("moment about the height left in plate axes", ("A3",), "moment, Lambda.T @ moment",
            "moment, np.append((Lambda.T @ moment)[:2], moment[2])"),
    Mistake("the moment for the angular acceleration in the increment", ("I2",), "h * h / 2 * A  # I2",
            "h * h / 2 * T  # I2"),
    Mistake("turns added up as vectors since the start", ("I3",), STEPPED,
            STEPPED.replace("_, Lambda", "Theta, Lambda"), True,
            ((ONE_STEP, 'turn = state.get("turn", np.zeros(3)) + Theta\n'
              "    Lambda = problem.start.Lambda @ (np.eye(3) + rotation_less_identity(turn))\n    " + ONE_STEP),
             (ADVANCED, '"F": F, "turn": turn, **memory}'))),
    Mistake("velocity overwritten by the predicted one before it is corrected", ("I4",), FIRST,
            FIRST.replace('state["v"]', "v_p")),
    Mistake("half of the new moment taken away", ("I5",), "+ h / 2 * T_next", "- h / 2 * T_next"),
    Mistake("predicted rates turned into the new axes", ("S1",), "v + h * a, W + h * A, E",
            "v + h * a, W + E.T @ W + h * A, E"),
    # The run.
    Mistake("predicted rates handed out", ("S2", "S1", "I5"), ROWS,
            ROWS.replace("row[k] for", 'row.get("ahead", row[k]) if k == "W" else row[k] for'), True,
            ((ADVANCED, '"F": F, "ahead": W_p, **memory}'),)),
    Mistake("places handed out from the first one on", ("S2",), ROWS,
            ROWS.replace("row[k] for", 'row[k] - kept[0][k] if k == "x" else row[k] for')),
)  # fmt: skip

IN_PYTHON = (
    Variant("anchor made of the force of sticking feet, too",
            ((AFTER, ""), ('    return {"F_N": F_N, "F_T": F_T, "s": s,',
                           "    s = anchor_after(F_T, u_t, v_slide, K_T, C_T)\n"
                           '    return {"F_N": F_N, "F_T": F_T, "s": s,'))),
    Variant("velocity half a step ahead, then its other half",
            (("    x_next = x + h * v + h * h / 2 * a  # I1\n",
              "    v_half = v + h / 2 * a\n    x_next = x + h * v_half\n"),
             ("v + h * a, W + h * A, E", "v_half + h / 2 * a, W + h * A, E"))),
    Variant("exponential by a series below a hundredth of a radian",
            ((E, "q = angle * angle\n    if angle < 0.01:\n"
              "        return (1 - q / 6 * (1 - q / 20)) * H + (1 - q / 12 * (1 - q / 30)) / 2 * H @ H\n    " + E),)),
    Variant("normal forces and friction summed apart",
            ((SUM, "    force = F[:, 2].sum() * np.array([0, 0, 1]) + np.append(F[:, :2].sum(axis=0), -mass * g)\n"
              "    moment = np.cross(r, F * [0, 0, 1]).sum(axis=0) + np.cross(r, F * [1, 1, 0]).sum(axis=0)\n"),)),
    Variant("moments by the skew part of a matrix",
            ((SUM, "    G = F.T @ r\n    force = F.sum(axis=0) - [0, 0, mass * g]\n"
              "    moment = np.array([G[2, 1] - G[1, 2], G[0, 2] - G[2, 0], G[1, 0] - G[0, 1]])\n"),)),
    Variant("attitude turned from the plate's side to the body's",
            ((TURNED, "back = Lambda.T\n    Lambda_next = (back + E.T @ back).T"),)),
    Variant("anchors kept as forces",
            ((ANCHOR, '            memory["s"][i] if "begun" not in memory else memory["begun"][i] / made[2, i],\n'),
             (SECOND, '    memory["begun"] = memory["s"] * problem.points.K_T[:, None]\n' + SECOND))),
    Variant("sine and cosine by one complex exponential",
            ((E, "w = np.exp(0.5j * angle)\n"
              "    return 2 * w.real * w.imag / angle * H + 2 * (w.imag / angle) ** 2 * H @ H"),)),
)  # fmt: skip
