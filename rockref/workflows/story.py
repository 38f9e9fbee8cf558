"""The whole path on one experiment: compared, diagnosed, the effect added, the error before and after."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from rockref.discover.add_effect import Addition, add_effect
from rockref.discover.compare.models import Comparison, baseline_model, compare
from rockref.discover.diagnose import Diagnosis, diagnose
from rockref.discover.fit_store import FitStore
from rockref.discover.progress import StageReport
from rockref.measure.experiment import load_experiment

#: Verdicts after which an effect is added.
ADDED = ("named", "indicated", "pair", "class")
#: Steps of the story, with the page that follows it, and how long what follows a diagnosis takes, as a share of it
#: (measured on a shipped experiment).
STEPS, AFTER = 4, 0.4
#: Seconds of each run that are used; decided: about half of what a diagnosis uses, which is enough for an effect of its
#: typical size.
QUICK_END = 1.6


@dataclass
class Journey:
    """What was found at each step; `addition` is None where the diagnosis names nothing that could be added."""

    diagnosis: Diagnosis
    addition: Addition | None
    comparison: Comparison


def step(
    number: int, name: str, report: Callable[[StageReport], None], after: float = 0.0
) -> Callable[[StageReport], None]:
    """Return what passes the stages of one step on as those of the story; after : time of what follows, as a share."""
    started = time.monotonic()

    def tell(inner: StageReport) -> None:
        left, spent = inner.seconds_left, time.monotonic() - started
        if left is not None:
            left += after * (spent + left)
        report(StageReport(number, STEPS, f"{name}: {inner.name}", inner.best, left, inner.line))

    return tell


def run_story(experiment: str | Path, report: Callable[[StageReport], None], engine: str = "auto") -> Journey:
    """Diagnose, add the first effect of the verdict, and compare: the nominal baseline and what was found.

    report : called with every stage. The addition starts from the fits of the diagnosis.

    Raises
    ------
    InputError, NumericalError
    """
    store = FitStore(fresh=True, on_disk=False)
    found = diagnose(experiment, end=QUICK_END, progress=step(1, "diagnosing", report, AFTER), store=store)
    addition = None
    if found.verdict in ADDED:
        effect = found.effects[0]
        adding = step(2, f"adding {effect}", report)
        addition = add_effect(effect, experiment, end=QUICK_END, progress=adding, store=store)
    report(StageReport(3, STEPS, "comparing before and after"))
    loaded = load_experiment(experiment)
    models, names = [baseline_model(loaded)], ["baseline"]
    if addition is not None:
        models.append(addition.model)
        names.append(f"with {addition.effect}")
    return Journey(found, addition, compare(loaded, models, names, engine=engine))
