"""Fit of whole tosses in the published measure of error; frames that the start's uncertainty blurs count less."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.tosses import descent
from rockref.discover.tosses.body import cut
from rockref.discover.tosses.parameters import apply, parameters
from rockref.discover.tosses.predict import Prediction, predict
from rockref.measure.tosses.flight import Poses
from rockref.model.rotation import logarithm

#: Steps a frame while fitting; the gate `step_small` tests what comes out.
STEPS = 24
#: Frames over which a fit looks, one stage after the other, at the camera's rate: the first two impacts, then all that
#: moves. What a short horizon finds is where the long one begins: the error of a long toss has many valleys.
HORIZONS = (40, 120)
#: Error below which it counts as square, in percent of the width and degrees: the noise of a pose and of its frame.
FLOOR = 0.3
#: Error beyond which a frame counts no more, in the same units: half a width, or a face that came down otherwise.
CEILING = 60.0
#: Systematic part of the uncertainty of a start: 0.1 mm, 1 mrad, 4 mm/s, 0.03 rad/s. Decided from the rest poses of
#: the public tosses, which scatter by 1.4 mrad about any fixed frame, over a flight of 0.1 s.
SYSTEMATIC = np.array([1e-4] * 3 + [1e-3] * 3 + [4e-3] * 3 + [3e-2] * 3)
#: Blur by the start, in percent and degrees, from which on a frame's error counts by the blur's inverse; decided: about
#: what is left after the first impact.
BLUR = 1.0


@dataclass
class TossFit:
    """A family of models over tosses, from their flights: `base` with `parameters`."""

    base: Model
    effects: tuple[str, ...]
    poses: Poses
    width: float
    log: Callable[[str], None] = field(default=lambda line: None)

    def __post_init__(self) -> None:
        self.parameters: tuple[Parameter, ...] = parameters(self.base, self.effects)
        self.prior = np.array([p.prior for p in self.parameters])

    def model(self, z: np.ndarray) -> Model:
        """Return the model at z."""
        return apply(self.base, self.parameters, z)

    def residual(self, z: np.ndarray, poses: Poses) -> np.ndarray:
        """Return (B, F, 6): position in percent of the width and turn in degrees, zero behind the end of a toss."""
        return residual(predict(self.model(z), poses, steps=STEPS), poses, self.width)

    def run(self, z: np.ndarray, iterations: int = 8, horizons: tuple[int, ...] = HORIZONS) -> tuple[np.ndarray, float]:
        """Return best z and its objective: mean over tosses and frames of position [%] plus rotation [deg], and prior.

        Frames are weighted by the blur of the start at the z with which a horizon begins.
        """
        objective = np.inf
        for frames in horizons:
            poses = cut(self.poses, frames)
            weight = self.frame_weights(z, poses)
            z = np.clip(z, *descent.limits(self.parameters))
            objective = self.objective(z, self.residual(z, poses), weight)
            z, objective = downhill(self, z, objective, poses, weight, iterations)
            many = f"{len(self.effects)} effects" if len(self.effects) > 3 else "+".join(self.effects)
            self.log(f"  {many or 'the law'}, {frames} frames: {objective:.3f}")
        return z, objective

    def descend(
        self, z: np.ndarray, poses: Poses, weight: np.ndarray, slopes: descent.Slopes
    ) -> tuple[np.ndarray, float]:
        """Return one step: the best of those that the slopes offer, and its objective."""
        value = descent.guarded(lambda trial: self.objective(trial, self.residual(trial, poses), weight))
        return descent.best_way(slopes, z, value, value(z), *descent.limits(self.parameters))

    def objective(self, z: np.ndarray, r: np.ndarray, weight: np.ndarray) -> float:
        """Return what the fit minimises; the prior counts as one toss's frame of noise would."""
        size = np.sqrt(_sizes(r) ** 2 + FLOOR**2)
        size = CEILING * (1 - np.exp(-size / CEILING))
        prior = float(np.sum((z / self.prior) ** 2)) / (2 * len(r))
        return float(np.mean(np.sum(weight[..., None] * size, axis=(1, 2)))) + prior

    def slopes(self, z: np.ndarray, poses: Poses, weight: np.ndarray) -> descent.Slopes:
        """Return derivatives at z; position and turn of a frame count by the inverse of their size."""
        r = self.residual(z, poses)
        high = descent.limits(self.parameters)[1]
        J = descent.derivatives(lambda moved: self.residual(moved, poses), z, r, high)
        size = np.sqrt(_sizes(r) ** 2 + FLOOR**2)
        by = weight[..., None] / size * np.exp(-size / CEILING)
        seen = weight > 0
        J = J[seen].reshape(-1, 2, 3, J.shape[-1])
        return descent.Slopes(r[seen].reshape(-1, 2, 3), J, by[seen], self.prior, len(r))

    def frame_weights(self, z: np.ndarray, poses: Poses) -> np.ndarray:
        """Return (B, F) weights that sum to one a toss if nothing is blurred: less where the start's uncertainty
        decides."""
        blur = start_blur(self.model(z), poses, self.width)
        even = poses.measured / poses.frames[:, None]
        return even / np.sqrt(1 + (blur / BLUR) ** 2)


def downhill(
    fit: TossFit, z: np.ndarray, objective: float, poses: Poses, weight: np.ndarray, iterations: int
) -> tuple[np.ndarray, float]:
    """Return z and objective some steps further down; a step that gains next to nothing is the last one."""
    for _ in range(iterations):
        z, then = fit.descend(z, poses, weight, fit.slopes(z, poses, weight))
        gain, objective = objective - then, then
        if gain < descent.ENOUGH * objective:
            break
    return z, objective


def residual(found: Prediction, poses: Poses, width: float) -> np.ndarray:
    """Return (B, F, 6): position in percent of the width, turn in degrees; a lost prediction counts as far away."""
    dx = 100 * (found.x - poses.x) / width
    turn = np.degrees(logarithm(poses.Lambda.swapaxes(-1, -2) @ np.nan_to_num(found.Lambda)))
    r = np.concatenate([dx, turn], axis=-1) * poses.measured[..., None]
    return np.clip(np.nan_to_num(r, nan=200.0), -200.0, 200.0)


def _sizes(r: np.ndarray) -> np.ndarray:
    """Return (B, F, 2) lengths of the position and the turn parts."""
    return np.stack([np.linalg.norm(r[..., :3], axis=-1), np.linalg.norm(r[..., 3:], axis=-1)], axis=-1)


def start_blur(model: Model, poses: Poses, width: float, draws: int = 3) -> np.ndarray:
    """Return (B, F) how far predictions from starts drawn within their uncertainty lie apart: position [%] plus turn
    [deg].

    The same draws in every call: antithetic pairs of a fixed sequence.
    """
    first = predict(model, poses, steps=STEPS)
    rng = np.random.default_rng(7)
    total = np.zeros(poses.x.shape[:2])
    for _ in range(draws):
        d = drawn_starts(first, rng)
        for sign in (1, -1):
            other = predict(model, poses, steps=STEPS, moved=sign * d)
            r = residual(other, poses._replace(x=first.x, Lambda=np.nan_to_num(first.Lambda)), width)
            total += _sizes(r).sum(axis=-1) ** 2 / (2 * draws)
    return np.sqrt(total)


def drawn_starts(found: Prediction, rng: np.random.Generator) -> np.ndarray:
    """Return (B, 12) one draw of every start's error: the flight's covariance and the systematic part."""
    C = found.starts.covariance + np.diag(SYSTEMATIC**2)
    return np.einsum("bij,bj->bi", np.linalg.cholesky(C), rng.normal(size=C.shape[:2]))
