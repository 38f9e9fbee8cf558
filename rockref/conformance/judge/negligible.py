"""Differences that are too small to be physical: a remark with its size, never a verdict.

A double tells places of a metre to 1e-16 m, and a right program may lose more of that than the bars allow for. Decided:
a hundredth of an atom's diameter, and the weight of a tenth of a microgram, decide nothing about a block of 54 kg.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

#: Decided, see above [N, m].
FORCE, LENGTH = 1e-9, 1e-12
#: What follows from them: 1 nN at a lever of 1 m, 1 pm at 1 m, 1 pm a second, 1 nN on 100 kg.
MOMENT, ANGLE, VELOCITY, ACCELERATION = FORCE, LENGTH, LENGTH, FORCE / 100
#: 100 kg at a metre, moved by 1 pm [kg m2].
INERTIA = 100 * LENGTH
#: Instants of main impacts [s]: the feet cross the plate at 0.1 m/s or more, and need so long for 1 pm. Decided.
INSTANT = LENGTH / 0.1

#: Results by name: size and unit.
SIZES: dict[str, tuple[float, str]] = {
    **dict.fromkeys(("F", "F_N", "F_T", "F_stick", "F_slip", "F_trial", "force", "threshold"), (FORCE, "N")),
    **dict.fromkeys(("moment", "T"), (MOMENT, "N m")),
    **dict.fromkeys(("x", "x_T", "u", "r", "P", "xi", "s", "s_stick", "s_slip", "s_trial"), (LENGTH, "m")),
    **dict.fromkeys(("v", "xi_rate", "v_slide", "v_predicted"), (VELOCITY, "m/s")),
    **dict.fromkeys(("W", "W_predicted"), (ANGLE, "rad/s")),
    "Lambda": (ANGLE, ""),
    "Theta": (ANGLE, "rad"),
    "inertia": (INERTIA, "kg m2"),
    "crv_deg_s": (math.degrees(VELOCITY), "deg/s"),
    "a": (ACCELERATION, "m/s2"),
}


#: Layers of a few steps: a place there shows the force that moved it, and 1 pm after a step of 10 us is a newton.
#: Forces alone have a size there.
OF_FEW_STEPS = ("L4", "L5s", "LS")


def size_and_unit(name: str, layer: str = "") -> tuple[float, str]:
    """Return the size [SI] below which a difference of a result is negligible, zero where there is none; and its unit.

    name : as results are called, `F_N@1`, `trace.s_trial`
    """
    size, unit = SIZES.get(name.removeprefix("trace.").partition("@")[0], (0.0, ""))
    return (0.0, unit) if layer in OF_FEW_STEPS and unit != "N" else (size, unit)


def same_force(q: dict[str, Any]) -> bool:
    """Return whether a foot is so near its cone that sticking and sliding give the same force, to a negligible
    difference.

    q : inputs of `contact_law`
    """
    if q["xi"] < 0:
        return False
    stretch = np.asarray(q["u_t"]) - q["s"] if q["anchored"] else np.zeros(2)
    trial = float(np.hypot(*(-q["K_T"] * stretch - q["C_T"] * np.asarray(q["v_slide"]))))
    cone = float(q["mu"] * max(q["K_N"] * q["xi"] + q["C_N"] * q["xi_rate"], 0.0))
    return abs(trial - cone) <= FORCE
