"""The four-point models that the source's authors tried first, and found wanting.

Each scenario gives the four-point model one defect, or several: the wire pulls out of plane, the centre of mass is off,
the feet differ in stiffness, damping, friction, or in the direction of their contact normals. Every scenario is fitted
with the same budget to a reference made by the eight-point model.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.effects.contact.uneven_foot_damping import UnevenFootDamping
from rockref.effects.contact.uneven_foot_stiffness import UnevenFootStiffness
from rockref.effects.friction.uneven_foot_friction import UnevenFootFriction
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.identify.campaign import Campaign, campaign
from rockref.identify.candidates import evaluate, feature_costs, releases
from rockref.identify.genes import TILT_RANGE, Gene, Space, gene, model_of, space_12
from rockref.identify.search import Settings, search
from rockref.identify.target import Target
from rockref.measure.phases import phases
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
#: What is tried: nothing, each alone, and combinations.
SCENARIOS: tuple[tuple[str, ...], ...] = (
    (),
    *((name,) for name in DEFECTS),
    ("wire", "eccentricity"),
    ("stiffness", "damping"),
    ("stiffness", "damping", "friction"),
    ("eccentricity", "friction"),
    tuple(DEFECTS),
)
#: Length of the run in which the return to quasi-2-D motion is looked for [s]; decided: the reference returns after
#: some ten seconds.
LONG = 15.0


def scenario_space(defects: Sequence[str], tilt: float, block: Model | None = None) -> Space:
    """Return the genes of a four-point model with these defects, released at `tilt` +- 0.08 degrees [rad]."""
    model = (Model.four_points() if block is None else block).replace(points="four_points", theta_0=tilt, effects=())
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


#: The row to hold the others against: the eight-point model with its twelve genes, fitted with the same budget.
REFERENCE = ("eight_points",)


def try_scenarios(
    target: Target, settings: Settings, work: Campaign, scenarios: Sequence[Sequence[str]] = (REFERENCE, *SCENARIOS)
) -> Iterator[tuple[int, dict[str, Any]]]:
    """Return one row a scenario (`try_scenario`), with its index, as it is done; all are fitted with the same
    budget."""
    return work.as_done(_several, (target, settings), [tuple(s) for s in scenarios])


def _several(target: Target, settings: Settings, scenarios: Sequence[tuple[str, ...]]) -> list[dict[str, Any]]:
    return [try_scenario(target, settings, defects) for defects in scenarios]


def try_scenario(target: Target, settings: Settings, defects: tuple[str, ...]) -> dict[str, Any]:
    """Fit a four-point model with these defects (or the eight-point model, `REFERENCE`) to the target.

    Returns, for JSON: name; genes, their number; cost and its terms; rms_deg_s (3,) of the difference up to the second
    main impact; values by gene; quasi_2d_from, start of the last planar arcs [s] (None: none within `LONG`).
    """
    space = space_12(Model.table_3_1(), target.tilt) if defects == REFERENCE else scenario_space(defects, target.tilt)
    with campaign(1) as here:
        found = search(feature_costs, (space, [target]), len(space.genes), settings, here)
    terms = evaluate(space, [target], found.u[None])[0][1][0]
    t, crv = releases(space, target, [found.u])
    n = int(np.searchsorted(target.t, target.until))
    seen = np.stack([np.interp(target.t[:n], t, crv[0, :, j]) for j in range(3)], axis=-1)
    late = returns_to_plane(model_of(space, found.u), **start_of(space, found.u))
    return {
        "name": words(defects),
        "defects": list(defects),
        "genes": len(space.genes),
        "cost": found.cost,
        "terms": None if terms is None else terms._asdict(),
        "rms_deg_s": np.degrees(np.sqrt(np.mean(np.square(seen - target.crv[:n]), axis=0))).tolist(),
        "u": found.u.tolist(),
        "values": dict(zip(space.names, map(float, space.values(found.u)), strict=True)),
        "quasi_2d_from": late if np.isfinite(late) else None,
    }


def words(defects: Sequence[str]) -> str:
    """Return a scenario in words."""
    if tuple(defects) == REFERENCE:
        return "eight points"
    return "four points" + (", uneven or off: " + ", ".join(defects) if defects else ", no defect")


def returns_to_plane(model: Model, duration: float = LONG, **start) -> float:
    """Return when the last planar arcs begin [s]; infinite where the motion stays 3-D, or never left the plane."""
    from rockref.engines import run

    response = run(model.problem(duration, output_rate=1000.0, **start), engine="auto")
    found = phases(response.t, response.W)
    # Motion that is planar from the first arc on has not returned.
    return found.quasi_2d_from if np.isfinite(found.onset) and found.quasi_2d_from > found.repeatable_until else np.inf
