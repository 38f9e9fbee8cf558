"""What an effect is: parameters with units and ranges, and the one term of the step that it changes."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any, ClassVar, NamedTuple

import numpy as np

from rockref.effects.prior import Prior
from rockref.model.errors import InputError

#: Least value of a quantity that must be above zero: the smallest normal float64.
POSITIVE = 2.2250738585072014e-308

#: The methods by which an effect acts, in the order of the step, with the names of their arguments.
HOOKS = {
    "points": ("block", "points"),
    "release": ("block", "points", "state"),
    "start": ("problem",),
    "plate_motion": ("t", "m"),
    "normal_force": ("F", "k", "points", "m"),
    "friction_coefficient": ("mu_0", "mu", "F_N", "k", "points", "m"),
    "point_wrench": ("problem", "c", "m"),
    "body_wrench": ("problem", "c", "x", "Lambda", "v", "W", "m"),
    "advance": ("problem", "c", "h", "m"),
    "sensor": ("t", "crv"),
}

#: The methods by which an effect of the sensor is taken back out of a record, with the names of their arguments.
UNDO_HOOKS = {"undo": ("t", "crv"), "heard": ("t", "crv")}

#: Where an effect stands in the measured channel: before the data sheet's low-pass; after it; at the recorder's clock,
#: which says when a sample is taken; at the samples, which it cuts.
STAGES = ("mounting", "electronics", "clock", "samples")


class Quantity(NamedTuple):
    """What is known of one parameter of an effect.

    unit ("1" for a plain number); absent: the value at which the effect is not there; low, high: plausible range;
    typical: typical size; sign: "+" where only values above the absent one are physical (positive ones, of a parameter
    that shapes the effect but does not bring it in), else "any"; meaning: a few words; least, most: hard limits, beyond
    which the value is unphysical and refused.
    """

    unit: str
    absent: float | None
    low: float
    high: float
    typical: float | None
    sign: str = "any"
    meaning: str = ""
    least: float = -math.inf
    most: float = math.inf

    @property
    def suffix(self) -> str:
        """Return the unit as it stands behind a number, " N m"; nothing where the number is plain."""
        return "" if self.unit == "1" else f" {self.unit}"


@dataclass(frozen=True)
class Effect:
    """Base of all effects: every hook leaves the law alone. A subclass overrides the one that it changes.

    Class attributes: `id` (appears in files and verdicts), `file` (of a user's own), `question` (the folder),
    `quantities` (one Quantity per parameter), `switches` (the parameters that bring the effect in; None: all of them),
    `sentence` (the physics), `equation` (LaTeX), `source` (with DOI where there is one), `confounder` (id),
    `experiment` (what would tell them apart), `stage` (where in the measured channel it stands), `only_on` (the points
    that a model must have, "four_points"; empty: any), `not_shaken` (why it cannot act on a plate that moves,
    after "it"; empty: it can).
    For fits: `priors` (what `rockref.effects.scale` does not get from a Quantity), `seeds` (values, the others typical,
    to start from beside zero, where a small step shows nothing), `of_run` (a size and its phase that every run has of
    its own: a fit finds their cosine and sine parts), `not_with_block` (quantities of a film or a floor, which do
    not grow with the block: `rockref.effects.natural`), `by_ratio` (factors that only act by their ratios: a common one
    is a number of the law; a fit holds their geometric mean at one), `anywhere` (quantities that are feet, as the law's
    own: where a fit starts over the whole prior, they are drawn between low and high).
    The hooks in the order of the step. Arrays as in the model; `m` is the effect's own memory, whose entries may be
    replaced (never changed in place).

    >>> from dataclasses import dataclass
    >>> import numpy as np
    >>> from rockref import Model, simulate
    >>> from rockref.effects.base import Effect, Quantity
    >>> @dataclass(frozen=True)
    ... class Wind(Effect):
    ...     id = "wind"
    ...     quantities = {"force": Quantity("N", absent=0.0, low=0.0, high=5.0, typical=1.0)}
    ...     force: float = 0.0
    ...     def body_wrench(self, problem, c, x, Lambda, v, W, m):
    ...         return self.force * np.array([0.0, 1.0, 0.0]) + 0 * x, 0 * x
    >>> Wind().is_absent(), Wind.typical()
    (True, Wind(force=1.0))
    >>> calm, windy = (simulate(Model(effects=(Wind(F),)), duration=1e-3).crv[-1, 0] for F in (0.0, 1.0))
    >>> bool(windy < calm)  # it pushes against the fall
    True
    """

    id: ClassVar[str] = "none"
    file: ClassVar[str | None] = None
    question: ClassVar[str] = ""
    quantities: ClassVar[dict[str, Quantity]] = {}
    switches: ClassVar[tuple[str, ...] | None] = None
    sentence: ClassVar[str] = ""
    equation: ClassVar[str] = ""
    source: ClassVar[str] = ""
    confounder: ClassVar[str] = ""
    experiment: ClassVar[str] = ""
    stage: ClassVar[str] = "electronics"
    only_on: ClassVar[str] = ""
    not_shaken: ClassVar[str] = ""
    priors: ClassVar[dict[str, Prior]] = {}
    seeds: ClassVar[tuple[dict[str, float], ...]] = ()
    of_run: ClassVar[tuple[str, str] | tuple[()]] = ()
    not_with_block: ClassVar[tuple[str, ...]] = ()
    by_ratio: ClassVar[tuple[str, ...]] = ()
    anywhere: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def typical(cls) -> Effect:
        """Return the effect at its typical size."""
        return cls(**{name: q.typical for name, q in cls.quantities.items()})

    @classmethod
    def seeds_in(cls, records) -> tuple[dict[str, float], ...]:
        """Return finite starts, as `seeds`, that records suggest: of each run times (N,) [s] and rates (N, 3)
        [rad/s]."""
        return cls.seeds

    @classmethod
    def largest_on(cls, name: str, width: float, depth: float) -> float:
        """Return largest value of a parameter that a base with these sides [m] has room for; infinite unless it is a
        place."""
        return math.inf

    def within(self, width: float, depth: float) -> Effect:
        """Return the effect that a fit makes of this one on a base with these sides [m]: places for which there is no
        room are drawn inside."""
        return self

    def values(self) -> dict[str, Any]:
        """Return the parameters by name."""
        return {f.name: getattr(self, f.name) for f in fields(self)}

    def is_absent(self) -> bool:
        """Return whether every parameter that can switch the effect off is at the value at which it is absent."""
        names = self.quantities if self.switches is None else self.switches
        return all(getattr(self, name) == self.quantities[name].absent for name in names)

    def check(self, where: str) -> None:
        """Refuse values that are no numbers or are unphysical. Raises InputError (E-TYPE, E-RANGE)."""
        for name, given in self.values().items():
            q, place, value = self.quantities[name], f"{where}: {self.id} {name}", as_float(given)
            if value is None and q.absent is None:
                continue
            if isinstance(value, bool) or not isinstance(value, (int, float)) or math.isnan(value):
                raise InputError("E-TYPE", place, f"is {value!r}", f"Give a number{q.suffix and ', in' + q.suffix}.")
            if value == q.absent:
                continue
            if not (math.isfinite(value) and q.least <= value <= q.most):
                raise InputError("E-RANGE", place, f"is {value!r}{q.suffix}", f"Give {limits(q)}.")

    def points(self, block, points):
        """Return geometry, mass, properties of the points: returns (Block, ContactPoints). Once, before the run."""
        return block, points

    def release(self, block, points, state):
        """Return the state at release: returns a State. Once, before the run."""
        return state

    def start(self, problem) -> dict[str, Any]:
        """Return the effect's own memory at the start (arrays with the batch's leading axes)."""
        return {}

    def plate_motion(self, t, m):
        """Return None, or displacement and velocity of the plate, two (..., 3) [m, m/s].

        Where it turns, its small turn about the origin and the rate of that follow, two (..., 3) [rad, rad/s].
        """
        return None

    def normal_force(self, F, k, points, m):
        """Return spring and damper of every point, (..., n) [N], K_N xi + C_N xi_rate in the law; k: Kinematics.

        What comes out negative, or belongs to a point above the plate, is cut to zero afterwards.
        """
        return F

    def friction_coefficient(self, mu_0, mu, F_N, k, points, m):
        """Return static and dynamic friction coefficient, two (..., n)."""
        return mu_0, mu

    def point_wrench(self, problem, c, m):
        """Return None, or a further force and moment (plate axes, about the centre of mass) from the points; c:
        Contact."""
        return None

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        """Return None, or a further force (..., 3) [N] and moment (..., 3) [N m] on the body, plate axes."""
        return None

    def advance(self, problem, c, h, m):
        """Advance own degrees of freedom by one step h: replaces entries of m."""

    def sensor(self, t, crv):
        """Return what the gyroscope makes of the crv, (..., N, 3) [rad/s] at the instants t (N,) [s]."""
        return crv

    def undo(self, t, crv):
        """Return true instants (N,) [s] and rates (..., N, 3) [rad/s] of what `sensor` shows as crv at t: its
        inverse."""
        return t, crv

    def heard(self, t, crv):
        """Return which of the shown rates tell the true ones: truths (..., N, 3); False where `undo` cannot know."""
        return np.ones(np.shape(crv), bool)

    @classmethod
    def changes_target(cls) -> bool:
        """Return whether the true rates behind a record depend on this effect: whether `undo` is not the default."""
        return cls.undo is not Effect.undo


def as_float(value: Any) -> Any:
    """Return a whole number as a float, infinite where it is larger than every float; anything else as it is."""
    if isinstance(value, bool) or not isinstance(value, int):
        return value
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def in_json(value: float | None) -> float | str | None:
    """Return a number as JSON holds it: an infinite one as a word, what is open as null."""
    if value is None or math.isnan(value):
        return None
    return value if math.isfinite(value) else str(value)


def implausible(effect: Effect) -> list[tuple[str, str, str]]:
    """Return parameters that lie outside what is plausible: (name, what it is, the range), in words.

    A value that is absent is fine: there is nothing to be plausible.
    """
    found = []
    for name, value in effect.values().items():
        q = effect.quantities[name]
        if value is not None and value != q.absent and not q.low <= value <= q.high:
            found.append((name, f"is {value:g}{q.suffix}", f"{q.low:g} to {q.high:g}{q.suffix}"))
    return found


def limits(q: Quantity) -> str:
    """Return what a quantity may be, in words: the hard limits, then the plausible range."""
    unit = q.suffix
    low = "above 0" if q.least == POSITIVE else f"of at least {q.least:g}{unit}" if math.isfinite(q.least) else ""
    high = f"of at most {q.most:g}{unit}" if math.isfinite(q.most) else ""
    hard = " and ".join(a for a in (low, high) if a) or "that is finite"
    return f"a number {hard}; plausible is {q.low:g} to {q.high:g}{unit}"
