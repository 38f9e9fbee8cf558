"""Copies among runs: the same numbers, whatever their line ends, digits, units, further columns or cut ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.measure.records.notice import Notice
from rockref.measure.records.release import Run
from rockref.measure.signals.noise import smallest_step

# decided: two runs share so many samples in a row by a copy only; noise makes each of them another number.
LEAST_COMMON = 100
# decided: a number is rounded by half a step, and a per cent of it for the rounding of the other.
HALF_STEP = 0.51
# decided: of the shorter run four fifths have to be in the longer one.
COMMON_SHARE = 0.8
# decided: values that change fewer times say nothing.
LEAST_CHANGES = 50


def note_copies(runs: Sequence[Run], source: str) -> list[Notice]:
    """Return remarks on runs that hold the same numbers as an earlier one (W-SAME-DATA)."""
    notices: list[Notice] = []
    opened = [run for run in runs if run.crv is not None and run.sha256 is not None]
    # All columns of a table are written with as many digits; one of few values shows the step best.
    steps = [float(smallest_step(run.crv).max()) for run in opened if run.crv is not None]
    for later in range(1, len(opened)):
        for earlier in range(later):
            a, b = opened[earlier], opened[later]
            assert a.crv is not None and b.crv is not None
            same = a.sha256 == b.sha256 or are_copies(a.crv, b.crv, steps[earlier], steps[later])
            if same:
                held = "bytes" if a.sha256 == b.sha256 else "numbers"
                what = f"runs {a.id} and {b.id} hold the same {held}"
                notices.append(Notice("W-SAME-DATA", source, what, "A copy is no second measurement: remove one."))
                break
    return notices


def are_copies(a: np.ndarray, b: np.ndarray, step_a: float, step_b: float) -> bool:
    """Return whether rates a (N, 3) and b (M, 3) rad/s, written in steps of so many rad/s, are the same measurement.

    Records of the same steps have to be equal; of unlike steps the coarser one has to be the other one rounded.
    """
    if len(b) > len(a):
        a, b = b, a
    size = np.maximum(np.abs(a).max(axis=0), np.abs(b).max(axis=0))
    coarse = max(step_a, step_b)
    near = 1e-7 * size + (0.0 if abs(step_a - step_b) <= 1e-6 * coarse else HALF_STEP * coarse)
    for start in _places(a[:, 0], b[:, 0], float(near[0])):
        first, last = max(0, start), min(len(a), start + len(b))
        if last - first < max(LEAST_COMMON, COMMON_SHARE * len(b)):
            continue
        ours, theirs = a[first:last], b[first - start : last - start]
        changes = int((np.diff(ours, axis=0) != 0.0).sum())
        if changes > LEAST_CHANGES and bool((np.abs(ours - theirs) <= near).all()):
            return True
    return False


def _places(a: np.ndarray, b: np.ndarray, near: float) -> np.ndarray:
    """Return where in a (N,) the record b (M,) may begin: where samples from its middle are within `near`."""
    middle = len(b) // 2
    places = np.arange(len(a) - min(64, len(b) - middle))
    for ahead in range(min(64, len(b) - middle)):
        places = places[np.abs(a[places + ahead] - b[middle + ahead]) <= near]
        if not len(places):
            break
    return places[:8] - middle
