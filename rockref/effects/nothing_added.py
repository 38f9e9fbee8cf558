"""What the source says to each question: nothing is added to the law."""

from __future__ import annotations

from dataclasses import dataclass

from rockref.effects.base import Effect


def nothing(name: str, question: str, says: str, sentence: str, equation: str, source: str) -> type[Effect]:
    """Make the effect that adds nothing, as the source's answer to a question."""
    facts = {"question": question, "sentence": sentence, "equation": equation, "source": source}
    return dataclass(frozen=True)(type(name, (Effect,), {"__doc__": says, **facts}))


NoContactEffect = nothing(
    "NoContactEffect", "contact", "Nothing added to the normal contact.",
    "Spring and damper in parallel at every point, without tension, all springs alike (rules N1, N2, P1 to P3).",
    r"F^{(N)} = \max(K^{(N)}\xi + C^{(N)}\dot\xi,\ 0)",
    "The model's source, (3.5), (3.7) to (3.9)",
)  # fmt: skip
NoFrictionEffect = nothing(
    "NoFrictionEffect", "friction", "Nothing added to friction.",
    "Coulomb's cone with a stick spring and damper, radial return, no resistance to turning (rules T1 to T6).",
    r"\|F^{(T)}\| \leq \mu F^{(N)}",
    "The model's source, (3.6)",
)  # fmt: skip
NoShapeEffect = nothing(
    "NoShapeEffect", "shape", "Nothing changed in shape and mass.",
    "A uniform cuboid on point feet, centre of mass in the middle, plate normal everywhere (rules G1, G2).",
    r"J = \frac{m}{12}\,\mathrm{diag}(d^2+h^2,\ b^2+h^2,\ b^2+d^2)",
    'The model\'s source, "Defects", Fig. 3.2b',
)  # fmt: skip
NoLoad = nothing(
    "NoLoad", "loads", "No further load.",
    "The weight alone, along e_z (rule A1).",
    r"F = \sum_i F_i - m g\,e_z",
    "The model's source, section 3.3",
)  # fmt: skip
RigidSupport = nothing(
    "RigidSupport", "support", "The plate does not move.",
    "The plate is fixed (rule K1: penetration is -z).",
    r"\xi = -z",
    'The model\'s source, "Contact non-linearities"',
)  # fmt: skip
ReleaseAtRest = nothing(
    "ReleaseAtRest", "release", "The block starts at rest.",
    "At rest, in equilibrium with the wire, both pivot points touching with half the weight each (decided).",
    r"v = 0,\quad W = 0",
    "The model's source says only that the block is released by a wire",
)  # fmt: skip
IdealGyroscope = nothing(
    "IdealGyroscope", "sensor", "The gyroscope shows the crv.",
    "What is measured is the crv, along the block's axes (rule M1).",
    "W_m = W",
    "The model's source, Fig. 3.4",
)  # fmt: skip
TrackedAsDrawn = nothing(
    "TrackedAsDrawn", "tracking", "The tracked frame is that of the body, and the plate is the board's plane z = 0.",
    "Tags sit where the drawing has them, the plate lies in the plane of the camera's board.",
    r"\Lambda = \Lambda_t,\quad x = x_t,\quad z_p = 0",
    "Decided: what the poses of a recording mean until something else is shown",
)  # fmt: skip
#: To the questions that are asked of every experiment, in their order; tracking is asked of tosses.
NOTHING_ADDED = (
    NoContactEffect, NoFrictionEffect, NoShapeEffect, NoLoad, RigidSupport, ReleaseAtRest, IdealGyroscope,
)  # fmt: skip
