"""What these very runs could show: how large each effect could be unseen, and which effects they confuse."""

from __future__ import annotations

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.information import eliminated, information
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import Setup
from rockref.discover.hypotheses.candidates import LEFT_OUT, kinds
from rockref.discover.plan import NEEDED_Z, amplitude, cosines, switches_of


def seen_by(
    setup: Setup, fit: Fit, point: Point, has: tuple[str, ...] = ()
) -> tuple[dict[str, dict[str, object]], dict[str, dict[str, float]]]:
    """Detection limits by parameter, and cosines of every two candidates, linearised at a fit of these runs.

    has : effects that the fit holds already. A limit is the size whose gain reaches what the verdict demands, and at
    least the least size that it names; a cosine near one means that these runs cannot tell two effects apart.
    """
    effects = kinds(setup.base.points, (*LEFT_OUT, *has), setup.own)
    own = [switches_of(kind) for kind in effects]
    wide = Fit(fit.series, fit.base, (*fit.parameters, *(p for block in own for p in block)))
    at, blocks = len(fit.parameters), []
    for block in own:
        blocks.append(np.arange(at, at + len(block)))
        at += len(block)
    z = np.concatenate([point.z, np.zeros(at - len(point.z))])
    found = information(fit, point, wide, z)
    nuisance = np.arange(at) < len(point.z)
    S, _ = eliminated(found.total, found.g.sum(axis=0), nuisance, wide.prior)
    S = 0.5 * (S + S.T) / rules.INTERVAL**2
    blocks = [b - len(point.z) for b in blocks]
    limits: dict[str, dict[str, object]] = {}
    for at_block, parameters in zip(blocks, own, strict=True):
        needed = NEEDED_Z / np.sqrt(np.maximum(np.diag(S)[at_block], 1e-12))
        for p, size in zip(parameters, np.maximum(needed, rules.LEAST_SIZE), strict=True):
            limits[p.name] = {"value": amplitude(p, float(size)), "unit": p.unit, "in_typical_sizes": float(size)}
    table = np.round(cosines(S, blocks), 3)
    names = [kind.id for kind in effects]
    return limits, {a: dict(zip(names, row, strict=True)) for a, row in zip(names, table.tolist(), strict=True)}
