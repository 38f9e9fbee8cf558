"""One more effect in a model: fitted with everything else, and the error before and after on every kind of run."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import baseline_model
from rockref.discover.compare.stretches import AXES
from rockref.discover.fit.errors import FIT_STRETCH, STRETCHES, Errors, errors_of, holdout_errors, spread_of
from rockref.discover.fit.families import Family, afresh, mean_loss
from rockref.discover.fit.fitted import Estimate, estimates, fitted_model, in_file_order, origin_of
from rockref.discover.fit.information import covariance, information
from rockref.discover.fit.search import Setup, baseline
from rockref.discover.fitting import started_family
from rockref.discover.looking.presearch import MISLEADING, release_fit, tone
from rockref.discover.looking.resized import resized
from rockref.discover.looking.screen import screen
from rockref.discover.windows.opened import opened
from rockref.effects import catalogue
from rockref.measure.experiment import Experiment
from rockref.model.errors import InputError

#: Effects that must be there before the runs are cut into windows: they spoil the reconstructed state, or need a tone.
FROM_THE_START = (*MISLEADING, "base_vibration")
#: Iterations of the refit with the effect; the model without it gets as many.
ITERATIONS = 6
#: Iterations of the model without it, on short and on longer windows.
START = (6, 8)


@dataclass(frozen=True)
class State:
    """A model of the history: its effects, errors on fit and (where known) held-out runs."""

    effects: tuple[str, ...]
    fit: Errors
    holdout: Errors | None

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers, as they stand in a model's origin."""
        found: dict[str, Any] = {"effects": list(self.effects), "fit_deg_s": self.fit.total}
        found["fit_by_stretch_deg_s"] = _cells(self.fit)
        if self.holdout is not None:
            found |= {"holdout_deg_s": self.holdout.total, "holdout_by_stretch_deg_s": _cells(self.holdout)}
        return found


def _cells(errors: Errors) -> list[float]:
    """Nine numbers, stretch by stretch; -1 where there was no window."""
    return [float(v) if np.isfinite(v) else -1.0 for v in errors.table.ravel()]


@dataclass
class Addition:
    """What `rockref add` found: the model with the effect, the state before and after, the yardsticks."""

    experiment: Experiment
    effect: str
    before: State
    after: State
    model: Model
    estimates: list[Estimate]
    spread: np.ndarray | None
    history: list[dict[str, Any]]
    end: float
    seconds: float
    family: Family = field(repr=False)

    @property
    def noise(self) -> float:
        """The noise floor, deg/s."""
        return self.after.fit.noise

    def closed(self, use: str) -> float | None:
        """Which share of the gap between error and noise floor the effect closes on the runs of one use."""
        before, after = getattr(self.before, use), getattr(self.after, use)
        if before is None or after is None or before.total <= self.noise:
            return None
        return (before.total - after.total) / (before.total - self.noise)

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        from rockref.discover.provenance import versions

        def both(state: State) -> dict[str, Any]:
            holdout = None if state.holdout is None else state.holdout.to_dict()
            return {"effects": list(state.effects), "fit": state.fit.to_dict(), "holdout": holdout}

        spread = None if self.spread is None else dict(zip(AXES, map(float, self.spread), strict=True))
        return {
            "experiment": self.experiment.name,
            "effect": self.effect,
            "parameters": {e.name: e.to_dict() for e in self.estimates},
            "error": {
                "unit": "deg/s RMS",
                "stretch": FIT_STRETCH.format(end=self.end),
                "noise_floor": self.noise,
                "two_repeated_runs_differ_by": spread,
                "before": both(self.before),
                "after": both(self.after),
                "gap_closed": {"fit": self.closed("fit"), "holdout": self.closed("holdout")},
            },
            "history": self.history,
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


def add(
    effect: str,
    path: str | Path,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = 3.0,
    progress: Callable[[str], None] | None = None,
) -> Addition:
    """Fit one more effect into a model, jointly with everything that the model has.

    Parameters
    ----------
    effect : id or path/to/file.py:Class; path : experiment folder
    model : what it is added to (None: the baseline of the experiment)
    seed, workers, end, progress : as in `rockref.discover.fitting.fit_experiment`.

    Raises
    ------
    InputError
        E-EFFECT (unknown, or the model has it already), or where the experiment cannot be used.
    """
    begun = time.perf_counter()
    say = progress or (lambda line: None)
    (effect,) = (kind.id for kind in catalogue.of_releases([effect], "argument effect"))
    experiment, whole = opened(path)
    base = baseline_model(experiment, model)
    own = tuple(e.id for e in base.active_effects())
    if effect in own:
        raise InputError("E-EFFECT", f"argument {effect}", "is in the model already", "Add another one.")
    setup = Setup(experiment, experiment.fit_runs(), base, end, seed, workers, say)
    setup = with_tone(setup, (*own, effect))
    say(f"the model without {effect}")
    # A model that was fitted before begins where it ended: fewer iterations on the short windows are enough.
    before = started_family(setup, own, iterations=START)
    say(f"the model with {effect}")
    after = with_one_more(setup, before, effect, seed)
    rng = np.random.default_rng(seed + 1)
    before = Family(own, before.fit, before.fit.run(before.point, ITERATIONS, rng))
    say("held-out runs")
    states = [state_of(setup, family) for family in (before, after)]
    say("intervals")
    found = information(after.fit, after.point)
    numbers = in_file_order(estimates(after.fit, after.point, covariance(after.fit, found)))
    history = [*earlier(base, own), *(state.to_dict() for state in states)]
    origin = origin_of(experiment, seed, "rockref add") | {"history": history}
    return Addition(
        experiment=experiment,
        effect=effect,
        before=states[0],
        after=states[1],
        model=fitted_model(after.fit, after.point, numbers, origin),
        estimates=numbers,
        spread=spread_of(whole, end),
        history=history,
        end=end,
        seconds=time.perf_counter() - begun,
        family=after,
    )


def earlier(model: Model, own: tuple[str, ...]) -> list[dict[str, Any]]:
    """The model's history up to the state before its own effects, which is measured anew."""
    listed = model.origin.get("history", [])
    return [dict(entry) for entry in listed if sorted(entry.get("effects", [])) != sorted(own)]


def with_tone(setup: Setup, effects: tuple[str, ...]) -> Setup:
    """The setup with the frequency of a shaking base: the model's, else that of the strongest tone at release."""
    if "base_vibration" not in effects:
        return setup
    for e in setup.base.effects:
        if e.id == "base_vibration":
            return replace(setup, frequency=float(e.values()["frequency"]))
    plain = replace(setup, base=setup.base.replace(effects=()))
    fit, point = release_fit(plain)
    return replace(setup, frequency=tone(fit, point)[0])


def with_one_more(setup: Setup, before: Family, effect: str, seed: int) -> Family:
    """The family with one more effect, refitted jointly."""
    effects = (*before.effects, effect)
    plain = replace(setup, base=before.fit.base)
    if effect in FROM_THE_START:
        # The release, where nothing is restarted, tells where a sensor or a shaking base begins.
        bare = replace(setup, base=setup.base.replace(effects=()))
        family = started_family(setup, effects, release_fit(bare, effects, iterations=12)[1].z, iterations=START)
        fit, point = family.fit, family.point
    else:
        trial = screen(before.fit, before.point, (catalogue.find(effect),), plain, before.effects)[0]
        z = np.zeros(len(trial.fit.parameters))
        z[: len(trial.point.z)] = trial.point.z  # where no step along the effect was better, it begins absent
        # From short windows on: from long ones a large effect is reached in steps that are too small.
        found = Family(effects, *baseline(plain, effects, z, iterations=START))
        found = min(found, afresh(plain, found), key=mean_loss)
        fit, point = found.fit, found.point
    found = Family(effects, fit, fit.run(point, ITERATIONS, np.random.default_rng(seed + 1)))
    return resized(plain, found, seed)


def state_of(setup: Setup, family: Family) -> State:
    """Errors of a family on fit and held-out runs."""
    model = family.fit.models(family.point.z)[0][0]
    return State(family.effects, errors_of(family.fit, family.point), holdout_errors(setup, model, family.effects))


def cell_names() -> list[tuple[str, str]]:
    """Stretch and axis of the nine numbers of a state, in their order."""
    return [(stretch, axis) for stretch in STRETCHES for axis in AXES]
