"""Table 3.1, the 12-parameter chromosome, the 54-parameter one, and the maps between them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rockref.model.errors import InputError


class Given(NamedTuple):
    """A published value: number, unit, place of the last significant digit (stated precision), source."""

    value: float
    unit: str
    precision: float
    source: str


#: Optimal parameter values of the 8ACP model. "The number of significant digits in this table corresponds to the
#: precision required to have no significant changes in the response."
TABLE_3_1 = {
    "K_N": Given(6e7, "N/m", 1e7, "Table 3.1"),
    "K_T": Given(5e7, "N/m", 1e7, "Table 3.1"),
    "beta_int": Given(0.15, "1", 0.01, "Table 3.1"),
    "beta_ext": Given(0.18, "1", 0.01, "Table 3.1"),
    "mu_int": Given(0.30, "1", 0.01, "Table 3.1"),
    "mu_ext": Given(0.25, "1", 0.01, "Table 3.1"),
    "delta_long_1": Given(0.010e-3, "m", 0.001e-3, "Table 3.1"),
    "delta_long_2": Given(0.040e-3, "m", 0.001e-3, "Table 3.1"),
    "delta_long_3": Given(0.092e-3, "m", 0.001e-3, "Table 3.1"),
    "delta_long_4": Given(0.058e-3, "m", 0.001e-3, "Table 3.1"),
    "delta_diag": Given(6.0e-3, "m", 0.1e-3, "Table 3.1"),
    "theta_0": Given(0.1170, "rad", 0.0001, "Table 3.1"),
}

#: The block. The excerpt gives the mass only. Decided: a solid steel cuboid (7850 kg/m3) of 54 kg with a base of
#: 0.100 m; with it the first main impact comes at 0.51 s and the ninth to eleventh fall where the source plots them.
BLOCK = {
    "mass": Given(54.0, "kg", 1.0, '"m is the mass of the block (54 kg)"'),
    "width": Given(0.100, "m", 0.001, "decided"),
    "depth": Given(0.100, "m", 0.001, "decided"),
    "height": Given(0.688, "m", 0.001, "decided"),
}

GENES_12 = tuple(TABLE_3_1)
#: Six properties per point, in the order of the points, then the geometry and the tilt: 6 x 8 + 5 + 1 = 54.
PROPERTIES = ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")


#: No dry contact has more friction; decided: rubber has 1 to 4, and 50 is 0.50 in another unit.
MOST_FRICTION = 10.0


def check_friction(key: str, values) -> None:
    """Refuse friction coefficients, one or (n,), that no dry contact has (E-RANGE)."""
    most = float(np.max(values))
    if most > MOST_FRICTION:
        what = f"is {most!r}, and no dry contact has more than {MOST_FRICTION:g}"
        raise InputError("E-RANGE", key, what, "Give a friction coefficient, not per cent or degrees.")


@dataclass(frozen=True)
class Parameters:
    """The twelve parameters of the reduced model; units as in `TABLE_3_1`. `delta_long` holds four heights [m]."""

    K_N: float = TABLE_3_1["K_N"].value
    K_T: float = TABLE_3_1["K_T"].value
    beta_int: float = TABLE_3_1["beta_int"].value
    beta_ext: float = TABLE_3_1["beta_ext"].value
    mu_int: float = TABLE_3_1["mu_int"].value
    mu_ext: float = TABLE_3_1["mu_ext"].value
    delta_long: tuple[float, float, float, float] = (0.010e-3, 0.040e-3, 0.092e-3, 0.058e-3)
    delta_diag: float = TABLE_3_1["delta_diag"].value
    theta_0: float = TABLE_3_1["theta_0"].value

    def replace(self, **changes) -> Parameters:
        """Return a copy with some values changed; unknown names raise InputError (E-KEY)."""
        unknown = [k for k in changes if k not in self.__dataclass_fields__]
        if unknown:
            raise InputError("E-KEY", unknown[0], "is no parameter", f"Known: {', '.join(self.__dataclass_fields__)}.")
        if "delta_long" in changes:
            changes["delta_long"] = tuple(float(d) for d in changes["delta_long"])
        return replace(self, **changes)

    def number(self, key: str) -> float:
        """Return a parameter by its name in Table 3.1, as delta_long_1."""
        name, _, place = key.rpartition("_")
        return self.delta_long[int(place) - 1] if name == "delta_long" else float(getattr(self, key))

    def in_words(self, key: str) -> str:
        """Return a parameter by its name in Table 3.1, with its unit."""
        return f"{self.number(key):g} {TABLE_3_1[key].unit.removeprefix('1')}".rstrip()


def common_stiffness(K: float, n: int) -> np.ndarray:
    """Rule P1: the stiffness K [N/m] is common to all n points, internal and external. Source: (3.7)."""
    return np.full(n, float(K))  # (3.7)


def viscous_damping(beta: np.ndarray, K: np.ndarray, mass: float) -> np.ndarray:
    """Rule P2: C = 2 beta sqrt(K m) [N s/m] for each of (N), (T) and int., ext. Source: (3.8).

    beta : critical damping ratios; K : stiffnesses [N/m], same shape; mass [kg]. The root is lost in the excerpt's
    text; C is a damping only with it.
    """
    return 2 * beta * np.sqrt(K * mass)  # (3.8)


def common_damping_ratio(beta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rule P3: the same ratio in the normal and the tangential direction; (beta_N, beta_T). Source: (3.9)."""
    return beta, beta  # (3.9)


def point_properties(parameters: Parameters, mass: float, external: np.ndarray) -> dict[str, np.ndarray]:
    """Return the six properties of every point from the twelve parameters.

    external : (n,) bool, which points are external ones  ->  K_N, K_T, C_N, C_T, mu_0, mu, each (n,).
    """
    external = np.asarray(external)
    n = len(external)
    K_N, K_T = common_stiffness(parameters.K_N, n), common_stiffness(parameters.K_T, n)
    beta_N, beta_T = common_damping_ratio(np.where(external, parameters.beta_ext, parameters.beta_int))
    mu = np.where(external, parameters.mu_ext, parameters.mu_int)
    return {
        "K_N": K_N,
        "K_T": K_T,
        "C_N": viscous_damping(beta_N, K_N, mass),
        "C_T": viscous_damping(beta_T, K_T, mass),
        "mu_0": mu,
        "mu": mu.copy(),
    }


def chromosome_12(parameters: Parameters) -> np.ndarray:
    """Return the twelve genes in the order of Table 3.1, (12,)."""
    p = parameters
    return np.array([p.K_N, p.K_T, p.beta_int, p.beta_ext, p.mu_int, p.mu_ext, *p.delta_long, p.delta_diag, p.theta_0])


def from_chromosome_12(genes: np.ndarray) -> Parameters:
    """Return parameters from twelve genes, (12,)."""
    K_N, K_T, beta_int, beta_ext, mu_int, mu_ext, d1, d2, d3, d4, delta_diag, theta_0 = _genes(genes, 12)
    return Parameters(K_N, K_T, beta_int, beta_ext, mu_int, mu_ext, (d1, d2, d3, d4), delta_diag, theta_0)


def chromosome_54(parameters: Parameters, mass: float) -> np.ndarray:
    """Return the 54 genes: six properties for each of 1ext..4ext, 1int..4int, then delta_long, delta_diag, theta_0,
    (54,)."""
    properties = point_properties(parameters, mass, np.arange(8) < 4)
    per_point = np.stack([properties[k] for k in PROPERTIES], axis=-1).ravel()
    return np.concatenate([per_point, parameters.delta_long, [parameters.delta_diag, parameters.theta_0]])


def split_54(genes: np.ndarray) -> tuple[dict[str, np.ndarray], np.ndarray, float, float]:
    """Return properties of the eight points, delta_long (4,) [m], delta_diag [m], theta_0 [rad] from 54 genes."""
    g = np.array(_genes(genes, 54))
    per_point = g[:48].reshape(8, 6)
    return {k: per_point[:, i] for i, k in enumerate(PROPERTIES)}, g[48:52], float(g[52]), float(g[53])


def _genes(genes: np.ndarray, n: int) -> list[float]:
    genes = np.asarray(genes)
    if genes.shape != (n,):
        raise InputError("E-SHAPE", "chromosome", f"has shape {genes.shape}", f"Give {n} genes.")
    return [float(g) for g in genes]
