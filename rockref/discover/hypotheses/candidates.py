"""What may be missing: every effect of the catalogue as numbers that a fit can move, read from what it declares."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import partial
from typing import TypeVar

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.hypotheses.parameter import Parameter as PriorParameter
from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.effects.natural import SOURCE, NaturalUnits, factor_of, natural_units
from rockref.effects.prior import ROLES
from rockref.effects.scale import from_scale, prior_of

#: Candidates that no window can judge by a derivative: what has a phase of its own in every run, and what cuts samples.
LEFT_OUT = tuple(kind.id for kind in catalogue.IN_STEP_ORDER if kind.of_run or kind.stage == "samples")
#: The priors of all numbers that all runs share.
PRIORS = {
    (kind.id, key): prior_of(kind, key)
    for kind in catalogue.IN_STEP_ORDER
    if not kind.of_run
    for key in kind.quantities
}  # fmt: skip


#: Steps of finite differences, in spreads: of what all runs share, and of what each has of its own.
STEP, STEP_OF_RUN = 0.05, 0.1


def current(model: Model, kind: type[Effect]) -> Effect:
    """Return effect of this kind in a model, or a new one with its shape parameters typical and its switches absent."""
    for effect in model.effects:
        if effect.id == kind.id:
            return effect
    return kind(**typical_values(kind, natural_units(model), ("shape", "fixed")))


def typical_values(kind: type[Effect], units: NaturalUnits, roles: Iterable[str] = ROLES) -> dict[str, float | None]:
    """Return typical values of the quantities with these roles on a block with these units."""
    chosen = {k: q.typical for k, q in kind.quantities.items() if prior_of(kind, k).role in roles}
    return {k: v if v is None else v * factor_of(kind, k, units) for k, v in chosen.items()}


def with_effect(model: Model, effect: Effect) -> Model:
    """Return the model with this effect in place of the one of the same kind."""
    kept = [e for e in model.effects if e.id != effect.id]
    return replace(model, effects=catalogue.in_step_order([*kept, effect]))


def setter(kind: type[Effect], key: str) -> Callable[[Model, float], Model]:
    """Set one parameter of an effect in a model; an effect that is absent and stays so is not even made.

    An effect whose size every run has of its own is made by its shapes, which stand before the sizes.
    """
    absent, shapes = kind.quantities[key].absent, prior_of(kind, key).role == "shape"

    def set_value(model: Model, found: float) -> Model:
        value = from_scale(kind, key, found)
        there = kind.of_run or any(e.id == kind.id for e in model.effects)
        if not there and (shapes or value == absent):
            return model
        effect = replace(current(model, kind), **{key: value})
        return with_effect(model, effect.within(model.width, model.depth))

    return set_value


def parameters_of(
    kind: type[Effect], runs: int, frequency: float | None = None, units: NaturalUnits = SOURCE
) -> tuple[Parameter, ...]:
    """Return the free parameters of an effect; z = 0 is its absence, z = 1 its typical size (shapes: typical at z = 0).

    frequency [Hz] : known beforehand, of an effect with a phase of its own in every run.  units : of the block.
    """
    free = [key for key in kind.quantities if prior_of(kind, key).role != "fixed" and key not in kind.of_run]
    ordered = sorted(free, key=lambda key: prior_of(kind, key).role == "shape")
    found = [parameter_of(kind, key, units) for key in ordered]
    if kind.of_run and frequency:
        found = [replace(p, centre=frequency) if p.unit == "Hz" else p for p in found]
    return (*found, *(p for i in range(runs) for p in parts_of_run(kind, i, units)))


def parameter_of(kind: type[Effect], key: str, units: NaturalUnits) -> Parameter:
    """Return one parameter of an effect as a number that a fit can move, on its own scale."""
    p, centre, spread = prior_of(kind, key), *on_block(kind, key, units)
    return Parameter(
        f"{kind.id}.{key}", setter(kind, key), centre, spread, p.scale == "log", None, STEP, p.deviation,
        p.low, p.high, kind.quantities[key].unit,
    )  # fmt: skip


def on_block(kind: type[Effect], key: str, units: NaturalUnits) -> tuple[float, float]:
    """Return centre and spread of a prior on a block with these units."""
    p, factor = prior_of(kind, key), factor_of(kind, key, units)
    if p.scale == "log":
        return p.centre * factor, p.spread
    factor = 1 / factor if p.scale == "inverse" else factor
    return p.centre * factor, p.spread * factor


def parts_of_run(kind: type[Effect], run: int, units: NaturalUnits) -> tuple[Parameter, ...]:
    """Return cosine and sine part of what a run has of its own: a size and its phase; nothing where an effect has
    neither."""
    if not kind.of_run:
        return ()
    size, phase = kind.of_run

    def part(real: bool, model: Model, value: float) -> Model:
        if value == 0 and not any(e.id == kind.id for e in model.effects):
            return model
        e = current(model, kind)
        c, s = (getattr(e, size) * f(getattr(e, phase)) for f in (math.cos, math.sin))
        c, s = (value, s) if real else (c, value)
        return with_effect(model, replace(e, **{size: math.hypot(c, s), phase: math.atan2(s, c)}))

    _, spread = on_block(kind, size, units)
    return tuple(
        Parameter(
            f"{kind.id}.{name}[{run}]", partial(part, real), 0.0, spread, run=run, step=STEP_OF_RUN,
            prior=prior_of(kind, size).deviation, unit=kind.quantities[size].unit,
        )
        for name, real in (("cosine", True), ("sine", False))
    )  # fmt: skip


def kind_and_key(name: str) -> tuple[type[Effect] | None, str]:
    """Return the effect and the quantity that a number, by its name in a fit ("effect.quantity"), belongs to."""
    id, _, key = name.partition(".")
    kind = (catalogue.EFFECTS | catalogue.OWN).get(id)
    return (kind, key) if kind is not None and key in kind.quantities else (None, key)


P = TypeVar("P", Parameter, PriorParameter)


def within_base(p: P, model: Model) -> P:
    """Return a parameter of an effect that keeps it within what a model's base has room for."""
    kind, key = kind_and_key(p.name)
    if kind is None or kind.largest_on(key, model.width, model.depth) >= p.high:
        return p
    return replace(p, high=kind.largest_on(key, model.width, model.depth))


def kinds(points: str, leave_out: Iterable[str] = (), own: Iterable[str] = ()) -> tuple[type[Effect], ...]:
    """Return the candidates beside a model with these points, of those that need no others. own : a user's, by id."""
    left = set(leave_out)
    candidates = (*catalogue.IN_STEP_ORDER, *map(catalogue.find, own))
    return tuple(k for k in candidates if k.id not in left and k.only_on in ("", points))
