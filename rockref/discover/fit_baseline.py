"""`rockref fit`: find the numbers of the baseline on the fit runs of an experiment, and check them.

1. Start from what an earlier command has found; without it, from nominal numbers at the shortest memory.
2. Where the innovations contradict the local start, start over the whole prior.
3. Add the effects that are asked for, each by one step of everything, or from its own starts.
4. Lengthen the memory.
5. Check: stages, starts, step, bounds, innovations. Innovations that are not white say that an effect is missing.
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
from rockref.discover.diagnose import error_record
from rockref.discover.evidence.collect import hypothesis_evidence
from rockref.discover.evidence.evidence import HypothesisEvidence
from rockref.discover.evidence.result import model_of
from rockref.discover.evidence.widths import deviations
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import END, FitProblem, fit_problem
from rockref.discover.fit.stages import S1, S2, S3, F
from rockref.discover.fit.steps import fine_enough
from rockref.discover.fit.whitening import quieten, whiten
from rockref.discover.fit_gates import Gate, innovations_white, off_bounds, same_place, step_halved
from rockref.discover.fit_store import FitStore
from rockref.discover.listening.records import opened
from rockref.discover.plan import effect_z
from rockref.discover.progress import StageCounter, StageReport
from rockref.discover.provenance import versions
from rockref.discover.selection.finalists import CONVERGED
from rockref.discover.selection.halving import halving
from rockref.discover.selection.score_test import proposals
from rockref.discover.selection.search import CONTRADICTED, STEPS, Search
from rockref.discover.selection.tone import tone
from rockref.discover.threads import one_blas_thread
from rockref.discover.verdict.calibration import calibration
from rockref.discover.verdict.rules import contradicting_run
from rockref.effects import catalogue
from rockref.measure.records.release import Experiment

#: Starts of a fit whose gates are asked for, at most; decided: two that end in one place are enough, and of two that do
#: not one may have stopped in a side valley.
STARTS = 3
#: Spread of another start in prior deviations; decided: half of what is expected, in the same region of valleys.
OTHER_START = 0.5
#: Stages of a fit, each with its share of the time (decided: as the stages of a diagnosis that do the same).
STAGES = {"baseline": 5.0, "starts": 29.0, "effects": 10.0, "memory": 10.0, "gates": 2.0, "starts again": 15.0}


@dataclass
class BaselineFit:
    """What `rockref fit` found: the model, its numbers (in `evidence`), the gates, the outcome.

    noise : of a sample [deg/s];  end : seconds used of each run
    """

    experiment: Experiment
    model: Model
    effects: tuple[str, ...]
    evidence: HypothesisEvidence
    gates: list[Gate]
    outcome: str
    noise: float
    end: float
    seconds: float
    from_store: bool = False
    run: str = ""

    @property
    def passed(self) -> bool:
        """Return whether nothing speaks against the fit."""
        return self.outcome != "not_trustworthy"

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""
        said = self.evidence
        return {
            "experiment": self.experiment.name,
            "effects": list(self.effects),
            "outcome": self.outcome,
            "parameters": {name: number_record(n) for name, n in {**said.law, **said.numbers}.items()},
            "gates": {"passed": self.passed, "checks": [gate.to_dict() for gate in self.gates]},
            "error": error_record(self.end, self.noise, fit=said.error["total"]),
            "mean_loss": round(said.loss, 4),
            "started_from_kept_fit": self.from_store,
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


def number_record(n) -> dict[str, Any]:
    """Return a number with its 90 % interval as plain values."""
    return {"value": n.value, "low": n.low, "high": n.high, "unit": n.unit, "z_in_prior": round(n.z, 3)}


@one_blas_thread()
def fit_baseline(
    path: str | Path,
    effects: tuple[str, ...] = (),
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = END,
    check: bool = True,
    progress: Callable[[StageReport], None] | None = None,
    store: FitStore | None = None,
) -> BaselineFit:
    """Find the parameters of the baseline on the fit runs; no fit sees a held-out run.

    Parameters
    ----------
    path : experiment folder; model : starts from it in place of the nominal baseline
    effects : fitted along with those that `model` has, ids or file.py:Class
    seed : of the other starts; workers : threads; end : seconds used of each run (for the source's block)
    check : go through the gates (costs about as much as the fit)
    progress : called with every stage and every line of the optimiser
    store : what is kept of the experiment, to start from and to add to.

    Raises
    ------
    InputError
        where the experiment cannot be used, or an effect is unknown.
    """
    started = time.perf_counter()
    asked = known_effects(effects)
    experiment, whole = opened(path)
    fitter = prepared(experiment, whole, model, end, workers, seed, StageCounter(STAGES, progress), store)
    problem = fitter.problem
    own = problem.carried
    wanted = (*own, *(e for e in asked if e not in own))
    h, earlier, from_store = fitted(fitter, wanted, baseline_model(experiment, model), store)
    if check:
        gates, h, said = checked(fitter, h, earlier, seed)
    else:
        gates, said = [], hypothesis_evidence(fitter, h, *calibration().widths)
    outcome, run = outcome_of(gates, said)
    state = {"effects": list(h.effects), "fit_deg_s": said.error["total"]}
    return BaselineFit(
        experiment=experiment,
        model=model_of(fitter, h, said, "rockref fit", gates_passed=GATES_SAID[outcome], history=[state]),
        effects=h.effects,
        evidence=said,
        gates=gates,
        outcome=outcome,
        noise=noise_floor(problem),
        end=problem.listener.end,
        seconds=time.perf_counter() - started,
        from_store=from_store,
        run=run,
    )


#: What a fit may be (believed; not to be believed; not asked; right but for an effect that is missing), and what its
#: model says of it.
GATES_SAID: dict[str, Any] = {
    "trustworthy": True, "not_trustworthy": False, "not_checked": "not checked",
    "effect_missing": "an effect is missing: run rockref diagnose",
}  # fmt: skip


def known_effects(effects: tuple[str, ...]) -> tuple[str, ...]:
    """Return the ids of effects that are named by id or, a user's own, by path/to/file.py:Class.

    Raises
    ------
    InputError
        E-EFFECT, E-FILE for one that nobody knows, cannot be used, is twice, or is of tosses only.
    """
    return tuple(kind.id for kind in catalogue.of_releases(effects))


def prepared(
    experiment: Experiment, whole: Experiment, model: Model | None, end: float, workers: int | None, seed: int,
    progress: StageCounter, store: FitStore | None = None,
) -> Fitter:  # fmt: skip
    """Return the fitter of an experiment's fit runs, which leaves what it finds in the whole experiment's store."""
    problem = fit_problem(experiment, experiment.fit_runs(), baseline_model(experiment, model), end, workers, seed=seed)
    problem.progress = progress
    problem.tone = stated_tone(model)
    if store is not None:
        problem.refined = store.open(whole).note(problem)
    return Fitter(problem)


def stated_tone(model: Model | None) -> float | None:
    """Return the frequency [Hz] of an effect of a model that has a phase of its own in every run, or None."""
    for effect in () if model is None else model.active_effects():
        for key, quantity in effect.quantities.items():
            if effect.of_run and quantity.unit == "Hz":
                return float(getattr(effect, key))
    return None


def noise_floor(problem: FitProblem) -> float:
    """Return the noise of a sample, the root mean square over runs and axes [deg/s]."""
    return float(np.degrees(np.sqrt(np.mean(problem.listener.sigma**2))))


def fitted(
    fitter: Fitter, effects: tuple[str, ...], model: Model, store: FitStore | None
) -> tuple[FittedModel, np.ndarray | None, bool]:
    """Return the fit of a set of effects at F, z of the same fit at S3 (None where it was not made), and whether it
    began at a kept one."""
    known = None if store is None else store.start(fitter.problem, effects)
    if known is not None:
        h, stage = known
        fitter.problem.say(f"{h.name}: from what was found before, at {stage.name}")
        if stage is S1:
            h = Search(fitter).settled(h)
            stage = S2
        return (*lengthened(fitter, h, after=stage.name), True)
    start = model_start(fitter.problem, model)
    fitter.problem.progress.begin("baseline", f"fitting {FittedModel(fitter.problem.carried, start).name}")
    h = local_fit(fitter, FittedModel(fitter.problem.carried, start.copy()))
    for effect in effects:
        if effect not in h.effects:
            h = with_one_more(fitter, h, effect, start)
    fitter.problem.say(f"{h.name}: mean loss {h.loss:.2f}")
    if h.loss > CONTRADICTED:
        fitter.problem.progress.begin("starts", "fitting from other starts", h.name)
        begin = FittedModel(h.effects, h.z.copy())
        begin.z[: len(start)] = start
        h = min(h, Search(fitter).anywhere(begin), key=lambda k: k.objective)
    return (*lengthened(fitter, h), False)


def local_fit(fitter: Fitter, h: FittedModel) -> FittedModel:
    """Fit a hypothesis from where it is, at the two shortest memories."""
    fitter.tempered(h, S1, 4)
    h.start = h.z.copy()
    return Search(fitter).settled(h)


def model_start(problem: FitProblem, model: Model) -> np.ndarray:
    """Return z at which the shared numbers have the values of a model; those of a single run are zero."""
    z = problem.nominal(problem.carried)
    for k, p in enumerate(problem.parameters(problem.carried)):
        if p.run is None and p.effect:
            z[k] = np.clip(effect_z(p, model), p.least, p.most)
    return z


def with_one_more(fitter: Fitter, base: FittedModel, effect: str, start: np.ndarray) -> FittedModel:
    """Return a model, fitted at S2, with one more effect, all numbers fitted together at S2.

    The effect is tried where the base ended and where it started (z of the carried model), before it bent towards what
    it lacks.
    """
    problem = fitter.problem
    before, problem.candidates = problem.candidates, (effect,)
    problem.progress.begin("effects", f"adding {effect}", base.name)
    if problem.tone is None:
        problem.tone = tone(fitter, fitter.evaluate(base, S2))
    starts = [base]
    if base.effects == problem.carried and base.loss > CONTRADICTED:
        starts.append(FittedModel(problem.carried, start.copy()))
    try:
        return min(halving(fitter, starts), key=lambda h: h.objective)
    finally:
        problem.candidates = before


def added_at_once(fitter: Fitter, base: FittedModel, effect: str) -> FittedModel:
    """Return a model at F with one more effect, from one step of everything at F: there weak effects show."""
    problem = fitter.problem
    before, problem.candidates = problem.candidates, (effect,)
    try:
        (h,) = proposals(fitter, fitter.evaluate(base.copy(), F), F, 1)
        return fitter.refine(h, F, CONVERGED)
    finally:
        problem.candidates = before


def lengthened(fitter: Fitter, h: FittedModel, after: str = "S2") -> tuple[FittedModel, np.ndarray | None]:
    """Fit a hypothesis through the stages that follow, S3 and F; return it, and z at S3."""
    earlier = None
    fitter.problem.progress.begin("memory", "refining at longer memories", h.name)
    fitter.widen()
    fine_enough(fitter, [h], (S3, F))
    if after in (S1.name, S2.name):
        if S3.name not in fitter.problem.spikes:  # as `whiten`, once: fits from other starts are compared
            quieten(fitter, h, S3)
        whiten(fitter, h, S3)
        fitter.refine(h, S3, STEPS)
        earlier = h.z.copy()
        fitter.problem.say(f"{h.name} at S3: mean loss {h.loss:.2f}")
    whiten(fitter, h, F)
    fitter.refine(h, F, CONVERGED)
    fitter.problem.say(f"{h.name} at F: mean loss {h.loss:.2f}")
    return h, earlier


def checked(
    fitter: Fitter, h: FittedModel, earlier: np.ndarray | None, seed: int
) -> tuple[list[Gate], FittedModel, HypothesisEvidence]:
    """Return the gates of a fit, the best fit of all starts, and what it says.

    Where the innovations are not white the model is wrong: stages and starts then need not agree, and are not asked.
    """
    fitter.problem.progress.begin("gates", "checking the innovations", h.name)
    said = hypothesis_evidence(fitter, h, *calibration().widths)
    white = innovations_white(said, calibration())
    if not white.passed:
        return [white], h, said
    best, other, earlier = other_starts(fitter, h, earlier, seed)
    if best is not h:
        said = hypothesis_evidence(fitter, best, *calibration().widths)
    parameters = fitter.parameters(best)
    width, _ = deviations(fitter, best, F, calibration().temperature)
    gates = [
        same_place("stages_agree", parameters, earlier, best.z, width),
        same_place("starts_agree", parameters, other.z, best.z, width),
        step_halved(fitter, best),
        off_bounds(parameters, best.z),
        innovations_white(said, calibration()),
    ]
    return gates, best, said


def other_starts(
    fitter: Fitter, h: FittedModel, earlier: np.ndarray | None, seed: int
) -> tuple[FittedModel, FittedModel, np.ndarray]:
    """Return the best of several starts, the nearest other one, and z of the best at half the memory.

    A third start is only made where two do not end in the same place.
    """
    if earlier is None:
        earlier = fitter.refine(h.copy(), S3, STEPS).z
    ends = [(h, earlier)]
    for k in range(1, STARTS):
        fitter.problem.progress.begin("starts again", "checking from another start", h.name)
        start = FittedModel(h.effects, other_start(fitter, h, seed + k))
        other, at_s3 = lengthened(fitter, local_fit(fitter, start))
        assert at_s3 is not None
        ends.append((other, at_s3))
        ends.sort(key=lambda end: end[0].objective)
        best = ends[0][0]
        width, _ = deviations(fitter, best, F, calibration().temperature)
        gates = [same_place("starts_agree", fitter.parameters(h), end.z, best.z, width) for end, _ in ends[1:]]
        nearest = int(np.argmin([gate.value for gate in gates]))
        if gates[nearest].passed:
            break
    return ends[0][0], ends[1 + nearest][0], ends[0][1]


def other_start(fitter: Fitter, h: FittedModel, seed: int) -> np.ndarray:
    """Return another start: the law's numbers moved at random, those of effects by a tenth, releases at rest."""
    rng = np.random.default_rng(seed)
    z = h.z.copy()
    for k, p in enumerate(fitter.parameters(h)):
        draw = rng.normal()
        if p.effect:
            z[k] *= 1 + 0.1 * draw
        else:
            z[k] = 0.0 if p.run is not None else z[k] + OTHER_START * draw
        z[k] = np.clip(z[k], max(p.least, -2.5), min(p.most, 2.5)) if not p.effect else np.clip(z[k], p.least, p.most)
    return z


def outcome_of(gates: list[Gate], said: HypothesisEvidence) -> tuple[str, str]:
    """Return what a fit is, one of GATES_SAID, and the run that contradicts the others, if one does."""
    if not gates:
        return "not_checked", ""
    run = contradicting_run(said, calibration()) or ""
    white = next(gate for gate in gates if gate.name == "innovations_white")
    if not white.passed:
        return ("not_trustworthy" if run else "effect_missing"), run
    return ("trustworthy" if all(gate.passed for gate in gates) else "not_trustworthy"), run
