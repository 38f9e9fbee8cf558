"""Which part of padded arrays holds anything: windows are rows as long as the longest, and most are far shorter."""

from __future__ import annotations

from itertools import pairwise

import numpy as np


def pieces(length: np.ndarray, long: np.ndarray, most: int) -> list[tuple[slice, int]]:
    """Rows that are neighbours and alike, and how many samples of them have to be looked at.

    The windows that begin at a release are some ten times as long as the others, of which there are some thirty a run;
    so four fifths of an array (windows, samples, ...) are zeros, and nobody has to touch them.

    Parameters
    ----------
    length : (B,) samples from which on a row is zero; long : (B,) mask of the rows that are long; most : samples of the
        longest row.
    """
    edges = [0, *(np.flatnonzero(np.diff(long)) + 1), len(long)]
    return [(slice(a, b), min(most, int(length[a:b].max()))) for a, b in pairwise(edges) if b > a]
