"""The error of a model by axis and stretch of a run: before the first main impact, between the first two, after."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.records.release import Gyro
from rockref.measure.signals.impacts import Impacts
from rockref.measure.signals.repeatability import Repeatability

AXES = ("main", "transverse", "longitudinal")
STRETCHES = ("before", "between", "after")
STRETCH_WORDS = {
    "before": "before the first main impact",
    "between": "between the first two main impacts",
    "after": "after the second main impact",
}
# decided: a factor between two signals means something where both stand out of the noise by this much.
LEAST_SIGNAL = 5.0
# decided: fewer samples than this make no mean.
LEAST_SAMPLES = 8


@dataclass(frozen=True)
class StretchError:
    """How far a model is from one run about one axis in one stretch.

    Attributes
    ----------
    stretch, axis : str
        One of ``STRETCHES``, one of ``AXES``.
    rms : float
        RMS of model minus measured, rad/s, noise included; the model aligned with the run's first main
        impact.
    on_clock : float
        The same for the model let go at the stated tilt, both counted from the release, rad/s.
    in_noise : float or None
        ``rms`` over the noise floor of the run; a perfect model has 1. None where the run has no noise.
    in_spread : float or None
        ``rms`` over the standard deviation between repeated runs in this stretch (noise included); two repeated runs
        differ by 1.4. None where no run was repeated.
    ratio : float or None
        The factor by which the model has to be multiplied to come closest to the measured rate. None in the noise.
    correlation : float or None
        Correlation of model and measured rate; None in the noise.
    """

    stretch: str
    axis: str
    rms: float
    on_clock: float
    in_noise: float | None
    in_spread: float | None
    ratio: float | None
    correlation: float | None


def stretch_masks(t: np.ndarray, impacts: Impacts) -> dict[str, np.ndarray]:
    """Return the samples of each stretch, by name: (N,) bool for times t (N,) s. Without impacts all is ``before``."""
    first = float(impacts.times[0]) if len(impacts) else np.inf
    second = float(impacts.times[1]) if len(impacts) > 1 else np.inf
    return {"before": t < first, "between": (t >= first) & (t < second), "after": t >= second}


def noise_of(sigma: np.ndarray, gyro: Gyro) -> np.ndarray:
    """Return the noise floor (3,) rad/s: what was measured, but at least the rounding to the gyroscope's resolution."""
    return np.maximum(sigma, gyro.resolution / np.sqrt(12.0))


def stretch_errors(
    t: np.ndarray,
    measured: np.ndarray,
    aligned: np.ndarray,
    on_clock: np.ndarray,
    impacts: Impacts,
    noise: np.ndarray,
    repeats: Repeatability | None,
) -> tuple[StretchError, ...]:
    """Return the errors of every stretch with samples, axis by axis.

    t (N,) s; measured, aligned, on_clock (N, 3) rad/s: the run, the model aligned with it, and as released (NaN where
    the simulation ends); `impacts` of the run; noise (3,) rad/s.
    """
    found = []
    spread = _spread_at(t, impacts, repeats)
    for name, mask in stretch_masks(t, impacts).items():
        for axis, label in enumerate(AXES):
            x, p, q = measured[mask, axis], aligned[mask, axis], on_clock[mask, axis]
            both = np.isfinite(p)
            if both.sum() < LEAST_SAMPLES:
                continue
            rms = _rms(p[both] - x[both])
            between_runs = None if spread is None else _rms(_known(spread[mask, axis]))
            ratio, correlation = _alike(x[both], p[both], float(noise[axis]))
            found.append(
                StretchError(
                    stretch=name,
                    axis=label,
                    rms=rms,
                    on_clock=_rms(_known(q - x)),
                    in_noise=rms / float(noise[axis]) if noise[axis] > 0.0 else None,
                    in_spread=rms / between_runs if between_runs is not None and between_runs > 0.0 else None,
                    ratio=ratio,
                    correlation=correlation,
                )
            )
    return tuple(found)


def _spread_at(t: np.ndarray, impacts: Impacts, repeats: Repeatability | None) -> np.ndarray | None:
    """Return the standard deviation between runs (N, 3) rad/s at the times of this run; NaN where it is not known."""
    if repeats is None or not len(impacts):
        return None
    after = t - impacts.times[0]
    columns = [np.interp(after, repeats.t, repeats.spread[:, k], left=np.nan, right=np.nan) for k in range(3)]
    return np.stack(columns, axis=-1)


def _known(x: np.ndarray) -> np.ndarray:
    return x[np.isfinite(x)]


def _rms(x: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(x)))) if len(x) else float("nan")


def _alike(x: np.ndarray, p: np.ndarray, noise: float) -> tuple[float | None, float | None]:
    """Return factor and correlation of measured x over modelled p, (n,) each, or None where one is in the noise."""
    floor = LEAST_SIGNAL * noise
    if _rms(x) <= floor or _rms(p) <= floor:
        return None, None
    product = float(np.mean(x * p))
    return product / float(np.mean(p * p)), product / (_rms(x) * _rms(p))
