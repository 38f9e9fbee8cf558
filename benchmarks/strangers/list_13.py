"""A thirteenth list of strangers: habits of engines for games, of ports from Fortran, and of kernels for GPUs.

Half lengths for whole ones, contacts with a margin, limits on velocities, bodies that fall asleep, pyramids for cones,
an index of the step before, numbers of half precision, lanes that are left over, loops that end early. Mistakes and
variants were written down, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers import list_04, list_05, schemes
from strangers.controls import SUM, E, Variant
from strangers.list_01 import N1, SPEED, T3, Mistake
from strangers.list_02 import TRIAL
from strangers.list_05 import FORCES, MADE, ROWS, SUMS
from strangers.list_07 import ADVANCED, AFTER, ONE_STEP
from strangers.list_10 import INSTANTS
from strangers.list_12 import GAIN, KICK, NORMAL, PLACE, RATE

DEPTH = "-u[:, 2], -rate[:, 2], rate[:, :2]"
BODY_MOMENT = f"    force, _, T = {SUMS}\n"
STEPPED = "    x, _, Lambda, v_p, W_p, E = first_half("
#: One over the root, by the bits of a number of single precision and one step of Newton's.
FAST_ROOT = """q = np.float32(F_trial @ F_trial)
    y = (np.int32(0x5F3759DF) - (q.view(np.int32) >> 1)).view(np.float32)
    return mu * F_N * float(y * (np.float32(1.5) - q / 2 * y * y)) * F_trial"""
ASLEEP = """    if max(np.abs(state["v"]).max(), np.abs(state["W"]).max()) < 1e-3:
        return state
"""

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("half lengths in the inertia", ("G1",), "mass / 12 *", "mass / 48 *", False),
    Mistake("half of the half lengths for the corners", ("G2",), "[width / 2, depth / 2]", "[width / 4, depth / 4]",
            False),
    Mistake("damping ratio in per cent", ("P2",), "2 * beta * np.sqrt", "2 * beta / 100 * np.sqrt", False),
    Mistake("stiffness along the plate by Poisson's ratio", ("P1",), "np.full(8, K_T)",
            "np.full(8, 2 * (1 - 0.3) / (2 - 0.3) * K_N)", False),
    Mistake("rates in gons", ("M1",), "np.degrees(W)", "200 / np.pi * W", False),
    # Points.
    Mistake("a margin of a tenth of a micrometre round the block", ("K1", "N2", "N1"), DEPTH,
            DEPTH.replace("-u[:, 2]", "1e-7 - u[:, 2]")),
    Mistake("rate of penetration of the next foot", ("K1",), DEPTH,
            DEPTH.replace("-rate[:, 2]", "-np.roll(rate[:, 2], -1)")),
    Mistake("velocities of feet never above a tenth of a metre a second", ("K1",), RATE,
            f"rate = np.clip({RATE.removeprefix('rate = ')}, -0.1, 0.1)"),
    Mistake("penetration in half precision", ("N1", "K1"), NORMAL, NORMAL.replace("(xi,", "(float(np.float16(xi)),")),
    Mistake("spring of half the stiffness in unloading", ("N1",), N1,
            N1.replace("K_N * xi", "K_N * (1.0 if xi_rate >= 0 else 0.5) * xi")),
    Mistake("the loop over the feet ends at the first that is open", ("N1", "N2", "S2"), FORCES,
            FORCES + "    F[np.argmax(xi < 0) if np.any(xi < 0) else len(F) :] = 0\n"),
    Mistake("a foot that touched before is not asked whether it is open", ("N2",), NORMAL,
            "F_N = max(K_N * xi + C_N * xi_rate, 0.0) if anchored else " + NORMAL.removeprefix("F_N = ")),
    Mistake("a new foot is tied to a grid of micrometres", ("T5",), "if anchored and xi >= 0 else u_t",
            "if anchored and xi >= 0 else np.round(u_t, 6)"),
    Mistake("feet are tied anew after the whole block was in the air", ("T5",), 'memory["anchored"][i],',
            'bool(memory["anchored"].any()),'),
    Mistake("damper of friction along the stretch alone", ("T1",), TRIAL,
            "e = (u_t - s) / max(np.hypot(*(u_t - s)), 1e-300)\n    "
            + TRIAL.replace("v_slide", "(v_slide @ e) * e")),
    Mistake("a pyramid that stands on its edges for the cone", ("T2",), "np.hypot(*F_trial) <= limit",
            "np.abs(F_trial).sum() <= np.sqrt(2) * limit"),
    Mistake("static coefficient in the step of touching alone", ("T6",), "sliding and anchored, mu_0",
            "anchored, mu_0"),
    Mistake("each component of the sliding force cut by itself", ("T3",), T3,
            "np.clip(F_trial, -mu * F_N / np.sqrt(2), mu * F_N / np.sqrt(2))"),
    Mistake("direction of sliding by a fast inverse root", ("T3",), "return " + T3, FAST_ROOT),
    Mistake("anchor moved to the threshold, not to the sliding force", ("T4",), AFTER,
            AFTER.replace("(F_T,", "(F_T * mu_0 / mu,")),
    Mistake("anchor moved from the second step of sliding on", ("T4",), AFTER,
            AFTER.replace("K_T, C_T)", "K_T, C_T) if sliding and anchored else s")),
    # The body.
    Mistake("feet left over from lanes of four are not summed", ("A1", "S2"), "force = F.sum(axis=0) -",
            "force = F[: len(F) // 4 * 4].sum(axis=0) -"),
    Mistake("a hundredth of the velocity lost each second", ("A1", "I4"), "return force / block.mass,",
            "return force / block.mass - 0.01 * v,"),
    Mistake("moment about the foot that is deepest", ("A2",), "np.cross(r, F).sum",
            "np.cross(r - r[np.argmin(r[:, 2])], F).sum"),
    Mistake("all forces at the centre of pressure", ("A2",), "moment = np.cross(r, F).sum(axis=0)",
            "moment = np.cross(F[:, 2] @ r / max(F[:, 2].sum(), 1e-300), F.sum(axis=0))"),
    Mistake("moment in the body axes of the start", ("A3",), BODY_MOMENT,
            BODY_MOMENT.replace("_, T", "M, _") + "    T = problem.start.Lambda.T @ M\n"),
    Mistake("place by the acceleration of the step before", ("I1",), ONE_STEP,
            'x = x + h * h / 2 * (state.get("old", state["a"]) - state["a"])\n    ' + ONE_STEP, True,
            ((ADVANCED, '"F": F, "old": state["a"], **memory}'),)),
    Mistake("gyroscopic moment of a top with two moments alike", ("I2",), SPEED,
            SPEED.replace("J @ W", "np.diag(np.diag(J)[[0, 0, 2]]) @ W")),
    Mistake("Cayley's transform for the exponential", ("I3",), E,
            "return np.linalg.solve(np.eye(3) - H / 2, np.eye(3) + H / 2) - np.eye(3)"),
    Mistake("angle of the turn in single precision", ("I3",), "angle = np.sqrt(x * x + y * y + z * z)",
            "angle = float(np.sqrt(np.float32(x * x + y * y + z * z)))"),
    Mistake("a step changes the velocity by a millimetre a second at most", ("I4",), KICK,
            "v_next = v + np.clip(h / 2 * (a + a_next), -1e-3, 1e-3)"),
    Mistake("no gain of the rate about the height", ("I5",), "W + np.linalg.solve(J, gain)",
            "W + np.linalg.solve(J, gain) * [1, 1, 0]"),
    Mistake("angular acceleration predicted in plate axes", ("S1",), "v + h * a, W + h * A, E",
            "v + h * a, W + h * Lambda @ A, E"),
    # The run.
    Mistake("the first row twice, and all others a row late", ("S2",), ROWS,
            ROWS.replace("row in kept", "row in [kept[0], *kept[:-1]]")),
    Mistake("instants in whole milliseconds", ("S2",), INSTANTS, '"t": np.round(wanted * problem.step, 3)'),
    Mistake("a block that hardly moves falls asleep", ("S2", "I1", "I4"), STEPPED, ASLEEP + STEPPED),
)  # fmt: skip

#: The integrators of the lists before, in which the mistakes are planted.
INTO = {**schemes.SCHEMES, **list_04.SCHEMES, **list_05.SCHEMES}

IN_PYTHON = (
    Variant("sums in extended precision",
            ((SUM, "    force = np.sum(F, axis=0, dtype=np.longdouble).astype(float) - [0, 0, mass * g]\n"
              "    moment = np.sum(np.cross(r, F), axis=0, dtype=np.longdouble).astype(float)\n"),)),
    Variant("cross products written out",
            ((SUM, "    (a, b, c), (d, e, f) = r.T, F.T\n    force = F.sum(axis=0) - [0, 0, mass * g]\n"
              "    moment = np.array([(b * f - c * e).sum(), (c * d - a * f).sum(), (a * e - b * d).sum()])\n"),)),
    Variant("depth along the normal of the plate",
            ((DEPTH, "-u @ [0.0, 0.0, 1.0], -rate @ [0.0, 0.0, 1.0], rate[:, :2]"),)),
    Variant("direction of sliding first, then its size",
            (("return " + T3, "e = F_trial / np.sqrt(F_trial @ F_trial)\n    return mu * F_N * e"),)),
    Variant("place by Horner's rule", ((PLACE, "x_next = x + h * (v + h * (a / 2))"),)),
    Variant("velocity by two halves of a kick", ((KICK, "v_next = (v + h / 2 * a) + h / 2 * a_next"),)),
    Variant("feet that push summed alone",
            ((SUM, "    some = np.any(F != 0, axis=1)\n    force = F[some].sum(axis=0) - [0, 0, mass * g]\n"
              "    moment = np.cross(r[some], F[some]).sum(axis=0)\n"),)),
    Variant("rates in plate axes by the columns of the attitude",
            ((RATE, "X, Y, Z = Lambda.T\n    rate = v + np.cross(W[0] * X + W[1] * Y + W[2] * Z, r)"),)),
    Variant("moment of forces in body axes with levers in body axes",
            (("return force, moment, Lambda.T @ moment",
              "return force, moment, np.cross(r @ Lambda, F @ Lambda).sum(axis=0)"),)),
    Variant("feet from the last to the first",
            (("for i in range(len(r))\n    ]\n", "for i in reversed(range(len(r)))\n    ][::-1]\n"),)),
    Variant("momentum after the step, divided by the inertia at last",
            ((GAIN, "momentum = E.T @ half + half + h / 2 * T_next"),
             ("W + np.linalg.solve(J, gain)", "np.linalg.solve(J, momentum)"))),
    Variant("constants of each foot gathered from a table",
            ((MADE, MADE + "    made = np.ascontiguousarray(made.T)[np.arange(len(r))].T\n"),)),
)  # fmt: skip
