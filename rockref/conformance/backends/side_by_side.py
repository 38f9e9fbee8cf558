"""Runs asked for side by side: problems of one step made alike, and their answers taken apart again.

For engines that compute a batch (`simulate_many`): a batch of ten runs takes hardly longer than one.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping
from rockref.model.problem import ContactPoints, Problem, State
from rockref.model.simulate import output_steps

#: Runs are put together where the shortest has this share of the steps of the longest. Decided.
SHARE = 0.5
PER_POINT = ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")


def steps_of(problem: Problem) -> int:
    """Return the number of the last step of a run."""
    return int(output_steps(problem)[-1])


def kind(problem: Problem) -> tuple[Any, ...]:
    """Return what runs must share to be computed side by side: the step, whether the start brings a force evaluation;
    and rows that fall on whole steps, or else everything about their rows."""
    every = 1 / (problem.output_rate * problem.step)
    whole = abs(every - round(every)) < 1e-6
    rows = () if whole else (problem.output_rate, problem.duration)
    return (problem.step, problem.start.a is not None, *rows)


def grouped(problems: list[Problem]) -> list[list[int]]:
    """Return indices of the problems that can be computed side by side, longest first: of one kind, about as long."""
    groups: list[list[int]] = []
    for i in sorted(range(len(problems)), key=lambda i: -steps_of(problems[i])):
        for group in groups:
            first = problems[group[0]]
            if kind(problems[i]) == kind(first) and steps_of(problems[i]) >= SHARE * steps_of(first):
                group.append(i)
                break
        else:
            groups.append([i])
    return groups


def with_inert_points(problem: Problem, n: int) -> Problem:
    """Return the problem with points up to n added that hang a metre above the centre of mass and never touch."""
    p, s = problem.points, problem.start
    more = n - p.n
    if not more:
        return problem
    P = np.concatenate([p.P, np.tile([0.0, 0.0, 1.0], (more, 1))])
    made = {k: np.concatenate([getattr(p, k), np.ones(more)]) for k in PER_POINT}
    points = ContactPoints(P=P, **made, radius=None, names=(*p.names, *(f"inert {i}" for i in range(more))))
    state: dict[str, Any] = {"s": np.concatenate([s.s, np.zeros((more, 2))])}
    state |= {k: np.concatenate([getattr(s, k), np.zeros(more, bool)]) for k in ("anchored", "sliding")}
    state |= {} if s.F is None else {"F": np.concatenate([s.F, np.zeros((more, 3))])}
    start: State = replace(s, **state)
    return replace(problem, points=points, start=start)


def alike(problems: list[Problem]) -> list[Problem]:
    """Return the problems with as many points and steps each, and a row for every step that one of them asks for."""
    if len(problems) == 1:
        return problems
    n, last = max(p.points.n for p in problems), max(map(steps_of, problems))
    every = int(np.gcd.reduce(np.concatenate([output_steps(p) for p in problems] + [np.array([last])])))
    h = problems[0].step
    # Half a step more: the last row is asked for by its number, whatever its product with the step rounds to.
    duration, rate = (last + 0.5) * h, 1 / (every * h)
    return [replace(with_inert_points(p, n), duration=duration, output_rate=rate) for p in problems]


def rows_of(problem: Problem, answer: Any, every: int) -> dict[str, Any]:
    """Return the rows and the points that a problem asks for, of an answer with a row for each so many steps."""
    rows, n = output_steps(problem) // every, problem.points.n
    out = {k: v for k, v in as_mapping(answer, "simulate").items() if v is not None}
    found = {k: np.asarray(v)[rows] for k, v in out.items()}
    return found | {k: found[k][:, :n] for k in ("F", "anchored") if k in found}


def simulate_group(backend: Any, problems: list[Problem]) -> list[Any]:
    """Return the answers of a backend to the problems of a group, in one batch. What it raises goes through."""
    shared = alike(problems)
    answers = backend.simulate_many(shared)
    if shared is problems:
        return list(answers)
    every = int(output_steps(shared[0])[1]) if steps_of(shared[0]) else 1
    return [rows_of(p, a, every) for p, a in zip(problems, answers, strict=True)]


def simulate(backend: Any, problems: list[Problem]) -> list[Any]:
    """Return the answers of a backend to a group, side by side where it can; an exception stands for the answer that it
    spoiled."""
    if hasattr(backend, "simulate_many"):
        try:
            return simulate_group(backend, problems)
        except ANYTHING:  # one of them spoils all: ask one by one
            pass
    answers: list[Any] = []
    for problem in problems:
        try:
            answers.append(backend.simulate(problem))
        except ANYTHING as e:
            answers.append(e)
    return answers
