"""A fit as a model: values, intervals, effects, and where each number came from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.fit.intervals import half_widths
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.hypotheses.candidates import value_of
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.provenance import versions
from rockref.effects.base import Effect
from rockref.effects.prior import to_scale
from rockref.measure.experiment import Experiment

#: What are notes about one release, not properties of the block.
OF_ONE_RELEASE = ("tilt_offset", "roll_offset")


@dataclass(frozen=True)
class Estimate:
    """One number found: `name`, `value`, 90 % interval `low` to `high`, `unit`; `z`, in its priors."""

    name: str
    value: float
    low: float
    high: float
    unit: str
    z: float
    of_effect: bool
    of_run: int | None

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        return {
            "value": self.value, "low": self.low, "high": self.high, "unit": self.unit, "z_in_prior": round(self.z, 3),
        }  # fmt: skip


#: Units of the twelve parameters.
UNITS = {"K_N": "N/m", "K_T": "N/m", "delta_diag": "m", **{f"delta_long_{k}": "m" for k in range(1, 5)}}


def estimates(fit: Fit, point: Point, covariance: np.ndarray) -> list[Estimate]:
    """All parameters of a fit with 90 % intervals; covariance (G, G) of z, widened as calibrated."""
    half, found = half_widths(fit, point, covariance), []
    for k, p in enumerate(fit.parameters):
        ends = sorted((value_of(p, point.z[k] - half[k]), value_of(p, point.z[k] + half[k])))
        found.append(
            Estimate(
                name=p.name,
                value=value_of(p, point.z[k]),
                low=ends[0],
                high=ends[1],
                unit=p.unit or UNITS.get(p.name, "1"),
                z=float(point.z[k] / p.prior),
                of_effect="." in p.name,
                of_run=p.run,
            )
        )
    return found


def in_file_order(found: list[Estimate]) -> list[Estimate]:
    """Shared parameters, then effects, then what belongs to one run."""
    return sorted(found, key=lambda e: (e.of_run is not None, e.of_effect))


def fitted_model(fit: Fit, point: Point, found: list[Estimate], origin: dict[str, Any]) -> Model:
    """The model of a fit with its uncertainty (shared numbers only) and its origin; absent effects left out."""
    model = fit.models(point.z)[0][0]
    kept = {k: v for k, v in model.origin.items() if k not in (*OF_ONE_RELEASE, "source")}
    uncertainty = {e.name: finite(e.to_dict()) for e in found if e.of_run is None}
    return model.replace(effects=model.active_effects(), uncertainty=uncertainty, origin={**kept, **origin})


def finite(values: dict[str, Any]) -> dict[str, Any]:
    """Values that a TOML file of ours may hold: a number that is not finite as a word."""
    return {k: str(v) if isinstance(v, float) and not np.isfinite(v) else v for k, v in values.items()}


def origin_of(experiment: Experiment, seed: int, made_by: str) -> dict[str, Any]:
    """From which files, with which versions and seed a model was made."""
    return {
        "made_by": made_by,
        "experiment": experiment.name,
        "seed": seed,
        "versions": {k: v for k, v in versions(experiment).items() if isinstance(v, str)},
        "files_sha256": dict(experiment.digests),
    }


def z_of(parameter: Parameter, value: float) -> float:
    """The z at which a parameter has this value (as `Parameter.value` counts it)."""
    if parameter.log:
        return float(np.log(max(value, 1e-12) / parameter.centre) / parameter.spread)
    return float((value - parameter.centre) / parameter.spread)


def start_from(parameters: tuple[Parameter, ...], model: Model) -> np.ndarray:
    """z (G,) at which the shared parameters have the values of a model; those of one run begin at zero."""
    z = np.zeros(len(parameters))
    effects = {e.id: e for e in model.effects}
    for k, p in enumerate(parameters):
        if p.run is not None:
            continue
        id, _, key = p.name.partition(".")
        if not key:
            z[k] = z_of(p, parameter_of(model, p.name))
        elif id in effects:
            z[k] = z_of(p, inner_value(effects[id], key))
    return z


def parameter_of(model: Model, name: str) -> float:
    """One of the twelve by its name in a fit (delta_long_1 to delta_long_4 are the heights of the feet)."""
    if name.startswith("delta_long_"):
        return float(model.parameters.delta_long[int(name[-1]) - 1])
    return float(getattr(model.parameters, name))


def inner_value(effect: Effect, key: str) -> float:
    """An effect's parameter as a fit counts it: what is absent at infinity or when rigid is found as its inverse."""
    return to_scale(type(effect), key, float(getattr(effect, key)))
