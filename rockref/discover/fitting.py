"""`rockref fit`: the baseline, with effects if wanted, found on the fit runs of an experiment, and its gates."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import baseline_model
from rockref.discover.fit.errors import FIT_STRETCH, Errors, errors_of
from rockref.discover.fit.families import Family, mean_loss
from rockref.discover.fit.fitted import Estimate, estimates, fitted_model, in_file_order, origin_of, start_from
from rockref.discover.fit.gates import Gate, gates, other_start, starts_agree
from rockref.discover.fit.information import Information, covariance, information
from rockref.discover.fit.search import Setup, baseline
from rockref.discover.looking.presearch import suspects
from rockref.discover.windows.opened import opened
from rockref.effects import catalogue
from rockref.measure.experiment import Experiment

#: A set of effects without which the windows cannot even be restarted is taken along where it lowers the mean loss
#: by this factor (as the diagnosis does).
CLEARLY = 1.15

#: Most iterations on short and on longer windows; decided: on a control the objective still falls after ten.
ITERATIONS = (10, 20)
#: The same for a plain baseline that the release windows refute already.
FEW = (3, 2)
#: Starts of a fit whose gates are asked for, at most; decided: two that end in one place are enough, and of two that do
#: not one may have stopped in a side valley.
STARTS = 3


@dataclass
class Fitted:
    """What `rockref fit` found: the model, its numbers, the gates, errors on the fit runs."""

    experiment: Experiment
    model: Model
    effects: tuple[str, ...]
    estimates: list[Estimate]
    gates: list[Gate]
    errors: Errors
    mean_loss: float
    seconds: float
    setup: Setup = field(repr=False)
    family: Family = field(repr=False)

    @property
    def passed(self) -> bool:
        """Whether every gate was passed."""
        return all(gate.passed for gate in self.gates)

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        from rockref.discover.provenance import versions

        return {
            "experiment": self.experiment.name,
            "effects": list(self.effects),
            "parameters": {e.name: e.to_dict() for e in self.estimates},
            "gates": {"passed": self.passed, "checks": [gate.to_dict() for gate in self.gates]},
            "error": {
                "unit": "deg/s RMS",
                "stretch": FIT_STRETCH.format(end=self.setup.end),
                "noise_floor": self.errors.noise,
                "fit": self.errors.total,
            },
            "mean_loss": round(self.mean_loss, 4),
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


def known_effects(effects: tuple[str, ...]) -> tuple[str, ...]:
    """The ids of effects that are named by id or, a user's own, by path/to/file.py:Class.

    Raises InputError (E-EFFECT, E-FILE) for one that nobody knows, cannot be used, is twice, or is of tosses only.
    """
    return tuple(kind.id for kind in catalogue.of_releases(effects))


def fit_experiment(
    path: str | Path,
    effects: tuple[str, ...] | None = None,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = 3.0,
    check: bool = True,
    progress: Callable[[str], None] | None = None,
) -> Fitted:
    """Find the parameters of the baseline on the fit runs; held-out runs are not opened.

    Parameters
    ----------
    path : experiment folder; model : starts from it in place of the nominal baseline
    effects : to be fitted along with those that `model` has, ids or file.py:Class; None lets the release decide whether
        a sensor error or a shaking base comes along
    seed : of the random restarts; workers : threads; end : seconds used of each run
    check : go through the gates (costs about as much as the fit); progress : called with a line at every stage.

    Raises
    ------
    InputError
        where the experiment cannot be used, or an effect is unknown.
    """
    begun = time.perf_counter()
    say = progress or (lambda line: None)
    experiment, _ = opened(path)
    base = baseline_model(experiment, model)
    setup = Setup(experiment, experiment.fit_runs(), base, end, seed, workers, say)
    say("release windows")
    if effects is None:
        setup, family = chosen_family(setup)
    else:
        setup, _, seen = suspects(setup)
        family = started_family(setup, beside(setup, known_effects(effects)), start_of(setup, seen, effects))
    other = None
    if check:
        family, other, found = begun_again(replace(setup, base=family.fit.base), family, seed, say)
    else:
        say("information of each run")
        found = information(family.fit, family.point)
    fit, point = family.fit, family.point
    checks = gates(fit, point, found, other.point) if other is not None else []
    numbers = in_file_order(estimates(fit, point, covariance(fit, found)))
    seen_errors = errors_of(fit, point)
    origin = origin_of(experiment, seed, "rockref fit") | {
        "gates_passed": all(gate.passed for gate in checks) if checks else "not checked",
        "history": [{"effects": list(family.effects), "fit_deg_s": seen_errors.total}],
    }
    return Fitted(
        experiment=experiment,
        model=fitted_model(fit, point, numbers, origin),
        effects=family.effects,
        estimates=numbers,
        gates=checks,
        errors=seen_errors,
        mean_loss=mean_loss(family),
        seconds=time.perf_counter() - begun,
        setup=setup,
        family=family,
    )


def begun_again(
    setup: Setup, family: Family, seed: int, say: Callable[[str], None]
) -> tuple[Family, Family, Information]:
    """A fit and the same fit from other starts: the nearest to the runs, of the others the one that confirms it, and
    what each run says of the nearest.

    A third start is only made where two do not end in the same place. What is kept stands on two that do.
    """
    ends, best = [family], family
    known: Information | None = None
    for k in range(1, STARTS):
        say("gates: another start")
        begin = other_start(family.fit.parameters, family.point.z, seed + k)
        found = baseline(replace(setup, seed=seed + k), family.effects, begin, iterations=ITERATIONS)
        ends = sorted([*ends, Family(family.effects, *found)], key=mean_loss)
        if known is None or best is not ends[0]:
            best, known = ends[0], information(ends[0].fit, ends[0].point)
        agree = [starts_agree(best.fit, best.point, end.point, known) for end in ends[1:]]
        nearest = min(range(len(agree)), key=lambda i: agree[i].value)
        if agree[nearest].passed:
            break
    assert known is not None  # there are two starts at least
    return best, ends[1 + nearest], known


def started_family(
    setup: Setup, effects: tuple[str, ...], seen: np.ndarray | None = None, iterations=ITERATIONS
) -> Family:
    """The baseline with these effects, begun where the release windows or the setup's own model say."""
    plain = replace(setup, base=setup.base.replace(effects=()))
    parameters = plain.parameters(effects)
    z = start_from(parameters, setup.base)
    if seen is not None:
        n = len(seen)
        z[:n] = np.where(z[:n] == 0, np.clip(seen, -3, 3), z[:n])
    fit, point = baseline(plain, effects, z, iterations=iterations)
    return Family(effects, fit, point)


def beside(setup: Setup, effects: tuple[str, ...]) -> tuple[str, ...]:
    """The effects that the setup's own model has, which are fitted again, and these."""
    return tuple(dict.fromkeys((*(e.id for e in setup.base.active_effects()), *effects)))


def start_of(setup: Setup, seen: dict[str, Any], effects: tuple[str, ...]) -> np.ndarray | None:
    """Where the release windows say that a set of effects begins, beside those of the setup's own model, of which they
    say nothing; None where they say nothing of the set."""
    starts = seen.get("starts", {})
    z = starts.get(effects, None if starts else seen["z"])
    if z is None:
        return None
    law, own = len(setup.parameters()), len(setup.parameters(beside(setup, ())))
    return np.concatenate([z[:law], np.zeros(own - law), z[law:]])


def chosen_family(setup: Setup) -> tuple[Setup, Family]:
    """The plain baseline, or the one with what the release windows suspect, whichever is clearly nearer."""
    setup, sets, seen = suspects(setup)
    families = [
        started_family(
            setup,
            beside(setup, effects),
            start_of(setup, seen, effects),
            ITERATIONS if effects or len(sets) == 1 else FEW,
        )
        for effects in sets
    ]
    best = min(families, key=mean_loss)
    plain = families[0]
    return setup, best if mean_loss(plain) > CLEARLY * mean_loss(best) else plain
