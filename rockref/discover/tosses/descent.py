"""Downhill in an objective with many small valleys: at every step several ways down are tried, and the best is gone.

The error of a toss is smooth until a small change makes another corner strike first; from there on its derivatives tell
nothing. So a Gauss-Newton step is made several times, with more and with less trust in frames whose derivatives are
large, each with several dampings. A trial costs one simulation of all tosses, the derivatives one for each parameter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from rockref.discover.hypotheses.counted import Parameter
from rockref.model.errors import RockrefError

#: Sensitivities to the parameters' spreads, in percent and degrees, at which a frame counts half in a step (the last
#: one trusts all frames), and dampings of the step; decided by trial on the public fit tosses: each of them wins.
STEEP = (3.0, 15.0, 1e9)
DAMPING = (1e-4, 1e-2, 1.0, 30.0)
#: Longest step in a parameter's spread, and by how much a step that helped is made longer while it helps.
LONGEST, STRETCH = 1.5, 1.7
#: Finite difference in spreads; decided: ten times the kinks that a contact's first step makes.
DIFFERENCE = 0.05
#: Change of one parameter that is tried where no step of all of them helps, in spreads; decided: some differences.
PROBE = 0.15
#: Share of the objective that an iteration must gain for another one.
ENOUGH = 1e-3
#: Rows of a product that is made at once. Decided: a larger one the library of linear algebra may share out among
#: threads, and its last bits, on which the valley hangs in which a fit ends, would be those of their number. OpenBLAS
#: does so from 2^18 multiplications on; sixty numbers have fewer in so many rows.
AT_ONCE = 64


@dataclass(frozen=True)
class Slopes:
    """What a step is made of: residuals (N, 2, 3) of frames, derivatives (N, 2, 3, G), weight (N, 2) and size (N, 2) of
    position and turn; prior (G,) standard deviations and how many tosses share them."""

    r: np.ndarray
    J: np.ndarray
    weight: np.ndarray
    prior: np.ndarray
    tosses: int

    def normal_equations(self, z: np.ndarray, steep: float) -> tuple[np.ndarray, np.ndarray]:
        """Return matrix and gradient of the reweighted squares, frames steeper than `steep` counting less."""
        G = self.J.shape[-1]
        size = np.sqrt(np.sum(self.J**2, axis=(1, 2, 3)) / G)
        by = self.weight / (1 + (size[:, None] / steep) ** 2) / self.tosses
        w = np.repeat(by, 3, axis=1).ravel()
        flat = self.J.reshape(-1, G)
        sums = summed(flat * w[:, None], np.column_stack([flat, self.r.ravel()]))
        prior = 1 / self.prior**2 / self.tosses
        return sums[:, :G] + np.diag(prior), sums[:, G] + prior * z


def summed(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    """Return A^T B of A (N, G) and B (N, K), (G, K): the same last bits on any number of threads."""
    a, b = (np.pad(m, ((0, -len(m) % AT_ONCE), (0, 0))).reshape(-1, AT_ONCE, m.shape[1]) for m in (A, B))
    return (a.swapaxes(1, 2) @ b).sum(axis=0)


def limits(parameters: Sequence[Parameter]) -> tuple[np.ndarray, np.ndarray]:
    """Return lowest and highest z of each parameter: twice its prior, and what its quantity can be."""
    low = np.array([max(-2 * p.prior, p.least) for p in parameters])
    return low, np.array([min(2 * p.prior, p.most) for p in parameters])


def derivatives(
    residual: Callable[[np.ndarray], np.ndarray], z: np.ndarray, r: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """Return (..., G) by differences, toward the inside at a limit."""
    columns = []
    for i in range(len(z)):
        moved = z.copy()
        d = DIFFERENCE if z[i] + DIFFERENCE <= high[i] else -DIFFERENCE
        moved[i] += d
        columns.append((residual(moved) - r) / d)
    return np.stack(columns, axis=-1)


def step_of(H: np.ndarray, g: np.ndarray, damping: float, z: np.ndarray, low: np.ndarray, high: np.ndarray):
    """Return a damped step (G,) that leaves a parameter at its limit alone if it would go beyond."""
    free = ~(((z <= low) & (g > 0)) | ((z >= high) & (g < 0)))
    step = np.zeros(len(z))
    if free.any():
        A = (H + damping * np.diag(np.diag(H)))[np.ix_(free, free)]
        step[free] = -np.linalg.solve(A, g[free])
    longest = float(np.max(np.abs(step)))
    return step * min(1.0, LONGEST / longest) if longest > 0 else step


def best_way(
    slopes: Slopes, z: np.ndarray, value: Callable[[np.ndarray], float], now: float, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, float]:
    """Return the best of all tried steps from z, made longer while that helps; z itself where none helps."""
    best, least = z, now
    for steep in STEEP:
        H, g = slopes.normal_equations(z, steep)
        for damping in DAMPING:
            trial = np.clip(z + step_of(H, g, damping, z, low, high), low, high)
            then = value(trial)
            if then < least:
                best, least = trial, then
    if least >= now:
        best, least = along_one(z, value, now, low, high)
    while least < now:
        trial = np.clip(z + STRETCH * (best - z), low, high)
        then = value(trial)
        if then >= least:
            break
        best, least = trial, then
    return best, least


def along_one(
    z: np.ndarray, value: Callable[[np.ndarray], float], now: float, low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, float]:
    """Return the best change of one parameter alone: the way out of a kink, where slopes of all together mislead."""
    best, least = z, now
    for i in range(len(z)):
        for d in (-PROBE, PROBE):
            trial = z.copy()
            trial[i] = np.clip(z[i] + d, low[i], high[i])
            then = value(trial) if trial[i] != z[i] else np.inf
            if then < least:
                best, least = trial, then
    return best, least


def guarded(value: Callable[[np.ndarray], float]) -> Callable[[np.ndarray], float]:
    """Return `value`, infinite where the model cannot be simulated."""

    def safe(z: np.ndarray) -> float:
        try:
            return value(z)
        except RockrefError:
            return np.inf

    return safe
