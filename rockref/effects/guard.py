"""A user's own effect while it runs: its hooks' results are looked over, and a mistake names class, hook and line."""

from __future__ import annotations

import functools
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rockref.effects.base import HOOKS, UNDO_HOOKS, Effect
from rockref.model.errors import InputError, RockrefError
from rockref.model.problem import Block, ContactPoints, State

#: What authors of effects most often forget.
AXES = "Leading axes are runs side by side: index from the end, as in x[..., 2], and it serves one run and many."
#: Properties of a contact point, one number each.
PER_POINT = ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")


def guard(kind: type[Effect], spec: str) -> None:
    """Have every hook that the class overrides looked over whenever it is called.

    spec : "path/to/file.py:Class". The hooks raise InputError (E-EFFECT) from then on: what fails inside, or what is
    wrong with what they give back.
    """
    for name in HOOKS | UNDO_HOOKS:
        hook = getattr(kind, name)
        if hook is not getattr(Effect, name):
            setattr(kind, name, guarded(hook, spec, name))


def guarded(hook: Callable, spec: str, name: str) -> Callable:
    """Return the hook, with its result looked over."""

    @functools.wraps(hook)
    def looked_over(self, *arguments):
        try:
            with np.errstate(all="ignore"):  # what is not finite is said below, once
                result = hook(self, *arguments)
        except RockrefError:
            raise
        except (Exception, SystemExit) as e:
            what = f"fails: {type(e).__name__}: {e}"
            cure = f"Use np.exp, np.cos in place of math's: times may be an array, one a run. {AXES}"
            cure = cure if isinstance(e, TypeError) and "Python scalars" in str(e) else f"Mend the line. {AXES}"
            line = line_in(e, Path(spec.rpartition(":")[0]))
            raise InputError("E-EFFECT", f"{spec}.{name}{line}", what, cure) from e
        try:
            LOOKS[name](f"{spec}.{name}", arguments, result)
        except NotFinite:
            if are_finite(arguments):  # else the numbers were lost before: the engine says where
                raise
        return result

    return looked_over


def line_in(error: BaseException, path: Path) -> str:
    """Return ", line N" of the last line of this file through which the error came; "" where there is none."""
    lines = [
        f.lineno for f in traceback.extract_tb(error.__traceback__) if Path(f.filename).resolve() == path.resolve()
    ]
    return f", line {lines[-1]}" if lines else ""


class NotFinite(InputError):
    """A result that holds a number that is not finite."""


def are_finite(things: Any) -> bool:
    """Return whether all arrays among these arguments of a hook are finite, (F, k, points, m) for example."""
    if isinstance(things, (np.ndarray, float)):
        return np.asarray(things).dtype.kind != "f" or bool(np.all(np.isfinite(things)))
    inside = things.values() if isinstance(things, dict) else things if isinstance(things, tuple) else ()
    return all(are_finite(thing) for thing in inside)


def wrong(where: str, what: str, cure: str) -> InputError:
    """Return the error for a result that the step cannot use."""
    return InputError("E-EFFECT", where, what, cure)


def numbers(where: str, key: str, a: Any, shape: tuple[int, ...]) -> None:
    """Refuse what is no array of numbers, has the wrong shape, or holds a number that is not finite (E-EFFECT)."""
    try:
        array = np.asarray(a)
        finite = array.dtype.kind in "fiub" and bool(np.all(np.isfinite(array)))
    except (TypeError, ValueError) as e:
        raise wrong(where, f"{key} is {type(a).__name__}", "Return an array of numbers.") from e
    if array.dtype.kind not in "fiub":
        raise wrong(where, f"{key} is {type(a).__name__}", "Return an array of numbers.")
    if array.shape != shape:
        raise wrong(where, f"{key} has shape {array.shape}, the law's has {shape}", AXES)
    if not finite:
        what, cure = f"{key} holds a number that is not finite", "Look for 0/0, roots and powers of negatives."
        raise NotFinite("E-EFFECT", where, what, cure)


def pair(where: str, given: Any) -> tuple[Any, Any]:
    """Return the two results of a hook that gives back two. Raises InputError (E-EFFECT)."""
    if not isinstance(given, tuple) or len(given) != 2:
        raise wrong(where, f"gives back {type(given).__name__}", "Return two things, with a comma between them.")
    return given


def look_at_points(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is no Block, with contact points that have one number each of every property."""
    block, points = pair(where, result)
    if not isinstance(block, Block) or not isinstance(points, ContactPoints):
        raise wrong(where, f"gives back {type(block).__name__}, {type(points).__name__}", "Return block, points.")
    numbers(where, "P", points.P, np.shape(points.P)[:-1] + (3,))
    for key in PER_POINT:
        numbers(where, key, getattr(points, key), np.shape(points.P)[:-1])
    if points.radius is not None:
        numbers(where, "radius", points.radius, np.shape(points.P)[:-1])
    names, n = points.names, np.shape(points.P)[-2]
    if not isinstance(names, tuple) or len(names) != n:
        raise wrong(where, f"names are {names!r}"[:80], f"Give each of the {n} points a name, in a tuple.")
    for key in ("mass", "inertia", "g"):
        numbers(where, key, getattr(block, key), np.shape(getattr(arguments[0], key)))


def look_at_release(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is no State like the one that came in."""
    if not isinstance(result, State):
        raise wrong(where, f"gives back {type(result).__name__}", "Return dataclasses.replace(state, ...).")
    for key in ("x", "Lambda", "v", "W"):
        numbers(where, key, getattr(result, key), np.shape(getattr(arguments[2], key)))


def look_at_start(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is no dict of arrays whose leading axes are those of the problem."""
    if not isinstance(result, dict):
        raise wrong(where, f"gives back {type(result).__name__}", "Return a dict of arrays, or leave it out.")
    batch = arguments[0].batch
    for key, a in result.items():
        if np.shape(a)[: len(batch)] != batch:
            what = f"memory {key!r} has shape {np.shape(a)} for a batch of shape {batch}"
            raise wrong(where, what, "Begin its shape as those of the problem's arrays, with np.zeros_like.")


#: What a plate's motion holds; it may end with the velocity.
MOTION = ("displacement", "velocity", "turn", "rate of turn")


def look_at_plate_motion(where: str, arguments: tuple, result: Any) -> None:
    """Refuse all but None, or displacement and velocity, with turn and rate of turn or without, of unknown number of
    runs."""
    if result is not None:
        given = result if isinstance(result, tuple) and len(result) == len(MOTION) else pair(where, result)
        for key, a in zip(MOTION, given, strict=False):
            numbers(where, key, a, np.shape(a)[:-1] + (3,))


def look_at_normal_force(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is no force for every point."""
    numbers(where, "F", result, np.shape(arguments[0]))


def look_at_friction_coefficient(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is not two coefficients for every point."""
    for key, a in zip(("mu_0", "mu"), pair(where, result), strict=True):
        numbers(where, key, a, np.shape(arguments[2]))


def look_at_wrench(where: str, arguments: tuple, result: Any) -> None:
    """Refuse all but None, or a force and a moment for every run."""
    if result is not None:
        for key, a in zip(("force", "moment"), pair(where, result), strict=True):
            numbers(where, key, a, np.shape(arguments[0].start.x))


def look_at_advance(where: str, arguments: tuple, result: Any) -> None:
    """Refuse memory that is not finite."""
    for key, a in arguments[3].items():
        numbers(where, f"memory {key!r}", a, np.shape(a))


def look_at_sensor(where: str, arguments: tuple, result: Any) -> None:
    """Refuse another number of rates than came in."""
    numbers(where, "crv", result, np.shape(arguments[1]))


def look_at_undo(where: str, arguments: tuple, result: Any) -> None:
    """Refuse another number of instants and rates than came in."""
    for key, a, came in zip(("t", "crv"), pair(where, result), arguments, strict=True):
        numbers(where, key, a, np.shape(came))


def look_at_heard(where: str, arguments: tuple, result: Any) -> None:
    """Refuse what is no truth for every rate."""
    numbers(where, "what is heard", result, np.shape(arguments[1]))
    if np.asarray(result).dtype != bool:
        raise wrong(where, f"gives back {np.asarray(result).dtype} numbers", "Return truths, such as abs(crv) < 1.")


#: What is looked at in the result of each hook.
LOOKS: dict[str, Callable[[str, tuple, Any], None]] = {
    "points": look_at_points,
    "release": look_at_release,
    "start": look_at_start,
    "plate_motion": look_at_plate_motion,
    "normal_force": look_at_normal_force,
    "friction_coefficient": look_at_friction_coefficient,
    "point_wrench": look_at_wrench,
    "body_wrench": look_at_wrench,
    "advance": look_at_advance,
    "sensor": look_at_sensor,
    "undo": look_at_undo,
    "heard": look_at_heard,
}
