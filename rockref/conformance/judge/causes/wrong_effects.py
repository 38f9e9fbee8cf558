"""What a wrong answer to a vector of an effect looks like: the effect left out, a sign, a parameter, a missing point.

The law is run with each of these mistakes; the answer is held to what comes out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from rockref.conformance.judge.compare_answer import LOOK, weighed_in_bars
from rockref.conformance.judge.negligible import size_and_unit
from rockref.conformance.vectors import problem_of
from rockref.conformance.vectors.claim import Claim, with_effect
from rockref.effects import catalogue
from rockref.effects.base import Effect
from rockref.engines import run
from rockref.model.problem import Problem

#: A mistake in words, and the results that it gives, by name.
Mistake = tuple[str, Callable[[], dict[str, Any]]]


def likely(claim: Claim, answer: dict[str, Any]) -> str:
    """Return the mistake that gives this answer within ten bars, in words: "as if ..."; "" where none that is tried
    does."""
    with np.errstate(all="ignore"):
        for words, made in mistakes(claim):
            try:
                if gives(made(), answer, claim.expect):
                    return words
            except (ArithmeticError, ValueError, TypeError, LookupError):  # a mistake that cannot be computed
                continue
    return ""


def gives(made: dict[str, Any], answer: dict[str, Any], expect: dict[str, tuple[np.ndarray, np.ndarray]]) -> bool:
    """Return whether what a mistake has made is what is shown of an answer, within ten bars."""
    for name, (right, bar) in expect.items():
        got, wrong = answer.get(name), np.asarray(made[name]).reshape(right.shape)
        if got is None:
            continue
        if np.max(weighed_in_bars(np.asarray(got), wrong, bar, size_and_unit(name)[0])[0]) > LOOK:
            return False
    return True


def mistakes(claim: Claim) -> Iterator[Mistake]:
    """Yield all that are tried, the simplest first."""
    effect = catalogue.make(catalogue.find(claim.effect), dict(claim.parameters), "effect")
    yield "as if it were left out", partial(of, claim, type(effect)())
    for words, changed in other_values(effect):
        yield words, partial(of, claim, changed)
    if claim.piece == "effect":
        problem = with_effect(problem_of(claim.inputs), effect)
        for i, name in enumerate(problem.points.names):
            yield f"as if point {name} were missing", partial(without_one, problem, i)


def other_values(effect: Effect) -> Iterator[tuple[str, Effect]]:
    """Yield the effect with parameters of the other sign (a ratio: the other way round) or left out, one or all of a
    kind."""
    for names, called in groups(list(effect.quantities)):
        values = {n: getattr(effect, n) for n in names if getattr(effect, n) not in (None, effect.quantities[n].absent)}
        if not values:
            continue
        ratio = all(effect.quantities[n].absent == 1.0 for n in values)
        turned = {n: 1.0 / v if ratio else -v for n, v in values.items()}
        how = "the other way round" if ratio else "of the other sign"
        # Left out comes first: a share that cannot be negative does nothing with the other sign, too.
        yield f"as if {called} were left out", replace(effect, **{n: effect.quantities[n].absent for n in values})
        yield f"as if {called} were {how}", replace(effect, **turned)


def groups(names: list[str]) -> list[tuple[list[str], str]]:
    """Return each parameter, then those that differ by their last digit together: [names], and what to call them."""
    stems: dict[str, list[str]] = {}
    for name in names:
        stems.setdefault(name.rstrip("0123456789"), []).append(name)
    return [([n], n) for n in names] + [(m, f"{m[0]} to {m[-1]}") for m in stems.values() if len(m) > 1]


def of(claim: Claim, effect: Effect) -> dict[str, Any]:
    """Return the results of a claim with another effect in place of its own."""
    if claim.piece == "effect":
        return rows(with_effect(problem_of(claim.inputs), effect))
    crv = np.radians(claim.inputs["crv_deg_s"])
    return {"crv_deg_s": np.degrees(catalogue.measured((effect,), claim.inputs["t"], crv))}


def rows(problem: Problem) -> dict[str, Any]:
    """Return the rows of a run of the law."""
    response = run(problem, engine="numpy")
    return {name: getattr(response, name) for name in ("W", "x", "Lambda")}


def without_one(problem: Problem, i: int) -> dict[str, Any]:
    """Return the rows of a run without the i-th contact point."""
    return rows(without_point(problem, i))


def without_point(problem: Problem, i: int) -> Problem:
    """Return the problem without its i-th contact point."""
    p, s = problem.points, problem.start

    def rest(a: Any, axis: int = -1) -> Any:
        return None if a is None else np.delete(a, i, axis)

    one = {k: rest(getattr(p, k)) for k in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu", "radius")}
    points = replace(p, P=rest(p.P, -2), **one, names=p.names[:i] + p.names[i + 1 :])
    memory = {"s": rest(s.s, -2), "anchored": rest(s.anchored), "sliding": rest(s.sliding)}
    return replace(problem, points=points, start=replace(s, **memory, a=None, T=None, F=None))
