"""The public face: `Model`, what a user describes, and `simulate`."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from rockref import model_file
from rockref.effects.base import Effect
from rockref.effects.catalogue import in_step_order, parse
from rockref.engines import run
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.geometry import (
    EXTERNAL,
    INTERNAL,
    check_cuboid,
    check_inertia,
    check_number,
    check_plausible,
    cuboid_inertia,
    eight_points,
    four_points,
)
from rockref.model.parameters import BLOCK, GENES_12, PROPERTIES, Parameters, check_friction, point_properties, split_54
from rockref.model.problem import GRAVITY, Block, ContactPoints, Problem, State
from rockref.model.release import check_tilt, release_posture
from rockref.model.response import Response
from rockref.model.shown import Shown
from rockref.model.simulate import check_names, check_points
from rockref.model.standing import standing_posture

#: What `simulate` takes beside its own arguments.
OF_START = frozenset({"start", "turned", "out_of_plane", "theta_0", "body", "base", "standing", "heading"})
POINT_SETS = ("eight_points", "four_points", "custom")


def _same(a: Any, b: Any) -> bool:
    """Return whether two values of a model are equal, of arrays every number."""
    if isinstance(a, ContactPoints) and isinstance(b, ContactPoints):
        a, b = vars(a), vars(b)
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    return np.array_equal(a, b) if isinstance(a, np.ndarray) or isinstance(b, np.ndarray) else bool(a == b)


@dataclass(frozen=True)
class Model(Shown):
    """A block, its contact points, their parameters and the effects added to the law.

    mass [kg]; width, depth, height along X, Y, Z [m]; g [m/s2]; parameters: the twelve of Table 3.1
    points : "eight_points", "four_points", or "custom" (then `custom_points` gives everything)
    properties : optional, the six properties of every point (n each), for the 54-parameter model
    inertia : optional (3, 3) [kg m2], in place of the uniform cuboid's
    foot_radius : [m], zero in the source
    effects : in the order in which they act; or words, as "rolling_resistance:lever=3e-4", or a list of them
    uncertainty, origin : notes kept with the model (per parameter; where it came from)

    >>> from rockref import Model
    >>> from rockref.effects.catalogue import parse
    >>> source = Model.table_3_1()
    >>> light = source.replace(mass=27.0, mu_ext=0.2, effects=(parse("quadratic_drag:c=0.4"),))
    >>> source.parameters.mu_ext, light.parameters.mu_ext, [e.id for e in light.effects]
    (0.25, 0.2, ['quadratic_drag'])
    >>> block, points = light.body()
    >>> print(block.mass, points.names)
    27.0 ('1ext', '2ext', '3ext', '4ext', '1int', '2int', '3int', '4int')
    """

    mass: float = BLOCK["mass"].value
    width: float = BLOCK["width"].value
    depth: float = BLOCK["depth"].value
    height: float = BLOCK["height"].value
    g: float = GRAVITY
    parameters: Parameters = field(default_factory=Parameters)
    points: str = "eight_points"
    properties: dict[str, np.ndarray] | None = None
    custom_points: ContactPoints | None = None
    inertia: np.ndarray | None = None
    foot_radius: float = 0.0
    effects: tuple[Effect, ...] = ()
    uncertainty: dict[str, Any] = field(default_factory=dict)
    origin: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Read effects that are given in words. Raises InputError (E-TYPE, E-EFFECT, ...)."""
        object.__setattr__(self, "effects", effects_of(self.effects))
        if not isinstance(self.parameters, Parameters):
            cure = "Give Parameters(...), or its numbers to Model.replace: replace(K_N=6e7)."
            raise InputError("E-TYPE", "parameters", f"is {self.parameters!r}"[:80], cure)

    def __repr__(self) -> str:
        """Return the block in a line."""
        effects = ", ".join(effect.id for effect in self.effects) or "no effects"
        sides = f"{self.width} x {self.depth} x {self.height} m"
        return f"<Model: {self.mass} kg, {sides}, {self.points}, {effects}>"

    def facts(self) -> dict[str, str]:
        """Return block, points, acting parameters and effects, in words, for the table of a notebook."""
        sides = f"{self.width:g} x {self.depth:g} x {self.height:g} m"
        numbers = {key: self.parameters.in_words(key) for key in self.acting_parameters()}
        effects = "; ".join(f"{e.id}: {', '.join(f'{k} {v}' for k, v in e.values().items())}" for e in self.effects)
        return {"mass": f"{self.mass:g} kg", "sides": sides, "points": self.points, **numbers,
                "effects": effects or "none"}  # fmt: skip

    def summary(self) -> str:
        """Return block, parameters and effects, a line each, as one would put them in an e-mail."""
        numbers = [f"{key} {self.parameters.number(key):g}" for key in self.acting_parameters()]
        effects = [f"{e.id}: {', '.join(f'{k} {v}' for k, v in e.values().items())}" for e in self.effects]
        return "\n".join([repr(self)[1:-1], ", ".join(numbers), *effects])

    def __eq__(self, other: object) -> bool:
        """Return whether two models have the same values, arrays and notes included."""
        return _same(vars(self), vars(other)) if isinstance(other, Model) else NotImplemented

    @classmethod
    def table_3_1(cls) -> Model:
        """Return the model of the source: eight points, Table 3.1."""
        return cls(origin={"source": "Table 3.1"})

    @classmethod
    def four_points(cls) -> Model:
        """Return the model that the source's authors tried first: four corners, Table 3.1's external properties."""
        return cls(points="four_points", origin={"source": "Table 3.1, four points"})

    @classmethod
    def from_chromosome_54(cls, genes: np.ndarray, **changes: Any) -> Model:
        """Return a model from 54 genes (see `rockref.model.parameters.chromosome_54`)."""
        properties, delta_long, delta_diag, theta_0 = split_54(genes)
        parameters = Parameters(delta_diag=delta_diag, theta_0=theta_0).replace(delta_long=delta_long)
        return cls(parameters=parameters, properties=properties, **changes)

    @classmethod
    def load(cls, path: str | os.PathLike, effects: Sequence[str] = ()) -> Model:
        """Read a model from a TOML file.

        effects : the user's own effects that the file may have, each "path/to/file.py:Class". A file of effects is
        Python; only those that are named here, or were named before in this process, are run.

        Raises InputError that names the file and the key (E-TRUST for an effect that was not named).

        >>> import tempfile
        >>> from rockref import Model
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     Model(mass=60.0).save(f"{folder}/mine.toml")
        ...     Model.load(f"{folder}/mine.toml").mass
        60.0
        """
        return model_file.load(cls, path, effects)

    def save(self, path: str | os.PathLike) -> None:
        """Write the model to a TOML file, whole or not at all."""
        model_file.save(self, path)

    def replace(self, **changes: Any) -> Model:
        """Return a copy with some values changed: fields of the model, or parameters by name (K_N=..., theta_0=...)."""
        own = {f.name for f in fields(self)}
        known = set(Parameters.__dataclass_fields__) - own
        of_parameters = {k: changes.pop(k) for k in list(changes) if k in known}
        unknown = [k for k in changes if k not in own]
        if unknown:
            raise model_file.unknown_key("Model.replace", unknown[0], own | set(Parameters.__dataclass_fields__))
        if of_parameters:
            changes["parameters"] = changes.get("parameters", self.parameters).replace(**of_parameters)
        return replace(self, **changes)

    def check(self) -> None:
        """Refuse values that make no block, that no block has, and a release tilt from which the block falls over.

        Raises InputError (E-RANGE, E-KEY, E-SHAPE, E-TYPE, E-TILT). A file is loaded only if its model passes.
        """
        self.check_values()
        p = self.parameters
        check_plausible(self.width, self.depth, self.height, p.delta_long, self.foot_radius)
        for key in ("mu_int", "mu_ext"):
            check_friction(key, getattr(p, key))
        if self.properties is not None:
            points = point_set(self.properties)
            _of("properties", lambda: check_points(points))
            _of("properties", lambda: check_friction("mu_0", points.mu_0))
        if self.points == "custom":
            own = self.custom_points
            assert own is not None  # checked above
            _of("custom_points", lambda: check_friction("mu_0", own.mu_0))
            if np.min(own.P[:, 2]) >= 0:
                what = "lie above the centre of mass, all of them"
                raise InputError("E-RANGE", "custom_points P", what, "z is up, and the feet are below: give z < 0.")
        else:
            block, points = self.body_without_effects()
            check_tilt(block, points, p.theta_0)

    def check_values(self) -> None:
        """Refuse values with which nothing can be computed. Raises InputError (E-RANGE, E-KEY, E-SHAPE, E-TYPE)."""
        p = self.parameters
        check_cuboid(self.mass, self.width, self.depth, self.height, p.delta_long, p.delta_diag)
        if self.points not in POINT_SETS:
            raise InputError("E-KEY", "points", f"is {self.points!r}", f"Use one of {', '.join(POINT_SETS)}.")
        for key in ("K_N", "K_T"):
            check_number(key, getattr(p, key), more_than_least=True)
        for key in ("beta_int", "beta_ext", "mu_int", "mu_ext", "theta_0"):
            check_number(key, getattr(p, key))
        check_number("g", self.g, more_than_least=True)
        check_number("foot_radius", self.foot_radius)
        if self.inertia is not None:
            check_inertia(self.inertia)
        if self.points == "custom" and self.custom_points is None:
            raise InputError("E-KEY", "custom_points", "is missing", 'Give the points, or points = "eight_points".')
        if self.points == "custom" and self.custom_points is not None:
            own = self.custom_points
            _of("custom_points", lambda: check_points(own))
            _of("custom_points", lambda: check_names(own))
        enough = 4 if self.points == "four_points" else 8
        for key in PROPERTIES if self.properties is not None else ():
            values = np.asarray((self.properties or {}).get(key, ()))
            if values.ndim != 1 or len(values) < enough:
                raise InputError(
                    "E-SHAPE", f"properties[{key!r}]", "is not one number a point", f"Give {enough} numbers."
                )

    def acting_parameters(self) -> tuple[str, ...]:
        """Return names of those of the twelve parameters that this model is made of, in the order of Table 3.1.

        Stated `properties` take the place of stiffness, damping and friction, custom points that of all but theta_0,
        and four points have no inner ones. The others are in the file and change nothing.

        >>> from rockref import Model
        >>> Model.four_points().acting_parameters()
        ('K_N', 'K_T', 'beta_ext', 'mu_ext', 'theta_0')
        """
        of_points, inner = GENES_12[:6], ("beta_int", "mu_int")
        idle: tuple[str, ...] = ()
        if self.points == "custom":
            idle = GENES_12[:-1]
        else:
            idle += of_points if self.properties is not None else ()
            idle += (*inner, *GENES_12[6:-1]) if self.points == "four_points" else ()
        return tuple(name for name in GENES_12 if name not in idle)

    def body(self) -> tuple[Block, ContactPoints]:
        """Return block and contact points as arrays, with the effects on geometry and mass applied."""
        block, points = self.body_without_effects()
        for effect in self.active_effects():
            block, points = effect.points(block, points)
        return block, points

    def body_without_effects(self) -> tuple[Block, ContactPoints]:
        """Return block and contact points as arrays, as the parameters alone make them. Raises InputError."""
        self.check_values()
        p = self.parameters
        sides = self.width, self.depth, self.height
        inertia = cuboid_inertia(self.mass, *sides) if self.inertia is None else self.inertia
        block = Block(np.array(float(self.mass)), np.array(inertia, float), np.array(float(self.g)))
        if self.points == "custom":
            assert self.custom_points is not None  # checked above
            points = self.custom_points
        else:
            names: tuple[str, ...]
            if self.points == "eight_points":
                P, names = eight_points(*sides, p.delta_long, p.delta_diag), EXTERNAL + INTERNAL
            else:
                P, names = four_points(*sides), EXTERNAL
            q = self.properties or point_properties(p, self.mass, np.array([n.endswith("ext") for n in names]))
            radius = np.full(len(names), float(self.foot_radius)) if self.foot_radius else None
            own = {k: np.array(q[k], float)[: len(names)] for k in PROPERTIES}
            points = ContactPoints(P=P, radius=radius, names=names, **own)
        return block, points

    def active_effects(self) -> tuple[Effect, ...]:
        """Return the effects that are not at the value at which they are absent, in the order of the step."""
        return in_step_order(e for e in self.effects if not e.is_absent())

    def problem(
        self,
        duration: float = 1.5,
        step: float = 1e-5,
        output_rate: float = 2000.0,
        start: State | None = None,
        turned: bool = False,
        out_of_plane: float = 0.0,
        theta_0: float | None = None,
        body: tuple[Block, ContactPoints] | None = None,
        base: BaseMotion | None = None,
        standing: bool | None = None,
        heading: float = 0.0,
        posture: State | None = None,
    ) -> Problem:
        """Return what the engines take. Without `start`, the release posture at theta_0 (by default the model's) [rad].

        body : what `body()` returns, posture : what `release_posture` does, where they are known already.
        base : how the plate moves.
        standing : the block stands still on its feet, turned by `heading` [rad] about the vertical, and is not
        released; by default where the plate moves. Effects on the release are then left aside.

        >>> from rockref import Model
        >>> problem = Model.table_3_1().problem(duration=0.5, turned=True)
        >>> problem.duration, len(problem.points.names), problem.effects
        (0.5, 8, ())
        """
        block, points = self.body() if body is None else body
        effects = self.active_effects()
        if start is None and (base is not None if standing is None else standing):
            start = standing_posture(block, points, heading)
        elif start is None:
            tilt = self.parameters.theta_0 if theta_0 is None else theta_0
            start = release_posture(block, points, tilt, turned, out_of_plane) if posture is None else posture
            for effect in effects:
                start = effect.release(block, points, start)
        return Problem(block, points, start, step, duration, output_rate, effects, base=base)


def effects_of(given: Any) -> tuple[Effect, ...]:
    """Return effects, given as such or in words: one, or a sequence of them.

    Raises InputError: E-TYPE for what is neither, those of :func:`rockref.effects.catalogue.parse`.
    """
    listed = [given] if isinstance(given, (str, Effect)) else given
    if not isinstance(listed, (list, tuple)):
        cure = 'Give effects, or words such as "rolling_resistance:lever=3e-4".'
        raise InputError("E-TYPE", "effects", f"is {given!r}"[:80], cure)
    found = []
    for one in listed:
        if not isinstance(one, (str, Effect)):
            cure = 'Give effects, or words such as "rolling_resistance:lever=3e-4".'
            raise InputError("E-TYPE", "effects", f"holds {one!r}"[:80], cure)
        found.append(parse(one, "effects") if isinstance(one, str) else one)
    return in_step_order(found) if any(isinstance(one, str) for one in listed) else tuple(found)


def point_set(properties: dict[str, Any]) -> ContactPoints:
    """Return the properties of the eight points, or of the first four, in no place yet."""
    names = (EXTERNAL + INTERNAL)[: len(properties["K_N"])]
    own = {k: np.array(properties[k], float)[: len(names)] for k in PROPERTIES}
    return ContactPoints(P=np.zeros((len(names), 3)), radius=None, names=names, **own)


def _of(part: str, check: Callable[[], None]) -> None:
    """Make a check, and say of what refused it that it belongs to this part of the model."""
    try:
        check()
    except InputError as e:
        raise InputError(e.code, f"{part} {e.where}", e.what, e.cure) from e


def simulate(
    model: Model | Problem,
    duration: float = 1.5,
    step: float = 1e-5,
    output_rate: float = 2000.0,
    engine: str = "auto",
    progress: Callable[[float], None] | None = None,
    dtype: Any = None,
    **start: Any,
) -> Response:
    """Simulate a model from release, or a problem as it is.

    Parameters
    ----------
    model : Model or Problem; a Problem brings its own duration, step and output rate.
    duration, step : [s];  output_rate : rows a second [Hz].
    engine : "auto" (the fastest that is there), "numpy" (the law), "numba" (compiled, extra `fast`); the same bits.
    progress : called with the fraction done.
    dtype : float32, float64, longdouble (numpy engine).
    start : `start=` a State, or `turned=`, `out_of_plane=`, `theta_0=` of the release; `base=` a BaseMotion of the
        plate, on which the block stands, and `standing=`, `heading=` (see `Model.problem`).

    Raises
    ------
    InputError, NumericalError

    >>> import rockref
    >>> response = rockref.simulate(rockref.Model.table_3_1(), duration=2e-3, output_rate=1000.0)
    >>> print(response.t, response.crv[-1].round(3))
    [0.    0.001 0.002] [ 0.064 -0.001 -0.   ]
    """
    if not isinstance(model, (Model, Problem)):
        cure = "Give a Model: Model.table_3_1(), or Model.load of a file."
        raise InputError("E-TYPE", "model", f"is {model!r}"[:80], cure)
    if isinstance(model, Problem):
        return run(model, engine=engine, progress=progress, dtype=dtype)
    unknown = [key for key in start if key not in OF_START]
    if unknown:
        raise model_file.unknown_key("simulate", unknown[0], OF_START)
    problem = model.problem(duration, step, output_rate, **start)
    return run(problem, engine=engine, progress=progress, dtype=dtype)
