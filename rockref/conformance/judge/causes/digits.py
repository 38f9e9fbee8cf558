"""Numbers that were cut to a few digits on their way out: a format is to blame for what they are off by, no rule."""

from __future__ import annotations

import math
from decimal import Decimal
from typing import Any

import numpy as np

from rockref.conformance.backends import richardson
from rockref.conformance.judge.causes.slips import pairs_of
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

#: Fifteen digits are what many languages print of a double by default, and pass. Decided: fewer are a format.
FEW = 14
#: Decided: of so many numbers with all their bits one at least has more digits.
LEAST = 30
#: A number that was rounded is off by half a unit of its last digit, one that was cut by a whole one.
CUT = 1.01
#: Layers of extrapolated rows, and how many times what the format takes away they are off by: the sum of the weights.
#: Their own digits tell of no format.
OFF = {"LS": sum(map(abs, richardson.WEIGHTS))}


def digits_of(x: float) -> tuple[int, int]:
    """Return the significant digits of a number, and its decimals, as its shortest decimal has them."""
    number = Decimal(repr(x)).normalize().as_tuple()
    return len(number.digits), max(0, -int(number.exponent))


class Format:
    """The most significant digits, or the most decimals, that any number of the answers has, told where they are few;
    or whether all are numbers of single precision.

    answers : vectors with their answers
    """

    def __init__(self, answers: list[tuple[Vector, dict[str, Any]]]):
        found = {float(x) for v, out in answers for p in pairs_of(v, out, set()) for x in full(p.expected, p.got)}
        counts = np.array([digits_of(x) for x in found]).reshape(-1, 2)
        most = counts.max(axis=0, initial=0)
        enough = len(counts) >= LEAST
        # Numbers of few decimals have few digits, too.
        self.decimals = int(most[1]) if enough and most[1] <= FEW else None
        self.digits = int(most[0]) if enough and self.decimals is None and most[0] <= FEW else None
        long = self.decimals is None and self.digits is None
        with np.errstate(over="ignore"):
            self.single = enough and long and all(float(np.float32(x)) == x for x in found)

    @property
    def words(self) -> str:
        """Return what is wrong with the format, and its cure; "" where nothing is."""
        if self.single:
            return "all numbers are those of single precision: hand out doubles, or be judged by --profile float32"
        if self.digits is None and self.decimals is None:
            return ""
        what = f"{self.decimals} decimals" if self.digits is None else f"{self.digits} significant digits"
        return (
            f"no number that is given has more than {what}: write 17 digits (%.17g), which read back to the same double"
        )

    def explains(self, check: Check) -> bool:
        """Return whether a check is outside by no more than the format takes away."""
        if check.got is None or check.expected is None or not math.isfinite(check.got):
            # Instants of the shortest steps are zero in few decimals.
            return check.name == "t" and self.decimals is not None
        return abs(check.got - check.expected) <= CUT * self.unit(abs(check.got)) * OFF.get(check.layer, 1)

    def unit(self, size: float) -> float:
        """Return the unit of the last place of a number of this size."""
        if self.single:
            return float(np.spacing(np.float32(size)))
        place = self.decimals if self.digits is None else self.digits - 1 - math.floor(math.log10(size)) if size else 0
        return 10.0 ** -(place or 0)


def cut_short(answers: list[tuple[Vector, dict[str, Any]]], failed: list[Check]) -> tuple[str, bool]:
    """Return the formats of the pieces in words, and whether they explain all failures. Where they do not, single
    precision alone is told: few digits beside a wrong rule are no news."""
    pieces = {v.id: v.piece for v, _ in answers}
    forms = {
        piece: Format([(v, out) for v, out in answers if v.piece == piece and v.layer not in OFF])
        for piece in dict.fromkeys(pieces[c.vector] for c in failed if c.vector in pieces)
    }
    blamed = [forms.get(pieces.get(c.vector, "")) for c in failed]
    pairs = zip(blamed, failed, strict=True)
    explained = bool(failed) and all(f is not None and f.words and f.explains(c) for f, c in pairs)
    told = [f.words for f in forms.values() if f.words and (explained or f.single)]
    return "; ".join(dict.fromkeys(told)), explained


def full(expected: np.ndarray, got: np.ndarray) -> np.ndarray:
    """Return the numbers that were given where those expected have all their digits."""
    long = [digits_of(float(x))[0] > FEW for x in expected.ravel()]
    return np.asarray(got, float).ravel()[np.array(long, bool)]
