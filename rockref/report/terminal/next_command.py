"""The command to type next: what each verb proposes at its end, quoted as a shell takes it."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from rockref.effects import catalogue

if TYPE_CHECKING:
    from rockref.api import Model
    from rockref.discover.add_effect import Addition
    from rockref.discover.fit_baseline import BaselineFit
    from rockref.discover.plan import Plan

#: The name of an experiment's own baseline, in the place of a model file.
BASELINE = "baseline"


def command(*words: object) -> str:
    """Return a command of rockref, each word quoted where a shell needs it."""
    return shlex.join(["rockref", *map(str, words)])


def effect_words(id: str) -> str:
    """Return an effect as it is typed: its id, or file and class of a user's own."""
    own = catalogue.OWN.get(id)
    return id if own is None or own.file is None else own.file


def own_effects(model: Model | None) -> list[str]:
    """Return the options that let a model file have the user's own effects of `model`."""
    files = [effect.file for effect in model.effects if effect.file] if model is not None else []
    return [word for file in files for word in ("--effect", file)]


def model_options(name: object, model: Model | None) -> list[str]:
    """Return the options that name a model file and its own effects; none for the baseline."""
    return [] if name is None else ["--model", str(name), *own_effects(model)]


def after_import(folder: object) -> str:
    """Return what follows ``rockref new``."""
    return command("compare", folder)


def after_comparison(experiment: object, names: Sequence[str], models: Sequence[Model]) -> str:
    """Return what follows ``rockref compare``: what the last of the model files lacks."""
    files = [(name, model) for name, model in zip(names, models, strict=False) if name != BASELINE]
    name, model = files[-1] if files else (None, None)
    return command("diagnose", experiment, *model_options(name, model), "--report", "report")


def after_diagnosis(
    d: dict[str, Any], experiment: object, name: object = None, model: Model | None = None, page: bool = False
) -> str:
    """Return what follows ``rockref diagnose`` from its JSON record: each effect is added.

    Without one the page is looked at; where it was written, a law that suffices is fitted, and one that does not is
    compared with the runs.

    name, model : what the diagnosis began with; None for the baseline.  page : whether it was written.
    """
    if not d["effects"]:
        verb = "diagnose" if not page else "fit" if d["verdict"] == "none" else "compare"
        report = [] if verb == "fit" else ["--report", "compared" if page else "report"]
        return command(verb, experiment, *model_options(name, model), *report)
    # Members of a class exclude one another: the first of them is tried.
    effects = d["effects"][:1] if d["verdict"] == "class" else d["effects"]
    steps, own = [], own_effects(model)
    for id in effects:
        start = [] if name is None else ["--model", str(name), *own]
        last = id == effects[-1]
        output = [] if last else ["--output", f"with_{id}.toml"]
        steps.append(command("add", experiment, effect_words(id), *start, *output))
        name, own = f"with_{id}.toml", own + _trust(id)
    return " && ".join(steps)


def _trust(id: str) -> list[str]:
    return ["--effect", effect_words(id)] if effect_words(id) != id else []


def after_fit(found: BaselineFit, experiment: object, output: object, name: object, start: Model | None) -> str:
    """Return what follows ``rockref fit``."""
    if found.outcome == "effect_missing":
        return command("diagnose", experiment, *model_options(name, start))
    return command("compare", experiment, *model_options(output, found.model))


def after_addition(a: Addition, experiment: object, output: object, before: object = None) -> str:
    """Return what follows ``rockref add``: the new model beside the one before."""
    return command("compare", experiment, "--model", before or BASELINE, *model_options(output, a.model))


def after_plan(p: Plan, model: str, candidates: Iterable[str] = ()) -> str:
    """Return what follows ``rockref plan``: the same plan with the run that helps most."""
    runs = ",".join(map(str, [*p.outlook.runs, p.further[0]["run"]]))
    listed = [word for effect in candidates for word in ("--effect", effect)]
    return command("plan", *([] if model == "table_3_1" else ["--model", model]), "--runs", runs, *listed)


def after_identification(result: dict[str, Any], experiment: object, model: object) -> str:
    """Return what follows ``rockref identify``."""
    if result["least_squares"]["at_noise_floor"]:
        return command("compare", experiment, "--model", model)
    return command("diagnose", experiment)
