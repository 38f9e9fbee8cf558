"""The numbers of effects that a fit finds, as their own files declare them."""

from __future__ import annotations

from rockref.discover.fit import candidates
from rockref.discover.hypotheses.parameter import Parameter
from rockref.effects import catalogue
from rockref.effects.base import Effect


def effect_parameters(id: str, runs: int, frequency: float | None = None) -> tuple[Parameter, ...]:
    """Return the numbers of an effect: those that bring it in, then those that shape it.

    frequency [Hz] : of a tone, where the effect has one.
    """
    kind = catalogue.find(id)
    moves = kind.changes_target()
    return tuple(counted_in_priors(p, moves) for p in candidates.parameters_of(kind, runs, frequency))


def counted_in_priors(p: candidates.Parameter, moves_target: bool) -> Parameter:
    """Return a number counted in typical sizes as one that is counted in prior deviations."""
    head, _, key = p.name.partition(".")
    shape = (head, key) in candidates.SHAPES or (head, key) in candidates.FORMS
    return Parameter(
        p.name, p.set, p.centre, p.spread * p.prior, "log" if p.log else "linear", p.run, p.low, p.high,
        typical=0.0 if shape else 1 / p.prior, one_sided=not p.log and p.low >= p.centre, unit=p.unit,
        moves_target=moves_target,
    )  # fmt: skip


def inner_value(effect: Effect, key: str, name: str) -> float:
    """Return an effect's number as a fit counts it: what is absent at infinity, or when rigid, by its inverse."""
    value = float(getattr(effect, key))
    if effect.id == "compliant_support" and key == "frequency":
        typical = type(effect).quantities[key].typical
        assert typical is not None
        return (typical / value) ** 2 if value > 0 else 0.0
    if candidates.is_inverse(name):
        return 1 / value if value > 0 and value != float("inf") else 0.0
    return value


def own_value(p: Parameter, z: float) -> float:
    """Return the effect's own number at z: an inverse is turned back."""
    value = p.value(z)
    if p.name == "compliant_support.frequency":
        typical = float(catalogue.EFFECTS["compliant_support"].quantities["frequency"].typical or 60.0)
        return typical / value**0.5 if value > 1e-3 else 0.0
    if candidates.is_inverse(p.name):
        return 1 / value if value > 0 else float("inf")
    return value
