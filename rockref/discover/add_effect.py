"""`rockref add`: fit one more effect jointly with everything that a model has, and measure the error before and after.

1. Fit the model without the effect, and with it: from kept fits, or through all stages.
2. With the effect: also by one step of everything at the longest memory, where weak effects show. The better fit stays.
3. Fit the releases of the held-out runs, everything else kept, and measure the innovations by axis.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import baseline_model
from rockref.discover.compare.stretches import AXES
from rockref.discover.diagnose import error_record
from rockref.discover.evidence.collect import errors, hypothesis_evidence
from rockref.discover.evidence.evidence import Number
from rockref.discover.evidence.held_out import held_out_fit, held_out_listener
from rockref.discover.evidence.result import model_of
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import END
from rockref.discover.fit.stages import F
from rockref.discover.fit_baseline import (
    added_at_once,
    fitted,
    lengthened,
    model_start,
    noise_floor,
    number_record,
    prepared,
    with_one_more,
)
from rockref.discover.fit_store import FitStore
from rockref.discover.listening.records import opened
from rockref.discover.progress import StageCounter, StageReport
from rockref.discover.provenance import versions
from rockref.discover.threads import one_blas_thread
from rockref.discover.verdict.calibration import calibration
from rockref.effects import catalogue
from rockref.measure.reading.keys import USES
from rockref.measure.records.release import Experiment
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.repeatability import repeat_groups, repeatability
from rockref.model.errors import InputError

#: Stages of an addition, each with its share of the time (decided: as the stages of a diagnosis that do the same).
STAGES = {"baseline": 5.0, "starts": 29.0, "effects": 15.0, "held-out": 3.0, "intervals": 1.0}


@dataclass(frozen=True)
class State:
    """A model of the history: its effects, and its errors by axis and in all [deg/s] on fit and held-out runs."""

    effects: tuple[str, ...]
    fit: dict[str, float]
    holdout: dict[str, float] | None

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers, as they stand in a model's origin."""
        found: dict[str, Any] = {"effects": list(self.effects), "fit_deg_s": self.fit["total"]}
        found["fit_by_axis_deg_s"] = [self.fit[axis] for axis in AXES]
        if self.holdout is not None:
            found["holdout_deg_s"] = self.holdout["total"]
            found["holdout_by_axis_deg_s"] = [self.holdout[axis] for axis in AXES]
        return found


@dataclass
class Addition:
    """What `rockref add` found: the model with the effect, the states before and after, the yardsticks.

    without : the model before;  numbers : of effects and of the law;  noise : of a sample [deg/s]
    spread : by how much two repeated runs differ about each axis [deg/s], None without repeats
    end : seconds used of each run
    """

    experiment: Experiment
    effect: str
    before: State
    after: State
    model: Model
    numbers: dict[str, Number]
    spread: np.ndarray | None
    noise: float
    history: list[dict[str, Any]]
    end: float
    seconds: float
    from_store: bool = False
    without: Model | None = None

    @property
    def own_numbers(self) -> dict[str, Number]:
        """Return the numbers of the added effect that all runs share."""
        return {name: n for name, n in self.numbers.items() if name.startswith(f"{self.effect}.") and "[" not in name}

    def gap_closed(self, use: str) -> float | None:
        """Return which share of the gap between error and noise floor the effect closes on the runs of one use."""
        before, after = getattr(self.before, use), getattr(self.after, use)
        if before is None or after is None or before["total"] <= self.noise:
            return None
        return (before["total"] - after["total"]) / (before["total"] - self.noise)

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""

        def both(state: State) -> dict[str, Any]:
            return {"effects": list(state.effects), "fit": state.fit, "holdout": state.holdout}

        spread = None if self.spread is None else dict(zip(AXES, map(float, self.spread), strict=True))
        return {
            "experiment": self.experiment.name,
            "effect": self.effect,
            "parameters": {name: number_record(n) for name, n in self.numbers.items()},
            "error": error_record(
                self.end,
                self.noise,
                two_repeated_runs_differ_by=spread,
                before=both(self.before),
                after=both(self.after),
                gap_closed={use: self.gap_closed(use) for use in USES},
            ),
            "history": self.history,
            "started_from_kept_fit": self.from_store,
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


@one_blas_thread()
def add_effect(
    effect: str,
    path: str | Path,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = END,
    progress: Callable[[StageReport], None] | None = None,
    store: FitStore | None = None,
) -> Addition:
    """Fit one more effect into a model, jointly with everything that the model has.

    Parameters
    ----------
    effect : id or path/to/file.py:Class; path : experiment folder
    model : what it is added to (None: the baseline of the experiment)
    seed, workers, end, progress, store : as in `rockref.discover.fit_baseline.fit_baseline`.

    Raises
    ------
    InputError
        E-EFFECT (unknown, or the model has it already), or where the experiment cannot be used.
    """
    started = time.perf_counter()
    (effect,) = (kind.id for kind in catalogue.of_releases([effect], "argument effect"))
    experiment, whole = opened(path)
    base = baseline_model(experiment, model)
    if effect in (e.id for e in base.active_effects()):
        raise InputError("E-EFFECT", f"argument {effect}", "is in the model already", "Add another one.")
    fitter = prepared(experiment, whole, model, end, workers, seed, StageCounter(STAGES, progress), store)
    problem = fitter.problem
    before, _, _ = fitted(fitter, problem.carried, base, store)
    after, known = joined(fitter, before, effect, model_start(problem, base), store)
    problem.progress.begin("held-out", "checking on held-out runs", after.name)
    states = [state_of(fitter, h, whole) for h in (before, after)]
    problem.progress.begin("intervals", "computing intervals")
    said = hypothesis_evidence(fitter, after, *calibration().widths)
    history = [*earlier(base, problem.carried), *(state.to_dict() for state in states)]
    return Addition(
        experiment=whole,
        effect=effect,
        before=states[0],
        after=states[1],
        model=model_of(fitter, after, said, "rockref add", history=history),
        numbers={**said.numbers, **said.law},
        spread=spread_of(whole, problem.listener.end),
        noise=noise_floor(problem),
        history=history,
        end=problem.listener.end,
        seconds=time.perf_counter() - started,
        from_store=known,
        without=fitter.model(before),
    )


def joined(
    fitter: Fitter, before: FittedModel, effect: str, start: np.ndarray, store: FitStore | None
) -> tuple[FittedModel, bool]:
    """Return a model at F with one more effect, and whether it began at a kept fit."""
    known = None if store is None else store.start(fitter.problem, (*before.effects, effect))
    if known is not None and known[1] is F:
        return fitter.refine(known[0], F, 2), True
    fitter.problem.progress.begin("effects", f"adding {effect}", before.name)
    at_once = added_at_once(fitter, before, effect)
    if known is not None:
        through, _ = lengthened(fitter, known[0], after=known[1].name)
    else:
        through, _ = lengthened(fitter, with_one_more(fitter, before.copy(), effect, start))
    return min(at_once, through, key=lambda h: h.objective), known is not None


def state_of(fitter: Fitter, h: FittedModel, whole: Experiment) -> State:
    """Return the errors of a fit on fit and held-out runs."""
    held = None
    if (listener := held_out_listener(fitter, whole)) is not None:
        held = errors(*held_out_fit(fitter, h, listener))
    return State(h.effects, errors(fitter, h), held)


def earlier(model: Model, own: tuple[str, ...]) -> list[dict[str, Any]]:
    """Return the model's history up to the state before its own effects, which is measured anew."""
    listed = model.origin.get("history", [])
    return [dict(entry) for entry in listed if sorted(entry.get("effects", [])) != sorted(own)]


def spread_of(experiment: Experiment, end: float) -> np.ndarray | None:
    """Return by how much two repeated runs differ about each axis, (3,) deg/s, up to `end` s; None without repeats.

    The root of two times the standard deviation between runs, noise included, aligned at the first main impact.
    """
    squares = []
    for group in repeat_groups(experiment.runs):
        pairs = [(run.t, run.crv) for run in group if run.t is not None and run.crv is not None]
        found = repeatability(pairs)
        first = float(main_impacts(*pairs[0]).times[0])
        seen = found.spread[found.t < end - first]
        squares.append(2.0 * np.nanmean(seen**2, axis=0))
    return np.degrees(np.sqrt(np.mean(squares, axis=0))) if squares else None
