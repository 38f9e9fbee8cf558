"""A fit as a model: values, intervals, effects, and where each number came from."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.evidence.evidence import HypothesisEvidence
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.provenance import OF_ONE_RELEASE, versions


def model_of(fitter: Fitter, h: FittedModel, said: HypothesisEvidence, made_by: str, **notes: Any) -> Model:
    """Return the model of a fit with its uncertainty (shared numbers only) and its origin; absent effects left out."""
    problem = fitter.problem
    model = fitter.model(h)
    kept = {k: v for k, v in model.origin.items() if k not in (*OF_ONE_RELEASE, "source")}
    experiment = problem.experiment
    origin = {
        "made_by": made_by,
        "experiment": experiment.name,
        "seed": problem.seed,
        "versions": {k: v for k, v in versions(experiment).items() if isinstance(v, str)},
        "files_sha256": dict(experiment.digests),
        **notes,
    }
    uncertainty = {
        name: finite({"value": n.value, "low": n.low, "high": n.high, "unit": n.unit, "z_in_prior": round(n.z, 3)})
        for name, n in {**said.law, **said.numbers}.items()
        if "[" not in name
    }
    return model.replace(effects=model.active_effects(), uncertainty=uncertainty, origin={**kept, **origin})


def finite(values: dict[str, Any]) -> dict[str, Any]:
    """Return values that a TOML file of ours may hold: a number that is not finite as a word."""
    return {k: str(v) if isinstance(v, float) and not np.isfinite(v) else v for k, v in values.items()}
