"""Four-point models with defects: their genes, and the model that the genes make.

The wire pulls out of plane, the centre of mass is off, the feet differ in stiffness, damping, friction, or in the
direction of their contact normals.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from rockref.api import Model
from rockref.effects.contact.uneven_foot_damping import UnevenFootDamping
from rockref.effects.contact.uneven_foot_stiffness import UnevenFootStiffness
from rockref.effects.friction.uneven_foot_friction import UnevenFootFriction
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.identify.genes import TILT_RANGE, Gene, Space, gene
from rockref.model.parameters import Parameters

PREFIX = "four_points"
#: The genes of every scenario; a four-point model has one damping ratio and one friction coefficient.
COMMON = ("K_N", "K_T", "beta_ext", "mu_ext", "theta_0")
#: The genes of each defect: name, unit, range, by logarithm. Decided: feet differ by up to a factor of three, the first
#: being the measure of the others; the centre of mass is off by up to 5 mm, a twentieth of the base; a normal leans by
#: up to 0.05 rad; the wire pulls out of plane by as much as the release angle is uncertain.
DEFECTS: dict[str, tuple[Gene, ...]] = {
    "wire": (Gene("out_of_plane", "rad", -TILT_RANGE, TILT_RANGE),),
    "eccentricity": (Gene("eccentricity_x", "m", -5e-3, 5e-3), Gene("eccentricity_y", "m", -5e-3, 5e-3)),
    "stiffness": tuple(Gene(f"stiffness_{i}", "1", 1 / 3, 3.0, True) for i in (2, 3, 4)),
    "damping": tuple(Gene(f"damping_{i}", "1", 1 / 3, 3.0, True) for i in (2, 3, 4)),
    "friction": tuple(Gene(f"friction_{i}", "1", 1 / 3, 3.0, True) for i in (2, 3, 4)),
    "normals": tuple(Gene(f"normal_{a}{i}", "1", -0.05, 0.05) for i in (1, 2, 3, 4) for a in "xy"),
}


def scenario_space(defects: Sequence[str], tilt: float) -> Space:
    """Return the genes of a four-point model with these defects, released at `tilt` +- 0.08 degrees [rad]."""
    model = Model.four_points().replace(theta_0=tilt)
    genes = [gene(name, tilt) for name in COMMON] + [g for name in defects for g in DEFECTS[name]]
    return Space(":".join((PREFIX, *defects)), tuple(genes), model)


def model_of_scenario(space: Space, values: np.ndarray) -> Model:
    """Return the model of a scenario's genes (G,)."""
    v = dict(zip(space.names, map(float, values), strict=True))
    parameters = Parameters(
        K_N=v["K_N"], K_T=v["K_T"], beta_ext=v["beta_ext"], beta_int=v["beta_ext"], mu_ext=v["mu_ext"],
        mu_int=v["mu_ext"], theta_0=v["theta_0"],
    )  # fmt: skip
    effects = [make(v) for name, make in _EFFECTS.items() if name in space.kind.split(":")]
    return space.model.replace(parameters=parameters, effects=tuple(effects))


def _feet(kind: type, name: str) -> Callable[[dict[str, float]], object]:
    return lambda v: kind(1.0, *(v[f"{name}_{i}"] for i in (2, 3, 4)))


_EFFECTS: dict[str, Callable] = {
    "eccentricity": lambda v: MassEccentricity(v["eccentricity_x"], v["eccentricity_y"], 0.0),
    "stiffness": _feet(UnevenFootStiffness, "stiffness"),
    "damping": _feet(UnevenFootDamping, "damping"),
    "friction": _feet(UnevenFootFriction, "friction"),
    "normals": lambda v: UnevenContactNormals(*(v[f"normal_{a}{i}"] for i in (1, 2, 3, 4) for a in "xy")),
}


def start_of(space: Space, u: np.ndarray) -> dict[str, float]:
    """Return what the release needs beside the model: the out-of-plane angle of the wire [rad]."""
    if "out_of_plane" not in space.names:
        return {}
    return {"out_of_plane": float(space.values(u)[space.names.index("out_of_plane")])}
