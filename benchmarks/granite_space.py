"""Whether the granite blocks fall, by the three-dimensional law on four uneven feet of their meshes.

The feet are corners of the mesh near the floor, with their heights. The level distances of the feet from the centre are
multiplied by one number, which is to be fitted: the sheets' falls begin below what the feet allow. Heading, heights and
friction are drawn for every run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from granite_blocks import CROSSOVER, GraniteBlocks

from rockref.api import Model
from rockref.model.problem import ContactPoints
from rockref.shake.ensemble import Draws, Ensemble, run_ensemble, shares_that_fell

# decided: the weight sinks the feet by half a millimetre; stiffer feet ask for shorter steps.
STIFFNESS = 2e6  # N/m, each foot
# decided: tangential over normal stiffness and damping, as of elastic bodies in contact (0.67 to 1, Mindlin 1949).
TANGENTIAL = 0.7
# decided: an impact of stone on a table hardly bounces.
DAMPING_RATIO = 0.3
# What moves with one foot is m/(1 + m r^2/I): r^2 = 0.12 m2 and I = 19 kg m2 of these blocks.
SHARE = 3.2
# decided: granite on steel or concrete, 0.5 to 0.8.
FRICTION = 0.7
# decided: a fiftieth of the shortest period of a foot on its spring, 2 pi sqrt(m'/K) with a third of the mass.
STEP = 2e-4  # s
#: Nothing is known of the heading; heights of the feet are read to a millimetre or so.
DRAWS = Draws(heading=180.0, feet=5e-4, friction=0.2)
# decided: a block that is still rocking three seconds after the record is not falling any more.
AFTER = 3.0  # s


def granite_model(block: dict[str, Any], reach: float, within: str = "within_5mm") -> Model:
    """Return a block on the four corners of its mesh that are near the floor.

    block : as `GraniteBlocks.block` returns it;  reach : factor on the level distances of the feet from the centre
    within : which corners: points within_2mm, within_5mm, within_10mm or within_20mm of the floor
    """
    P = np.array(block[within]["four_feet"], float)
    P[:, :2] *= reach
    P[:, 2] -= block["centre_height"]
    one = np.ones(4)
    damping = 2.0 * DAMPING_RATIO * np.sqrt(STIFFNESS * block["mass"] / SHARE)
    points = ContactPoints(
        P=P,
        K_N=STIFFNESS * one,
        K_T=TANGENTIAL * STIFFNESS * one,
        C_N=damping * one,
        C_T=TANGENTIAL * damping * one,
        mu_0=FRICTION * one,
        mu=FRICTION * one,
        radius=None,
        names=("1", "2", "3", "4"),
    )
    return Model(mass=block["mass"], points="custom", custom_points=points, inertia=np.array(block["inertia"]))


def fall_shares(
    data: GraniteBlocks,
    tests: Sequence[int],
    block: int,
    reach: float,
    rounds: int,
    *,
    crossover: float = CROSSOVER,
    seed: int = 1,
    workers: int | None = 1,
    say: Callable[[str], None] = lambda text: None,
) -> np.ndarray:
    """Return the share (n,) of `rounds` runs of each test in which block 1 or 2 fell. Raises InputError as runs do."""
    motions = tuple(data.base_motion(int(test), crossover) for test in tests)
    model = granite_model(data.block(block), reach)
    ensemble = Ensemble(model, motions, (1.0,), DRAWS, step=STEP, after=AFTER, seed=seed)
    rows = run_ensemble(ensemble, len(motions) * rounds, workers, done=lambda k, _: say(f"block {k + 1} of runs"))
    return shares_that_fell(rows, len(motions))
