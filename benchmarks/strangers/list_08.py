"""An eighth list of strangers: mistakes and correct variants of somebody in a hurry.

An index that is one too low, a list that was sorted for one use and read for another, a limit that was meant for a
test. Mistakes and variants were written down, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import SUM, TURNED, Variant
from strangers.list_01 import Mistake
from strangers.list_04 import MOVED
from strangers.list_05 import CONE, MADE, ROWS, SUMS
from strangers.list_06 import ANCHOR
from strangers.list_07 import ADVANCED, SLIDES

MISTAKES = (
    Mistake("the weight once more in the predicted velocity", ("S1",), "v + h * a, W + h * A, E",
            "v + h * (a - [0, 0, 9.81]), W + h * A, E"),
    Mistake("accelerations never above fifty g", ("A1", "I4"), "return force / block.mass,",
            "return np.clip(force / block.mass, -490, 490),"),
    Mistake("a new foot is tied to where it was a step before", ("T5",), ANCHOR, "            tied[i],\n",
            more=((MOVED, MOVED + "    before = u[:, :2] - problem.step * v_slide\n"
                   '    tied = np.where(memory["anchored"][:, None], memory["s"], before)\n'),
                  ('memory["anchored"][i],', "bool(xi[i] >= 0),"))),
    Mistake("who slides goes on until it stands still", ("T2", "T6"), SLIDES,
            SLIDES + " or bool(sliding and anchored and np.hypot(*v_slide) > 1e-3)"),
    Mistake("threshold by the normal force of the foot before", ("T6", "T2"), CONE,
            CONE.replace("F_N", "F_N if N is None else N"),
            more=(("C_T, mu_0, mu):\n", "C_T, mu_0, mu, N=None):\n"),
                  ("*made[:, i],", "*made[:, i], normal_force(xi[i - 1], xi_rate[i - 1], *made[:2, i - 1]),"))),
    Mistake("levers sorted by who touches, forces not", ("A2",), SUMS,
            SUMS.replace("r,", 'r[np.argsort(xi < 0, kind="stable")],')),
    Mistake("forces handed out a step late", ("S2", "S1"), ROWS,
            ROWS.replace("row[k] for", 'row.get("late", row[k]) if k == "F" else row[k] for'),
            more=((ADVANCED, '"F": F, "late": state["F"], **memory}'),)),
    Mistake("sliding velocity less that of all feet", ("K1",), "rate[:, :2]", "rate[:, :2] - rate[:, :2].mean(axis=0)"),
    Mistake("tangential stiffness shared by the feet that touch", ("T1",), MADE,
            MADE + "    made[2] /= max(1, np.sum(xi >= 0))\n"),
    Mistake("new rates turned into the new axes once more", ("I5",), "W + np.linalg.solve(J, gain)",
            "(np.eye(3) + E.T) @ (W + np.linalg.solve(J, gain))"),
)  # fmt: skip

IN_PYTHON = (
    Variant("attitude divided by the cube root of its determinant",
            ((TURNED, "Lambda_next = Lambda + Lambda @ E\n"
              "    Lambda_next = Lambda_next / np.cbrt(np.linalg.det(Lambda_next))"),)),
    Variant("squares at the cone",
            (("return np.hypot(*F_trial) <= limit", "return F_trial @ F_trial <= limit * limit"),)),
    Variant("moments about the plate's origin, less that of the sum at the centre of mass",
            ((SUM, "    place = r[0] + [0.25, -0.125, 0.0]\n    force = F.sum(axis=0) - [0, 0, mass * g]\n"
              "    moment = np.cross(place + r, F).sum(axis=0) - np.cross(place, F.sum(axis=0))\n"),)),
)  # fmt: skip
