"""Energy of the block and of the contact springs."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.model.rotation import apply, dot


class Energy(NamedTuple):
    """Energies [J], each (...)."""

    kinetic: np.ndarray
    potential: np.ndarray
    stored_normal: np.ndarray
    stored_tangential: np.ndarray

    @property
    def mechanical(self) -> np.ndarray:
        """Return kinetic and potential energy of the block [J]."""
        return self.kinetic + self.potential

    @property
    def total(self) -> np.ndarray:
        """Return mechanical energy and what the contact springs store [J]."""
        return self.kinetic + self.potential + self.stored_normal + self.stored_tangential


def kinetic_energy(v: np.ndarray, W: np.ndarray, mass: np.ndarray, J: np.ndarray) -> np.ndarray:
    """Return m v.v / 2 + W.J W / 2 [J]; v, W (..., 3); mass (...); J (..., 3, 3)."""
    return mass * dot(v, v) / 2 + dot(W, apply(J, W)) / 2


def potential_energy(x: np.ndarray, mass: np.ndarray, g: np.ndarray) -> np.ndarray:
    """Return m g z [J]; x (..., 3)."""
    return mass * g * x[..., 2]


def spring_energy(xi, touching, u_t, s, K_N, K_T) -> tuple[np.ndarray, np.ndarray]:
    """Return what the normal and the tangential springs of the touching points store [J], two (...)."""
    stretch = u_t - s
    normal = np.where(touching, K_N * xi * xi / 2, 0)
    tangential = np.where(touching, K_T * (stretch[..., 0] ** 2 + stretch[..., 1] ** 2) / 2, 0)
    return np.sum(normal, axis=-1), np.sum(tangential, axis=-1)
