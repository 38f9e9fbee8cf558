"""An experiment folder to an identified model: the holdout runs are opened when the parameters are fixed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rockref.api import Model
from rockref.identify.genes import Space, space_12, space_54
from rockref.identify.identifiability import identifiability
from rockref.identify.identification import ROUNDS, identify
from rockref.identify.outcome import found_model, record
from rockref.identify.polish import Effort
from rockref.identify.runs import run_errors
from rockref.identify.search import Progress, Settings
from rockref.identify.target import Target, chosen_runs, targets_of
from rockref.jobs.campaign import Campaign
from rockref.measure.experiment import load_experiment
from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError


@dataclass(frozen=True)
class Question:
    """What is to be identified, checked: nothing was written for it, and no holdout run was opened.

    targets : the fit runs;  chosen : those of the evolutionary search;  space : the genes;  stated : the baseline that
    the experiment states;  notices : what the reader remarked on.
    """

    experiment: Path
    targets: tuple[Target, ...]
    chosen: tuple[Target, ...]
    space: Space
    stated: str
    notices: tuple[Notice, ...] = ()


def question(experiment: Path, base: Model | None = None, genes: int = 12, search_runs: str | None = None) -> Question:
    """Return what is to be identified from an experiment's fit runs.

    base : gives what is not searched;  genes : 12 or 54;  search_runs : of the evolutionary search, as "01,06".

    Raises InputError (E-KEY, E-KIND, E-RUN, E-MOOT, ...).
    """
    if genes not in (12, 54):
        raise InputError("E-KEY", "--genes", f"is {genes}", "Use 12 or 54.")
    data = load_experiment(experiment, uses=("fit",))
    targets = targets_of(data)
    check_searched(base, genes)
    chosen = chosen_runs(targets, search_runs)
    # Release angles are counted from the model's: it has to be that about which the gene of the angle is searched.
    model = (base or Model.table_3_1()).replace(
        mass=data.mass, width=data.width, depth=data.width, height=data.height, points="eight_points", effects=(),
        theta_0=chosen[0].tilt,
    )  # fmt: skip
    space = (space_12 if genes == 12 else space_54)(model, chosen[0].tilt)
    return Question(experiment, targets, chosen, space, data.baseline, data.notices)


def answered(
    asked: Question,
    settings: Settings,
    work: Campaign,
    folder: Path,
    *,
    resume: bool = False,
    report: Callable[[Any, str, Progress], None] | None = None,
    effort: Effort = Effort(),  # noqa: B008 - frozen
    rounds: int = ROUNDS,
) -> tuple[dict[str, Any], Model]:
    """Return the record (`rockref.identify.outcome.record`) and the model that answer a question.

    folder : of the checkpoints;  report : called with (space, stage, progress).  Raises InputError (E-RESUME, ...).
    """
    space, targets = asked.space, asked.targets
    say = None if report is None else (lambda stage, p: report(space, stage, p))
    end = identify(space, asked.chosen, targets, settings, work, folder, resume, say, rounds, effort=effort)
    known = identifiability(space, targets, end.polished)
    # Only now, with the parameters fixed, are the holdout runs opened.
    everything = load_experiment(asked.experiment)
    holdout = targets_of(everything, everything.holdout_runs())
    errors = run_errors(space, end.polished, targets, holdout)
    result = record(end, known, errors, asked.chosen, targets, settings, everything.digests)
    return result, found_model(end, known, everything.digests, settings.seed)


def check_searched(base: Model | None, genes: int) -> None:
    """Refuse a model on other points than are searched, or with which some genes would change nothing (E-MOOT)."""
    if base is not None and base.points == "custom":
        what = "stands on points of its own, and eight points are searched"
        raise InputError("E-MOOT", "--model", what, "Take [custom_points] out.")
    if base is not None and base.points == "four_points":
        cure = "Give a model on eight points; rockref fit takes four."
        raise InputError("E-MOOT", "--model", "stands on four points, and eight are searched", cure)
    if base is not None and base.properties is not None and genes == 12:
        what = "states the properties of its points, so that stiffness, damping and friction of the 12 change nothing"
        raise InputError("E-MOOT", "--model", what, "Use --genes 54, or take [properties] out.")
