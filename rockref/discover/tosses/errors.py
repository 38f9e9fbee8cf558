"""The error of a predicted toss, in the measure of the published study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.discover.tosses.predict import Prediction
from rockref.measure.tosses.flight import Poses

#: What a prediction that lost its numbers counts as: a width and a half turn.
LOST = 1.5, 180.0


@dataclass(frozen=True)
class Errors:
    """Per toss: mean over all frames of the position error in parts of the width, and of the geodesic angle in degrees.

    position, rotation : (B,), the metric of B. Acosta, W. Yang, M. Posa (2022), IEEE Robot. Autom. Lett. 7:6471-6478,
        arXiv:2110.00541.  position_at, rotation_at : (B, F) by frame, NaN behind the end of a toss.
    """

    position: np.ndarray
    rotation: np.ndarray
    position_at: np.ndarray
    rotation_at: np.ndarray

    def summary(self) -> dict[str, Any]:
        """Return means, standard deviations, medians and quartiles; position in percent of the width, rotation in
        degrees."""
        return {
            "position_percent": _summary(100 * self.position),
            "rotation_deg": _summary(self.rotation),
            "tosses": len(self.position),
        }


def _summary(a: np.ndarray) -> dict[str, float]:
    low, middle, high = np.quantile(a, (0.25, 0.5, 0.75))
    values = {
        "mean": np.mean(a), "sd": np.std(a), "median": middle, "lower_quartile": low, "upper_quartile": high,
    }  # fmt: skip
    return {k: round(float(v), 3) for k, v in values.items()}


def angle(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return geodesic angle between rotations, (..., 3, 3) -> (...) [rad], without loss near zero."""
    # |A - B|_F = 2 sqrt(2) sin(angle/2)
    return 2 * np.arcsin(np.minimum(np.sqrt(np.sum((A - B) ** 2, axis=(-1, -2)) / 8), 1.0))


def errors(prediction: Prediction, poses: Poses, width: float) -> Errors:
    """Return the errors of predicted tosses; width [m] is the unit of the position."""
    position = np.linalg.norm(prediction.x - poses.x, axis=-1) / width
    rotation = np.degrees(angle(prediction.Lambda, poses.Lambda))
    position = np.minimum(np.where(np.isfinite(position), position, LOST[0]), LOST[0] * 10)
    rotation = np.where(np.isfinite(rotation), rotation, LOST[1])
    position, rotation = (np.where(poses.measured, e, np.nan) for e in (position, rotation))
    return Errors(np.nanmean(position, axis=1), np.nanmean(rotation, axis=1), position, rotation)
