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
HYSTERESIS = _block(2)  # on, kappa
HUNT = _block(2)  # on, a
STRIBECK = _block(3)  # on, ratio, velocity
LOAD = _block(3)  # on, exponent, reference
#: Whether any of the following, which add forces and moments to the body, is on.
ON_BODY = _block(1)
ADHESION = _block(3)  # on, force, range
VISCOUS = _block(2)  # on, c
NORMALS = _block(9)  # on, x1, y1 .. x4, y4
SPIN = _block(2)  # on, radius
ROLLING = _block(2)  # on, lever
DRAG = _block(3)  # on, c, half the height
CABLE = _block(6)  # on, k, c, height of attachment, its place at the start (x, y)
WIRE = _block(4)  # on, force, tau, height of attachment
VIBRATION = _block(6)  # on, amplitude, angular frequency, phase, sine and cosine of the direction
TILT = _block(3)  # on, x, y
SUPPORT = _block(4)  # on, mass, stiffness, damping
SLOTS = _next

#: The effects that act in the step, in the order in which they do (that of `rockref.effects.catalogue`).
IN_THE_STEP = tuple(
    "hertzian_contact hysteretic_contact hunt_crossley_contact stribeck_friction load_dependent_friction adhesion "
    "viscous_friction uneven_contact_normals spin_friction rolling_resistance quadratic_drag cable_restraint "
    "lingering_wire_pull base_vibration plate_tilt compliant_support".split()
)

#: Effects that act before the run (on points, mass, release) or after it (sensor).
OUTSIDE_THE_STEP = frozenset(
    "foot_defects rounded_feet uneven_foot_stiffness uneven_foot_damping uneven_foot_friction mass_eccentricity "
    "inertia_deviation dimension_deviation release_velocity gyro_misalignment gyro_scale gyro_drift gyro_bandwidth "
    "gyro_saturation clock_error none rounded_corners gravity_deviation tag_frame plate_pose".split()
)
