"""`rockref reproduce`: every study of the source in pieces that are kept, its figures, and one page."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.engines import run
from rockref.identify.candidates import releases
from rockref.identify.four_points import scenario_space
from rockref.identify.from_experiment import answered, question
from rockref.identify.genes import space_12
from rockref.identify.polish import Effort
from rockref.identify.search import Settings, versions
from rockref.identify.target import twin
from rockref.jobs.campaign import Campaign, campaign
from rockref.jobs.checkpoints import Pieces
from rockref.jobs.folder_lock import alone_in
from rockref.measure.experiment import load_experiment
from rockref.model.errors import InputError
from rockref.model.housner import housner
from rockref.model.storage import write_bytes, write_text
from rockref.report.charts.figures import rendered
from rockref.report.charts.sensitivity_figures import sensitivity_figures
from rockref.report.output import made_folder
from rockref.studies.reduction import reduction_study
from rockref.studies.scenarios import REFERENCE, SCENARIOS, try_scenarios
from rockref.studies.sensitivity import STEPS
from rockref.studies.sensitivity_study import record as sensitivity_record
from rockref.studies.sensitivity_study import study
from rockref.studies.source_facts import LONG, facts
from rockref.studies.twins import EFFORT, SEEDS, twin_experiments
from rockref.workflows import source_figures
from rockref.workflows.source_page import source_page

#: Dots an inch of the pictures in the page, which must stay below two megabytes with all of them (decided: a tenth is
#: left for longer tables).
PAGE_DPI = 76
#: Step of the records of reduction and scenarios [s]: half of that of their searches; decided: what these tell apart is
#: far above what the step does.
SEARCHED_STEP = 5e-6


#: The parts of the study, in the order in which they are made: quick ones first.
PARTS = ("response", "sensitivity", "scenarios", "reduction", "identification", "twins")


@dataclass(frozen=True)
class Budget:
    """How much each study may compute. Decided: all of it in a few minutes of two cores."""

    sensitivity: tuple[float, int] = (6.0, 10)  # duration [s], trials
    steps: tuple[float, ...] = STEPS
    identification: Settings = Settings(40, 250)  # the source's
    identification_effort: Effort = Effort(moves=1, walks=1)
    seeds: tuple[int, ...] = SEEDS
    twins: Settings = Settings(20, 40)
    twins_effort: Effort = EFFORT
    reduction: Settings = Settings(40, 80)
    scenarios: tuple[tuple[str, ...], ...] = (REFERENCE, *SCENARIOS)
    scenarios_settings: Settings = Settings(20, 30)


#: Everything once through with next to nothing: what it finds means nothing.
QUICK = Budget(
    sensitivity=(2.0, 2),
    steps=(1e-5, 5e-6),
    identification=Settings(4, 2),
    identification_effort=Effort(windows=(), steps=1, moves=0),
    seeds=(1,),
    twins=Settings(4, 2),
    twins_effort=Effort(windows=(), steps=1, moves=0),
    reduction=Settings(6, 5),
    scenarios=(REFERENCE, ()),
    scenarios_settings=Settings(4, 2),
)


def reproduce(
    folder: Path,
    experiment: Path | None,
    budget: Budget,
    workers: int | None = None,
    say: Callable[[str], None] = lambda line: None,
    only: Sequence[str] = (),
) -> Path:
    """Make everything that is not yet in `folder`, and the page; returns its path.

    experiment : to identify, a folder; without one that study is left out and the page has no section about it.
    only : names of the parts that are wanted, on a page with their names (all, on index.html).

    Raises InputError as the studies; E-KEY for a part that is not known; E-WRITE, E-PAGE-SIZE; E-BUSY.
    """
    for part in only:
        if part not in PARTS:
            raise InputError("E-KEY", "--only", f"is {part!r}", f"Use one of {', '.join(PARTS)}.")
    for part in ("", "pieces", "figures", "checkpoints"):
        made_folder(folder / part)
    with alone_in(folder):
        return _made(folder, experiment, budget, workers, say, only)


def _made(
    folder: Path,
    experiment: Path | None,
    budget: Budget,
    workers: int | None,
    say: Callable[[str], None],
    only: Sequence[str],
) -> Path:
    """Return the same in a folder that is there, of this process alone."""
    digests = load_experiment(experiment).digests if experiment else {}
    kept = Pieces(folder / "pieces", {"versions": versions()})
    art = _Art(folder / "figures")
    results: dict[str, Any] = {}
    with campaign(workers) as work:
        for name, make in _studies(folder, experiment, digests, budget, work, art).items():
            if only and name not in only:
                continue
            say(name)
            results[name] = make(kept)
    say("page")
    # Parts alone have files of their own: the page of everything stays.
    alone = "-".join(only)
    write_text(folder / f"{alone or 'results'}.json", json.dumps(results, indent=1) + "\n")
    provenance = {"versions": versions(), "inputs": digests, "budget": asdict(budget)}
    return source_page(results, art.pictures, provenance).write(folder / f"{alone or 'index'}.html")


class _Art:
    """Figures on disk as SVG and PNG, and small for the page."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.pictures: dict[str, bytes] = {}

    def keep(self, figures: dict[str, Any]) -> None:
        for name, figure in figures.items():
            for kind in ("png", "svg"):
                write_bytes(self.folder / f"{name}.{kind}", rendered(figure, kind))
            self.pictures[name] = rendered(figure, "png", PAGE_DPI)


def _studies(
    folder: Path, experiment: Path | None, digests: dict[str, str], budget: Budget, work: Campaign, art: _Art
) -> dict[str, Callable[[Pieces], Any]]:
    """Return what is made, by name, in the order of `PARTS`."""
    model = Model.table_3_1()

    def identified() -> dict[str, Any]:
        assert experiment is not None
        result, found = answered(
            question(experiment), budget.identification, work, folder / "checkpoints", resume=True, rounds=0,
            effort=budget.identification_effort,
        )  # fmt: skip
        found.save(folder / "model.toml")
        return result

    def twins(kept: Pieces) -> list[dict[str, Any]]:
        def make(seeds):
            return twin_experiments(model, seeds, budget.twins, work, budget.twins_effort)

        rows = kept.each("twin", budget.seeds, make, [asdict(budget.twins), asdict(budget.twins_effort)])
        art.keep({"twins": source_figures.twins_figure(rows)})
        return rows

    def reduced(kept: Pieces) -> dict[str, Any]:
        target, checkpoint = twin(model, SEARCHED_STEP, 1), folder / "checkpoints" / "reduction.json"
        result = kept.once(
            "reduction", lambda: reduction_study(target, budget.reduction, work, checkpoint), asdict(budget.reduction)
        )
        art.keep({"reduction": source_figures.reduction_figure(result)})
        return result

    found: dict[str, Callable[[Pieces], Any]] = {
        "response": lambda kept: _response(model, art),
        "sensitivity": lambda kept: _sensitivity(model, budget, work, art),
        "scenarios": lambda kept: _scenarios(model, budget, work, kept, art),
        "reduction": reduced,
        "identification": lambda kept: kept.once(
            "identification", identified, [asdict(budget.identification), asdict(budget.identification_effort), digests]
        ),
        "twins": twins,
    }
    if experiment is None:
        del found["identification"]
    return found


def _response(model: Model, art: _Art) -> dict[str, Any]:
    """Compute the response, which takes a second, so that it is not kept."""
    response = run(model.problem(LONG, output_rate=2000.0), engine="auto")
    J = float(np.asarray(response.problem.block.inertia)[0, 0])
    plane = housner(model.mass, model.width, model.height, J, model.g, model.parameters.theta_0, LONG, 500.0, 1e-3)
    art.keep(source_figures.response_figures(response, plane))
    return {"facts": [asdict(f) for f in facts(response)], "main_impacts_s": response.main_impacts().tolist()}


def _sensitivity(model: Model, budget: Budget, work: Campaign, art: _Art) -> dict[str, Any]:
    """Compute the sensitivity, which takes some seconds, so that it is not kept."""
    duration, trials = budget.sensitivity
    found = study(model, 0, duration, budget.steps, trials, work.threads)
    art.keep(sensitivity_figures(found))
    return sensitivity_record(found)


def _scenarios(model: Model, budget: Budget, work: Campaign, kept: Pieces, art: _Art) -> list[dict[str, Any]]:
    target = twin(model, SEARCHED_STEP, None)

    def make(names: Sequence[str]) -> Iterator[tuple[int, dict[str, Any]]]:
        return try_scenarios(target, budget.scenarios_settings, work, [by_name[name] for name in names])

    by_name = {"-".join(s) or "none": s for s in budget.scenarios}
    rows = kept.each("scenario", list(by_name), make, asdict(budget.scenarios_settings))
    best = sorted(rows[1:], key=lambda row: row["cost"])[:3]
    drawn = []
    for row in [rows[0], *best]:
        defects = tuple(row["defects"])
        space = space_12(model, target.tilt) if defects == REFERENCE else scenario_space(defects, target.tilt)
        [(t, crv)] = releases(space, [target], [[np.array(row["u"])]])
        drawn.append((f"{row['name']} (cost {row['cost']:.2f})", t, crv[0]))
    art.keep({"scenarios": source_figures.scenarios_figure(target.t, target.crv, drawn)})
    return rows
