"""Models and effects as they are named on the command line."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rockref.api import Model
    from rockref.effects.base import Effect

NAMED = ("table_3_1", "four_points")
#: Errors of a run that come from what the model says, as much as from how it is run.
OF_THE_MODEL = ("E-STEP", "E-NAN", "E-ANGLE", "E-TILT", "E-RELEASE", "E-FEET")


def named_model(text: str) -> Model:
    """Return Table 3.1 on eight or four points by name, or the model in a file. Raises InputError (E-FILE, ...)."""
    from rockref.api import Model

    if text in NAMED:
        return getattr(Model, text)()
    near = difflib.get_close_matches(text.lower(), NAMED, 1)
    if near and not Path(text).exists():
        from rockref.model.errors import InputError

        raise InputError("E-FILE", text, "is no file, and no model of that name", f"Did you mean {near[0]}?")
    model = Model.load(text)
    say_implausible(model.effects, text)
    return model


@contextmanager
def of_file(text: str) -> Iterator[None]:
    """Put the model's file before the place of an error of its run; models of the house keep the place alone."""
    from rockref.model.errors import InputError, NumericalError

    try:
        yield
    except (InputError, NumericalError) as e:
        if text in NAMED or e.code not in OF_THE_MODEL:
            raise
        raise type(e)(e.code, f"{text}: {e.where}", e.what, e.cure) from e


def say_implausible(effects: Iterable[Effect], where: str) -> None:
    """Print a remark on standard error for every parameter outside its plausible range; it is used all the same."""
    from rockref.effects.base import implausible

    for effect in effects:
        for name, what, plausible in implausible(effect):
            from rockref.measure.notice import Notice

            cure = f"Plausible is {plausible}; it is used as it is."
            notice = Notice("W-RANGE", f"{where}: {effect.id} {name}", f"{what}, which is not plausible", cure)
            print(f"rockref: {notice}", file=sys.stderr)


def labels(texts: Sequence[str]) -> list[str]:
    """Return a short name for each model: the file's without its ending; what is twice keeps its path."""
    short = [text if text in NAMED else Path(text).stem for text in texts]
    return [name if short.count(name) == 1 else text for name, text in zip(short, texts, strict=True)]


def with_effects(model: Model, texts: Sequence[str]) -> Model:
    """Return the model with effects added, written as ``id:key=value,key=value``; an effect that it has is replaced."""
    from rockref.effects.catalogue import in_step_order, parse

    if not texts:
        return model
    added = [parse(text) for text in texts]
    for text, effect in zip(texts, added, strict=True):
        say_implausible([effect], f"--effect {text}")
    kept = [effect for effect in model.effects if effect.id not in {new.id for new in added}]
    return model.replace(effects=in_step_order([*kept, *added]))
