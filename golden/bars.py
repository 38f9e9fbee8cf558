"""Values with an error bar each: computed from runs in extended precision and from ensembles, never guessed."""

from __future__ import annotations

import gzip
import io
import math
from dataclasses import replace

import numpy as np

from rockref.model.problem import ARRAYS_OF_BLOCK, ARRAYS_OF_POINTS, ARRAYS_OF_STATE, Problem, stack

#: A bar is this many times the largest difference seen. Decided: twelve members and one run in extended precision see
#: about the standard deviation of the rounding; eight of them are left by none in 1e15 of normally distributed ones.
SAFETY = 8


def moved_by_an_ulp(problem: Problem, seed: int) -> tuple[Problem, np.ndarray]:
    """Return the problem with every input moved to a neighbouring float64, and its points in another order.

    Also returns the order: point i of the original is point order[i] of the moved one, so that the sums over the points
    run differently. Zeros stay, and the symmetry of the inertia.
    """
    generator = np.random.default_rng(seed)
    shuffled = generator.permutation(problem.points.n)

    def moved(a):
        if a is None or a.dtype == bool:
            return a
        return np.where(a == 0, a, np.nextafter(a, np.where(generator.random(a.shape) < 0.5, -np.inf, np.inf)))

    block = replace(problem.block, **{k: moved(getattr(problem.block, k)) for k in ARRAYS_OF_BLOCK})
    J = np.triu(block.inertia)
    block = replace(block, inertia=J + np.triu(J, 1).T)
    points = {k: moved(getattr(problem.points, k)) for k in ARRAYS_OF_POINTS}
    points["mu_0"] = np.maximum(points["mu_0"], points["mu"])  # static friction is never below dynamic friction
    points = {k: None if a is None else a[shuffled] for k, a in points.items()}
    start = {k: moved(getattr(problem.start, k)) for k in ARRAYS_OF_STATE}
    for k in ("s", "anchored", "sliding"):
        start[k] = start[k][shuffled]
    names = tuple(problem.points.names[i] for i in shuffled)
    order = np.argsort(shuffled)
    return (
        replace(
            problem,
            block=block,
            points=replace(problem.points, **points, names=names),
            start=replace(problem.start, **start),
        ),
        order,
    )


def ensemble(problem: Problem, members: int) -> tuple[Problem, np.ndarray]:
    """Moved copies of a problem as one batch, and the orders of their points, (members, n)."""
    copies = [moved_by_an_ulp(problem, seed) for seed in range(members)]
    return stack([copy for copy, _ in copies]), np.stack([order for _, order in copies])


def bar(value: np.ndarray, others: list[np.ndarray]) -> np.ndarray:
    """Error bar of each value: SAFETY times the largest difference to the other runs, and one ulp; 0 if all are 0."""
    largest = np.max([np.abs(other - value) for other in others], axis=0)
    return np.where((largest == 0) & (value == 0), 0.0, SAFETY * largest + np.spacing(np.abs(value)))


def rounded_up(size: float) -> str:
    """Return a bar with two digits, not below what it was."""
    if size == 0:
        return "0"
    exponent = math.floor(math.log10(size)) - 1
    digits = math.ceil(size / 10.0**exponent * (1 - 1e-9))
    return f"{digits}e{exponent}"


def down_to(value: float, size: float) -> str:
    """Return a value with the digits that its bar leaves, and one more; exact where the bar is zero."""
    if size == 0:
        return repr(float(value)) if value else "0"
    if value == 0:
        return "0"
    digits = math.floor(math.log10(abs(value))) - math.floor(math.log10(size)) + 2
    return f"{value:.{min(max(digits, 0), 16)}e}" if digits > 0 else f"{value:.0e}"


def compressed(text: str) -> bytes:
    """Gzip of a text, the same bytes on every machine and day."""
    stream = io.BytesIO()
    with gzip.GzipFile("", "wb", 9, stream, mtime=0) as packed:
        packed.write(text.encode())
    return stream.getvalue()
