"""Who shows `simulate` only: the pattern of its deviations, and the mistakes of the zoo that leave the most similar
one."""

from __future__ import annotations

import csv
import io
from functools import lru_cache
from typing import Any

import numpy as np

from rockref.conformance import vectors
from rockref.conformance.backends.call import ANYTHING, as_mapping
from rockref.conformance.backends.side_by_side import grouped, simulate, steps_of
from rockref.conformance.judge.compare_answer import bar_of, weighed_in_bars
from rockref.conformance.judge.negligible import size_and_unit
from rockref.conformance.judge.trajectories import SHOWN, expected_columns
from rockref.conformance.vectors import Expected, Vector, as_shipped, manifest, problem_of, read_bytes, trajectory
from rockref.conformance.vectors.fields import Missing, result
from rockref.model.storage import unpacked

#: Every so many rows of a window enter the fingerprint: windows are long, and their rows alike.
STRIDE = 10
#: Windows of more steps are left out: they cost more than they tell. Decided: 20 ms of 10 us.
MOST_STEPS = 2000
#: Deviations are written as whole tenths of their logarithm; a number that is none counts as 10^20 bars.
TENTHS, LARGEST = 10, 20.0
#: Deviations below so many bars are rounding.
SILENT = 10.0
#: A cosine from which on two backends make the same mistake. Decided: other compilers and orders of summation leave
#: it above, and no two mistakes of different rules that can be told apart at all reach it.
SAME = 0.99
#: A cosine below which two patterns are not called similar: of the pairs of mistakes of different rules in the zoo, 95
#: in a hundred are below.
SIMILAR = 0.25


def mark(got: Any, expected: np.ndarray, bar: np.ndarray, size: float) -> np.ndarray:
    """Return sign(deviation) log10(1 + deviation in bars), flat; 0 inside ten bars, and below a physical size."""
    ratio, _ = weighed_in_bars(got, expected, bar, size)
    with np.errstate(all="ignore"):
        size = np.minimum(np.log10(1 + ratio), LARGEST)
        sign = np.where(np.asarray(got, float) < expected, -1.0, 1.0)
    return np.where(ratio > SILENT, sign * size, 0.0).ravel()


def of_short_run(vector: Vector, out: dict[str, Any]) -> np.ndarray:
    """Return the marks of one short run."""
    marks = []
    for name, expected in vector.expect.items():
        marks.append(_mark_of(name, expected, vector, out))
    return np.concatenate(marks)


def _mark_of(name: str, expected: Expected, vector: Vector, out: dict[str, Any]) -> np.ndarray:
    nothing = np.full(expected.value.size, np.nan)
    bar = bar_of(expected, "float64")
    if bar is None:
        return nothing
    try:
        got = np.asarray(result(name, out, vector.branch), float)
    except (Missing, TypeError, ValueError, IndexError):
        return nothing
    size = size_and_unit(name, vector.layer)[0]
    return mark(got, expected.value, bar, size) if got.shape == expected.value.shape else nothing


def of_window(name: str, out: dict[str, Any]) -> np.ndarray:
    """Return the marks of one window."""
    t = trajectory(name)
    expected, bars = expected_columns(t, "float64")
    marks = []
    for key in SHOWN:
        right = expected[key][::STRIDE]
        try:
            got = np.asarray(out[key], float)[::STRIDE]
        except (KeyError, TypeError, ValueError, IndexError):
            got = None
        if got is None or got.shape != right.shape:
            marks.append(np.full(right.size, np.nan))
            continue
        bar = bars[key][::STRIDE].reshape((-1,) + (1,) * (right.ndim - 1))
        marks.append(mark(got, right, np.broadcast_to(bar, right.shape), size_and_unit(key)[0]))
    return np.concatenate(marks)


def compared() -> list[str]:
    """Return the windows that enter a fingerprint: those of few steps."""
    return [name for name in vectors.window_names() if steps_of(trajectory(name).problem) <= MOST_STEPS]


def fingerprint(backend: Any) -> np.ndarray:
    """Return all marks of a backend, in a fixed order; not a number where it shows nothing."""
    short, names = vectors.layer("L5s"), compared()
    problems = [problem_of(v.inputs) for v in short] + [trajectory(name).problem for name in names]
    answers: list[Any] = [None] * len(problems)
    for group in grouped(problems):
        for i, answer in zip(group, simulate(backend, [problems[i] for i in group]), strict=True):
            answers[i] = {} if isinstance(answer, ANYTHING) else as_mapping(answer, "simulate")
    marks = [of_short_run(v, answers[i]) for i, v in enumerate(short)]
    return np.concatenate(marks + [of_window(name, answers[len(short) + i]) for i, name in enumerate(names)])


def code(marks: np.ndarray) -> np.ndarray:
    """Return marks as small whole numbers."""
    return np.rint(np.nan_to_num(marks) * TENTHS).astype(int)


@lru_cache
def library() -> tuple[tuple[str, ...], np.ndarray]:
    """Return ids of the mistakes, and their fingerprints (mistakes, marks)."""
    name = "fingerprints.csv.gz"
    with as_shipped(name):
        rows = list(csv.reader(io.StringIO(unpacked(read_bytes(name), name, vectors.LARGEST).decode())))
        return tuple(row[0] for row in rows), np.array([row[1:] for row in rows], float) / TENTHS


def neighbours(
    marks: np.ndarray, without: tuple[str, ...] = (), count: int = 2, rule: str | None = None
) -> list[tuple[str, float]]:
    """Return mistakes whose fingerprints are most similar: id and cosine, best first; `without` some ids. None where no
    mistake leaves similar traces.

    rule : the rule that the short runs point to. Its nearest mistake is among them, unless another is as good as the
    same.
    """
    ids, known = library()
    seen = np.isfinite(marks)
    a, B = np.where(seen, marks, 0.0), np.where(seen, known, 0.0)
    length = np.sqrt(np.sum(B * B, axis=1)) * np.sqrt(np.sum(a * a))
    cosine = np.where(length > 0, np.sum(B * a, axis=1) / np.where(length > 0, length, 1), 0.0)
    order = [i for i in np.argsort(-cosine, kind="stable") if ids[i] not in without]
    if rule is not None and order and cosine[order[0]] < SAME:
        own = [i for i in order if manifest()["mistakes"][ids[i]]["rule"] == rule][:1]
        order = own + [i for i in order if i not in own]
    found = [(ids[i], float(cosine[i])) for i in order[:count] if cosine[i] >= SIMILAR]
    return sorted(found, key=lambda pair: -pair[1])
