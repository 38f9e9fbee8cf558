"""All effects by id and by question; effects from words, from tables, and from a user's file."""

from __future__ import annotations

import difflib
import os
import shlex
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.effects.base import STAGES, Effect, as_float
from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.contact.hertzian_contact import HertzianContact
from rockref.effects.contact.hunt_crossley_contact import HuntCrossleyContact
from rockref.effects.contact.hysteretic_contact import HystereticContact
from rockref.effects.contact.orientation_dependent_damping import OrientationDependentDamping
from rockref.effects.contact.uneven_foot_damping import UnevenFootDamping
from rockref.effects.contact.uneven_foot_stiffness import UnevenFootStiffness
from rockref.effects.friction.load_dependent_friction import LoadDependentFriction
from rockref.effects.friction.rolling_resistance import RollingResistance
from rockref.effects.friction.spin_friction import SpinFriction
from rockref.effects.friction.stribeck_friction import StribeckFriction
from rockref.effects.friction.uneven_foot_friction import UnevenFootFriction
from rockref.effects.friction.viscous_friction import ViscousFriction
from rockref.effects.loads.base_vibration import BaseVibration
from rockref.effects.loads.cable_restraint import CableRestraint
from rockref.effects.loads.gravity_deviation import GravityDeviation
from rockref.effects.loads.lingering_wire_pull import LingeringWirePull
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.effects.loads.quadratic_drag import QuadraticDrag
from rockref.effects.nothing_added import NOTHING_ADDED
from rockref.effects.release.release_velocity import ReleaseVelocity
from rockref.effects.sensor.clock_error import ClockError
from rockref.effects.sensor.gyro_bandwidth import DAMPING, GyroBandwidth, even_step, undo_low_pass
from rockref.effects.sensor.gyro_drift import GyroDrift
from rockref.effects.sensor.gyro_misalignment import GyroMisalignment
from rockref.effects.sensor.gyro_saturation import GyroSaturation
from rockref.effects.sensor.gyro_scale import GyroScale
from rockref.effects.shape.dimension_deviation import DimensionDeviation
from rockref.effects.shape.foot_defects import FootDefects
from rockref.effects.shape.inertia_deviation import InertiaDeviation
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.rounded_corners import RoundedCorners
from rockref.effects.shape.rounded_feet import RoundedFeet
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.effects.support.compliant_support import CompliantSupport
from rockref.effects.tracking.plate_pose import PlatePose
from rockref.effects.tracking.tag_frame import TagFrame
from rockref.effects.user import file_and_class, file_beside, load_user
from rockref.model.errors import InputError

#: All effects in the order in which they act, however they are given: what makes the body, normal force and friction,
#: forces of the points, loads, the plate, the release, and the gyroscope (whose own order `measured` keeps).
IN_STEP_ORDER: tuple[type[Effect], ...] = (
    FootDefects, DimensionDeviation, RoundedFeet, MassEccentricity, InertiaDeviation,
    UnevenFootStiffness, UnevenFootDamping, UnevenFootFriction,
    HertzianContact, HystereticContact, HuntCrossleyContact,
    StribeckFriction, LoadDependentFriction,
    Adhesion, ViscousFriction, UnevenContactNormals, SpinFriction, RollingResistance,
    QuadraticDrag, CableRestraint, LingeringWirePull, BaseVibration, PlateTilt,
    CompliantSupport, ReleaseVelocity,
    GyroMisalignment, GyroScale, GyroBandwidth, GyroDrift, GyroSaturation, ClockError,
)  # fmt: skip

#: Ids that a message names; decided: more are not read.
MOST_NAMED = 4

#: Every effect by its id.
EFFECTS: dict[str, type[Effect]] = {effect.id: effect for effect in IN_STEP_ORDER}

#: Effects that only tosses know: a released block stands on its feet all the while, and a gyroscope sees no pose. They
#: are read and written like all others and act after them; what looks for effects in releases does not try them.
OF_TOSSES: dict[str, type[Effect]] = {
    effect.id: effect for effect in (RoundedCorners, GravityDeviation, TagFrame, PlatePose, OrientationDependentDamping)
}

#: Effects of the user's own that this process was told of, by id; the file that was read last holds.
OWN: dict[str, type[Effect]] = {}

#: The files that he has named himself, by their resolved paths. No other one is run, whatever a model file says.
NAMED: set[str] = set()

#: The answer "none" to each question, in the order of the questions.
NONE: dict[str, type[Effect]] = {effect.question: effect for effect in NOTHING_ADDED}

#: Every question, with its answers; "none" first.
QUESTIONS: dict[str, tuple[type[Effect], ...]] = {
    question: (none, *(effect for effect in IN_STEP_ORDER if effect.question == question))
    for question, none in NONE.items()
}

__all__ = [
    "EFFECTS", "IN_STEP_ORDER", "NAMED", "NONE", "OF_TOSSES", "OWN", "QUESTIONS", "analogue", "digital", "find",
    "from_table", "heard", "in_step_order", "load_user", "measured", "named", "own_effect", "parse", "to_table",
    "undone",
]  # fmt: skip


#: Characters of a stranger's words that a message shows; decided.
SHOWN = 80


def short(words: str) -> str:
    """Return words of a command line or a file as a message shows them."""
    return words if len(words) <= SHOWN else words[: SHOWN - 3] + "..."


def short_path(path: str) -> str:
    """Return a path as a message shows it: its end says which file it is."""
    return path if len(path) <= SHOWN else "..." + path[3 - SHOWN :]


def find(id: str, where: str = "effect") -> type[Effect]:
    """Return effect of this id: of the catalogue, or a user's own that this process was told of. No file is run for it.

    Raises InputError (E-EFFECT) where nobody knows it, with the nearest name.
    """
    if id == Effect.id:
        raise InputError("E-EFFECT", where, "'none' is what holds where no effect is named", "Leave it out.")
    known = EFFECTS | OF_TOSSES | OWN
    if id in known:
        return known[id]
    near = difflib.get_close_matches(id.lower(), known, 1) or _holding(id.lower(), known)
    cure = f"Did you mean {' or '.join(map(repr, near))}?" if near else "`rockref effects` lists them."
    raise InputError("E-EFFECT", where, f"there is no effect {short(id)!r}", cure)


def _holding(word: str, known: Iterable[str]) -> list[str]:
    """Return the ids that hold a word as one of their parts, if they are few enough to be read."""
    found = [id for id in known if word in id.split("_")]
    return found if len(found) <= MOST_NAMED else []


def names_file(words: str) -> bool:
    """Return whether words are those of a user's own effect, a file or a class in it."""
    return words.strip().endswith(".py") or ".py:" in words


def named(words: str, where: str = "effect") -> type[Effect]:
    """Return the effect that a user names: by id, or his own as "path/to/file.py:Class", whose file is then run.

    For words of the user's alone, from the command line or an argument; what data say goes to `find`. A user's own is
    known by its id from then on, in this process, and model files may name its file.

    Raises InputError (E-EFFECT, E-FILE): nobody knows it (with the nearest name), or the class cannot be used.
    """
    if not names_file(words):
        return find(words, where)
    kind = own_effect(words.strip())
    NAMED.add(os.path.realpath(file_and_class(words.strip())[0]))
    return kind


def of_releases(words: Sequence[str], where: str = "--effect") -> tuple[type[Effect], ...]:
    """Return the effects that a user names for records of a gyroscope, each as in `named`.

    Raises InputError (E-EFFECT) for one that is given twice, or that only tracked poses of tosses show.
    """
    kinds = tuple(named(text) for text in words)
    ids = [kind.id for kind in kinds]
    if len(set(ids)) != len(ids):
        raise InputError("E-EFFECT", where, f"{', '.join(ids)}: one is given twice", "Give each once.")
    for id in ids:
        if id in OF_TOSSES:
            what = f"{id} is how the poses of tosses are read, and no gyroscope shows it"
            raise InputError("E-EFFECT", where, what, "Leave it out; `rockref effects` says which are of tosses only.")
    return kinds


def own_effect(spec: str) -> type[Effect]:
    """Load a user's own effect, "path/to/file.py:Class", and know it by its id. Raises InputError as `load_user`."""
    kind = load_user(spec, taken=EFFECTS | OF_TOSSES)
    OWN[kind.id] = kind
    return kind


def make(kind: type[Effect], given: dict[str, Any], where: str) -> Effect:
    """Return an effect with some parameters given by name. Raises InputError (E-KEY, E-TYPE, E-RANGE)."""
    for name in given:
        if name not in kind.quantities:
            near = difflib.get_close_matches(name.lower(), kind.quantities, 1)
            cure = f"Did you mean {near[0]!r}?" if near else f"It has {', '.join(kind.quantities) or 'none'}."
            raise InputError("E-KEY", where, f"{kind.id} has no parameter {short(name)!r}", cure)
    effect = kind(**{name: as_float(value) for name, value in given.items()})
    effect.check(where)
    return effect


def brought_in(kind: type[Effect], given: dict[str, Any], where: str) -> Effect:
    """Return an effect that somebody asks for by words or in a file.

    Where he gives none of the parameters that bring it in, these are typical: who names an effect wants it there. To
    have it absent he writes the value at which it is. Raises InputError (E-KEY, E-TYPE, E-RANGE).
    """
    switches = kind.quantities if kind.switches is None else kind.switches
    if any(name in given for name in switches):
        return make(kind, given, where)
    return make(kind, kind.typical().values() | given, where)


def parse(text: str, where: str = "--effect") -> Effect:
    """Return an effect from words: "quadratic_drag:c=0.4", "gyro_scale:x=1.02,y=0.98", "my_effect.py:Class:a=1".

    Without a parameter that brings it in, it has its typical size.

    Raises InputError (E-EFFECT, E-KEY, E-TYPE, E-RANGE): what cannot be read, with the nearest name or the range.
    """
    head, marker, rest = text.partition(".py:")
    name, _, words = rest.partition(":") if marker else text.partition(":")
    kind = named(f"{head}.py:{name}" if marker else name.strip(), where)
    place = f"{where} {short(text)}"
    return brought_in(kind, numbers_of(words, name, place), place)


def numbers_of(words: str, name: str, where: str) -> dict[str, float]:
    """Return parameters from "key=value,key=value". Raises InputError (E-KEY for one that is given twice, E-TYPE)."""
    given: dict[str, float] = {}
    for word in filter(None, (w.strip() for w in words.split(","))):
        key, equals, value = (part.strip() for part in word.partition("="))
        if key in given:
            raise InputError("E-KEY", where, f"{short(key)!r} is given twice", "Give each parameter once.")
        try:
            given[key] = float(value)
        except ValueError as e:
            what = f"{short(word)!r} is no parameter" if not equals else f"{short(value)!r} is no number"
            cure = f"Write {short(name)}:{'name'}=number, with commas between."
            if given and word.isdigit():
                cure = f"The decimal mark is a point: write {(last := next(reversed(given)))}={given[last]:g}.{word}."
            raise InputError("E-TYPE", where, what, cure) from e
    return given


def from_table(where: str, table: Any, beside: Path | None = None) -> tuple[Effect, ...]:
    """Return effects from the [effects] table of a model file: a sub-table of parameters for each id.

    A sub-table without a parameter that brings the effect in means its typical size, as on the command line. A user's
    own effect has `file = "my_effect.py:Class"` in its sub-table, looked for in the folder `beside`, which is that of
    the model file, and then in the current one. Such a file is run only if the user has `named` it.

    Raises InputError: E-TRUST, for a file that the user has not named; E-EFFECT, E-FILE, E-KEY, E-TYPE, E-RANGE: which
    entry, what is wrong, the nearest name or the range.
    """
    if not isinstance(table, dict):
        raise InputError("E-TYPE", f"{where}: effects", "is not a table", "Write [effects.quadratic_drag] and c = 0.4.")
    effects = []
    for id, given in table.items():
        place = f"{where}: [effects.{short(id)}]"
        if not isinstance(given, dict):
            raise InputError("E-TYPE", place, f"is {given!r}"[:80], f"Write [effects.{id}] and its parameters below.")
        given = dict(given)
        file = given.pop("file", None)
        kind = find(id, place) if file is None else own_effect(trusted(found_file(file, beside, place), place))
        if kind.id != id:
            raise InputError(
                "E-EFFECT", place, f"but the effect in {file} is {kind.id!r}", f"Write [effects.{kind.id}]."
            )
        effects.append(brought_in(kind, given, place))
    return in_step_order(effects)


def found_file(file: Any, beside: Path | None, place: str) -> str:
    """Return a model file's "file.py:Class", as it is found from the current folder. Raises InputError (E-TYPE)."""
    if not isinstance(file, str):
        raise InputError("E-TYPE", f"{place} file", f"is {file!r}"[:80], 'Write file = "path/to/file.py:Class".')
    path, _, name = file.rpartition(":")
    if beside is None or not path or (Path(path).is_file() and not (beside / path).is_file()):
        return file
    return f"{beside / path}:{name}"


def trusted(spec: str, place: str) -> str:
    """Return a model file's "file.py:Class", if the user has named that very file himself; nothing is run to know that.

    Raises InputError: E-TRUST for one that he has not named, E-FILE where there is none, E-EFFECT as `load_user`.
    """
    path = file_and_class(spec)[0]
    if not os.path.isfile(path):
        raise InputError("E-FILE", place, f"names {short_path(path)!r}, which is no file", "Check the path.")
    if os.path.realpath(path) in NAMED:
        return spec
    # It may stand in a command line, and comes from data.
    typed = file_beside(spec, Path())
    typed = shlex.quote(typed) if typed.isprintable() else repr(typed)
    what = f"names {typed}, a program, which nothing runs unless you name it, too"
    cure = f"If you trust it, add --effect {typed}; in Python, Model.load(path, effects=[...])."
    raise InputError("E-TRUST", place, what, cure)


def to_table(effects: Iterable[Effect], beside: Path | None = None) -> dict[str, dict[str, Any]]:
    """Return [effects] table of a model file in the folder `beside`: `from_table` reads it back to the same effects."""
    table = {}
    for effect in effects:
        values = {name: value for name, value in effect.values().items() if value is not None}
        table[effect.id] = ({"file": file_beside(effect.file, beside)} if effect.file else {}) | values
    return table


def in_step_order(effects: Iterable[Effect]) -> tuple[Effect, ...]:
    """Return the effects in the order in which they act; a user's own after the built-in ones, as given.

    Raises InputError (E-EFFECT) where one is given twice.
    """
    effects = tuple(effects)
    if len(effects) < 2:
        return effects
    ids = [effect.id for effect in effects]
    for id in ids:
        if ids.count(id) > 1:
            raise InputError("E-EFFECT", f"effect {id}", "is given twice", "Give it once, with all its parameters.")
    rank = {id: i for i, id in enumerate({**EFFECTS, **OF_TOSSES})}
    return tuple(sorted(effects, key=lambda effect: rank.get(effect.id, len(rank))))


def at_stage(effects: Iterable[Effect], *stages: str) -> list[Effect]:
    """Return the effects that stand at these stages of the measured channel, in its order."""
    acting = in_step_order(effects)
    return [effect for stage in stages for effect in acting if effect.stage == stage]


def analogue(
    effects: Iterable[Effect],
    t: np.ndarray,
    crv: np.ndarray,
    low_pass: Callable[[np.ndarray], np.ndarray] | None = None,
) -> np.ndarray:
    """Return what a sampler finds: crv (..., N, 3) [rad/s] at t (N,) [s], as the sensor gives it at the recorder's
    instants t.

    Misalignment, scale, low_pass (that of a data sheet, if any), bandwidth and delay, bias and drift, a user's own, and
    the clock: the recorder takes the sample of its time t at another one.
    """
    effects = tuple(effects)
    for effect in at_stage(effects, "mounting"):
        crv = effect.sensor(t, crv)
    if low_pass is not None:
        crv = low_pass(crv)
    for effect in at_stage(effects, "electronics", "clock"):
        crv = effect.sensor(t, crv)
    return crv


def digital(effects: Iterable[Effect], t: np.ndarray, crv: np.ndarray) -> np.ndarray:
    """Return what becomes of the samples, noise included: crv (..., N, 3) [rad/s] at t (N,) [s], cut at the range.

    After the clock: what comes after the stops would interpolate across their corners, and show more than the range.
    """
    for effect in at_stage(effects, "samples"):
        crv = effect.sensor(t, crv)
    return crv


def measured(effects: Iterable[Effect], t: np.ndarray, crv: np.ndarray) -> np.ndarray:
    """Return what the gyroscope of these effects shows: crv (..., N, 3) [rad/s] at t (N,) [s], in the order of a real
    one.

    `analogue`, then `digital`. Noise and rounding belong to a data sheet and come between and after:
    `rockref.measure.gyroscope.record`.
    """
    effects = tuple(effects)
    return digital(effects, t, analogue(effects, t, crv))


def undone(
    effects: Iterable[Effect], t: np.ndarray, crv: np.ndarray, bandwidth: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return true instants (N,) [s] and rates (..., N, 3) [rad/s] behind a record crv at t: `measured` run backwards.

    bandwidth : of the data sheet's low-pass [Hz], if any. Raises InputError (E-STEP) for a low-pass of uneven rows.
    """
    effects = tuple(effects)
    for effect in reversed(at_stage(effects, "electronics", "clock", "samples")):
        t, crv = effect.undo(t, crv)
    if bandwidth is not None and len(t) > 1:
        crv = undo_low_pass(crv, 1 / even_step(t), ((bandwidth, DAMPING),))
    for effect in reversed(at_stage(effects, "mounting")):
        t, crv = effect.undo(t, crv)
    return t, crv


def heard(effects: Iterable[Effect], t: np.ndarray, crv: np.ndarray) -> np.ndarray:
    """Return which rates of a record crv (..., N, 3) [rad/s] tell the true ones, row by row along its own axes:
    truths."""
    told, effects = np.ones(np.shape(crv), bool), tuple(effects)
    if all(type(effect).heard is Effect.heard for effect in effects):
        return told
    for effect in reversed(at_stage(effects, *STAGES)):
        told &= effect.heard(t, crv)
        t, crv = effect.undo(t, crv)
    return told
