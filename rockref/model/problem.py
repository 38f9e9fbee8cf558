"""What is simulated: the block, its contact points, the state from which it starts. Frozen, arrays only."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.rotation import empty
from rockref.model.shown import Shown, span

#: Standard value of the source's model; the excerpt states none. Decided: 9.81 m/s2.
GRAVITY = 9.81


@dataclass(frozen=True, repr=False)
class Block(Shown):
    """The rigid body: mass (...) [kg]; inertia about its centre, body axes (..., 3, 3) [kg m2]; g (...) [m/s2]."""

    mass: np.ndarray
    inertia: np.ndarray
    g: np.ndarray

    def sides(self) -> np.ndarray:
        """Return sides (..., 3) [m] of the uniform cuboid with this mass and these moments of inertia about X, Y, Z.

        A side is NaN where no cuboid has such moments.

        >>> import rockref
        >>> print(rockref.Model.table_3_1().body()[0].sides().round(3))
        [0.1   0.1   0.688]
        """
        moments = np.diagonal(np.asarray(self.inertia, float), axis1=-2, axis2=-1)
        squares = 6.0 * (moments.sum(axis=-1, keepdims=True) - 2.0 * moments) / np.asarray(self.mass)[..., None]
        return np.sqrt(np.where(squares > 0.0, squares, np.nan))

    def facts(self) -> dict[str, str]:
        """Return mass, sides as of a uniform cuboid, and gravity, in words."""
        sides = " x ".join(span(side) for side in np.moveaxis(self.sides(), -1, 0))
        return {"mass": span(self.mass, "kg"), "as a cuboid": f"{sides} m", "gravity": span(self.g, "m/s2")}


@dataclass(frozen=True, repr=False)
class ContactPoints(Shown):
    """The n contact points and what each is made of.

    P : (..., n, 3) position from the centre of mass, body axes [m]
    K_N, K_T : (..., n) normal and tangential stiffness [N/m];  C_N, C_T : damping [N s/m]
    mu_0, mu : (..., n) static and dynamic friction coefficient
    radius : (..., n) foot radius [m], or None for the point feet of the source
    names : n labels, for example "1ext"
    """

    P: np.ndarray
    K_N: np.ndarray
    K_T: np.ndarray
    C_N: np.ndarray
    C_T: np.ndarray
    mu_0: np.ndarray
    mu: np.ndarray
    radius: np.ndarray | None
    names: tuple[str, ...]

    @property
    def n(self) -> int:
        """Return how many points there are."""
        return self.P.shape[-2]

    def facts(self) -> dict[str, str]:
        """Return number and names of the points, where they lie, and what they are made of, in words."""
        reach = " x ".join(span(np.ptp(self.P[..., axis], axis=-1)) for axis in (0, 1))
        named = f" ({self.names[0]} to {self.names[-1]})" if self.names else ""
        found = {
            "points": f"{self.n}{named}",
            "reach": f"{reach} m",
            "uneven by": span(1e3 * np.ptp(self.P[..., 2], axis=-1), "mm"),
            "K_N": span(self.K_N, "N/m"),
            "K_T": span(self.K_T, "N/m"),
            "mu": span(self.mu),
        }
        return found if self.radius is None else found | {"radius": span(self.radius, "m")}


@dataclass(frozen=True, repr=False)
class State(Shown):
    """Everything that the next step needs: restarting from it continues the run bit for bit.

    x, v : (..., 3) position [m] and velocity [m/s] of the centre of mass, plate axes
    Lambda : (..., 3, 3) rotation, body to plate;  W : (..., 3) convected rotational velocity (crv), body axes [rad/s]
    s : (..., n, 2) anchors on the plate [m];  anchored : (..., n) bool, whether they are valid
    sliding : (..., n) bool, whether the point was sliding
    a : (..., 3) acceleration [m/s2];  T : (..., 3) moment in body axes [N m];  F : (..., n, 3) point forces [N], all
        of the last force evaluation; None where it has not been made yet (the run then makes it first)
    t : time [s], counted as origin + count * h, so that a restart counts on without rounding anew
    memory : one mapping of arrays per effect, its own state
    """

    x: np.ndarray
    v: np.ndarray
    Lambda: np.ndarray
    W: np.ndarray
    s: np.ndarray
    anchored: np.ndarray
    sliding: np.ndarray
    a: np.ndarray | None = None
    T: np.ndarray | None = None
    F: np.ndarray | None = None
    t: float = 0.0
    origin: float = 0.0
    count: int = 0
    h: float = 0.0
    memory: tuple[dict[str, np.ndarray], ...] = ()

    @classmethod
    def at_rest(cls, x: Any, Lambda: Any, n: int, v: Any = None, W: Any = None) -> State:
        """Return a state without contact history: x (..., 3), Lambda (..., 3, 3), n points, rates zero where not
        given."""
        x = np.asarray(x)
        batch = x.shape[:-1]
        return cls(
            x=x,
            v=np.zeros_like(x) if v is None else np.asarray(v),
            Lambda=np.asarray(Lambda),
            W=np.zeros_like(x) if W is None else np.asarray(W),
            s=np.zeros(batch + (n, 2), x.dtype),
            anchored=np.zeros(batch + (n,), bool),
            sliding=np.zeros(batch + (n,), bool),
        )

    def lean(self) -> np.ndarray:
        """Return the angle of the body's height from the vertical (...) [rad]."""
        return np.arctan2(np.hypot(self.Lambda[..., 0, 2], self.Lambda[..., 1, 2]), self.Lambda[..., 2, 2])

    def facts(self) -> dict[str, str]:
        """Return time, lean, rates, and how many points touch, in words."""
        return {
            "time": f"{float(self.t):.6g} s",
            "lean": span(np.degrees(self.lean()), "deg"),
            "speed": span(np.linalg.norm(self.v, axis=-1), "m/s"),
            "rate": span(np.degrees(np.linalg.norm(self.W, axis=-1)), "deg/s"),
            "touching": f"{span(np.sum(self.anchored, axis=-1))} of {self.anchored.shape[-1]} points",
        }


def complete_state(**fields) -> State:
    """Return a State from all its fields, which are taken as they are.

    A frozen dataclass assigns its fields one by one with a check; fifteen of them would cost a step a thirtieth of its
    time.
    """
    state = object.__new__(State)
    state.__dict__.update(fields)
    return state


@dataclass(frozen=True, repr=False)
class Problem(Shown):
    """One run, or a batch of runs side by side (leading axes): what `simulate` of every engine takes.

    step, duration [s]; output_rate [Hz]; effects in the order in which they act (empty: the law alone); base: how the
    plate moves, the same for the runs of a batch (None: it stands still); first_by_share: whether the first force of a
    contact counts by the share of its step in which the points touch, as runs that listen have it; the law does not.
    """

    block: Block
    points: ContactPoints
    start: State
    step: float
    duration: float
    output_rate: float
    effects: tuple[Any, ...] = ()
    labels: dict[str, Any] = field(default_factory=dict)
    base: BaseMotion | None = None
    first_by_share: bool = False

    def replace(self, **changes: Any) -> Problem:
        """Return a copy with some fields changed."""
        return replace(self, **changes)

    @property
    def batch(self) -> tuple[int, ...]:
        """Return shape of the leading axes; () for one block."""
        return self.start.x.shape[:-1]

    def facts(self) -> dict[str, str]:
        """Return block, feet, start, plate, effects and time step, in words."""
        block, points = self.block.facts(), self.points.facts()
        batch = {"blocks": " x ".join(map(str, self.batch))} if self.batch else {}
        plate = {} if self.base is None else {"plate": f"moves as {self.base.name or 'a record'} does"}
        return {
            **batch,
            "mass": block["mass"],
            "as a cuboid": block["as a cuboid"],
            "points": points["points"],
            "lean at start": self.start.facts()["lean"],
            **plate,
            "effects": ", ".join(effect.id for effect in self.effects) or "none",
            "duration": f"{self.duration:g} s",
            "step": f"{self.step:g} s",
        }


#: What the law can be computed in.
PRECISIONS = tuple(np.dtype(real) for real in (np.float32, np.float64, np.longdouble))

ARRAYS_OF_BLOCK = {"mass": 0, "inertia": 2, "g": 0}
ARRAYS_OF_POINTS = {"P": 2, "K_N": 1, "K_T": 1, "C_N": 1, "C_T": 1, "mu_0": 1, "mu": 1, "radius": 1}
ARRAYS_OF_STATE = {"x": 1, "v": 1, "Lambda": 2, "W": 1, "s": 2, "anchored": 1, "sliding": 1, "a": 1, "T": 1, "F": 2}


def batch_fastest(a: np.ndarray, core_axes: int, batch: tuple[int, ...], dtype) -> np.ndarray:
    """Return a copy of `a`, broadcast to the batch, in the memory order of `rotation.empty`."""
    a = np.asarray(a)
    core = a.shape[a.ndim - core_axes :]
    b = empty(batch, core, bool if a.dtype == bool else dtype)
    b[...] = a
    return b


def _convert(thing, axes: dict[str, int], batch, dtype):
    values = {k: getattr(thing, k) for k in axes}
    return replace(
        thing, **{k: None if a is None else batch_fastest(a, axes[k], batch, dtype) for k, a in values.items()}
    )


def precision(problem: Problem, dtype=None) -> np.dtype:
    """Return the precision of a problem: `dtype`, or that of the start's positions.

    Raises
    ------
    InputError
        E-TYPE, where it is not float32, float64 or longdouble.
    """
    try:
        found = np.dtype(problem.start.x.dtype if dtype is None else dtype)
    except TypeError:
        found = None
    if found is None or found not in PRECISIONS:  # NumPy takes None for float64
        what = f"is {dtype if found is None else found.name!s}"
        raise InputError("E-TYPE", "dtype", what, "Use float32, float64 or longdouble.")
    return found


def as_arrays(problem: Problem, dtype=None) -> Problem:
    """Return the same problem with every array of one dtype (float32, float64 or longdouble) and of the batch's shape.

    Without `dtype` the positions of the start decide. Raises InputError (E-TYPE) for another one.
    """
    dtype = precision(problem, dtype)
    batch = problem.batch
    return replace(
        problem,
        block=_convert(problem.block, ARRAYS_OF_BLOCK, batch, dtype),
        points=_convert(problem.points, ARRAYS_OF_POINTS, batch, dtype),
        start=_convert(problem.start, ARRAYS_OF_STATE, batch, dtype),
        base=None if problem.base is None else replace(problem.base, a=np.asarray(problem.base.a, dtype)),
    )


def _stack(things, axes: dict[str, int]):
    columns = {k: [getattr(thing, k) for thing in things] for k in axes}
    missing = [k for k, c in columns.items() if any(a is None for a in c) and not all(a is None for a in c)]
    if missing:
        raise InputError("E-STACK", missing[0], "is given for some of the problems only", "Give it for all of them.")
    return replace(things[0], **{k: None if c[0] is None else np.stack(c) for k, c in columns.items()})


def stack(problems: list[Problem]) -> Problem:
    """Stack many single problems side by side as one batch; step, duration, rate, effects and base motion must be the
    same

    Raises
    ------
    InputError
        E-STACK, where two problems differ in what a batch shares.
    """
    first = problems[0]
    for p in problems[1:]:
        for key in ("step", "duration", "output_rate", "effects", "base"):
            if getattr(p, key) != getattr(first, key):
                raise InputError("E-STACK", key, "differs between the problems of a batch", "Run them one by one.")
    return replace(
        first,
        block=_stack([p.block for p in problems], ARRAYS_OF_BLOCK),
        points=_stack([p.points for p in problems], ARRAYS_OF_POINTS),
        start=_stack([p.start for p in problems], ARRAYS_OF_STATE),
    )
