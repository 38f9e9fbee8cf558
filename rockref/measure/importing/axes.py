"""Which axis of the chip is which of the block: X from the first swing, Z from gravity or from the clatter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.measure.importing.motion import Motion
from rockref.model.errors import InputError

# decided: a thousand samples at rest give the noise to 2 %; motion that adds less than a tenth to it is not seen.
HEARD = 1.1
# decided: an axis that takes less than this of the turn is not alone: the chip sits askew, by 18 degrees or more.
ALONE = 0.95


@dataclass(frozen=True)
class Axes:
    """The block's axes as axes of the chip.

    Attributes: ``places`` and ``signs`` of X, Y, Z in the log's x, y, z; ``reason``, how Z was told; ``up_known``,
    whether the sign of Z was measured; ``askew`` rad, how far the rocking axis lies from the chip's axis.
    """

    places: tuple[int, int, int]
    signs: tuple[int, int, int]
    reason: str
    up_known: bool
    askew: float = 0.0

    def body(self, chip: np.ndarray) -> np.ndarray:
        """Return rates about X, Y, Z (N, 3) of those about the chip's axes (N, 3)."""
        return chip[:, self.places] * np.array(self.signs, dtype=np.float64)

    def spoken(self, names: Sequence[str]) -> str:
        """Return the axes in words, as ``X = gy, Y = -gx, Z = gz``."""
        parts = (f"{'-' if s < 0 else ''}{names[k]}" for k, s in zip(self.places, self.signs, strict=True))
        return ", ".join(f"{axis} = {part}" for axis, part in zip("XYZ", parts, strict=True))


def find_axes(motions: Sequence[Motion], turned: Sequence[bool | None]) -> Axes:
    """Return the axes of a chip that sits on the block in the same way in all runs.

    `turned` says of each run whether the block was turned by 180 degrees, None where nobody said; most runs are not.
    Raises InputError E-AXES where runs rock about different axes of the chip.
    """
    mains = [m.main for m in motions]
    x = max(set(mains), key=mains.count)
    if any(main != x for main in mains):
        odd = motions[next(i for i, main in enumerate(mains) if main != x)]
        what = f"rocks about {odd.recording.channels.chip[odd.main]}, the others about {odd.recording.channels.chip[x]}"
        cure = "The chip has to sit on the block in the same way in all runs: import the others alone."
        raise InputError("E-AXES", odd.recording.source, what, cure)
    known = [(np.sign(m.turn[x]), told) for m, told in zip(motions, turned, strict=True) if told is not None]
    votes = sum(s * (-1 if told else 1) for s, told in known) if known else sum(np.sign(m.turn[x]) for m in motions)
    # As many one way as the other: the first run is the one that is not turned.
    sign_x = int(np.sign(votes) or np.sign(motions[0].turn[x]))
    z, sign_z, reason, up_known = _height(motions, x)
    y = 3 - x - z
    # Right-handed: Y = Z x X, whose sign is that of the permutation.
    even = (x, y, z) in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    sign_y = sign_x * sign_z * (1 if even else -1)
    shares = [abs(m.turn[x]) / float(np.linalg.norm(m.turn)) for m in motions]
    askew = float(np.arccos(min(1.0, float(np.median(shares)))))
    return Axes((x, y, z), (sign_x, sign_y, sign_z), reason, up_known, askew)


def _height(motions: Sequence[Motion], x: int) -> tuple[int, int, str, bool]:
    """Return the chip's axis along the height, its sign, how it was told, and whether the sign was."""
    others = [axis for axis in range(3) if axis != x]
    pulls = [p for m in motions if (p := _gravity(m)) is not None]
    if pulls:
        pull = np.mean(pulls, axis=0)
        z = max(others, key=lambda axis: abs(pull[axis]))
        y = next(axis for axis in others if axis != z)
        if abs(pull[y]) <= 0.5 * abs(pull[z]):
            return z, 1 if pull[z] > 0 else -1, "Z along gravity in the accelerometer", True
    rough = np.median([_roughness(m) for m in motions], axis=0)
    z = max(others, key=lambda axis: rough[axis])
    return z, 1, "Z is the axis that clatters most", False


def _gravity(motion: Motion) -> np.ndarray | None:
    """Return what an accelerometer shows (3,) while the block stands, scaled to one; None without gravity in it."""
    a, t = motion.recording.accelerations, motion.recording.t
    if a is None or motion.standing <= 0.0:
        return None
    rest = a[(t > motion.release - motion.standing) & (t < motion.release - 0.05)]
    if len(rest) < 8:
        return None
    mean, scatter = rest.mean(axis=0), float(rest.std(axis=0).max())
    size = float(np.linalg.norm(mean))
    # An accelerometer from which gravity was taken shows noise about zero.
    return mean / size if size > 20.0 * scatter and size > 0.5 else None


def _roughness(motion: Motion) -> np.ndarray:
    """Return how much each rate (3,) jumps from sample to sample after the first impact, as a share of its size."""
    t, chip = motion.recording.t, motion.recording.chip
    after = chip[(t > motion.impact) & (t < motion.impact + 3.0)] - motion.bias
    # White noise jumps most of all: without taking it off, the axis of the smaller motion would be the rougher one.
    motion_power = np.maximum(after.var(axis=0) - motion.noise**2, 1e-300)
    jump_power = np.maximum(np.mean(np.diff(after, axis=0) ** 2, axis=0) - 2.0 * motion.noise**2, 0.0)
    heard = after.std(axis=0) > HEARD * motion.noise
    return np.where(heard, np.sqrt(jump_power / motion_power), 0.0)


def other_way_up(axes: Axes) -> tuple[str, str, str]:
    """Return the chip's axes along X, Y and Z, as they are stated, with Y and Z the other way."""
    x, y, z = (
        f"{'-' if sign * turn < 0 else ''}{'xyz'[place]}"
        for place, sign, turn in zip(axes.places, axes.signs, (1, -1, -1), strict=True)
    )
    return x, y, z
