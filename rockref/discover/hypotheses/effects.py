"""The numbers of effects that a fit finds, as their own files declare them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.discover.hypotheses import candidates
from rockref.discover.hypotheses.counted import Parameter as Counted
from rockref.discover.hypotheses.parameter import Parameter
from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.effects.natural import SOURCE, NaturalUnits, factor_of
from rockref.effects.scale import from_scale, prior_of, to_scale

#: Part of a spread that a step may take a number whose prior is narrower (decided: a third leads from one form of a law
#: to another one in three steps).
REACH = 1 / 3


def effect_parameters(
    id: str, runs: int, tone: float | None = None, units: NaturalUnits = SOURCE
) -> tuple[Parameter, ...]:
    """Return the numbers of an effect: those that bring it in, those that shape it, and those of each run.

    tone [Hz] : a line in the misfit, at which an effect that oscillates starts.  units : of the block, with which
    typical sizes grow.
    """
    kind = catalogue.find(id)
    return tuple(counted_in_priors(p, units) for p in candidates.parameters_of(kind, runs, tone, units))


def counted_in_priors(p: Counted, units: NaturalUnits = SOURCE) -> Parameter:
    """Return a number counted in typical sizes as one that is counted in prior deviations."""
    kind, key = candidates.kind_and_key(p.name)
    role = "" if kind is None else prior_of(kind, key).role
    return Parameter(
        p.name, p.set, p.centre, p.spread * p.prior, "log" if p.log else "linear", p.run, p.low, p.high,
        typical=0.0 if role in ("shape", "form") else 1 / p.prior,
        one_sided=not p.log and p.low >= p.centre, unit=p.unit,
        moves_target=kind is not None and kind.changes_target(), by_ratio=kind is not None and key in kind.by_ratio,
        drawn=between(kind, key, units) if kind is not None and key in kind.anywhere else None,
        reach=max(1.0, REACH / p.prior), form=role == "form",
    )  # fmt: skip


def between(kind: type[Effect], key: str, units: NaturalUnits) -> tuple[float, float]:
    """Return the plausible ends of a quantity on a block with these units."""
    q, factor = kind.quantities[key], factor_of(kind, key, units)
    return factor * q.low, factor * q.high


def own_value(p: Parameter, z: float) -> float:
    """Return the number as its effect states it: what a fit finds by its inverse is turned back."""
    kind, key = candidates.kind_and_key(p.name)
    value = p.value(z)
    return value if kind is None else from_scale(kind, key, value)


def seeds_of(
    parameters: Sequence[Parameter], id: str, records: Sequence[tuple[np.ndarray, np.ndarray]],
    units: NaturalUnits = SOURCE,
) -> list:  # fmt: skip
    """Return the finite starts of an effect, z of its numbers (G,); none where one step from zero shows it.

    records : times (N,) [s] and rates (N, 3) [rad/s] of the runs.  units : of the block.
    """
    kind = catalogue.find(id)
    found = []
    for values in kind.seeds_in(records):
        here = {key: value * factor_of(kind, key, units) for key, value in values.items()}
        effect = kind(**{**candidates.typical_values(kind, units), **here})
        z = np.zeros(len(parameters))
        for k, p in enumerate(parameters):
            _, key = candidates.kind_and_key(p.name)
            if p.run is None:
                z[k] = p.z_of(to_scale(kind, key, float(getattr(effect, key))))
        found.append(z)
    return found


def candidate_effects(points: str, carried: Sequence[str], own: Sequence[str] = ()) -> tuple[str, ...]:
    """Return the ids of the effects that may be missing: the catalogue's on these points, and those of the user's own.

    carried : effects that the user's model has already
    """
    return tuple(kind.id for kind in candidates.kinds(points, carried, own))
