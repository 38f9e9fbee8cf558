"""An identification on disk: what was found, from what, with what; and the model file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.identify.cost import WEIGHTS
from rockref.identify.identifiability import Identifiability
from rockref.identify.identification import Identified, fingerprint
from rockref.identify.models import model_of
from rockref.identify.runs import RunError
from rockref.identify.search import Settings, versions
from rockref.identify.target import Target

SCHEMA = "rockref-identification-1"


def record(
    end: Identified,
    known: Identifiability,
    runs: Sequence[RunError],
    search_targets: Sequence[Target],
    targets: Sequence[Target],
    settings: Settings,
    inputs: dict[str, str],
) -> dict[str, Any]:
    """Return everything that an identification says, for JSON; the same inputs give the same record, to the last bit.

    inputs : digests of the files that were read, by name.
    """
    from dataclasses import asdict

    space, polished = end.space, end.polished
    digits = known.digits()
    return {
        "schema": SCHEMA,
        "seed": settings.seed,
        "settings": asdict(settings),
        "versions": versions(),
        "inputs": inputs,
        "search": fingerprint(space, search_targets)
        | {
            "generations": len(end.found.history.costs),
            "simulations": sum(map(len, end.found.history.costs)) * len(search_targets),
            "cost": end.found.cost,
            "weights": WEIGHTS._asdict(),
            "terms": {
                t.name: None if terms is None else terms._asdict()
                for t, terms in zip(search_targets, end.terms, strict=True)
            },
            "chromosome": _named(space.names, space.values(end.found.u)),
            "best_cost_by_generation": end.found.history.best_cost,
            "restarts": end.found.history.restarts,
        },
        "least_squares": {
            "targets": [t.name for t in targets],
            "rounds_of_search_on_the_signals": end.rounds,
            "chi2": polished.chi2,
            "at_noise_floor": end.at_floor,
            "values": _named(space.names, space.values(polished.u)),
            "errors": _named(known.names, known.errors),
            "errors_in_last_digits": digits,
            "determined": known.determined(),
            "trade_offs": [list(pair) for pair in known.pairs],
            "weakest_combination": known.weakest,
            "release_tilt_rad": _named([t.name for t in targets], polished.tilts),
        },
        "runs": [
            {
                "run": r.name,
                "use": r.use,
                "release_tilt_rad": r.tilt,
                "rms_deg_s": np.degrees(r.rms).tolist(),
                "rms_over_noise": r.over_noise,
                "rms_over_noise_as_stated": r.over_noise_stated,
            }
            for r in runs
        ],
    }


def found_model(end: Identified, known: Identifiability, inputs: dict[str, str], seed: int) -> Model:
    """Return the identified model with its uncertainty (one standard deviation, SI) and where it came from."""
    model = model_of(end.space, end.polished.u)
    errors = {n: float(e) for n, e in zip(known.names, known.errors, strict=True) if not n.startswith("theta_0 of")}
    return model.replace(
        uncertainty=errors,
        origin={"command": "rockref identify", "seed": seed, "inputs": inputs, "versions": _plain(versions())},
    )


def _named(names: Sequence[str], values: np.ndarray) -> dict[str, float]:
    return {name: float(value) for name, value in zip(names, values, strict=True)}


def _plain(found: dict[str, str | None]) -> dict[str, str]:
    return {name: value or "not installed" for name, value in found.items()}


def files_in(folder: Path) -> dict[str, Path]:
    """Return where the files of an identification lie in its folder."""
    return {"result": folder / "identification.json", "model": folder / "model.toml"}
