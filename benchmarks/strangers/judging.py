"""What the judge says of a mistake that is planted in a backend: by its pieces, by runs, by runs without forces."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np

from rockref.conformance.judge.findings import LAYERS, judge
from rockref.conformance.judge.verdict import alike, suspects, verdict
from rockref.conformance.vectors import flat
from strangers import list_01, list_02, schemes
from strangers.list_01 import Mistake
from strangers.planting import SOURCE, planted, with_step
from strangers.registry import WITH_SCHEMES

QUICK = [name for name in LAYERS if name not in ("L5", "L6")]


class Runs:
    """`simulate` alone of a backend; answers are kept, the first to a question, the second, and so on, for the way
    without forces too."""

    language, precision = "Python", "float64"

    def __init__(self, backend: Any, kept: dict[bytes, list[Any]], hidden: tuple[str, ...] = ()):
        self.backend, self.kept, self.hidden, self.name = backend, kept, hidden, backend.name
        self.asked: dict[bytes, int] = {}

    def simulate(self, problem: Any) -> Any:
        """A run, without what is hidden."""
        key = b"|".join(np.asarray(v).tobytes() for v in flat(problem).values())
        answers, self.asked[key] = self.kept.setdefault(key, []), self.asked.get(key, 0) + 1
        if len(answers) < self.asked[key]:
            try:
                answers.append(self.backend.simulate(problem))
            except Exception as e:
                answers.append(e)
        answer = answers[self.asked[key] - 1]
        if isinstance(answer, Exception):
            raise answer
        return {k: v for k, v in answer.items() if k not in self.hidden}


def seen(backend: Any, mistake: Mistake, profile: str = "float64") -> dict[str, Any]:
    """What the judge says."""
    found = verdict(judge(backend, QUICK, profile))
    rules = {found.rule, *alike(found)}
    return {
        "detected": found.status == "FAIL",
        "named": found.rule in mistake.rules,
        "top two": bool(set(suspects(found)[:2]) & set(mistake.rules)),
        "alike": bool(rules & set(mistake.rules)),
        "rule": found.rule,
        "next": suspects(found)[1:2],
        "slip": found.slip,
        "says": found.says,
        "vector": None if found.check is None else f"{found.check.vector} {found.check.name}",
    }


def of_mistake(mistake: Mistake, scheme: str | None = None) -> dict[str, Any]:
    """One mistake, in all ways that can show it."""
    backend, kept = planted(mistake, scheme), {}
    backend.simulate = Runs(planted(mistake, scheme), kept).simulate
    profile = "float64" if scheme is None else "scheme"
    ways = {"pieces": seen(backend, mistake, profile)}
    if mistake.in_runs:
        ways["runs"] = seen(Runs(backend, kept), mistake, profile)
        ways["runs without forces"] = seen(Runs(backend, kept, ("F", "anchored")), mistake, profile)
    return {"says": mistake.says, "rules": mistake.rules, "ways": ways}


def of_schemes() -> Iterator[tuple[Mistake, str]]:
    """The mistakes that are planted in backends with another integrator, and in which: each in one, in turn."""
    yield from ((m, "symplectic Euler") for m in schemes.MISTAKES)
    yield from in_turn((*list_01.MISTAKES, *list_02.MISTAKES), list(schemes.SCHEMES))


def of_list(module: ModuleType) -> Iterator[tuple[Mistake, str]]:
    """The same of a list and its own integrators, without what dwindles with the step."""
    yield from getattr(module, "OF_STEPS", ())
    dwindle = getattr(module, "OF_THE_STEP", ())
    asked = getattr(module, "IN_STEPS", module.MISTAKES)
    into = getattr(module, "INTO", None) or module.SCHEMES
    yield from in_turn(tuple(m for m in asked if m.says not in dwindle), list(into))


def in_turn(mistakes: tuple[Mistake, ...], schemes: list[str]) -> Iterator[tuple[Mistake, str]]:
    """The mistakes that runs show and that lie outside the law's step, each in the next integrator."""
    source = SOURCE.read_text()
    step = source[source.index("def first_half") : source.index("PROPERTIES = ")]
    for i, mistake in enumerate(mistakes):
        text, changes = with_step(scheme := schemes[i % len(schemes)]), ((mistake.old, ""), *mistake.more)
        whole = all(text.count(old) == 1 for old, _ in changes)
        if mistake.in_runs and whole and mistake.old not in step:
            yield mistake, scheme


#: Lists whose mistakes are planted in backends with another integrator.
OF_SCHEMES: dict[str, Callable[[], Iterator[tuple[Mistake, str]]]] = {
    "scheme": of_schemes,
    **{f"{number} scheme": partial(of_list, module) for number, module in WITH_SCHEMES.items()},
}
