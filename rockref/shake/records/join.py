"""Components become one motion of the plate: which goes along x, which along y, and over which stretch of time."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError
from rockref.shake.records.channel import Channel

# decided: azimuths are given to a degree; two horizontal components stand at a right angle to that.
SQUARE_DEG = 2.0
# decided: starts are stamped to a millisecond; a tenth of an interval of 5 ms and more is no rounding.
SHIFT = 0.1
AXES = "xyz"


def joined(channels: Sequence[Channel]) -> tuple[np.ndarray, float, list[Notice]]:
    """Return acceleration (n, 3) [m/s2] in plate axes, the interval [s], and what was noticed.

    x, y and z (up) are right-handed: of two horizontal azimuths, x is the one that has the other 90 degrees to its
    left, so that east is x and north is y. Components without a direction take the free axes in their order.
    Components that begin or end at different times are cut to what they share.

    Raises InputError: E-RECORD-CHANNELS, E-RECORD-AXES, E-RECORD-STEP, E-RECORD-START.
    """
    if not 1 <= len(channels) <= 3:
        cure = "Give one to three channels: choose files, or cut the others off."
        raise InputError("E-RECORD-CHANNELS", channels[0].where, f"{len(channels)} channels together", cure)
    dt = channels[0].dt
    for channel in channels:
        # Steps that are written with five figures differ by rounding.
        if abs(channel.dt - dt) > 1e-5 * dt:
            what = f"the interval is {channel.dt:g} s, and {dt:g} s in {channels[0].where}"
            raise InputError("E-RECORD-STEP", channel.where, what, "Components of one motion have one interval.")
    places, notices = _places(channels)
    first, n = _stretch(channels, dt)
    if any(len(channel.a) != n for channel in channels):
        what = f"components cover different times; they share {n} samples"
        notices.append(Notice("W-RECORD-CUT", channels[0].where, what, "Only what they share was used."))
    a = np.zeros((n, 3))
    for channel, (axis, sign), start in zip(channels, places, first, strict=True):
        a[:, AXES.index(axis)] = sign * channel.a[start : start + n]
    return a, dt, notices + [notice for channel in channels for notice in channel.notices]


def _stretch(channels: Sequence[Channel], dt: float) -> tuple[list[int], int]:
    """Return the sample of each component at which the shared stretch begins, and its length."""
    starts = [channel.start for channel in channels]
    if any(start is None for start in starts):
        begins = [0] * len(channels)
    else:
        known = [start for start in starts if start is not None]
        exact = [(max(known) - start) / dt for start in known]
        begins = [round(shift) for shift in exact]
        worst = max(range(len(exact)), key=lambda i: abs(exact[i] - begins[i]))
        if abs(exact[worst] - begins[worst]) > SHIFT:
            what = f"begins {exact[worst]:.3g} intervals before the others, which is no whole number"
            raise InputError("E-RECORD-START", channels[worst].where, what, "Resample it, or read it alone.")
    n = min(len(channel.a) - begin for channel, begin in zip(channels, begins, strict=True))
    if n < 1:
        raise InputError("E-RECORD-START", channels[0].where, "the components share no time", "Give one record.")
    return begins, n


def _places(channels: Sequence[Channel]) -> tuple[list[tuple[str, float]], list[Notice]]:
    """Return axis and sign of each component, and a remark where the order of several decided."""
    found: dict[int, tuple[str, float]] = {}
    for i, channel in enumerate(channels):
        if channel.direction in ("up", "down"):
            found[i] = "z", 1.0 if channel.direction == "up" else -1.0
        elif isinstance(channel.direction, str):
            found[i] = channel.direction, 1.0
    level = [i for i, channel in enumerate(channels) if isinstance(channel.direction, float)]
    if len(level) == 2:
        left = _turn(channels[level[0]], channels[level[1]])
        found[level[0]], found[level[1]] = (("x", 1.0), ("y", 1.0)) if left else (("y", 1.0), ("x", 1.0))
    elif len(level) == 1:
        found[level[0]] = "x", 1.0
    elif level:
        raise InputError(
            "E-RECORD-AXES", channels[0].where, "three horizontal components", "Give two, and one that is vertical."
        )
    free = [axis for axis in AXES if axis not in {axis for axis, _ in found.values()}]
    silent = [i for i in range(len(channels)) if i not in found]
    for i, axis in zip(silent, free, strict=False):
        found[i] = axis, 1.0
    taken = [found[i][0] for i in sorted(found)]
    if len(set(taken)) < len(channels):
        what = f"components along {', '.join(taken)}: two on one axis"
        raise InputError("E-RECORD-AXES", channels[0].where, what, "Give components of different directions.")
    notices = [
        Notice("W-RECORD-AXES", channels[i].where, "no direction is stated", f"It was taken along {found[i][0]}.")
        for i in silent
        if len(channels) > 1
    ]
    return [found[i] for i in range(len(channels))], notices


def _turn(one: Channel, other: Channel) -> bool:
    """Return whether the other component lies 90 degrees to the left of the one. Raises InputError E-RECORD-AXES."""
    assert isinstance(one.direction, float) and isinstance(other.direction, float)
    angle = (one.direction - other.direction) % 360.0
    if min(abs(angle - 90.0), abs(angle - 270.0)) > SQUARE_DEG:
        what = f"azimuths {one.direction:g} and {other.direction:g} are not at a right angle"
        raise InputError("E-RECORD-AXES", other.where, what, "Give two components of one instrument.")
    return abs(angle - 90.0) <= SQUARE_DEG
