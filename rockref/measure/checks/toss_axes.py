"""Whether poses of tosses are in the axes, units and order that are stated: two facts that need no model.

In free flight the middle of the block falls at 9.8 m/s2 along z, and no corner is ever under the board; at rest a face
lies on it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from rockref.measure.records.toss import Toss
from rockref.model.errors import InputError
from rockref.model.problem import GRAVITY

# decided: a parabola through fifty milliseconds and eight frames shows the fall to some per cent.
LEAST_TIME, LEAST_FRAMES = 0.05, 8
# decided: a stretch that falls with a tenth of g more or less, whatever its direction, is free flight.
ALIKE = 0.12
# decided: of so many stretches of flight the mean direction is known to a few degrees.
LEAST_FLIGHTS = 3
# decided: a direction within 25 degrees of an axis is that axis.
ALONG = 0.9
# decided: of many tosses some forty show the axes of all.
MOST = 40
# decided: corners dip into the board by a fiftieth of the width at impacts, by noise and by what gives way; a tenth
# of it at rest is another place of the board.
UNDER, OFF = 0.03, 0.1
# decided: poses that move by less than a hundredth of the width over eight frames are at rest.
STILL = 0.01
# decided: another order of the quaternion is named where it lessens the misfit to a half.
BETTER = 0.5

_UNITS = {"mm": 1e-3, "cm": 1e-2}
_AXES = "xyz"


def check_axes(tosses: Sequence[Toss], sides: tuple[float, float, float], where: str) -> None:
    """Refuse tosses of a box of `sides` m whose poses cannot be in the stated axes.

    Raises InputError: E-UNIT (mm or cm), E-AXES (z is not up), E-POSE (order of the quaternion), E-BOARD (other zero).
    """
    tosses = tosses[:: max(1, len(tosses) // MOST)]
    falls = [fall for toss in tosses for fall in _falls(toss)]
    if len(falls) >= LEAST_FLIGHTS:
        _check_fall(np.array(falls), where)
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * sides
    _check_rotation(tosses, corners, min(sides), where)
    _check_board(tosses, corners, min(sides), where)


def _falls(toss: Toss) -> list[np.ndarray]:
    """Return the accelerations, (3,) in lengths of the table per s2, of stretches that are a parabola."""
    size = max(LEAST_FRAMES, round(LEAST_TIME / (toss.t[1] - toss.t[0])) + 1)
    found = []
    for first in range(0, toss.frames - size + 1, size // 2):
        t = toss.t[first : first + size] - toss.t[first]
        coefficients, rest, *_ = np.polyfit(t, toss.x[first : first + size], 2, full=True)
        fall = 2.0 * coefficients[0]
        sagitta = np.linalg.norm(fall) * t[-1] ** 2 / 8.0
        # A parabola leaves little beside its own height; a bounce, a slide and a rest do not.
        if len(rest) and np.sqrt(rest.sum() / size) < 0.05 * sagitta:
            found.append(fall)
    return found


def _check_fall(falls: np.ndarray, where: str) -> None:
    """Refuse accelerations of flight (K, 3) that are not 9.8 m/s2 down along z: another unit, or other axes."""
    # A block at rest or on a slide leaves parabolas, too, and flatter ones.
    sizes = np.linalg.norm(falls, axis=1)
    size = float(np.median(sizes[sizes > 0.5 * np.percentile(sizes, 90.0)]))
    for unit, metres in _UNITS.items():
        if abs(size * metres / GRAVITY - 1.0) < ALIKE:
            cure = f"Divide the lengths by {1.0 / metres:g}, or name the columns x_{unit} to z_{unit} in an experiment."
            raise InputError("E-UNIT", where, f"in flight blocks fall with {size:.4g} m/s2: these are {unit}", cure)
    flights = falls[np.abs(np.linalg.norm(falls, axis=1) / GRAVITY - 1.0) < ALIKE]
    if len(flights) < LEAST_FLIGHTS:
        return
    down = flights.mean(axis=0) / GRAVITY
    axis = int(np.argmax(np.abs(down)))
    if abs(down[axis]) < ALONG or (axis == 2 and down[2] < 0.0):
        return
    what = f"in flight the middle falls along {'-' if down[axis] < 0 else '+'}{_AXES[axis]}, not along -z"
    if axis == 2:
        cure = "z has to point up: turn the sign of z and of one other axis, also in the quaternion."
    else:
        up = _AXES[axis] if down[axis] < 0 else f"-{_AXES[axis]}"
        cure = f"The table seems to have {up} up: turn its axes so that z points up, also in the quaternion."
    raise InputError("E-AXES", where, what, cure)


def _turned(change: Callable[[np.ndarray], np.ndarray], Lambda: np.ndarray) -> np.ndarray:
    """Return rotations (N, 3, 3) after a change of their quaternion (N, 4)."""
    from rockref.model.rotation import from_quaternion, quaternion

    return from_quaternion(change(quaternion(Lambda)))


def _other_orders(Lambda: np.ndarray) -> dict[str, np.ndarray]:
    """Return what rotations (N, 3, 3) would be if their numbers had been written in another order, by its name."""
    inverse = np.swapaxes(Lambda, -1, -2)
    last = _turned(lambda q: np.roll(q, 1, axis=-1), Lambda)
    return {
        "the quaternion's scalar seems to be written last: name the columns in the order qx, qy, qz, qw": last,
        "the rotation seems to be that from board to body: change the signs of qx, qy, qz": inverse,
        "the quaternion seems to be written with its scalar last, and from board to body": np.swapaxes(last, -1, -2),
    }


def _check_rotation(tosses: Sequence[Toss], corners: np.ndarray, width: float, where: str) -> None:
    """Refuse rotations that put corners under the board, or no face on it at rest, where another order does not."""
    misfit = _misfit(tosses, corners, [toss.Lambda for toss in tosses])
    if misfit < UNDER * width:
        return
    orders = [_other_orders(toss.Lambda) for toss in tosses]
    misfits = {name: _misfit(tosses, corners, [order[name] for order in orders]) for name in orders[0]}
    name = min(misfits, key=misfits.__getitem__)
    # Where no order fits, the sides of the block may be others.
    if misfits[name] < min(BETTER * misfit, UNDER * width):
        what = f"corners are under the board, or no face lies on it at rest, by {1e3 * misfit:.3g} mm"
        raise InputError("E-POSE", where, what, f"{name[0].upper()}{name[1:]}.")


def _misfit(tosses: Sequence[Toss], corners: np.ndarray, rotations: Sequence[np.ndarray]) -> float:
    """Return how far, m, corners are under the lowest level of rest, and faces at rest are not flat: a mean."""
    found = []
    for toss, Lambda in zip(tosses, rotations, strict=True):
        heights = _heights(toss, corners, Lambda)
        low, floor = heights[:, 0], 0.0
        if _at_rest(toss):
            floor = float(np.median(low[-LEAST_FRAMES:]))
            found.append(float(np.median(heights[-LEAST_FRAMES:, 3] - low[-LEAST_FRAMES:])))
        found.append(max(0.0, floor - float(low.min())))
    return float(np.mean(found))


def _heights(toss: Toss, corners: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Return the heights of the eight corners in each frame, (N, 8) m, the lowest first."""
    return np.sort(toss.x[:, 2:] + np.einsum("nj,kj->nk", Lambda[:, 2], corners), axis=1)


def _at_rest(toss: Toss) -> bool:
    """Return whether a toss ends with eight frames in which the block lies still."""
    last = toss.x[-LEAST_FRAMES:]
    turn = np.abs(toss.Lambda[-LEAST_FRAMES:] - toss.Lambda[-1]).max()
    return toss.frames > 2 * LEAST_FRAMES and float(np.ptp(last, axis=0).max()) < STILL * 0.1 and float(turn) < STILL


def _check_board(tosses: Sequence[Toss], corners: np.ndarray, width: float, where: str) -> None:
    """Refuse heights from another zero than the board: at rest the lowest corner is far above or under it."""
    low = [float(np.median(_heights(t, corners, t.Lambda)[-LEAST_FRAMES:, 0])) for t in tosses if _at_rest(t)]
    if len(low) >= LEAST_FLIGHTS and abs(np.median(low)) > OFF * width:
        level = float(np.median(low))
        what = f"at rest the lowest corner is {abs(level):.4g} m {'above' if level > 0 else 'under'} the board"
        cure = f"Count heights from the board: subtract {level:.4g} m from z, or check the sides of the block."
        raise InputError("E-BOARD", where, what, cure)
