"""Where each effect's numbers stand in the flat array that the compiled step reads.

One row of `SLOTS` floats per run; zero means that the effect is not there (each block begins with its switch).
"""

from __future__ import annotations

_next = 0


def _block(n: int) -> int:
    global _next
    first, _next = _next, _next + n
    return first


HERTZ = _block(3)  # on, exponent, reference
HUNT = _block(2)  # on, a
HYSTERESIS = _block(2)  # on, kappa
ADHESION = _block(3)  # on, force, range
STRIBECK = _block(3)  # on, ratio, velocity
VISCOUS = _block(2)  # on, c
LOAD = _block(3)  # on, exponent, reference
SPIN = _block(2)  # on, radius
ROLLING = _block(2)  # on, lever
NORMALS = _block(9)  # on, x1, y1 .. x4, y4
DRAG = _block(4)  # on, c, height of the lowest point, height of the highest
CABLE = _block(4)  # on, k, c, height of attachment
WIRE = _block(5)  # on, force, tau, height of attachment, side
VIBRATION = _block(5)  # on, amplitude, angular frequency, direction, phase
TILT = _block(3)  # on, x, y
SUPPORT = _block(4)  # on, mass, stiffness, damping
SLOTS = _next

#: Effects that act before the run (on points, mass, release) or after it (sensor): the compiled step need not know them.
OUTSIDE_THE_STEP = frozenset(
    "foot_defects rounded_feet uneven_foot_stiffness uneven_foot_damping uneven_foot_friction mass_eccentricity "
    "inertia_deviation dimension_deviation release_velocity gyro_misalignment gyro_scale gyro_drift gyro_bandwidth "
    "gyro_saturation clock_error none".split()
)
