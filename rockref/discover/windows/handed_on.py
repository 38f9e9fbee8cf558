"""What the windows of a run hand on to each other, since no gyroscope shows it: how the plate moves, how deep it gave.

A window begins where the record says that the block is. A plate on a spring swings on from the impact before, and a
foot that yields stands in the dent that this impact has left: micrometres, but so are the heights of the feet.
"""

from __future__ import annotations

import numpy as np

from rockref.api import Model
from rockref.effects.support.compliant_support import CompliantSupport, Oscillator
from rockref.model.problem import Problem


def plate_of(model: Model) -> tuple[Oscillator, Oscillator] | None:
    """How a plate that yields bounces [kg, N/m, N s/m] and pitches [kg m2, ...], zeros if not; None if it is rigid."""
    for e in model.active_effects():
        if isinstance(e, CompliantSupport):
            return e.bouncing(), e.pitching() or (0.0, 0.0, 0.0)
    return None


def leaves_dents(model: Model) -> bool:
    """Whether feet come out of the plate another way than they went in."""
    return any(e.id == "hysteretic_contact" for e in model.active_effects())


def spin_slip(model: Model, problem: Problem) -> float:
    """Turn at which the carrying point slips in spin under the block's weight [rad]; 0 without spin friction."""
    radius = sum(e.values()["radius"] for e in model.active_effects() if e.id == "spin_friction")
    if not radius:
        return 0.0
    points, block = problem.points, problem.block
    return float(np.mean(points.mu) * np.mean(block.mass) * np.mean(block.g) / (np.mean(points.K_T) * radius))
