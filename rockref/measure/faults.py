"""Faults of the logger that would be taken for motion: single wild samples, and stretches that stand still.

They come before everything that integrates a rate: one sample of 5000 deg/s at 500 Hz is 10 degrees, and the block
seems to fall over.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from rockref.measure.columns import DEGREE
from rockref.measure.notice import Notice
from rockref.measure.running import sample_step
from rockref.model.errors import InputError

# decided: clatter reaches half of the first swing's rate; five times the largest that one sample in a hundred has, or
# that the block can have, is no motion of it.
WILD = 5.0
# decided: a fault of the line spoils a sample or two; what lasts longer than three is another unit, or a fall.
WILD_SAMPLES = 3
# decided: three channels with noise do not repeat their values for ten milliseconds.
LEAST_DROPOUT = 0.010
# decided: after fifty milliseconds of a swing at 30 deg/s the tilt is off by more than a degree, and nothing holds any
# more; what is shorter spoils some windows, and a diagnosis says so.
LONG_DROPOUT = 0.050
# decided: a twentieth of the first swing's rate, 2 deg/s, is more than the block gains in a sample.
JUMP = 0.05


def wild_samples(crv: np.ndarray, expected: float) -> np.ndarray:
    """Which samples, (N,) bool, of rates crv (N, 3) rad/s stand far out for three in a row at most.

    expected : the largest rate of the first swing, rad/s.
    """
    size = np.abs(crv).max(axis=1)
    out = size > WILD * max(expected, float(np.percentile(size, 99.0)))
    edges = np.flatnonzero(np.diff(np.concatenate(([0], out.astype(np.int8), [0]))))
    for first, last in edges.reshape(-1, 2):
        if last - first > WILD_SAMPLES:
            out[first:last] = False
    return out


def without(crv: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """The rates (N, 3) with the rows (N,) bool drawn straight between their neighbours; as they are where none is."""
    if not rows.any() or rows.all():
        return crv
    place = np.arange(len(crv))
    return np.stack([np.interp(place, place[~rows], crv[~rows, axis]) for axis in range(3)], axis=-1)


def check_wild(t: np.ndarray, crv: np.ndarray, rows: np.ndarray, names: list[str], path: Path) -> None:
    """Refuse wild samples, rows (N,) bool of rates crv (N, 3) rad/s at t (N,) s (E-SPIKE): which, and how large."""
    if not rows.any():
        return
    first = int(np.argmax(rows))
    axis = int(np.argmax(np.abs(crv[first])))
    count = int(rows.sum())
    many = f"{count} wild samples, the first" if count > 1 else "one wild sample,"
    what = f"{many} with {crv[first, axis] / DEGREE:.4g} deg/s at {t[first]:.4g} s"
    cure = "No block does that: leave these rows out, the reader draws a short gap straight."
    raise InputError("E-SPIKE", f"{path}, column {names[axis]}", what, cure)


def check_dropout(t: np.ndarray, crv: np.ndarray, standing: np.ndarray, expected: float, path: Path) -> list[Notice]:
    """Refuse a record whose three rates stand still for 50 ms or more in the midst of the motion (E-DROPOUT).

    From 10 ms on it is remarked on (W-DROPOUT). t (N,) s; crv (N, 3) rad/s; standing (N,) bool, where the block has
    not fallen over by then; expected: the largest rate of the first swing, rad/s. A block at rest has no rate, and no
    jump at either end of the stretch: no fault.
    """
    notices = []
    same = np.concatenate(([False], np.all(crv[1:] == crv[:-1], axis=1)))
    edges = np.flatnonzero(np.diff(np.concatenate((same.astype(np.int8), [0]))))
    for first, last in edges.reshape(-1, 2):
        # The value was held from `first` to `last`, both included.
        jumps = [np.abs(np.diff(crv[k : k + 2], axis=0)).max(initial=0.0) for k in (max(first - 1, 0), last)]
        moving = max(*jumps, float(np.abs(crv[first]).max())) > JUMP * expected
        seconds = (last - first) * sample_step(t)
        if seconds >= LEAST_DROPOUT and standing[first] and moving:
            values = ", ".join(f"{value / DEGREE:.4g}" for value in crv[first])
            what = f"all three rates are held at {values} deg/s from {t[first]:.4g} to {t[last]:.4g} s"
            cure = "The logger dropped out: cut the record before it, or leave these rows out where they are few."
            if seconds >= LONG_DROPOUT:
                raise InputError("E-DROPOUT", str(path), what, cure)
            notices.append(Notice("W-DROPOUT", str(path), what, cure))
    return notices
