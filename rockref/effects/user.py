"""A user's own effect: loaded from his file, and looked over, so that a mistake is explained to him at once."""

from __future__ import annotations

import ast
import difflib
import importlib.util
import inspect
import math
import os
import sys
from collections.abc import Container
from dataclasses import fields, is_dataclass
from pathlib import Path
from types import ModuleType

from rockref.effects.base import HOOKS, STAGES, UNDO_HOOKS, Effect, Quantity
from rockref.effects.guard import guard, line_in
from rockref.effects.prior import ROLES, SCALES, Prior
from rockref.effects.probe import probe, probe_absent
from rockref.effects.scale import prior_of
from rockref.model.errors import InputError

HELP = "See examples/my_effect.py."
QUANTITY = 'Quantity("N s/m", absent=0.0, low=..., high=..., typical=...)'


def load_user(spec: str, taken: Container[str] = ()) -> type[Effect]:
    """Return the effect class that "path/to/file.py:Class" names, looked over and tried once; its hooks are guarded.

    taken : ids that it must not have.

    Raises InputError: E-FILE, where the file cannot be run; E-EFFECT, where the class is not an effect that can be
    used: what is wrong and what to write.
    """
    path, name = file_and_class(spec)
    module = run_file(Path(path))
    kind = getattr(module, name, None)
    if kind is None:
        classes = [
            n for n, c in vars(module).items() if inspect.isclass(c) and issubclass(c, Effect) and c is not Effect
        ]
        raise InputError(
            "E-EFFECT", spec, f"there is no class {name!r} in it", f"It has {', '.join(classes) or 'none'}."
        )
    if not (inspect.isclass(kind) and issubclass(kind, Effect)):
        raise InputError("E-EFFECT", spec, f"{name} is not an Effect", f"Write class {name}(Effect). {HELP}")
    kind.file = spec
    check_class(kind, spec)
    if kind.id in taken:
        raise InputError("E-EFFECT", spec, f"the id {kind.id!r} is that of a built-in effect", "Choose another id.")
    guard(kind, spec)
    probe(kind.typical(), spec)
    probe_absent(kind(), spec)
    return kind


def file_and_class(spec: str) -> tuple[str, str]:
    """Return the two parts of "path/to/file.py:Class"; nothing is looked for. Raises InputError (E-EFFECT)."""
    path, _, name = spec.rpartition(":")
    if spec.endswith(".py"):
        names = classes_in(Path(spec)) or ["Class"]
        cure = f"Write {' or '.join(f'{spec}:{name}' for name in names)}."
        raise InputError("E-EFFECT", spec, "names a file, but no class in it", cure)
    if not path.endswith(".py") or not name.isidentifier():
        raise InputError("E-EFFECT", spec, "names no class in a file", "Write path/to/file.py:Class.")
    return path, name


def classes_in(path: Path) -> list[str]:
    """Return the classes that a Python file states as effects of its own, in its order; the file is not run."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, SyntaxError, RecursionError):
        return []
    return [n.name for n in tree.body if isinstance(n, ast.ClassDef) and any("Effect" in ast.dump(b) for b in n.bases)]


def file_beside(file: str, beside: Path | None) -> str:
    """Return a "file.py:Class" of the current folder as it is written in a file in the folder `beside`."""
    path, _, name = file.rpartition(":")
    if beside is None or Path(path).is_absolute():
        return file
    try:
        path = Path(os.path.relpath(os.path.realpath(path), os.path.realpath(beside))).as_posix()
    except ValueError:  # on another drive
        path = os.path.realpath(path)
    return f"{path}:{name}"


def run_file(path: Path) -> ModuleType:
    """Run a Python file as a module of its own. Raises InputError (E-FILE) that names its line."""
    try:
        source = path.read_text(encoding="utf-8")
    except (OSError, ValueError) as e:  # also a name that no file can have
        raise InputError("E-FILE", str(path), f"cannot be read ({e})", "Check the path.") from e
    try:
        ast.parse(source)
    except (SyntaxError, ValueError) as e:
        line = f", line {e.lineno}" if isinstance(e, SyntaxError) and e.lineno else ""
        what = f"is not valid Python: {e.msg if isinstance(e, SyntaxError) else e}"
        raise InputError("E-FILE", f"{path}{line}", what, "Mend the line.") from e
    name = f"rockref_user_effect_{path.stem}"
    module_spec = importlib.util.spec_from_file_location(name, path)
    assert module_spec is not None and module_spec.loader is not None
    module = importlib.util.module_from_spec(module_spec)
    sys.modules[name] = module  # dataclasses look their module up there
    try:
        module_spec.loader.exec_module(module)
    except SystemExit as e:
        cure = "A file of effects only defines classes: take the exit away."
        raise InputError("E-FILE", f"{path}{line_in(e, path)}", "ends the program when it is run", cure) from e
    except Exception as e:
        no_quantity = isinstance(e, TypeError) and "Quantity." in str(e)
        cure = f"Write {QUANTITY}, the unit first." if no_quantity else "Mend the line."
        what = f"fails when it is run: {type(e).__name__}: {e}"
        raise InputError("E-FILE", f"{path}{line_in(e, path)}", what, cure) from e
    return module


def check_class(kind: type[Effect], spec: str) -> None:
    """Refuse a class that says too little or has a hook that nobody calls. Raises InputError (E-EFFECT)."""

    def refuse(what: str, cure: str):
        return InputError("E-EFFECT", spec, what, f"{cure} {HELP}")

    if not is_dataclass(kind) or "__dataclass_params__" not in vars(kind):
        raise refuse("is not a dataclass", "Write @dataclass(frozen=True) above the class.")
    if not isinstance(kind.id, str) or not kind.id.isidentifier() or kind.id == "none":
        raise refuse(f"has the id {kind.id!r}", 'Write id = "my_effect", a name of letters, digits and underscores.')
    check_quantities(kind, refuse)
    try:
        absent = kind()
    except TypeError as e:
        raise refuse(
            f"cannot be made without parameters ({e})", "Give every parameter its absent value as default."
        ) from e
    if not absent.is_absent():
        raise refuse("is not absent by default", "Make the default of each parameter the absent value of its quantity.")
    check_priors(kind, spec, refuse)
    kind.typical().check(spec)
    if kind.typical().is_absent():
        raise refuse("is absent at its typical size", "Give a typical value at which something changes.")
    check_hooks(kind, refuse)


def check_quantities(kind: type[Effect], refuse) -> None:
    """Refuse parameters without a quantity, and quantities that say too little."""
    names = [f.name for f in fields(kind)]
    if not names or not isinstance(kind.quantities, dict):
        what = "has no parameter: it would always be absent" if not names else "has quantities that are no dict"
        raise refuse(what, f'Write quantities = {{"c": {QUANTITY}}} and c: float = 0.0.')
    for name in names:
        if hasattr(Effect, name):
            raise refuse(f"parameter {name!r} hides what every effect has under that name", "Choose another name.")
        if name not in kind.quantities:
            raise refuse(f"parameter {name!r} has no quantity", f'Write quantities = {{"{name}": {QUANTITY}}}.')
    for name, quantity in kind.quantities.items():
        if name not in names:
            raise refuse(f"quantity {name!r} belongs to no parameter", f"Write {name}: float = ... in the class.")
        check_quantity(name, quantity, refuse)
    for name in kind.switches or ():
        if name not in names:
            raise refuse(f"switch {name!r} is no parameter", f"It has {', '.join(names)}.")


def check_quantity(name: str, quantity: Quantity, refuse) -> None:
    """Refuse a quantity without a unit or a range."""
    if not isinstance(quantity, Quantity):
        raise refuse(f"quantity {name!r} is {quantity!r}", f"Write {QUANTITY}.")
    if not isinstance(quantity.unit, str) or not quantity.unit.strip():
        raise refuse(f"parameter {name!r} has no unit", 'Give one, for example "N s/m", or "1" for a plain number.')
    for key in ("low", "high"):
        if not isinstance(getattr(quantity, key), (int, float)):
            raise refuse(f"parameter {name!r} has {key} = {getattr(quantity, key)!r}", "Give a number.")


def check_priors(kind: type[Effect], spec: str, refuse) -> None:
    """Refuse what a fit cannot use: words without a meaning, priors and seeds of no parameter, starts of no effect."""
    if kind.stage not in STAGES:
        raise refuse(f"has the stage {kind.stage!r}", f"Write one of {', '.join(STAGES)}.")
    named = (*kind.priors, *kind.of_run, *(name for seed in kind.seeds for name in seed))
    for name in named:
        if name not in kind.quantities:
            raise refuse(f"a prior, a seed or of_run names {name!r}, which is no parameter", "Take it away.")
    if len(kind.of_run) not in (0, 2):
        raise refuse(f"of_run is {kind.of_run!r}", 'Write of_run = ("amplitude", "phase"), a size and its phase.')
    for name in kind.quantities:
        check_prior(kind, name, refuse)
    for seed in kind.seeds:
        kind(**{**kind.typical().values(), **seed}).check(f"{spec} seeds")


def check_prior(kind: type[Effect], name: str, refuse) -> None:
    """Refuse a prior on which no fit can count."""
    given = kind.priors.get(name, Prior())
    if not isinstance(given, Prior) or given.role not in ("", *ROLES) or given.scale not in ("", *SCALES):
        cure = f"Write Prior(role, scale, spread=...), with {', '.join(ROLES)} and {', '.join(SCALES)}."
        raise refuse(f"the prior of {name!r} is {given!r}", cure)
    try:
        prior = prior_of(kind, name)
    except (TypeError, ValueError, ArithmeticError):
        prior = Prior(spread=0.0)
    if prior.role != "fixed" and not (0 < prior.spread < math.inf and (prior.scale != "log" or prior.centre > 0)):
        cure = "Give a typical value that is not the absent one, above zero on a log scale, or Prior(spread=...)."
        raise refuse(f"a fit cannot count {name!r}: its spread is {prior.spread:g}", cure)


def check_hooks(kind: type[Effect], refuse) -> None:
    """Refuse hooks with a wrong name or wrong arguments, and a class without any."""
    own = {
        n: f for c in kind.__mro__[: kind.__mro__.index(Effect)] for n, f in vars(c).items() if inspect.isfunction(f)
    }
    known = HOOKS | UNDO_HOOKS
    for name in own:
        near = difflib.get_close_matches(name, known, 1, cutoff=0.75)
        if name not in known and near:
            raise refuse(f"method {name!r} is no hook: nobody would call it", f"Did you mean {near[0]!r}?")
    if not any(name in HOOKS for name in own):
        raise refuse("changes nothing", f"Write one of the methods {', '.join(HOOKS)}.")
    for name in (name for name in own if name in known):
        wanted = known[name]
        given = list(inspect.signature(own[name]).parameters)[1:]
        # A hook is called by place: other names are the author's own, the hook's names must stand where they belong.
        swapped = [a for a, b in zip(given, wanted, strict=False) if a.lstrip("_") in wanted and a.lstrip("_") != b]
        if len(given) != len(wanted) or swapped:
            what = f"{name} takes ({', '.join(given)})" + (f": {swapped[0]} is not in its place" if swapped else "")
            raise refuse(what, f"Write def {name}(self, {', '.join(wanted)}).")
