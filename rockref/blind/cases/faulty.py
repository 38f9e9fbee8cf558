"""Records that no experiment should be judged by: a logger's faults, whose right answer is a refusal.

A fault takes a table (t [s], rates (N, 3) [rad/s]) and a random generator; it returns the spoilt rates and its truth.
Nothing else is hidden where a record is faulty.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

Table = tuple[np.ndarray, np.ndarray]
#: Part of a record in which a fault begins: after the release, while the block still swings.
BEGINS = (0.1, 0.35)


def held_axis(t: np.ndarray, rates: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, dict[str, Any]]:
    """Make one axis repeat its value for a sixteenth to an eighth of the record; the others go on."""
    axis, first = int(rng.integers(3)), int(rng.uniform(*BEGINS) * len(t))
    last = first + int(rng.uniform(1 / 16, 1 / 8) * len(t))
    out = rates.copy()
    out[first:last, axis] = out[first, axis]
    return out, {"axis": "xyz"[axis], "from": float(t[first]), "to": float(t[last - 1])}


def wrapped(t: np.ndarray, rates: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, dict[str, Any]]:
    """Make a number too large for its register come out with the other sign."""
    limit = float(rng.uniform(0.5, 0.8)) * float(np.abs(rates).max())
    return (rates + limit) % (2.0 * limit) - limit, {"limit": limit}


def sample_and_hold(t: np.ndarray, rates: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, dict[str, Any]]:
    """Ask four to ten times as often as the sensor answers, and write the last answer again."""
    times = int(rng.integers(4, 11))
    return rates[np.arange(len(t)) // times * times], {"times": times}


def burst(t: np.ndarray, rates: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, dict[str, Any]]:
    """Read four to nine samples of one axis as two to ten times the largest rate."""
    axis, first, length = int(rng.integers(3)), int(rng.uniform(*BEGINS) * len(t)), int(rng.integers(4, 10))
    value = float(rng.choice([-1.0, 1.0]) * rng.uniform(2.0, 10.0)) * float(np.abs(rates).max())
    out = rates.copy()
    out[first : first + length, axis] = value
    return out, {"axis": "xyz"[axis], "from": float(t[first]), "samples": length, "rate": value}


#: Every fault by its id; and those that a device has in every run. The others befall one run that is fitted.
FAULTS = {function.__name__: function for function in (held_axis, wrapped, sample_and_hold, burst)}
OF_THE_DEVICE = ("wrapped", "sample_and_hold")


def spoil(
    id: str, tables: Sequence[Table], uses: Sequence[str], rng: np.random.Generator
) -> tuple[list[Table], dict[str, Any]]:
    """Return tables with this fault, and its truth: `id`, and what was done to each run, by its number from 1.

    Raises KeyError for a fault that is not known.
    """
    fault = FAULTS[id]
    fitted = [i for i, use in enumerate(uses) if use == "fit"]
    chosen = range(len(tables)) if id in OF_THE_DEVICE else [int(rng.choice(fitted))]
    spoilt, truth = list(tables), {}
    for i in chosen:
        t, rates = tables[i]
        rates, truth[str(i + 1)] = fault(t, rates, rng)
        spoilt[i] = (t, rates)
    return spoilt, {"id": id, "runs": truth}
