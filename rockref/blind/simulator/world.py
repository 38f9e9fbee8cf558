"""One block, its plate and its gyroscope, as the blind test draws them: what a hidden effect may change."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from rockref.blind.simulator.slots import GLOBALS, POINT, G, P

MASS, WIDTH, HEIGHT, GRAVITY = 54.0, 0.100, 0.688, 9.81
NOMINAL_TILT = 0.117
#: Table 3.1 of the model's source.
TABLE = {
    "K_N": 6e7, "K_T": 5e7, "beta_int": 0.15, "beta_ext": 0.18, "mu_int": 0.30, "mu_ext": 0.25,
    "delta_long_1": 1.0e-5, "delta_long_2": 4.0e-5, "delta_long_3": 9.2e-5, "delta_long_4": 5.8e-5,
    "delta_diag": 6e-3, "theta_0": NOMINAL_TILT,
}  # fmt: skip
CORNERS = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)], float)


@dataclass
class Sensor:
    """What the gyroscope adds: see :mod:`rockref.blind.simulator.recorder`. Rates in rad/s, frequencies in Hz."""

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

    def __getitem__(self, name: str) -> float:
        return float(self.g[G[name]])

    def __setitem__(self, name: str, value: float) -> None:
        self.g[G[name]] = value

    def scale(self, column: str, factors: np.ndarray) -> None:
        """Multiply a column of the points by a factor for each foot, (4,)."""
        self.props[:, P[column]] *= np.asarray(factors)[self.foot]


def draw_parameters(rng: np.random.Generator, spread: float = 0.10) -> dict[str, float]:
    """Table 3.1, off by `spread` (log-normal); delta_diag by half of it, theta_0 by a twenty-fifth."""
    own = {"delta_diag": spread / 2, "theta_0": spread / 25}
    return {name: value * float(np.exp(own.get(name, spread) * rng.normal())) for name, value in TABLE.items()}


def build(p: dict[str, float]) -> World:
    """The block with these parameters, on eight points."""
    half_w, half_h = WIDTH / 2, HEIGHT / 2
    J = MASS / 12 * np.diag([WIDTH**2 + HEIGHT**2, WIDTH**2 + HEIGHT**2, 2 * WIDTH**2])
    outer = np.column_stack([CORNERS * half_w, np.full(4, -half_h)])
    inner = outer.copy()
    inner[:, :2] -= CORNERS * p["delta_diag"] / np.sqrt(2)
    outer[:, 2] += [p[f"delta_long_{i}"] for i in (1, 2, 3, 4)]
    all_points, foot, external = np.vstack([outer, inner]), np.tile(np.arange(4), 2), np.arange(8) < 4
    props = np.zeros((8, len(POINT)))
    beta = np.where(external, p["beta_ext"], p["beta_int"])
    props[:, P["K_N"]], props[:, P["K_T"]] = p["K_N"], p["K_T"]
    props[:, P["C_N"]] = 2 * beta * np.sqrt(p["K_N"] * MASS)
    props[:, P["C_T"]] = 2 * beta * np.sqrt(p["K_T"] * MASS)
    props[:, P["mu"]] = np.where(external, p["mu_ext"], p["mu_int"])
    world = World(all_points, props, foot, external, MASS, J, np.zeros(len(GLOBALS)), np.zeros(3), Sensor())
    world["gravity"] = GRAVITY
    world["top"], world["bottom"] = half_h, -half_h
    return world
