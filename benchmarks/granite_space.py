"""Whether the granite blocks fall, by the three-dimensional law on the convex hull of their meshes.

A block stands, rolls and tips on points of its hull, each with a spring and a damper. The motion acts across the edge
over which the hull tips most easily; heading about it and friction are drawn for every run. What is read from the runs
is the factor on a motion at which the block falls: one where the mesh and the law were right.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from granite_blocks import CROSSOVER, GraniteBlocks
from scipy.spatial import ConvexHull

from rockref.api import Model
from rockref.model.problem import ContactPoints
from rockref.shake.ensemble import Draws, Ensemble, run_ensemble, shares_that_fell

# decided: the weight sinks the feet by half a millimetre; stiffer feet ask for shorter steps.
STIFFNESS = 2e6  # N/m, each point
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
#: Decided: a block is set up by eye, 15 degrees to either side; friction as above.
DRAWS = Draws(heading=15.0, friction=0.2)
# decided: a block that is still rocking three seconds after the record is not falling any more.
AFTER = 3.0  # s
# decided: no hull misses the mesh's by more, four times the weight's sinking; half of it doubles the points.
MISSED = 2e-3  # m
# decided: tilts up to which the hull is followed; beyond some 15 degrees the weak edge is past its balance.
TILT = 20.0  # degrees
#: Factors on the motions; decided: by the root of two from one half to four.
FACTORS = tuple((0.5 * 2.0 ** (0.5 * np.arange(7))).tolist())


def hull_of(mesh: Path, centre: Sequence[float], rotation: Sequence[Sequence[float]]) -> np.ndarray:
    """Return the corners (n, 3) of the hull of a mesh file, about its centre of mass, as the block stands [m]."""
    lines = mesh.read_text(encoding="utf-8").splitlines()
    vertices = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    placed = (vertices - np.asarray(centre)) @ np.asarray(rotation).T
    return placed[ConvexHull(placed).vertices]


def support(points: np.ndarray, azimuth: np.ndarray, tilt: np.ndarray) -> np.ndarray:
    """Return how far the lowest of points (n, 3) lies below the centre [m], for tilts towards azimuths [rad]."""
    down = np.stack([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])
    return np.tensordot(points, down, 1).max(axis=0)


def supporting(corners: np.ndarray) -> np.ndarray:
    """Return the corners that carry a block tilted by up to `TILT`, so few that the hull is missed by `MISSED`."""
    azimuth, tilt = np.meshgrid(np.radians(np.arange(0, 360, 3)), np.radians(np.linspace(0, TILT, 41)))
    wanted = support(corners, azimuth, tilt)
    kept: list[np.ndarray] = []
    found = np.full(wanted.shape, -np.inf)
    while (wanted - found).max() > MISSED:
        worst = np.unravel_index(np.argmax(wanted - found), wanted.shape)
        below = [float(support(corner[None], azimuth[worst], tilt[worst])) for corner in corners]
        kept.append(corners[int(np.argmax(below))])
        found = support(np.array(kept), azimuth, tilt)
    return np.array(kept)


def weakest_azimuth(corners: np.ndarray) -> float:
    """Return towards where the centre rises least before a block balances [degrees]."""
    degrees = np.arange(0.0, 360.0, 5.0)
    azimuth, tilt = np.meshgrid(np.radians(degrees), np.radians(np.linspace(0.0, 45.0, 91)))
    heights = support(corners, azimuth, tilt)
    return float(degrees[np.argmin(heights.max(axis=0) - heights[0])])


def granite_model(data: GraniteBlocks, number: int) -> tuple[Model, float]:
    """Return block 1 or 2 on points of its hull, and its weakest azimuth [degrees]."""
    block = data.block(number)
    corners = hull_of(data.folder / block["mesh"], block["centre_of_mass"], block["rest_rotation"])
    P = supporting(corners)
    one = np.ones(len(P))
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
        names=tuple(f"corner {k}" for k in range(len(P))),
    )
    model = Model(mass=block["mass"], points="custom", custom_points=points, inertia=np.array(block["inertia"]))
    return model, weakest_azimuth(corners)


def critical_factors(
    data: GraniteBlocks,
    tests: Sequence[int],
    number: int,
    *,
    crossover: float = CROSSOVER,
    seed: int = 1,
    workers: int | None = 1,
    say: Callable[[str], None] = lambda text: None,
) -> np.ndarray:
    """Return the factor (n,) on the motion of each test at which block 1 or 2 falls: one run at each of `FACTORS`.

    The number of falls is counted, because a larger motion may spare what a smaller one fells.
    """
    model, azimuth = granite_model(data, number)
    motions = tuple(data.base_motion(int(test), crossover).rotated(azimuth) for test in tests)
    ensemble = Ensemble(model, motions, FACTORS, DRAWS, step=STEP, after=AFTER, seed=seed)
    runs = len(motions) * len(FACTORS)
    rows = run_ensemble(ensemble, runs, workers, done=lambda k, _: say(f"block {k + 1} of runs"))
    fell = shares_that_fell(rows, runs).reshape(len(motions), len(FACTORS)).sum(axis=1)
    step = FACTORS[1] / FACTORS[0]
    return FACTORS[-1] * step ** (0.5 - fell)
