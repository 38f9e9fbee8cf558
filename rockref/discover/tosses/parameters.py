"""What a fit of tosses may move: the contact of the plain law, and the effects that the field would look at."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.hypotheses.candidates import with_effect
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses.body import effect_of
from rockref.effects import catalogue
from rockref.effects.base import Effect

#: The law's own: name -> spread of the logarithm; decided: nothing but the order of magnitude of the contact is stated.
LAW = {"K_N": 0.5, "K_T": 1.0, "C_N": 0.5, "C_T": 1.0, "mu": 0.2}
#: Candidates and the spread of each of their parameters: what a careful person would not be surprised to find on a
#: light body of ten centimetres with tags (decided). In the order in which they are shown.
CANDIDATES: dict[str, dict[str, float]] = {
    "mass_eccentricity": {"x": 2e-3, "y": 2e-3, "z": 2e-3},
    "inertia_deviation": {"xx": 0.15, "yy": 0.15, "zz": 0.15},
    "dimension_deviation": {"width": 0.01, "depth": 0.01, "height": 0.01},
    "rounded_corners": {"radius": 2e-3},
    "plate_pose": {"height": 1e-3, "slope_x": 4e-3, "slope_y": 4e-3},
    "plate_tilt": {"x": 4e-3, "y": 4e-3},
    "tag_frame": {"x": 5e-4, "y": 5e-4, "z": 5e-4, "turn_x": 4e-3, "turn_y": 4e-3, "turn_z": 4e-3},
    "gravity_deviation": {"scale": 0.01},
    "hertzian_contact": {"exponent": 0.2},
    "hunt_crossley_contact": {"a": 0.3},
    "hysteretic_contact": {"kappa": 0.3},
    "orientation_dependent_damping": {"a": 1.0},
    "adhesion": {"force": 0.3},
    "stribeck_friction": {"ratio": 0.3},
    "load_dependent_friction": {"exponent": 0.1},
    "viscous_friction": {"c": 0.1},
    "spin_friction": {"radius": 2e-3},
    "rolling_resistance": {"lever": 4e-4},
    "quadratic_drag": {"c_v": 0.01},
}
#: Shapes that are kept: depth and load of an impact of these tosses, and the speed over which the friction of a face
#: that slides flat is seen to change (decided).
KEPT = {
    "hertzian_contact": {"reference": 3e-3},
    "load_dependent_friction": {"reference": 20.0},
    "stribeck_friction": {"velocity": 0.2},
    "adhesion": {"range": 1e-3},
}
#: Prior standard deviation in spreads.
PRIOR = 3.0


def set_law(key: str):
    """Set one number of all contact points; friction sets both coefficients."""

    def set_value(model: Model, value: float) -> Model:
        q = model.custom_points
        assert q is not None
        same = np.full(q.n, value)
        changes: dict[str, Any] = {"mu": same, "mu_0": same} if key == "mu" else {key: same}
        q = replace(q, **changes)
        return replace(model, points="custom", custom_points=q)

    return set_value


def set_effect(kind: type[Effect], key: str):
    """Set one parameter of an effect; its shapes are those of `KEPT`."""

    def set_value(model: Model, value: float) -> Model:
        effect = effect_of(model, kind, **KEPT.get(kind.id, {}))
        return with_effect(model, replace(effect, **{key: value}))

    return set_value


def law_parameters(model: Model) -> tuple[Parameter, ...]:
    """Return the five numbers of the contact, about those of the model."""
    q = model.custom_points
    assert q is not None
    return tuple(
        Parameter(
            key, set_law(key), float(getattr(q, key)[0]), spread, log=True, prior=PRIOR,
            unit={"K": "N/m", "C": "N s/m", "m": "1"}[key[0]],
        )
        for key, spread in LAW.items()
    )  # fmt: skip


def effect_parameters(id: str) -> tuple[Parameter, ...]:
    """Return the parameters of a candidate; z = 0 is its absence."""
    kind = catalogue.find(id)
    found = []
    for key, spread in CANDIDATES[id].items():
        q = kind.quantities[key]
        absent = float(q.absent or 0.0)
        low = absent if q.sign == "+" else q.least
        found.append(
            Parameter(
                f"{id}.{key}", set_effect(kind, key), absent, spread, prior=PRIOR, low=low, high=q.most, unit=q.unit
            )
        )
    return tuple(found)


def parameters(model: Model, effects: tuple[str, ...]) -> tuple[Parameter, ...]:
    """Return the law's numbers and those of the effects, in this order."""
    return law_parameters(model) + tuple(p for id in effects for p in effect_parameters(id))


def z_of(p: Parameter, value: float) -> float:
    """Return the z at which a number has this value."""
    return (np.log(value / p.centre) if p.log else value - p.centre) / p.spread


def apply(model: Model, found: tuple[Parameter, ...], z: np.ndarray) -> Model:
    """Return the model with every parameter at its z."""
    for p, zi in zip(found, z, strict=True):
        model = p.set(model, p.value(float(zi)))
    return model
