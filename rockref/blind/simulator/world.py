"""One block, its plate and its gyroscope, as the blind test draws them: what a hidden effect may change."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rockref.blind.simulator.slots import GLOBALS, POINT, G, P

GRAVITY = 9.81
NOMINAL_TILT = 0.117


@dataclass(frozen=True)
class Block:
    """Mass [kg], width of the square base [m] and height [m] of a cuboid."""

    mass: float
    width: float
    height: float


#: The block of the model's source.
SOURCE = Block(54.0, 0.100, 0.688)
#: Table 3.1 of the model's source.
TABLE = {
    "K_N": 6e7, "K_T": 5e7, "beta_int": 0.15, "beta_ext": 0.18, "mu_int": 0.30, "mu_ext": 0.25,
    "delta_long_1": 1.0e-5, "delta_long_2": 4.0e-5, "delta_long_3": 9.2e-5, "delta_long_4": 5.8e-5,
    "delta_diag": 6e-3, "theta_0": NOMINAL_TILT,
}  # fmt: skip
#: For the source's block: half its weight [N], and what else another form of an effect is equal to the catalogue's at.
REFERENCES = {"half_weight": 264.87, "depth_0": 2e-5, "speed_0": 0.01, "sway_0": 0.08}
DEGREE = np.pi / 180
CORNERS = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)], float)


@dataclass
class Sensor:
    """What the gyroscope adds: see :mod:`rockref.blind.simulator.recorder`. Rates in rad/s, frequencies in Hz.

    The last four are its data sheet; the low-pass is its own, of second order. `bandwidth` is that of a further one.
    """

    turn: np.ndarray = field(default_factory=lambda: np.eye(3))
    scale: np.ndarray = field(default_factory=lambda: np.ones(3))
    cubic: float = 0.0
    bandwidth: float = 0.0
    bandwidth_order: int = 2
    bias: np.ndarray = field(default_factory=lambda: np.zeros(3))
    drift: np.ndarray = field(default_factory=lambda: np.zeros(3))
    warm_up: float = 0.0
    range: float = 0.0
    soft: bool = False
    clock: float = 1.0
    clock_bend: float = 0.0
    lost_packets: float = 0.0
    packet: int = 0
    ring_frequency: float = 0.0
    ring_gain: float = 0.0
    sample_rate: float = 1000.0
    noise: float = 0.05 * DEGREE
    low_pass: float = 300.0
    resolution: float = 0.01 * DEGREE


@dataclass
class World:
    """A block before its release.

    Attributes
    ----------
    points : (n, 3) contact points from the centre of mass, m. props : (n, POINT). foot : (n,) foot of each point, 0-3.
    mass : kg. J : (3, 3) kg m2. g : (GLOBALS,), see :mod:`rockref.blind.simulator.slots`.
    kick : (3,) body rates at release, rad/s; kick_at : height above the feet about which the block turns with them, m.
    sensor : the gyroscope.
    each_run : functions (world, rng, run number) that change a copy of the world for one run.
    factors : on the typical sizes of effects, by `effect` or `effect.parameter`; one where nothing is said.
    """

    points: np.ndarray
    props: np.ndarray
    foot: np.ndarray
    external: np.ndarray
    mass: float
    J: np.ndarray
    g: np.ndarray
    kick: np.ndarray
    sensor: Sensor
    kick_at: float = 0.0
    each_run: list[Callable[..., dict[str, float]]] = field(default_factory=list)
    factors: dict[str, float] = field(default_factory=dict)

    def __getitem__(self, name: str) -> float:
        return float(self.g[G[name]])

    def __setitem__(self, name: str, value: float) -> None:
        self.g[G[name]] = value

    def factor(self, name: str) -> float:
        """Return how much more than on the source's block is typical of this effect, or of this parameter of it."""
        return self.factors.get(name, 1.0)

    def scale(self, column: str, factors: np.ndarray) -> None:
        """Multiply a column of the points by a factor for each foot, (4,)."""
        self.props[:, P[column]] *= np.asarray(factors)[self.foot]


def draw_parameters(rng: np.random.Generator, spread: float = 0.10) -> dict[str, float]:
    """Draw Table 3.1, off by `spread` (log-normal); delta_diag by half of it, theta_0 by a twenty-fifth."""
    own = {"delta_diag": spread / 2, "theta_0": spread / 25}
    return {name: value * float(np.exp(own.get(name, spread) * rng.normal())) for name, value in TABLE.items()}


def build(p: dict[str, float], block: Block = SOURCE) -> World:
    """Build the block with these parameters, on eight points."""
    half_w, half_h, w, h = block.width / 2, block.height / 2, block.width, block.height
    J = block.mass / 12 * np.diag([w**2 + h**2, w**2 + h**2, 2 * w**2])
    outer = np.column_stack([CORNERS * half_w, np.full(4, -half_h)])
    inner = outer.copy()
    inner[:, :2] -= CORNERS * p["delta_diag"] / np.sqrt(2)
    outer[:, 2] += [p[f"delta_long_{i}"] for i in (1, 2, 3, 4)]
    all_points, foot, external = np.vstack([outer, inner]), np.tile(np.arange(4), 2), np.arange(8) < 4
    props = np.zeros((8, len(POINT)))
    beta = np.where(external, p["beta_ext"], p["beta_int"])
    props[:, P["K_N"]], props[:, P["K_T"]] = p["K_N"], p["K_T"]
    props[:, P["C_N"]] = 2 * beta * np.sqrt(p["K_N"] * block.mass)
    props[:, P["C_T"]] = 2 * beta * np.sqrt(p["K_T"] * block.mass)
    props[:, P["mu"]] = np.where(external, p["mu_ext"], p["mu_int"])
    world = World(all_points, props, foot, external, block.mass, J, np.zeros(len(GLOBALS)), np.zeros(3), Sensor())
    world["gravity"] = GRAVITY
    world["top"], world["bottom"] = half_h, -half_h
    for name, value in REFERENCES.items():
        world[name] = value
    return world
