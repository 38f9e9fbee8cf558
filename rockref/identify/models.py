"""The model of a chromosome, for every kind of genes."""

from __future__ import annotations

import numpy as np

from rockref.api import Model
from rockref.identify.four_points import model_of_scenario
from rockref.identify.genes import PROPERTIES, Space
from rockref.model.parameters import Parameters, from_chromosome_12


def model_of(space: Space, u: np.ndarray) -> Model:
    """Return the model of a chromosome u (G,) in [0, 1].

    Raises InputError (E-KEY) for a kind that is not known.
    """
    values = space.values(u)
    if space.kind == "12":
        return space.model.replace(parameters=from_chromosome_12(values))
    if space.kind == "54":
        return _model_of_54(space.model, values)
    return model_of_scenario(space, values)


def _model_of_54(model: Model, values: np.ndarray) -> Model:
    per_point = values[:48].reshape(8, 6)
    properties = {k: per_point[:, i].copy() for i, k in enumerate(PROPERTIES)}
    # Decided: the law wants mu_0 >= mu; a chromosome with less gets mu_0 = mu.
    properties["mu_0"] = np.maximum(properties["mu_0"], properties["mu"])
    first, second, third, fourth, diagonal, tilt = map(float, values[48:])
    parameters = Parameters(delta_long=(first, second, third, fourth), delta_diag=diagonal, theta_0=tilt)
    return model.replace(parameters=parameters, properties=properties)
