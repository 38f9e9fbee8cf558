"""Moves along the ridges of the law: numbers that trade with each other leave a fit on the slope of its valley."""

from __future__ import annotations

import numpy as np

from rockref.discover.fit.evolution import OUTSIDE
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.stages import Stage

#: Moves along a ridge in prior deviations.
KICKS = (-1.4, -0.7, -0.35, 0.35, 0.7, 1.4)
#: Ridges of the null: numbers of the law that trade with each other, and the signs with which they do. Feet on one
#: edge, a diagonal or alone; the inner points' distance with the mean height, by the angle at which these take over.
RIDGES: tuple[dict[str, float], ...] = (
    {"delta_diag": 1, "delta_long_1": 1, "delta_long_2": 1, "delta_long_3": 1, "delta_long_4": 1},
    {"delta_diag": 1, "delta_long_1": -1, "delta_long_2": -1, "delta_long_3": -1, "delta_long_4": -1},
    {"delta_diag": 1},
    {"delta_long_1": 1, "delta_long_2": 1, "delta_long_3": 1, "delta_long_4": 1},
    {"delta_long_1": 1, "delta_long_2": 1}, {"delta_long_3": 1, "delta_long_4": 1},
    {"delta_long_1": 1, "delta_long_4": 1}, {"delta_long_2": 1, "delta_long_3": 1},
    {"delta_long_1": 1, "delta_long_3": 1}, {"delta_long_2": 1, "delta_long_4": 1},
    {"delta_long_1": 1}, {"delta_long_2": 1}, {"delta_long_3": 1}, {"delta_long_4": 1},
    {"mu_int": 1, "mu_ext": 1}, {"mu_int": 1, "mu_ext": -1}, {"mu_int": 1}, {"mu_ext": 1},
    {"K_N": 1}, {"K_T": 1}, {"K_N": 1, "K_T": -1},
    {"beta_int": 1, "beta_ext": 1}, {"beta_int": 1, "beta_ext": -1},
)  # fmt: skip


def kicked(fitter: Fitter, h: FittedModel, stage: Stage, most: int, rounds: int = 3) -> FittedModel:
    """Move a fit along the ridges of the law, and each number of its effects, as long as a move, refined, is lower."""
    parameters = fitter.parameters(h)
    index = {p.name: k for k, p in enumerate(parameters)}
    own: list[dict[str, float]] = [{p.name: p.reach} for p in parameters if p.effect and p.run is None]
    for _ in range(rounds):
        moved = []
        for ridge in (*RIDGES, *own):
            if not ridge.keys() <= index.keys():
                continue
            for size in KICKS:
                z = h.z.copy()
                for name, sign in ridge.items():
                    k = index[name]
                    far = OUTSIDE * parameters[k].reach
                    z[k] = np.clip(z[k] + size * sign, max(-far, parameters[k].least), min(far, parameters[k].most))
                moved.append(FittedModel(h.effects, z))
        fitter.evaluate_all(moved, stage)
        best = min(moved, key=lambda k: k.loss)
        fitter.tempered(best, stage, most)
        if best.loss > 0.99 * h.loss:
            break
        h.z, h.r, h.objective, h.loss = best.z, best.r, best.objective, best.loss
    return h
