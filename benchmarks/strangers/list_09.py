"""A ninth list of strangers: mistakes of programs that share work between threads, and correct variants of them.

Sums that are made twice, a frame that is read before it is written, limits that a kernel has and the law has not.
Mistakes and variants were written down, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import SUM, Variant
from strangers.list_01 import E, Mistake
from strangers.list_04 import FOUND, MOVED
from strangers.list_05 import FORCES, SUMS, TRIAL
from strangers.list_07 import ADVANCED, ONE_STEP

MISTAKES = (
    Mistake("the last foot is summed twice", ("A1",), "force = F.sum(axis=0) -",
            "force = F.sum(axis=0) + F[-1] -"),
    Mistake("normal forces rounded to a newton", ("N1",), "F_N = normal_force(xi, xi_rate, K_N, C_N)",
            "F_N = np.rint(normal_force(xi, xi_rate, K_N, C_N))"),
    Mistake("penetration of the places before, rate of those now", ("K1", "S1"), MOVED,
            MOVED + '    xi = -(memory["x"] + points.P @ memory["Lambda"].T)[:, 2]\n'),
    Mistake("friction of the step before", ("T1", "S1"), FORCES,
            FORCES + '    if memory.get("F") is not None:\n        F[:, :2] = memory["F"][:, :2]\n'),
    Mistake("a foot that slid is tied to where it is", ("T5", "T4"), "s = anchor_before(xi, u_t, s, anchored)\n",
            "s = anchor_before(xi, u_t, s, anchored and not sliding)\n"),
    Mistake("damper of friction never above the cone", ("T1",), TRIAL,
            "    most = mu_0 * F_N / max(np.hypot(*v_slide), 1e-12)\n" + TRIAL.replace("C_T)", "min(C_T, most))")),
    Mistake("moment by the forces of the feet that touched before", ("A2",), SUMS,
            SUMS.replace("r,", '(r.T * memory["anchored"]).T,')),
    Mistake("one axis of the turn before the other", ("I3",), f"return {E}",
            "rest = rotation_less_identity(np.array([0, 0, z])) if z and (x or y) else None\n"
            "    if rest is not None:\n"
            "        tilt = rotation_less_identity(np.array([x, y, 0]))\n"
            "        return tilt + rest + tilt @ rest\n    " + f"return {E}"),
    Mistake("momentum turned back twice", ("I5",), "E.T @ half", "(2 * E.T + E.T @ E.T) @ half"),
    Mistake("no predicted velocity in the first step", ("S1", "S2"), ONE_STEP,
            'v_p = v_p if "begun" in state else state["v"]\n    ' + ONE_STEP,
            more=((ADVANCED, '"F": F, "begun": 1, **memory}'),)),
)  # fmt: skip

IN_PYTHON = (
    Variant("feet summed by a matrix of ones",
            ((SUM, "    ones = np.ones((1, len(F)))\n    force = (ones @ F)[0] - [0, 0, mass * g]\n"
              "    moment = (ones @ np.cross(r, F))[0]\n"),)),
    Variant("memory copied at every step",
            ((FOUND, "kept = {k: np.array([c[name] for c in found]) for k, name in keys.items()}\n"
              "    return force / block.mass, T.copy(), F.copy(), {k: a.copy() for k, a in kept.items()}"),)),
)  # fmt: skip
