"""Where each effect's numbers stand in the flat array that the compiled step reads, and which effects share a variant.

One row of `SLOTS` floats per run; zero means that the effect is not there (each block begins with its switch).
"""

from __future__ import annotations

from collections import namedtuple

_next = 0


def _block(n: int) -> int:
    global _next
    first, _next = _next, _next + n
    return first


HERTZ = _block(3)  # on, exponent, reference
HYSTERESIS = _block(3)  # on, kappa, share of the power 3/2 in the unloading
HUNT = _block(2)  # on, a
ORIENTATION = _block(2)  # on, a
STRIBECK = _block(3)  # on, ratio, velocity
LOAD = _block(3)  # on, exponent, reference
ADHESION = _block(3)  # on, force, range
VISCOUS = _block(2)  # on, c
NORMALS = _block(10)  # on, x1, y1 .. x4, y4, share that turns with the block
SPIN = _block(3)  # on, radius, share by which sliding weakens it
ROLLING = _block(2)  # on, lever
DRAG = _block(3)  # on, c of the moment, c_v of the force
CABLE = _block(7)  # on, k at no way, c, height of attachment, its place at the start (x, y), growth of k with way^2
WIRE = _block(5)  # on, force, tau, height of attachment, evenness
VIBRATION = _block(8)  # on, amplitude, angular frequency, phase, sine and cosine of the direction, second harmonic (2)
TILT = _block(3)  # on, x, y
SUPPORT = _block(8)  # on, mass, stiffness, damping, the same three of pitching, moment at rest; inertia 0: none
OF_EFFECTS = _next
BASE = _block(5)  # on, time of the first sample, interval, number of the last sample, row of the first one in the table
SLOTS = _next

#: Which effects are on, read once per run.
Switches = namedtuple(
    "Switches",
    "hertz hysteresis hunt orientation stribeck load adhesion viscous normals spin rolling drag cable wire vibration "
    "tilt support base",
)

#: The slots of these switches, in the same order.
SWITCHED_BY = [
    HERTZ, HYSTERESIS, HUNT, ORIENTATION, STRIBECK, LOAD, ADHESION, VISCOUS, NORMALS, SPIN, ROLLING, DRAG, CABLE, WIRE,
    VIBRATION, TILT, SUPPORT, BASE,
]  # fmt: skip

#: The groups of effects that a variant of the compiled step has or has not, with the slots of their numbers. A motion
#: of the plate, which is an input and no effect, makes a group too.
CONTACT, FORCES, MOMENTS, LOADS, PLATE, SHAKEN = 1, 2, 4, 8, 16, 32
GROUPS = {
    CONTACT: slice(HERTZ, ADHESION),
    FORCES: slice(ADHESION, SPIN),
    MOMENTS: slice(SPIN, DRAG),
    LOADS: slice(DRAG, SUPPORT),
    PLATE: slice(SUPPORT, BASE),
    SHAKEN: slice(BASE, SLOTS),
}
ALL = sum(GROUPS)
#: The variants: the law, each group, and everything for runs with effects of several groups. Decided: effects that
#: write the same things share a group, because a branch that is not taken costs little and a sum that is not needed
#: much; each further variant would be some ten seconds of compiling on the first call, and there are fifteen pairs.
VARIANTS = (0, *GROUPS, ALL)

#: The effects that act in the step, in the order in which they do (that of `rockref.effects.catalogue`).
IN_THE_STEP = tuple(
    "hertzian_contact hysteretic_contact hunt_crossley_contact stribeck_friction load_dependent_friction adhesion "
    "viscous_friction uneven_contact_normals spin_friction rolling_resistance quadratic_drag cable_restraint "
    "lingering_wire_pull base_vibration plate_tilt compliant_support orientation_dependent_damping".split()
)

#: Effects that act before the run (on points, mass, release) or after it (sensor).
OUTSIDE_THE_STEP = frozenset(
    "foot_defects rounded_feet uneven_foot_stiffness uneven_foot_damping uneven_foot_friction mass_eccentricity "
    "inertia_deviation dimension_deviation release_velocity gyro_misalignment gyro_scale gyro_drift gyro_bandwidth "
    "gyro_saturation clock_error none rounded_corners gravity_deviation tag_frame plate_pose".split()
)
