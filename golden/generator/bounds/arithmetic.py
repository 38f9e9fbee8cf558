"""The numbers in which `exact` computes: fifty digits, double, longdouble, and numbers that round at random."""

from __future__ import annotations

import math
import operator
import random
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np


class Digits:
    """mpmath with fifty decimal digits: the expected values."""

    route = "mpmath-50"

    def __init__(self, digits: int = 50):
        context = mpmath.mp.clone()
        context.dps = digits
        self.number, self.sqrt, self.sin, self.cos = context.mpf, context.sqrt, context.sin, context.cos
        self.hypot, self.pi = context.hypot, +context.pi


class Doubles:
    """Plain float64, one operation after the other."""

    number, sqrt, hypot, sin, cos, pi = float, math.sqrt, math.hypot, math.sin, math.cos, math.pi


class LongDoubles:
    """numpy.longdouble: 64 bits of mantissa where the processor has them."""

    route = "longdouble"
    number, sqrt, hypot, sin, cos = np.longdouble, np.sqrt, np.hypot, np.sin, np.cos
    pi = 4 * np.arctan(np.longdouble(1))


def _rounded(operation: Callable[[Any, Any], Any]) -> Any:
    """Return an operation of two numbers that is done in the wider precision, and rounded at random."""

    def done(self: _Rounded, other: Any) -> _Rounded:
        return self.made(operation(*self._wide(other)))

    return done


class _Rounded(float):
    """A float whose every inexact operation rounds up or down at random (Monte Carlo arithmetic)."""

    __slots__ = ()
    draw: Any = None
    single = False

    @classmethod
    def made(cls, exact: Any) -> _Rounded:
        """Return `exact` (a longdouble, or a float for single precision) rounded to one of its two neighbours."""
        near = np.float32(exact) if cls.single else np.float64(exact)
        if near == exact or not np.isfinite(near):
            return cls(near)
        towards = np.inf if exact > near else -np.inf
        return cls(np.nextafter(near, near.dtype.type(towards)) if cls.draw() < 0.5 else near)

    def _wide(self, other: Any) -> tuple[Any, Any]:
        return (float(self), float(other)) if self.single else (np.longdouble(self), np.longdouble(other))

    __add__ = __radd__ = _rounded(operator.add)
    __mul__ = __rmul__ = _rounded(operator.mul)
    __sub__, __rsub__ = _rounded(operator.sub), _rounded(lambda a, b: b - a)
    __truediv__, __rtruediv__ = _rounded(operator.truediv), _rounded(lambda a, b: b / a)

    def __neg__(self) -> _Rounded:
        return type(self)(-float(self))


class RandomRounding:
    """Arithmetic that rounds at random, in double or single precision; one seed, one course of roundings."""

    def __init__(self, seed: int, single: bool = False):
        draw = random.Random(seed).random
        self.kind: Any = type("Rounded", (_Rounded,), {"draw": staticmethod(draw), "single": single, "__slots__": ()})
        self.single = single
        self.pi = self.number(np.float32(math.pi) if single else math.pi)

    def number(self, value: Any) -> _Rounded:
        """Return an input; in single precision rounded (at random) to it."""
        return self.kind.made(float(value))

    def _wide(self, function: Any, x: Any) -> _Rounded:
        return self.kind.made(float(function(float(x))) if self.single else function(np.longdouble(x)))

    def sqrt(self, x: Any) -> _Rounded:
        """Return the square root."""
        return self._wide(np.sqrt, x)

    def hypot(self, x: Any, y: Any) -> _Rounded:
        wide = float if self.single else np.longdouble
        return self.kind.made(np.hypot(wide(x), wide(y)))

    def sin(self, x: Any) -> _Rounded:
        return self._wide(np.sin, x)

    def cos(self, x: Any) -> _Rounded:
        return self._wide(np.cos, x)


def converted(value: Any, number: Any) -> Any:
    """Return nested lists of `number` from arrays; flags, names and whole numbers of steps stay."""
    if isinstance(value, np.ndarray):
        return converted(value.tolist(), number)
    if isinstance(value, list):
        return [converted(v, number) for v in value]
    return number(value) if isinstance(value, float) else value
