"""`fit` and `add` for tosses: the law and chosen effects on the fit tosses, and what an effect changes on both uses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses.body import nominal_model
from rockref.discover.tosses.compare import measured, poses_by_use
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.first_guess import first_guesses, guessed
from rockref.discover.tosses.fit import TossFit
from rockref.discover.tosses.gates import paired, step_small
from rockref.discover.tosses.parameters import CANDIDATES, z_of
from rockref.discover.tosses.predict import STARTS, predict
from rockref.effects import catalogue
from rockref.measure.records.release import FIT, HOLDOUT
from rockref.measure.records.toss import Toss, Tosses
from rockref.measure.tosses.flight import Poses, side_by_side
from rockref.model.errors import InputError

#: Most iterations of a fit; one that gains no more ends it.
ITERATIONS = 24
#: Fewest tosses of a use (decided: a contact's eighteen numbers want at least as many falls, and of fewer the bootstrap
#: of a mean with heavy tails means little).
LEAST_TOSSES = 8


@dataclass(frozen=True)
class FittedTosses:
    """A fitted model: `errors` by start on the fit tosses, and the gate of the step."""

    fit: TossFit
    z: np.ndarray
    objective: float
    errors: dict[str, Errors]
    gates: list[dict[str, Any]]

    @property
    def model(self) -> Model:
        """Return the model, with the word of where it came from."""
        words = {"source": "fitted to tosses", "effects": ", ".join(self.fit.effects) or "none"}
        return self.fit.model(self.z).replace(origin=words)

    @property
    def passed(self) -> bool:
        """Return whether every gate was passed."""
        return all(gate["passed"] for gate in self.gates)

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers."""
        return {
            "kind": "toss", "effects": list(self.fit.effects), "objective": self.objective,
            "parameters": values(self.fit.parameters, self.z), "gates": self.gates,
            "errors": [{"use": FIT, "start": start} | e.summary() for start, e in self.errors.items()],
        }  # fmt: skip


@dataclass(frozen=True)
class TossAddition:
    """An effect that was added: the fits without and with it, errors by (use, start), the fall on held-out tosses."""

    effect: str
    before: FittedTosses
    after: FittedTosses
    errors: dict[tuple[str, str], tuple[Errors, Errors]]
    proof: dict[str, Any]

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers."""
        rows = [
            {"use": use, "start": start, "before": a.summary(), "after": b.summary()}
            for (use, start), (a, b) in self.errors.items()
        ]
        return {"effect": self.effect, "errors": rows, "holdout_falls_by": self.proof} | {
            k: v for k, v in self.after.to_dict().items() if k in ("kind", "effects", "parameters", "gates")
        }


def values(parameters: Sequence[Parameter], z: np.ndarray) -> dict[str, dict[str, Any]]:
    """Return every number of a fit with its unit."""
    return {p.name: {"value": p.value(float(zi)), "unit": p.unit} for p, zi in zip(parameters, z, strict=True)}


def fit_tosses(
    tosses: Tosses,
    effects: Sequence[str] = (),
    model: Model | None = None,
    iterations: int = ITERATIONS,
    progress: Callable[[str], None] | None = None,
) -> FittedTosses:
    """Fit the law, the effects that `model` has and those named to the fit tosses; held-out ones are not looked at.

    Raises
    ------
    InputError
        E-EFFECT, for an effect that tosses are not asked about; E-SIZE, where there are too few tosses; E-KIND, for a
        model that is no box.
    """
    chosen = enough(tosses, FIT, f"A fit needs {LEAST_TOSSES}.")
    for id in effects:
        check_served(id)
    base, own = unfitted(model or nominal_model(tosses))
    names = tuple(dict.fromkeys((*own, *effects)))
    poses = side_by_side(chosen, tosses.rate)
    fit = TossFit(base, names, poses, tosses.width, log=progress or (lambda line: None))
    first = at_values(fit.parameters, own)
    guesses = first_guesses(measured(chosen, tosses, nominal_model(tosses)), base)
    ends = [fit.run(z, iterations) for z in beginnings(first, fit.parameters, names, own, guesses)]
    z, objective = min(ends, key=lambda end: end[1])
    return FittedTosses(
        fit, z, objective, by_start(fit.model(z), poses, tosses.width), [step_small(fit.model(z), poses, tosses.width)]
    )


def add_to_tosses(
    effect: str, tosses: Tosses, model: Model | None = None, progress: Callable[[str], None] | None = None
) -> TossAddition:
    """Fit with and without an effect, from the same model with the same iterations, and compare on both uses.

    Raises InputError (E-EFFECT, ...) for one that is not asked of tosses, or that the model has.
    """
    check_served(effect)
    if model is not None and effect in {e.id for e in model.active_effects()}:
        raise InputError("E-EFFECT", f"argument {effect}", "is in the model already", "Add another one.")
    before = fit_tosses(tosses, (), model, progress=progress)
    after = fit_tosses(tosses, (effect,), before.model, progress=progress)
    found: dict[tuple[str, str], tuple[Errors, Errors]] = {}
    for use, poses in poses_by_use(tosses).items():
        a, b = (by_start(end.model, poses, tosses.width) for end in (before, after))
        found |= {(use, start): (a[start], b[start]) for start in STARTS}
    proof = paired(*found[HOLDOUT, "flight"]) if (HOLDOUT, "flight") in found else {}
    return TossAddition(effect, before, after, found, proof)


def enough(tosses: Tosses, use: str, cure: str) -> tuple[Toss, ...]:
    """Return the tosses of a use. Raises InputError (E-SIZE) where there are too few."""
    chosen = tosses.used(use)
    if len(chosen) < LEAST_TOSSES:
        raise InputError("E-SIZE", str(tosses.path), f"has {len(chosen)} tosses of use {use}", cure)
    return chosen


def check_served(id: str) -> None:
    """Raise InputError (E-EFFECT) for an effect that does not exist or is not asked of tosses."""
    catalogue.named(id)
    if id not in CANDIDATES:
        raise InputError(
            "E-EFFECT", f"effect {id}", "is not for tosses", f"Tosses are asked about {', '.join(CANDIDATES)}."
        )


def unfitted(model: Model) -> tuple[Model, dict[str, Any]]:
    """Return the model without the effects that a fit of tosses moves, and these effects by id."""
    own = {e.id: e for e in model.effects if e.id in CANDIDATES}
    if model.custom_points is None:
        raise InputError(
            "E-KIND", "model", "is a released block", "Tosses need a model of tosses: leave --model out to begin."
        )
    return replace(model, effects=tuple(e for e in model.effects if e.id not in own)), own


def at_values(parameters: Sequence[Parameter], own: dict[str, Any]) -> np.ndarray:
    """Return z at which the effects have the values that they have in a model."""
    z = np.zeros(len(parameters))
    for i, p in enumerate(parameters):
        id, _, key = p.name.partition(".")
        if key and id in own:
            z[i] = z_of(p, getattr(own[id], key))
    return z


def beginnings(z, parameters, names, own, guesses) -> list[np.ndarray]:
    """Return where a fit begins: at the model's values, and at what was measured of the effects that it does not
    have."""
    other = z
    for id in names:
        if id not in own:
            other = guessed(other, parameters, id, guesses)
    return [z] if np.array_equal(other, z) else [z, other]


def by_start(model: Model, poses: Poses, width: float) -> dict[str, Errors]:
    """Return the errors from both kinds of start."""
    return {start: errors(predict(model, poses, start), poses, width) for start in STARTS}
