"""What is searched: genes with unit, range and scale, and the model that a chromosome stands for.

A chromosome is held in units of its ranges, u in [0, 1], so that the search and the least squares see every gene at the
same size. Stiffness, damping and friction are searched by their logarithm: their ranges span factors.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rockref.api import Model
from rockref.model.errors import InputError
from rockref.model.parameters import GENES_12, PROPERTIES, TABLE_3_1, Parameters

#: Ranges in which the search looks. Decided: a decade for stiffness and damping and a factor of five for friction, each
#: about what steel on steel can be; heights of feet up to a tenth and a half of a millimetre; the inner points within
#: an eighth of the base. The source gives none. The release angle is bounded by what the experiment states, below.
RANGES = {
    "K_N": (2e7, 2e8),
    "K_T": (1.5e7, 1.5e8),
    "beta_int": (0.04, 0.4),
    "beta_ext": (0.04, 0.4),
    "mu_int": (0.12, 0.6),
    "mu_ext": (0.12, 0.6),
    "delta_long_1": (0.0, 0.15e-3),
    "delta_long_2": (0.0, 0.15e-3),
    "delta_long_3": (0.0, 0.15e-3),
    "delta_long_4": (0.0, 0.15e-3),
    "delta_diag": (1e-3, 12e-3),
}
#: Half the range of the release angle [rad]: the 1 mm of wire, 0.08 degrees, that the source gives as its uncertainty.
TILT_RANGE = float(np.radians(0.08))
LOGARITHMIC = ("K_N", "K_T", "C_N", "C_T", "beta_int", "beta_ext", "mu_int", "mu_ext", "mu_0", "mu")


@dataclass(frozen=True)
class Gene:
    """One number that is searched: between `low` and `high` in `unit`, by its logarithm or as it is."""

    name: str
    unit: str
    low: float
    high: float
    logarithmic: bool = False


@dataclass(frozen=True)
class Space:
    """The genes of a search and the kind of model that they make.

    kind : "12", "54", or a scenario of `rockref.identify.four_points`;  model : what the genes do not touch.
    """

    kind: str
    genes: tuple[Gene, ...]
    model: Model

    @property
    def names(self) -> tuple[str, ...]:
        """Return names of the genes."""
        return tuple(gene.name for gene in self.genes)

    def values(self, u: np.ndarray) -> np.ndarray:
        """Return values in the genes' units, (..., G), of u (..., G) in [0, 1]."""
        low, high, log = self._bounds()
        u = np.asarray(u, float)
        # Both branches are computed; ranges that begin at zero have no logarithm and take the other one.
        ratio = np.where(log, high / np.where(low > 0, low, 1), 1)
        return np.where(log, low * ratio**u, low + (high - low) * u)

    def units(self, values: np.ndarray) -> np.ndarray:
        """Return u (..., G) of values (..., G) in the genes' units; outside [0, 1] where a value is outside its
        range."""
        low, high, log = self._bounds()
        values = np.asarray(values, float)
        ratio = np.where(log, high / np.where(low > 0, low, 1), 2)
        by_log = np.log(np.where(log, values / np.where(low > 0, low, 1), 1)) / np.log(ratio)
        return np.where(log, by_log, (values - low) / (high - low))

    def slopes(self, u: np.ndarray) -> np.ndarray:
        """Return d(values)/d(u) at u, (..., G): what turns an error in u into one in the gene's unit."""
        low, high, log = self._bounds()
        ratio = np.where(log, high / np.where(low > 0, low, 1), math.e)
        return np.where(log, self.values(u) * np.log(ratio), high - low)

    def _bounds(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        columns = [(gene.low, gene.high, gene.logarithmic) for gene in self.genes]
        low, high, log = (np.array(c) for c in zip(*columns, strict=True))
        return low, high, log.astype(bool)


def genes_12(tilt: float) -> tuple[Gene, ...]:
    """Return the twelve genes of Table 3.1; the release angle about `tilt` [rad]."""
    return tuple(gene(name, tilt) for name in GENES_12)


def gene(name: str, tilt: float) -> Gene:
    """Return one of the twelve genes of Table 3.1."""
    unit = TABLE_3_1[name].unit
    if name == "theta_0":
        return Gene(name, unit, tilt - TILT_RANGE, tilt + TILT_RANGE)
    return Gene(name, unit, *RANGES[name], name in LOGARITHMIC)


def genes_54(tilt: float, mass: float) -> tuple[Gene, ...]:
    """Return the 54 genes: six properties of each of eight points, four heights, the diagonal, the release angle.

    The ranges are those of the twelve; damping C = 2 beta sqrt(K m) spans what they span together.
    """
    ranges = {"mu_0": RANGES["mu_int"], "mu": RANGES["mu_int"]}
    for direction in ("N", "T"):
        K = ranges[f"K_{direction}"] = RANGES[f"K_{direction}"]
        ends = zip(RANGES["beta_int"], K, strict=True)
        low, high = (2 * beta * float(np.sqrt(k * mass)) for beta, k in ends)
        ranges[f"C_{direction}"] = low, high
    units = {"K": "N/m", "C": "N s/m", "m": "1"}
    points = [f"{i}ext" for i in range(1, 5)] + [f"{i}int" for i in range(1, 5)]
    per_point = [Gene(f"{p} {k}", units[k[0]], *ranges[k], True) for p in points for k in PROPERTIES]
    return (*per_point, *genes_12(tilt)[6:])


def space_12(model: Model, tilt: float | None = None) -> Space:
    """Return the twelve genes on `model`'s block; the release angle about `tilt` [rad], by default the model's."""
    return Space("12", genes_12(model.parameters.theta_0 if tilt is None else tilt), model)


def space_54(model: Model, tilt: float | None = None) -> Space:
    """Return the 54 genes on `model`'s block; the release angle about `tilt` [rad], by default the model's."""
    return Space("54", genes_54(model.parameters.theta_0 if tilt is None else tilt, model.mass), model)


def chromosome(space: Space, parameters: Parameters) -> np.ndarray:
    """Return u (12,) of twelve parameters; for kind "12" only (E-KEY)."""
    from rockref.model.parameters import chromosome_12

    if space.kind != "12":
        raise InputError("E-KEY", "space", f"is of kind {space.kind!r}", 'Give one of kind "12".')
    return space.units(chromosome_12(parameters))
