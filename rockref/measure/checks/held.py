"""Values that stand still: dropouts of one channel or all, and values that are held from sample to sample.

Noise moves a value by more than a step of the resolution from sample to sample; where the step is coarse, an honest
value stands still by itself, and only a slope that is left out tells.
"""

from __future__ import annotations

import math

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.signals.signal import Signal, stretches
from rockref.model.errors import InputError

# decided: what lasts ten milliseconds spoils some windows, and a diagnosis says so; after fifty of a swing at 30 deg/s
# the tilt is off by more than a degree, and nothing holds any more.
LEAST_DROPOUT, LONG_DROPOUT = 0.010, 0.050
# decided: what noise does once in 1e10 samples is none.
CHANCE = 1e-10
# decided: a twentieth of the first swing's rate is motion; a leap of three times that is none of an impact.
MOVES, LEAP = 0.05, 0.15
# decided: nine samples of one value are a value held from sample to sample; more are a dropout, unless the record is
# held throughout: twenty holds, nine changes in ten after one of them, and two channels or more that change at once (a
# coarse step changes one), or of one channel all as long.
LONGEST_HOLD, LEAST_HOLDS, THROUGHOUT = 9, 20, 0.9
# decided: within forty samples motion and rest hardly change; of fewer than four such blocks no median is taken.
BLOCK, LEAST_BLOCKS = 40, 4
# decided: three samples in a hundred that stand still at once on all channels are no chance; of one channel a quarter.
TOGETHER, ALONE = 0.03, 0.25
# decided: one sample in twenty that is held makes the others late or early by a part of a sample.
REFUSED_SHARE = 0.05
# decided: nine in ten holds of one length are even.
EVEN_SHARE = 0.9


def repeats(x: np.ndarray) -> np.ndarray:
    """Return which samples of x (N,) have the value of the one before, (N,) bool."""
    return np.concatenate(([False], x[1:] == x[:-1]))


def chance_of_repeat(signal: Signal, axis: int) -> float:
    """Return the largest chance that an honest sample repeats the one before: by stated noise and step, and as seen."""
    same = repeats(signal.crv[:, axis])
    size = max(20, len(same) // 60)
    parts = same[: len(same) // size * size].reshape(-1, size).mean(axis=1)
    # What stands still all the time tells of no chance: it is a dropout itself, or a block at rest.
    parts = parts[parts < 1.0]
    # decided: where a quarter of the record stands still, it is the record's habit.
    return min(1.0, max(_stated_chance(signal, axis), float(np.percentile(parts, 75.0)) if len(parts) else 0.0))


def _stated_chance(signal: Signal, axis: int) -> float:
    """Return the largest chance that a sample of the stated noise repeats the one before, by the step of its values."""
    noise, step = signal.gyro.noise, max(signal.gyro.resolution, float(signal.steps[axis]))
    # In the middle of a step the noise has to reach half of it.
    return math.erf(step / (2.0 * math.sqrt(2.0) * noise)) if noise > 0.0 else 1.0


def check_dropouts(signal: Signal, standing: np.ndarray) -> list[Notice]:
    """Refuse channels that stand still for 50 ms (E-DROPOUT), remark from 10 ms on (W-DROPOUT): a line for each set.

    standing : (N,) bool, where the block has not fallen over by then.
    """
    chances = [chance_of_repeat(signal, axis) for axis in range(3)]
    alive = [axis for axis in range(3) if np.ptp(signal.crv[:, axis]) > 0.0]
    same = {axis: repeats(signal.crv[:, axis]) for axis in alive}
    sets = [tuple(alive)] if len(alive) == 3 else []
    found: dict[tuple[int, ...], list[tuple[int, int]]] = {}
    for axes in [*sets, *((axis,) for axis in alive)]:
        chance = math.prod(chances[axis] for axis in axes)
        for first, last in stretches(np.logical_and.reduce([same[axis] for axis in axes])):
            # The value was held from the row before `first` to the row before `last`.
            begin, end = first - 1, last - 1
            known = any(a <= begin and end <= b for places in found.values() for a, b in places)
            if (end - begin) * signal.step < LEAST_DROPOUT * (1.0 - 1e-9) or not standing[begin] or known:
                continue
            if _is_dropout(signal, axes, begin, end, chance):
                found.setdefault(axes, []).append((int(begin), int(end)))
    return [_said(signal, axes, places) for axes, places in _together(found).items()]


def _together(found: dict[tuple[int, ...], list[tuple[int, int]]]) -> dict[tuple[int, ...], list[tuple[int, int]]]:
    """Return dropouts by sets of columns: two that stand still at the same time are one dropout of both."""
    one = sorted((first, last, axes) for axes, places in found.items() for first, last in places)
    joined: list[tuple[int, int, tuple[int, ...]]] = []
    for first, last, axes in one:
        if joined and first < joined[-1][1]:
            before = joined.pop()
            whole = next((one for one in (before, (first, last, axes)) if len(one[2]) == 3), None)
            both = (min(first, before[0]), max(last, before[1]), tuple(sorted({*axes, *before[2]})))
            joined.append(whole or both)
        else:
            joined.append((first, last, axes))
    sets: dict[tuple[int, ...], list[tuple[int, int]]] = {}
    for first, last, axes in joined:
        sets.setdefault(axes, []).append((first, last))
    return sets


def _is_dropout(signal: Signal, axes: tuple[int, ...], begin: int, end: int, chance: float) -> bool:
    """Return whether values still from row `begin` to `end` are a fault: neither chance nor a block at rest."""
    crv, least = signal.crv, MOVES * signal.rate
    near = slice(max(begin - 1, 0), end + 2)
    moves = float(np.ptp(crv[near], axis=0).max()) > least or float(np.abs(crv[begin]).max()) > least
    if not moves:
        return False
    if len(axes) < 3 and any(crv[begin, axis] in (crv[:, axis].max(), crv[:, axis].min()) for axis in axes):
        return False  # a flat top
    if chance < 1.0 and (end - begin) * math.log(max(chance, 1e-300)) < math.log(CHANCE):
        return True
    if any(_stands_off(signal, axis, begin, end) for axis in axes):
        return True
    if len(axes) < 3:
        return False
    # With a coarse step only a slope that was left out tells: a leap where the motion itself has none.
    after = np.abs(np.diff(crv[end : end + 3, 0]))
    return len(after) == 2 and bool(after[0] > LEAP * signal.rate + 2.0 * signal.gyro.resolution + 3.0 * after[1])


def _stands_off(signal: Signal, axis: int, begin: int, end: int) -> bool:
    """Return whether a value held from row `begin` to `end`, for longer than a burst, is off the motion around it."""
    x, gyro = signal.crv[:, axis], signal.gyro
    if begin < 1 or end + 1 >= len(x) or end - begin < LONGEST_HOLD:
        return False
    off = np.array([x[begin - 1], x[end + 1]]) - x[begin]
    least = LEAP * signal.rate + 2.0 * gyro.resolution + 6.0 * gyro.noise
    return bool(off[0] * off[1] > 0.0 and np.abs(off).min() > least)


def _said(signal: Signal, axes: tuple[int, ...], places: list[tuple[int, int]]) -> Notice:
    """Return the remark on dropouts of some columns. Raises InputError E-DROPOUT where one lasts for 50 ms."""
    long = [(a, b) for a, b in places if (b - a) * signal.step >= LONG_DROPOUT * (1.0 - 1e-9)]
    first, last = (long or places)[0]
    values = ", ".join(f"{signal.crv[first, axis] / DEGREE:.4g}" for axis in axes)
    who = " and ".join(signal.names[axis] for axis in axes) + (" is held" if len(axes) == 1 else " are held")
    who = "all three rates are held" if len(axes) == 3 else who
    what = f"{who} at {values} deg/s from {signal.t[first]:.4g} to {signal.t[last]:.4g} s"
    if len(places) > 1:
        what += f", and at {len(places) - 1} other places"
    cure = "The logger dropped out: cut the record before it, or leave these rows out where they are few."
    where = signal.path if len(axes) == 3 else f"{signal.path}, column {signal.names[axes[0]]}"
    if long:
        raise InputError("E-DROPOUT", where, what, cure)
    return Notice("W-DROPOUT", where, what, cure)


def check_hold(signal: Signal) -> list[Notice]:
    """Refuse records whose values are held from sample to sample (E-HOLD); remark where that is rare (W-HOLD)."""
    held = _held_channels(signal)
    if not held:
        return []
    changes = np.flatnonzero(np.any([~repeats(signal.crv[:, axis]) for axis in held], axis=0))
    lengths = np.diff(changes)
    lengths = lengths[lengths <= max(LONGEST_HOLD, 2.0 * float(np.median(lengths)))]
    share = 1.0 - len(changes) / len(signal.t)
    usual = int(np.median(lengths[lengths > 1]))
    even = float(np.mean(lengths == usual)) > EVEN_SHARE
    rate = 1.0 / (usual * signal.step) if even else len(changes) / len(signal.t) / signal.step
    count = f"{usual}" if even else f"{int(np.percentile(lengths, 2.0))} to {int(np.percentile(lengths, 98.0))}"
    what = f"values are held for {count} samples: {rate:.4g} a second are measured, and {1.0 / signal.step:.4g} written"
    which = {2: "second", 3: "third"}.get(usual, f"{usual}th")
    cure = f"Keep every {which} row, and state sample_rate_hz = {rate:.4g}."
    if not even:
        cure = "Let the logger wait for a new value of the gyroscope, or record with the gyroscope's own clock."
    where = signal.path if len(held) == 3 else f"{signal.path}, column {signal.names[held[0]]}"
    if share > REFUSED_SHARE:
        raise InputError("E-HOLD", where, what, cure)
    return [Notice("W-HOLD", where, what, cure)]


def _held_channels(signal: Signal) -> list[int]:
    """Return the axes whose values are held from sample to sample: all three where they repeat at once, or one alone.

    Channels of a coarse step or of less noise than stated repeat one by one; those of a held record repeat together.
    """
    same = np.stack([repeats(signal.crv[:, axis]) for axis in range(3)])
    held = _held_throughout(same)
    if held:
        return held
    for axis in range(3):
        for first, last in stretches(same[axis]):
            if last - first >= LONGEST_HOLD:  # a dropout, or a step of the resolution
                same[axis, first:last] = False
    size = max(BLOCK, same.shape[1] // 60)
    count = same.shape[1] // size
    if count < LEAST_BLOCKS:
        return []
    blocks = same[:, : count * size].reshape(3, count, size)
    together = blocks.all(axis=0).mean(axis=1) - blocks.mean(axis=2).prod(axis=0)
    if float(np.median(together)) > TOGETHER:
        return [0, 1, 2]
    shares = np.median(blocks.mean(axis=2), axis=1)
    more = [shares[axis] - _stated_chance(signal, axis) for axis in range(3)]
    held = [axis for axis in range(3) if more[axis] > ALONE]
    others = [more[axis] for axis in range(3) if axis not in held]
    return held if held and others and max(others) < 0.5 * ALONE else []


def _held_throughout(same: np.ndarray) -> list[int]:
    """Return the axes whose values are all held for longer than nine samples; same (3, N) bool, equal to the last one.

    A gyroscope of 50 samples a second behind a logger of 1000 writes each of its values twenty times.
    """
    alive = [axis for axis in range(3) if not same[axis, 1:].all()]
    changes = np.flatnonzero(~same[alive].all(axis=0)) if alive else np.zeros(0, dtype=int)
    after = changes[1:][np.diff(changes) > LONGEST_HOLD]
    if len(after) >= max(LEAST_HOLDS, THROUGHOUT * len(changes)):
        together = float(np.mean((~same[:, after]).sum(axis=0) > 1))
        if together > 0.5:
            return alive
    held = []
    for axis in alive:
        lengths = np.diff(np.flatnonzero(~same[axis]))
        usual = float(np.median(lengths)) if len(lengths) >= LEAST_HOLDS else 0.0
        if usual > LONGEST_HOLD and float(np.mean(np.abs(lengths - usual) <= 1.0)) > THROUGHOUT:
            held.append(axis)
    return held
