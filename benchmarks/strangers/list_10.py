"""A tenth list of strangers: slips on the way from the paper's text to C, Fortran, Rust or JavaScript.

Numbers that are whole where they should not be, arrays of another order, values that are overwritten before they are
read, memory that nobody sets back. Mistakes and variants were written down, and published, before any of them was
judged.
"""

from __future__ import annotations

from strangers.controls import SECOND, SUM, TURNED, Variant
from strangers.list_01 import N1, SPEED, T3, Mistake
from strangers.list_02 import TRIAL
from strangers.list_05 import FORCES, MADE, ROWS, SUMS
from strangers.list_07 import AFTER, ONE_STEP, SLIDES

INSTANTS = '"t": wanted * problem.step'
#: x is divided by the length, and then y by the length that has changed.
OVERWRITTEN = """mu * F_N * np.array(
        [F_trial[0] / np.hypot(*F_trial), F_trial[1] / np.hypot(F_trial[0] / np.hypot(*F_trial), F_trial[1])]
    )"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("a twelfth of the mass in whole kilograms", ("G1",), "mass / 12 *", "mass // 12 *", False),
    Mistake("width and depth exchanged in the points", ("G2",), "[width / 2, depth / 2]", "[depth / 2, width / 2]",
            False),
    Mistake("rates written axis by axis, read row by row", ("M1",), "np.degrees(W)", "np.degrees(W).T.reshape(-1, 3)",
            False),
    # Points.
    Mistake("velocity of the turn with the lever of the foot before", ("K1",), "np.cross(Lambda @ W, r)",
            "np.cross(Lambda @ W, np.roll(r, 1, axis=0))"),
    Mistake("x and y of the places exchanged on the way to friction", ("K1", "T1", "T5"), "u[i, :2]", "u[i, 1::-1]"),
    Mistake("a comma in place of the plus in the maximum", ("N1",), N1, N1.replace("K_N * xi +", "K_N * xi,")),
    Mistake("normal dampers of outer and inner feet exchanged on the way", ("N1",), MADE,
            MADE + "    made[1] = np.roll(made[1], len(r) // 2)\n"),
    Mistake("the force of a foot that opens is not set back", ("N2",), FORCES,
            FORCES + '    if memory.get("F") is not None:\n        F[xi < 0] = memory["F"][xi < 0]\n'),
    Mistake("a foot that touches ties all feet anew", ("T5",), 'memory["anchored"][i],',
            'memory["anchored"][i] and bool(np.all(memory["anchored"][xi >= 0])),'),
    Mistake("anchors in single precision where they are moved", ("T4",), "return u_t + (F_T + C_T * v_slide) / K_T",
            "return np.float32(u_t + (F_T + C_T * v_slide) / K_T).astype(float)"),
    Mistake("x and y exchanged in the damper of friction", ("T1",), TRIAL, TRIAL.replace("v_slide", "v_slide[::-1]")),
    Mistake("who slides is returned to the cone by the flag of the step before", ("T2", "T3"), "    if slides:\n",
            "    if sliding and anchored:\n"),
    Mistake("flags of sliding for four feet", ("T6",), 'memory["sliding"][i]', 'memory["sliding"][i % 4]'),
    Mistake("the direction of sliding overwritten while it is made", ("T3",), T3, OVERWRITTEN),
    Mistake("the anchor moved along x alone", ("T4",), AFTER,
            "        s = np.array([anchor_after(F_T, u_t, v_slide, K_T, C_T)[0], s[1]])\n"),
    # The body.
    Mistake("a wrong index in one product of the moment", ("A2",), "moment = np.cross(r, F).sum(axis=0)",
            "moment = np.cross(r, F).sum(axis=0) + [0, (r[:, 0] * (F[:, 2] - F[:, 1])).sum(), 0]"),
    Mistake("levers of outer and inner feet exchanged in the moment", ("A2",), SUMS,
            SUMS.replace("r,", "np.roll(r, len(r) // 2, axis=0),")),
    Mistake("no acceleration in the height", ("I1",), "h * h / 2 * a  # I1", "h * h / 2 * a * [1, 1, 0]  # I1"),
    Mistake("a sign in the third of Euler's equations", ("I2",), SPEED,
            SPEED.replace("np.cross(W, J @ W)", "np.cross(W, J @ W) * [1, 1, -1]")),
    Mistake("angle of the turn by the sum of its components", ("I3",), "angle = np.sqrt(x * x + y * y + z * z)",
            "angle = abs(x) + abs(y) + abs(z)"),
    Mistake("momentum turned back by the rates alone", ("I5",), "E.T @ half",
            "rotation_less_identity(h * W).T @ half"),
    Mistake("forces half-way between the old place and the new", ("S1",), ONE_STEP,
            ONE_STEP.replace("state, x,", 'state, (state["x"] + x) / 2,')),
    # The run.
    Mistake("instants of the steps after", ("S2",), INSTANTS, INSTANTS.replace("wanted", "(wanted + 1)")),
    Mistake("one array for all rows", ("S2",), ROWS, ROWS.replace("row[k]", "kept[-1][k]")),
)  # fmt: skip

IN_PYTHON = (
    Variant("the weight shared by the feet",
            ((SUM, "    force = (F - [0, 0, mass * g / len(F)]).sum(axis=0)\n"
              "    moment = np.cross(r, F).sum(axis=0)\n"),)),
    Variant("moments by the tensor of permutations",
            ((SUM, "    e = np.zeros((3, 3, 3))\n"
              "    e[0, 1, 2] = e[1, 2, 0] = e[2, 0, 1] = 1\n    e[0, 2, 1] = e[2, 1, 0] = e[1, 0, 2] = -1\n"
              "    force = F.sum(axis=0) - [0, 0, mass * g]\n"
              '    moment = np.einsum("ijk,nj,nk->i", e, r, F)\n'),)),
    Variant("inertia solved for by Cholesky's factors",
            (("import numpy as np\n", "import numpy as np\nfrom scipy.linalg import cho_factor, cho_solve\n"),
             (SPEED, "cho_solve(cho_factor(J), T - np.cross(W, J @ W))"),
             ("np.linalg.solve(J, gain)", "cho_solve(cho_factor(J), gain)"))),
    Variant("stretches compared at the cone, not forces",
            ((SLIDES, "slides = not sticks(F_T / K_T, limit / K_T)"),)),
    Variant("instants added up step by step",
            ((INSTANTS, '"t": np.append(0, np.cumsum(np.full(wanted[-1], problem.step)))[wanted]'),)),
    Variant("turned twice by half",
            ((TURNED, "half = rotation_less_identity(Theta / 2)\n    Lambda_next = Lambda + Lambda @ half\n"
              "    Lambda_next = Lambda_next + Lambda_next @ half"),)),
    Variant("momentum turned back by both attitudes",
            ((SECOND, SECOND.replace("J, E)", 'J, Lambda.T @ state["Lambda"])')),
             ("gain = h / 2 * T + E.T @ half + h / 2 * T_next", "gain = E @ half - J @ W + h / 2 * T_next"),
             ("names = (\"x\"", "v_next, W_next = second_half(v, W, a, T, a_next, T_next, h, inertia,"
              " half[2].T @ Lambda)\n        names = (\"x\""))),
    Variant("half of a force and its size for its positive part",
            ((N1, "(K_N * xi + C_N * xi_rate + abs(K_N * xi + C_N * xi_rate)) / 2 if xi >= 0 else 0.0"),)),
)  # fmt: skip
