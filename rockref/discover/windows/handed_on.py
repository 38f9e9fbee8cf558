"""What the windows of a run hand on to each other, since no gyroscope shows it: how the plate moves, how deep it gave.

A window begins where the record says that the block is. A plate on a spring swings on from the impact before, and a
foot that yields stands in the dent that this impact has left: micrometres, but so are the heights of the feet.
"""

from __future__ import annotations

import numpy as np

from rockref.api import Model
from rockref.model.problem import Problem


def plate_of(model: Model) -> tuple[float, float, float] | None:
    """Mass [kg], stiffness [N/m] and damping [N s/m] of a plate that yields; None where it is rigid."""
    for e in model.active_effects():
        if e.id == "compliant_support":
            v = e.values()
            stiffness = (2 * np.pi * v["frequency"]) ** 2 * v["mass"]
            return v["mass"], stiffness, 2 * v["ratio"] * float(np.sqrt(stiffness * v["mass"]))
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
