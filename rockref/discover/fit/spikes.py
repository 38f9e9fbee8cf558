"""Innovations made white: what stands out of white noise in a piece of a run, by its directions and variances.

D. L. Donoho, M. Gavish, I. M. Johnstone (2018), Optimal shrinkage of eigenvalues in the spiked covariance model, Ann.
Statist. 46:1742-1778, doi:10.1214/17-AOS1601.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

#: Factor on the largest variance that white noise shows in a sample, from which there is a spike (decided: the largest
#: scatters by a twentieth; tested on white noise).
CERTAIN = 1.1


class Spikes(NamedTuple):
    """What is not white in a piece of a run: `run`, samples `first` to `end`, directions (k, 3 samples) of length one,
    and the variance along each, (k,)."""

    run: int
    first: int
    end: int
    directions: np.ndarray
    variances: np.ndarray


def spikes(sample: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return directions (k, p) in which a sample (K, p) is wider than white noise of size one, and their variances."""
    K, p = sample.shape
    shape = p / K
    _, s, V = np.linalg.svd(sample, full_matrices=False)
    seen = s**2 / K
    wide = seen > CERTAIN * (1 + np.sqrt(shape)) ** 2
    b = seen[wide] + 1 - shape
    return V[wide], 0.5 * (b + np.sqrt(np.maximum(b * b - 4 * seen[wide], 0.0)))


def whitened(r: np.ndarray, found: Sequence[Spikes]) -> np.ndarray:
    """Return innovations (..., R, N, 3) with the spikes of their covariance taken back to one; r is changed."""
    N = r.shape[-2]
    for s in found:
        if s.first >= N:
            continue
        piece = r[..., s.run, s.first : s.end, :]
        flat = piece.reshape(*piece.shape[:-2], -1)
        V = s.directions[:, : flat.shape[-1]]
        shown = flat @ V.T
        flat = flat - (shown * (1 - 1 / np.sqrt(s.variances))) @ V
        r[..., s.run, s.first : s.end, :] = flat.reshape(piece.shape)
    return r
