"""What an effect is: parameters with units and ranges, and the one term of the step that it changes."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any, ClassVar, NamedTuple


class Quantity(NamedTuple):
    """What is known of one parameter of an effect.

    unit; absent: the value at which the effect is not there; low, high: plausible range; typical: typical size;
    sign: "+" where only one sign is physical, else "any"; meaning: a few words.
    """

    unit: str
    absent: float
    low: float
    high: float
    typical: float
    sign: str = "any"
    meaning: str = ""


@dataclass(frozen=True)
class Effect:
    """Base of all effects: every hook leaves the law alone. A subclass overrides the one that it changes.

    Class attributes: `id` (appears in files and verdicts), `question` (the folder), `quantities` (one Quantity per
    parameter), `sentence` (the physics), `equation`, `reference` (with DOI), `confounder` (id), `experiment` (what
    would tell them apart).
    The hooks in the order of the step. Arrays as in the model; `m` is the effect's own memory, whose entries may be
    replaced (never changed in place).
    """

    id: ClassVar[str] = "none"
    question: ClassVar[str] = ""
    quantities: ClassVar[dict[str, Quantity]] = {}
    sentence: ClassVar[str] = ""
    equation: ClassVar[str] = ""
    reference: ClassVar[str] = ""
    confounder: ClassVar[str] = ""
    experiment: ClassVar[str] = ""

    def values(self) -> dict[str, Any]:
        """The parameters by name."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def is_absent(self) -> bool:
        """Whether every parameter that can switch the effect off is at the value at which it is absent."""
        return all(value == self.quantities[name].absent for name, value in self.values().items())

    def points(self, block, points):
        """Geometry, mass, properties of the points: returns (Block, ContactPoints). Once, before the run."""
        return block, points

    def release(self, block, points, state):
        """The state at release: returns a State. Once, before the run."""
        return state

    def start(self, problem) -> dict[str, Any]:
        """The effect's own memory at the start (arrays with the batch's leading axes)."""
        return {}

    def plate_motion(self, t, m):
        """None, or displacement and velocity of the plate, two (..., 3) [m, m/s]."""
        return None

    def normal_force(self, F_N, k, points, m):
        """The normal force (..., n) [N]; k: Kinematics."""
        return F_N

    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):
        """Static and dynamic friction coefficient, two (..., n)."""
        return mu_0, mu

    def point_wrench(self, problem, c, m):
        """None, or a further force and moment (plate axes, about the centre of mass) from the points; c: Contact."""
        return None

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        """None, or a further force (..., 3) [N] and moment (..., 3) [N m] on the body, plate axes."""
        return None

    def advance(self, problem, c, h, m):
        """Own degrees of freedom, one step h further: replaces entries of m."""

    def sensor(self, t, crv):
        """What the gyroscope makes of the crv, (N, 3) [rad/s] at t (N,) [s]."""
        return crv
