"""The four-point models that the source's authors tried first, and found wanting.

Each scenario gives the four-point model one defect, or several: the wire pulls out of plane, the centre of mass is off,
the feet differ in stiffness, damping, friction, or in the direction of their contact normals. Every scenario is fitted
with the same budget to a reference made by the eight-point model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.identify.candidates import evaluate, feature_costs, releases
from rockref.identify.four_points import DEFECTS, scenario_space, start_of
from rockref.identify.genes import space_12
from rockref.identify.models import model_of
from rockref.identify.search import Settings, search
from rockref.identify.target import Target
from rockref.jobs.campaign import Campaign, campaign
from rockref.measure.signals.phases import phases

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
    [(t, crv)] = releases(space, [target], [[found.u]])
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
