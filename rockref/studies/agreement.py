"""Until when two responses agree, and how fast they part."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.measure.signals.running import half_width, running_rms

#: Two responses agree while their difference, as an RMS over `WINDOW` [s], is below this share of the
#: RMS of the motion about the same axis. Decided: a tenth is what one sees in a figure of a page's width.
SHARE, WINDOW = 0.1, 0.1


def horizon(t: np.ndarray, a: np.ndarray, b: np.ndarray, share: float = SHARE) -> np.ndarray:
    """Return time (3,) [s] from which b differs from a by more than `share` of the motion, by axis; infinite if never.

    t : (N,) [s];  a, b : (N, 3) rates of any one unit. The motion is the RMS of a over the whole record.
    """
    motion = np.sqrt(np.mean(np.square(a), axis=0))
    apart = running_rms(b - a, half_width(t, WINDOW)) > share * motion
    return np.where(apart.any(axis=0), t[np.argmax(apart, axis=0)], np.inf)


def difference(t: np.ndarray, a: np.ndarray, b: np.ndarray, until: float) -> np.ndarray:
    """Return the RMS of b - a over that of a up to `until` [s], by axis, (3,).

    About an axis with no motion at all, as on four even feet, it is zero, or infinite where only b moves.
    """
    n = int(np.searchsorted(t, until))
    apart, motion = np.mean(np.square(b[:n] - a[:n]), axis=0), np.mean(np.square(a[:n]), axis=0)
    none = np.where(apart > 0, np.inf, 0.0)
    return np.sqrt(np.divide(apart, motion, out=none, where=motion > 0))


def common_horizon(t: np.ndarray, responses: Sequence[np.ndarray], share: float = SHARE) -> np.ndarray:
    """Return the earliest horizon (3,) of responses against the first."""
    return np.min([horizon(t, responses[0], b, share) for b in responses[1:]], axis=0)
