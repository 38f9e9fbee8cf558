"""rockref on four points, the corners of the base: the model that the source's authors tried first."""

from rockref.conformance.physics.adapters.rockref_law import KNOBS, facts, run

NAME = "rockref, four points"
SETTINGS = {
    "default": {"K": 1e7, "beta": 0.1, "step": 5e-5},
    "careful": {"K": 1e7, "beta": 0.3, "step": 2.5e-5},
}

__all__ = ["KNOBS", "NAME", "SETTINGS", "facts", "run"]
