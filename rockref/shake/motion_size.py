"""How large a motion of the plate is: its horizontal peaks, and the pulse that has the same."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion


def motion_size(base: BaseMotion) -> tuple[float, float]:
    """Return PGA [m/s2] and PGV [m/s]: the largest lengths of the horizontal acceleration and velocity.

    The velocity is the integral from rest of straight lines between samples. No baseline is removed: a record that
    drifts has too large a PGV, and its reader says that it drifts.
    """
    a = np.asarray(base.a[:, :2], float)
    v = np.vstack([np.zeros(2), np.cumsum(0.5 * base.dt * (a[1:] + a[:-1]), axis=0)])
    return float(np.hypot(*a.T).max()), float(np.hypot(*v.T).max())


def pulse_frequency(pga: Any, pgv: Any) -> Any:
    """Return w_p = 2 PGA/PGV [rad/s] of the one-sine pulse with these peaks, whose velocity reaches 2 a_p/w_p."""
    return 2.0 * np.asarray(pga) / np.asarray(pgv)
