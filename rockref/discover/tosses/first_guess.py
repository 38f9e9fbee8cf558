"""Where a fit begins: the values that the tosses show without a contact model.

The error of a toss has more than one valley. A soft contact at sharp corners and a hard one at round corners dip the
drawn corners equally deep; between them lies a ridge that no descent crosses. Which of the two it is, is seen without
any contact model: in the mean time of the impulse.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses.parameters import z_of

#: Numbers of the law that go along with an effect's first guess.
ALONG = {"rounded_corners": ("K_N", "K_T")}


def first_guesses(found: dict[str, Any], base: Model) -> dict[str, float]:
    """Return value by parameter's name, from `rockref.discover.tosses.compare.measured`; empty where nothing was
    measured."""
    guesses: dict[str, float] = {}
    arcs = found.get("flight_arcs", {}).get("values", {})
    part = found.get("measured_centre")
    if part is None:
        return guesses
    for axis in "xyz":
        guesses[f"mass_eccentricity.{axis}"] = arcs[f"centre_{axis}"]["value"]
    J = np.diag(np.asarray(base.body()[0].inertia))
    for k, axis in enumerate(("xx", "yy", "zz")):
        guesses[f"inertia_deviation.{axis}"] = part["inertia_kg_m2"][axis] / J[k]
    shape, corner = part["shape"]["values"], part["corner"]["values"]
    tau, radius = (shape[name]["value"] for name in ("half_contact_time", "radius"))
    if tau > 0 and radius > 0:
        # A spring under the effective mass of a corner struck along an edge's direction swings half a period in 2 tau.
        lever = float(np.max(np.abs(np.asarray(base.body()[1].P)[:, 0])))
        mass = 1 / (1 / float(base.mass) + lever**2 / float(part["inertia_kg_m2"]["xx"]))
        guesses["rounded_corners.radius"] = radius
        guesses["K_N"] = guesses["K_T"] = mass * (np.pi / (2 * tau)) ** 2
        slides = [v["value"] for v in found.get("sliding", {}).get("values", {}).values()]
        if slides and "friction" in corner:
            # Four corners share the weight in a slide; the impulse of an impact m u (1 + e) acts for 2 tau.
            flat = float(base.mass * base.body()[0].g) / 4
            struck = mass * (1 + corner["restitution"]["value"]) / (2 * tau)
            exponent = np.log(slides[-1] / corner["friction"]["value"]) / np.log(struck / flat)
            guesses["load_dependent_friction.exponent"] = float(exponent)
            guesses["stribeck_friction.ratio"] = slides[0] / slides[-1]
    return guesses


def guessed(z: np.ndarray, parameters: tuple[Parameter, ...], effect: str, guesses: dict[str, float]) -> np.ndarray:
    """Return z with the guesses for an effect and what goes along with it; as it is where there are none."""
    own = {k for k in guesses if k.startswith(effect + ".")}
    if own:
        own |= set(ALONG.get(effect, ()))
    z = z.copy()
    for i, p in enumerate(parameters):
        if p.name in own and p.name in guesses:
            z[i] = z_of(p, guesses[p.name])
    return z
