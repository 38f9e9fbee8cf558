"""The block of Table 3.1 as every simulator here gets it: released at 0.1170 rad, to the second main impact."""

from __future__ import annotations

import rockref
from rockref import Model, Problem

STEP = 1e-5
OUTPUT_RATE = 2000.0
#: A little beyond the second main impact (1.33 s) of the block of Table 3.1 [s].
DURATION = 1.34
#: Radius of the round feet that LAMMPS and MuJoCo need [m].
FOOT_RADIUS = 1e-3


def released(duration: float = DURATION, model: Model | None = None) -> Problem:
    """The release of Table 3.1, or of another model."""
    return (model or rockref.Model.table_3_1()).problem(duration, STEP, OUTPUT_RATE)


def released_on_round_feet(duration: float = DURATION) -> Problem:
    """The same block on round feet, for simulators that know spheres only."""
    return released(duration, rockref.Model.table_3_1().replace(foot_radius=FOOT_RADIUS))
