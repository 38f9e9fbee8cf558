"""Whether the granite blocks fall, predicted by ensembles of blocks in a plane with a few shared numbers.

Neither the side on which a block stood towards the table, nor its friction, nor the surface is known. So a test is a
draw over what is unknown: the weaker edge lies on either side with probability one half, and its angle is lognormal
about a median. Median, scatter, the stronger edge's angle over the weaker one's, the restitution and the share of
outcomes that no model holds are shared by all motions: five numbers a block, or six where the median may differ before
and after the campaign's break. They are chosen from a grid by the log loss of all other motions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import numpy as np
from granite_blocks import CROSSOVER, GraniteBlocks

from rockref.shake.plane_block import plane_block, rock_many

# decided: the interval of the records, a fiftieth of 1/p.
STEP = 5e-3
#: Share of outcomes that no model holds, half of it on either side; decided: no test is surer than one in 200.
UNHELD = (0.01, 0.02, 0.04, 0.08)


@dataclass(frozen=True)
class Candidates:
    """The grid of candidates: angles of the weaker edge and their medians [degrees], the rest without unit.

    ratios : of the stronger edge's angle to the weaker one's;  restitutions : factors on the ratio of rates that keeps
    the angular momentum, one is Housner's;  scatters : of the logarithm of the angle
    """

    weak_deg: tuple[float, ...]
    ratios: tuple[float, ...]
    restitutions: tuple[float, ...]
    medians_deg: tuple[float, ...]
    scatters: tuple[float, ...]


#: What the meshes allow, without a look at an outcome. Angles: from the least tipping angle of the points within 2 mm
#: of the floor (7.6 degrees), less the 1.8 degrees by which the pose of the mesh is unknown, to that of the points
#: within 20 mm (15.8). Ratio: the meshes have 1.3 and 1.4. Scatters: up to the 0.28 in the logarithm by which the least
#: angle grows from the points within 2 mm to those within 5 mm. Restitutions: Housner's, and decided, a tenth less.
PHYSICAL = Candidates(
    weak_deg=tuple(np.geomspace(5.8, 15.8, 14).tolist()),
    ratios=(1.35,),
    restitutions=(0.90, 1.0),
    medians_deg=tuple(np.arange(6.0, 15.1, 0.75).tolist()),
    scatters=(0.1, 0.15, 0.2, 0.3),
)
#: A range that was widened while looking at these outcomes, until no number lay at its end.
WIDENED = Candidates(
    weak_deg=tuple(np.geomspace(2.5, 16.0, 22).tolist()),
    ratios=(1.0, 1.25, 1.6),
    restitutions=(0.93, 1.0),
    medians_deg=tuple(np.arange(3.0, 10.1, 0.5).tolist()),
    scatters=(0.1, 0.15, 0.2, 0.3),
)
#: Ladder for critical angles. Ratio and restitutions are those of the meshes' range. Decided: from a degree to 45, so
#: that no motion fells all of its blocks; a tenth from step to step, a third of the scatter that outcomes have.
LADDER = replace(PHYSICAL, weak_deg=tuple(np.geomspace(1.0, 45.0, 39).tolist()))


@dataclass(frozen=True)
class PlaneNumbers:
    """The shared numbers of a prediction: angles in degrees, one a session; the rest without unit."""

    medians_deg: tuple[float, ...]
    scatter: float
    ratio: float
    restitution: float
    unheld: float


def plane_blocks(block: dict[str, Any], of: Candidates = PHYSICAL) -> np.ndarray:
    """Return blocks (A, R, E, 2, 6) over weak angle, ratio, restitution and side, for `rock_many`.

    block : height of the centre, mass and inertia, as `GraniteBlocks.block` returns them. The block is as high as its
    mesh; the radius of gyration is the mean of the two level axes.
    """
    height = block["centre_height"]
    inertia = np.asarray(block["inertia"])
    gyration = math.sqrt(0.5 * (inertia[0, 0] + inertia[1, 1]) / block["mass"])
    out = np.empty((len(of.weak_deg), len(of.ratios), len(of.restitutions), 2, 6))
    for (i, weak), (j, ratio), (k, e), side in product(
        enumerate(of.weak_deg), enumerate(of.ratios), enumerate(of.restitutions), (0, 1)
    ):
        reach = [height * math.tan(math.radians(angle)) for angle in (weak, weak * ratio)]
        made = plane_block(height, (reach[side], reach[1 - side]), gyration, restitution=e)
        out[i, j, k, side] = *made.alpha, *made.p, *made.e
    return out


def falls(
    data: GraniteBlocks,
    tests: Sequence[int],
    block: int,
    crossover: float = CROSSOVER,
    step: float = STEP,
    of: Candidates = PHYSICAL,
    say: Callable[[str], None] = lambda text: None,
) -> np.ndarray:
    """Return whether each block of the grid fell in each test: (n, A, R, E, 2) bool. Takes some minutes for 460 tests.

    block : 1 or 2;  crossover [Hz], as in `GraniteBlocks.base_motion`;  step [s];  say : is told how far it is
    """
    grid = plane_blocks(data.block(block), of)
    flat = grid.reshape(-1, 6)
    out = np.empty((len(tests), len(flat)), bool)
    for k, test in enumerate(tests):
        out[k] = rock_many(data.base_motion(int(test), crossover), flat, step=step)[:, 0] == 1.0
        if k % 50 == 49:
            say(f"{k + 1} of {len(tests)} tests")
    return out.reshape(len(tests), *grid.shape[:-1])


def critical_angles(fell: np.ndarray, of: Candidates = LADDER) -> np.ndarray:
    """Return the critical angle of each test (n,) [degrees]: its motion fells weaker edges below, and stronger not.

    fell : (n, A, R, E, 2) from `falls`. The angle is the geometric mean over what is unknown, restitution and side. The
    share of the ladder that falls is counted, because a motion may fell a block and spare a more slender one.
    """
    share = fell.mean(axis=tuple(range(1, fell.ndim)))
    return of.weak_deg[0] * (of.weak_deg[-1] / of.weak_deg[0]) ** share


def probabilities(
    fell: np.ndarray, session: Any = None, of: Candidates = PHYSICAL
) -> tuple[np.ndarray, list[PlaneNumbers]]:
    """Return the probability (n, k) of falling under each choice of the shared numbers, and the choices.

    fell : (n, A, R, E, 2) from `falls`; the two sides count one half each
    session : (n,) labels; tests of another session may have another median. None: all tests are of one
    """
    number = np.zeros(len(fell), int) if session is None else np.unique(session, return_inverse=True)[1]
    angles = np.log(np.asarray(of.weak_deg))
    medians = list(product(of.medians_deg, repeat=int(number.max()) + 1))
    weights = np.array(
        [[np.exp(-0.5 * ((angles - math.log(m)) / s) ** 2) for s in of.scatters] for m in of.medians_deg]
    )
    weights /= weights.sum(axis=-1, keepdims=True)
    mixed = np.einsum("msa,nare->nmsre", weights, fell.mean(axis=-1))
    place = np.array([[of.medians_deg.index(m) for m in choice] for choice in medians])
    # Each test takes the median of its own session.
    mixed = mixed[np.arange(len(fell))[:, None], place[:, number].T].reshape(len(fell), -1)
    columns = [0.5 * unheld + (1.0 - unheld) * mixed for unheld in UNHELD]
    choices = product(UNHELD, medians, of.scatters, of.ratios, of.restitutions)
    return np.concatenate(columns, axis=1), [PlaneNumbers(m, s, r, e, u) for u, m, s, r, e in choices]
