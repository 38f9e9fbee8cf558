"""Models and effects as they are named on the command line."""

from __future__ import annotations

import difflib
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rockref.commands._results import remark

if TYPE_CHECKING:
    from rockref.api import Model
    from rockref.effects.base import Effect

NAMED = ("table_3_1", "four_points")
#: Errors of a run that come from what the model says, as much as from how it is run.
OF_THE_MODEL = frozenset("E-STEP E-NAN E-ANGLE E-TILT E-RELEASE E-FEET E-MOOT".split())


def named_model(text: str) -> Model:
    """Return Table 3.1 on eight or four points by name, or the model in a file. Raises InputError (E-FILE, ...)."""
    from rockref.api import Model

    if text in NAMED:
        return getattr(Model, text)()
    if not text.strip():
        from rockref.model.errors import InputError

        raise InputError("E-FILE", "the name of the model", "is empty", f"Use {', '.join(NAMED)} or a model.toml.")
    near = difflib.get_close_matches(text.lower(), NAMED, 1)
    if near and not Path(text).exists():
        from rockref.model.errors import InputError

        raise InputError("E-FILE", text, "is no file, and no model of that name", f"Did you mean {near[0]}?")
    model = Model.load(text)
    say_implausible(model.effects, text)
    return model


def known_files(effects: Iterable[str] | None) -> None:
    """Run the files of the user's own effects that he has named, so that model files may name them."""
    from rockref.effects.catalogue import named, names_file

    for words in effects or ():
        if names_file(words):
            named(spec_of(words))


def spec_of(words: str) -> str:
    """Return the "file.py:Class" of the words of an effect, without its parameters."""
    head, marker, rest = words.strip().partition(".py:")
    return f"{head}.py:{rest.partition(':')[0]}" if marker else words.strip()


def given_model(text: str | None, effects: Iterable[str] | None) -> Model | None:
    """Return the model that is named, or None for the baseline. Raises as :func:`named_models`."""
    return next(iter(named_models([] if text is None else [text], effects)), None)


def given_and_others(text: str | None, effects: Iterable[str] | None) -> tuple[Model | None, list[str]]:
    """Return the model that is named, None for the baseline, and the effects that are none of its own."""
    models, others = models_and_others([] if text is None else [text], effects)
    return next(iter(models), None), others


def model_with(text: str, effects: Sequence[str] | None) -> Model:
    """Return the model that is named, with effects added (see :func:`with_effects`)."""
    known_files(effects)
    return with_effects(named_model(text), effects or ())


def models_and_others(texts: Iterable[str], effects: Iterable[str] | None) -> tuple[list[Model], list[str]]:
    """Return the models, and of the effects that are named those that are no user's own effect of any of them.

    Raises InputError (E-EFFECT) for numbers beside the name of one that a model has: they would change nothing.
    """
    from rockref.model.errors import InputError

    effects = list(effects or ())
    known_files(effects)
    models = [named_model(text) for text in texts]
    theirs = [words for words in effects if any(has(m, words) for m in models)]
    for words in theirs:
        if words.strip() != spec_of(words):
            what = "gives numbers to an effect of the model, whose own numbers hold"
            raise InputError("E-EFFECT", f"--effect {words}", what, f"Write {spec_of(words)}.")
    return models, [words for words in effects if words not in theirs]


def has(model: Model, words: str) -> bool:
    """Return whether a model has the user's own effect that words name: of that file, and of that class."""
    path, _, name = spec_of(words).rpartition(":")
    own = [effect.file.rpartition(":") for effect in model.effects if effect.file is not None]
    return any(os.path.realpath(p) == os.path.realpath(path) and n == name for p, _, n in own)


def carried_by(model: Model | None) -> set[str]:
    """Return the ids of the effects that a fit from a model carries; none for the baseline."""
    return set() if model is None else {effect.id for effect in model.active_effects()}


def named_models(texts: Iterable[str], effects: Iterable[str] | None) -> list[Model]:
    """Return the models, which may have the user's own effects that are named. Raises InputError (E-EFFECT) for other
    ones."""
    models, others = models_and_others(texts, effects)
    if others:
        from rockref.model.errors import InputError

        what = "is in no model here, and this command adds no effect"
        raise InputError("E-EFFECT", f"--effect {others[0]}", what, "Leave it out.")
    return models


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
            cure = f"Plausible is {plausible}; it is used as it is."
            remark("W-RANGE", f"{where}: {effect.id} {name}", f"{what}, which is not plausible", cure)


def check_step(model: Model | None, where: str | None) -> None:
    """Refuse a model whose releases cannot be computed with the step of the fits. Raises InputError (E-STEP, ...).

    A fit begins with the model, and the engine of the fits computes what it is given.
    """
    if model is None or where is None:
        return
    from rockref.measure.prediction import STEP
    from rockref.model.simulate import check

    with of_file(where):
        check(model.problem(step=STEP))


def say_idle(model: Model | None, where: str | None) -> None:
    """Print a remark on standard error where a fit leaves parameters out, since the model states its points itself.

    Raises InputError (E-MOOT) where it leaves none.
    """
    if model is None or where is None:
        return
    from rockref.discover.hypotheses.law import moved_parameters

    with of_file(where):
        moved = moved_parameters(model)
    if model.properties is None:
        return
    what = "states stiffness, damping and friction of its points, so that no fit moves those of [parameters]"
    remark("W-MOOT", f"{where}: [properties]", what, f"Of these {', '.join(moved)} are fitted.")


def say_left_out(model: Model, where: str) -> None:
    """Print a remark on standard error where a search of the law alone leaves the effects of a model out."""
    if not model.effects:
        return
    what = f"has {', '.join(effect.id for effect in model.effects)}, and the law alone is searched"
    remark("W-MOOT", where, what, "They are left out; rockref fit takes effects.")


def say_other_points(stated: str, where: Path) -> None:
    """Print a remark on standard error where an experiment states other points than are searched."""
    if stated == "eight_points":
        return
    what = f"states {stated} as its baseline, and eight points are searched"
    remark("W-MOOT", str(where), what, "rockref fit finds the parameters of the points that are stated.")


def labels(texts: Sequence[str]) -> list[str]:
    """Return a short name for each model: the file's without its ending; what is twice keeps its path."""
    short = [text if text in NAMED else Path(text).stem for text in texts]
    return [name if short.count(name) == 1 else text for name, text in zip(short, texts, strict=True)]


def with_effects(model: Model, texts: Sequence[str]) -> Model:
    """Return the model with effects added, written as ``id:key=value,key=value``; an effect that it has is replaced.

    A user's own that it has and that is named without parameters stays as it is.
    """
    from rockref.effects.catalogue import in_step_order, of_releases, parse

    texts = [text for text in texts if not (text.strip() == spec_of(text) and has(model, text))]
    if not texts:
        return model
    added = [parse(text) for text in texts]
    of_releases([effect.id for effect in added])
    for text, effect in zip(texts, added, strict=True):
        say_implausible([effect], f"--effect {text}")
    kept = [effect for effect in model.effects if effect.id not in {new.id for new in added}]
    return model.replace(effects=in_step_order([*kept, *added]))
