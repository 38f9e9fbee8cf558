"""Numbers for the questions: short ones, drawn with Python's own generator, the same on every machine."""

from __future__ import annotations

import math
import random
from typing import Any

import numpy as np

from golden.generator.bounds.arithmetic import Digits, Doubles
from golden.independent import exact

#: Table 3.1 and the block, as plain numbers: the questions do not ask the model under test for their inputs.
MASS, WIDTH, DEPTH, HEIGHT, G = 54.0, 0.1, 0.1, 0.688, 9.81
TABLE = {"K_N": 6e7, "K_T": 5e7, "beta_int": 0.15, "beta_ext": 0.18, "mu_int": 0.30, "mu_ext": 0.25}
DELTA_LONG, DELTA_DIAG, THETA_0 = (0.010e-3, 0.040e-3, 0.092e-3, 0.058e-3), 6.0e-3, 0.1170


def short(value: float, bits: int = 16) -> float:
    """Return the nearest number with so few bits of mantissa: exact in float32 too, and short to write."""
    if value == 0 or not math.isfinite(value):
        return value
    mantissa, exponent = math.frexp(value)
    return math.ldexp(round(mantissa * 2**bits) / 2**bits, exponent)


class Draw:
    """A seeded source of short numbers and vectors; of numbers with all their bits where `bits` is 53."""

    def __init__(self, seed: int, bits: int = 16):
        self.random, self.bits = random.Random(seed), bits

    def between(self, low: float, high: float) -> float:
        """Draw uniformly between two numbers."""
        return short(low + (high - low) * self.random.random(), self.bits)

    def decade(self, low: float, high: float) -> float:
        """Draw uniformly in the logarithm."""
        return short(math.exp(math.log(low) + (math.log(high) - math.log(low)) * self.random.random()), self.bits)

    def vector(self, size: float, n: int = 3) -> np.ndarray:
        """Draw components between -size and size."""
        return np.array([self.between(-size, size) for _ in range(n)])

    def vectors(self, size: float, rows: int, n: int = 3) -> np.ndarray:
        """Draw so many vectors."""
        return np.stack([self.vector(size, n) for _ in range(rows)])

    def rotation(self, angle: float) -> np.ndarray:
        """Return a rotation matrix about a random axis by up to `angle` [rad]."""
        return rotation(self.vector(angle))


def rotation(Theta: Any) -> np.ndarray:
    """Return exp(Theta^) rounded once to float64: an input that does not depend on anybody's sine."""
    m = Digits()
    return np.array(exact.exponential([m.number(float(t)) for t in Theta], m), float)


def orthonormal(Lambda: np.ndarray) -> np.ndarray:
    """Return rotation nearest to a matrix that has drifted from one by rounding, rounded once: who keeps the pose as a
    quaternion gets the same. Newton's iteration in fifty digits; the drift, 1e-14 at most, is squared each time."""
    m = Digits()
    L = [[m.number(float(c)) for c in row] for row in Lambda]
    for _ in range(3):
        LLL = exact.product(L, exact.product(exact.transposed(L), L))
        L = [[(3 * L[i][j] - LLL[i][j]) / 2 for j in range(3)] for i in range(3)]
    return np.array(L, float)


def turned(Lambda: np.ndarray, P: np.ndarray) -> np.ndarray:
    """Return Lambda p for every row of P, summed left to right: NumPy's own product has other bits on other
    machines."""
    return np.array([exact.apply(Lambda.tolist(), p) for p in P.tolist()])


def normalised(a: np.ndarray) -> np.ndarray:
    """Return a vector of length one."""
    return a / math.sqrt(exact.dot(a.tolist(), a.tolist()))


def diagonal(*values: float) -> np.ndarray:
    """Return a diagonal matrix."""
    return np.diag(np.array(values))


def table_3_1(mu: float | None = None, mu_0: float | None = None, delta_long: Any = DELTA_LONG) -> dict[str, Any]:
    """Return block on its eight points by Table 3.1, as flat inputs in float64; with another friction where given."""
    J = exact.cuboid_inertia(MASS, WIDTH, DEPTH, HEIGHT)
    P = exact.contact_points(WIDTH, DEPTH, HEIGHT, list(delta_long), DELTA_DIAG, Doubles)
    made = exact.properties(MASS, **TABLE, m=Doubles)
    q: dict[str, Any] = {"mass": MASS, "g": G, "inertia": np.array(J), "P": np.array(P)}
    q |= {k: np.array(v) for k, v in made.items()}
    if mu is not None:
        q |= {"mu": np.full(8, mu), "mu_0": np.full(8, mu if mu_0 is None else mu_0)}
    return q
