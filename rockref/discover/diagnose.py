"""Which effect is missing: fit the baseline, search the catalogue, weigh the evidence, ask the held-out runs."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import baseline_model
from rockref.discover.evidence.collect import add_held_out, hypothesis_evidence, least_loss
from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence
from rockref.discover.evidence.held_out import held_out_listener
from rockref.discover.evidence.misfit import misfit
from rockref.discover.evidence.result import model_of
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE
from rockref.discover.fit.problem import END, fit_problem
from rockref.discover.fit_store import FitStore, model_from, model_text, options_key
from rockref.discover.hypotheses.effects import candidate_effects
from rockref.discover.kept_search import KeptSearch
from rockref.discover.listening.records import opened, own_effects
from rockref.discover.progress import StageCounter, StageReport
from rockref.discover.provenance import versions
from rockref.discover.selection.chance import gained_by_chance
from rockref.discover.selection.finalists import lowest, penalised
from rockref.discover.selection.search import Search
from rockref.discover.separating import separating_run
from rockref.discover.threads import one_blas_thread
from rockref.discover.verdict.calibration import calibration
from rockref.discover.verdict.detection import detection
from rockref.discover.verdict.rules import Verdict, alternatives, decide
from rockref.discover.verdict.sentences import sentence
from rockref.effects import catalogue
from rockref.engines import compiled_ahead
from rockref.measure.records.release import Experiment

#: Hypotheses whose evidence is stored, and sets of effects that are asked of the held-out runs beside the baseline.
STORED, ASKED = 8, 3
#: Probability below which a set is not asked of the held-out runs (decided: no verdict depends on it).
UNLIKELY = 1e-3
#: Stages of a diagnosis, each with its share of the time in per cent (measured on a shipped experiment that needs them
#: all).
STAGES = {"baseline": 5.0, "effects": 30.0, "starts": 29.0, "S3": 15.0, "F": 12.0, "without": 5.0, "evidence": 4.0}
#: Remarks that tell of a fault of the sensor, which no hypothesis about the block explains.
SENSOR_CODES = ("W-ZERO", "W-LAG", "W-HUM")
STRETCH = (
    "innovations of a model that listens to the record with a memory of 40 ms, over the first {end:.2g} s of each run; "
    "the worst tenth of blocks of 50 ms left out"
)


@dataclass
class Diagnosis:
    """The result: `to_dict()` is what `rockref diagnose --json` prints; `evidence` is what it was decided from."""

    experiment: Experiment
    verdict: str
    effects: tuple[str, ...]
    sentence: str
    ranking: list[dict[str, Any]]
    amplitudes: dict[str, dict[str, Any]]
    error: dict[str, Any]
    signature: dict[str, Any]
    gates: dict[str, Any]
    seconds: float
    model: Model
    separating_experiment: str = ""
    probability: float = 1.0
    detection_limits: dict[str, dict[str, Any]] = field(default_factory=dict)
    confusion: dict[str, dict[str, float]] = field(default_factory=dict)
    evidence: Evidence | None = field(default=None, repr=False)
    from_store: bool = False

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""
        return {
            "experiment": self.experiment.name,
            "verdict": self.verdict,
            "probability": self.probability,
            "effects": list(self.effects),
            "sentence": self.sentence,
            "ranking": self.ranking,
            "amplitudes": self.amplitudes,
            "error": self.error,
            "separating_experiment": self.separating_experiment,
            "signature": self.signature,
            "detection_limits": self.detection_limits,
            "confusion": self.confusion,
            "gates": self.gates,
            "from_kept_diagnosis": self.from_store,
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


@one_blas_thread()
def diagnose(
    path: str | Path,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = END,
    progress: Callable[[StageReport], None] | None = None,
    own: Sequence[str] = (),
    store: FitStore | None = None,
) -> Diagnosis:
    """Learn which effect is missing from an experiment's fit runs, and prove it on its held-out runs.

    Parameters
    ----------
    path : experiment folder; model : starts from it in place of the nominal baseline
    seed : of the starts over the whole prior; workers : threads
    end : seconds used of each run (for the source's block); progress : called with every stage and optimiser line
    own : effects of the user's own that are tried with the catalogue's, each path/to/file.py:Class
    store : what is kept of the experiment: a diagnosis with the same options is the answer, an interrupted search goes
        on, and what is found is kept.

    Raises
    ------
    InputError
        where the experiment or an effect cannot be used.
    """
    started = time.perf_counter()
    known = own_effects(own)
    experiment, whole = opened(path)
    base = baseline_model(experiment, model)
    key = options_key(base, seed, end, known)
    if store is not None and (answer := kept_diagnosis(store.open(whole), key, whole)) is not None:
        return answer
    problem = fit_problem(experiment, experiment.fit_runs(), base, end, workers, seed=seed)
    problem.progress = StageCounter(STAGES, progress)
    problem.candidates = candidate_effects(base.points, problem.carried, known)
    problem.companion = calibration().companion
    fitter = Fitter(problem)
    search = Search(fitter) if store is None else KeptSearch(fitter, store, key)
    if store is not None:
        problem.refined = store.note(problem)
    with compiled_ahead():
        fits = search.run()
    evidence = evidence_of(fitter, fits, whole)
    if search.test is not None:
        evidence.limits, evidence.confusions = detection(problem, search.test, calibration())
    decision = decide(evidence)
    best = next(h for h in fits if h.effects == decision.best.effects)
    model_found = model_of(fitter, best, decision.best, "rockref diagnose")
    if decision.word == "class":
        problem.progress.begin("evidence", "looking for the run that tells the class apart")
        evidence.separating = of_class(fitter, fits, decision, end)
    seconds = time.perf_counter() - started
    if store is not None:
        keep_diagnosis(store, key, evidence, model_found, end * problem.time_scale, seconds)
    return diagnosis(whole, evidence, decision, model_found, end * problem.time_scale, seconds)


def of_class(fitter: Fitter, fits: Sequence[FittedModel], decision: Verdict, end: float) -> str:
    """Return the run that tells the members of a class apart best, in a sentence, or ""."""
    null = next(h for h in fits if h.effects == fitter.problem.carried)
    model = fitter.model(null)
    leader = next(h for h in fits if h.effects == decision.best.effects)
    own = zip(fitter.parameters(leader), leader.z, strict=True)
    size = [z for p, z in own if p.effect == decision.effects[0] and p.typical > 0 and p.run is None]
    return separating_run(fitter.problem, model, decision.effects, np.array(size), end)


def kept_diagnosis(store: FitStore, key: str, experiment: Experiment) -> Diagnosis | None:
    """Return the diagnosis that is kept under a key, decided again from its evidence; None where there is none."""
    kept = store.kept["diagnoses"].get(key)
    if kept is None:
        return None
    evidence = Evidence.from_dict(kept["evidence"])
    decision = decide(evidence)
    found = diagnosis(experiment, evidence, decision, model_from(kept["model"]), kept["end"], kept["seconds"])
    found.from_store = True
    return found


def keep_diagnosis(store: FitStore, key: str, evidence: Evidence, model: Model, end: float, seconds: float) -> None:
    """Keep a diagnosis, but for that of a model with a user's own effect, whose file may move."""
    store.kept["searches"].pop(key, None)  # the state of its search is no longer needed
    if all(e.file is None for e in model.effects):
        store.kept["diagnoses"][key] = {
            "evidence": evidence.to_dict(), "model": model_text(model), "end": end, "seconds": seconds,
        }  # fmt: skip
    store.save()


def diagnosis(
    experiment: Experiment, evidence: Evidence, decision: Verdict, model: Model, end: float, seconds: float
) -> Diagnosis:
    """Return a verdict with all that a reader wants to know of it; end [s] of each run that was used."""
    advised = catalogue.find(decision.effects[0]).experiment if decision.effects else ""
    return Diagnosis(
        experiment=experiment,
        verdict=decision.word,
        effects=decision.effects,
        sentence=sentence(decision, evidence),
        ranking=ranking(decision, evidence),
        amplitudes=amplitudes(decision),
        error=error(decision, evidence, end, experiment),
        signature=evidence.signature,
        gates=gates(decision, evidence),
        seconds=seconds,
        model=model,
        separating_experiment=evidence.separating or advised,
        probability=decision.probability,
        detection_limits=evidence.limits,
        confusion=evidence.confusions,
        evidence=evidence,
    )


def evidence_of(fitter: Fitter, fits: Sequence[FittedModel], experiment: Experiment) -> Evidence:
    """Return the evidence of fits at the longest memory; the most probable sets and the baseline see held-out runs."""
    problem = fitter.problem
    null = next(h for h in fits if h.effects == problem.carried)
    kept, first = stored(fitter, fits), lowest(fitter, fits)
    problem.progress.begin("evidence", "weighing the evidence", first.name)
    least = least_loss(fitter, first)
    said = {h.effects: hypothesis_evidence(fitter, h, *calibration().widths, least) for h in kept}
    listener = problem.listener
    held = held_out_listener(fitter, experiment)
    counts = [] if held is None else list(zip(held.runs, held.valid.sum(axis=1), strict=True))
    evidence = Evidence(
        experiment=experiment.name,
        digest=experiment.digest,
        samples=int(3 * listener.valid.sum()),
        held_out_samples={run.id: int(3 * n) for run, n in counts},
        hypotheses=list(said.values()),
        carried=problem.carried,
        remarks=tuple(sorted({notice.code for notice in experiment.notices})),
        sensor_faults=tuple(f"{n.where} {n.what}" for n in experiment.notices if n.code in SENSOR_CODES),
        cost={"block_steps": float(listener.simulated)},
    )
    ranked = alternatives(evidence, calibration())
    if ranked[0].effects:
        problem.progress.begin("evidence", "asking what chance would gain")
        # What is too small to matter is asked for only where the rest was not fitted alone.
        alone = next((h for h in fits if set(h.effects) == {*problem.carried, *ranked[0].effects}), None)
        found = next(h for h in kept if h.effects == ranked[0].evidence.effects) if alone is None else alone
        evidence.chance = gained_by_chance(fitter, fits, found)
        ranked = alternatives(evidence, calibration())
    if held is not None:
        problem.progress.begin("evidence", "checking on held-out runs")
        stands = decide(evidence).best.effects
        likely = [a.evidence.effects for a in ranked[:ASKED] if a.probability > UNLIKELY]
        for effects in dict.fromkeys([null.effects, stands, *likely]):
            add_held_out(said[effects], fitter, next(h for h in kept if h.effects == effects), held)
    best = next(h for h in kept if h.effects == ranked[0].evidence.effects)
    evidence.signature = misfit(fitter, null, best)
    return evidence


def stored(fitter: Fitter, fits: Sequence[FittedModel]) -> list[FittedModel]:
    """Return the fits whose evidence is kept, least objective first: the baseline, the best less what its effects have
    to gain, its parts, and the next best.

    By the objective alone three effects, of which one is there, would leave no room for that one.
    """
    ranked = sorted(fits, key=lambda h: penalised(fitter, h))
    parts = [h for h in ranked if set(h.effects) < set(ranked[0].effects)]
    null = [h for h in fits if h.effects == fitter.problem.carried]
    kept = list(dict.fromkeys([*null, ranked[0], *parts, *ranked]))[: STORED + 1]
    return sorted(kept, key=lambda h: h.objective)


def null_of(evidence: Evidence) -> HypothesisEvidence:
    """Return the evidence of the baseline."""
    found = evidence.of(evidence.carried)
    assert found is not None  # the baseline is always stored
    return found


def ranking(decision: Verdict, evidence: Evidence) -> list[dict[str, Any]]:
    """Return the sets of effects by probability: gain over the baseline [nat], the same in deviations, probability."""
    null, temperature = null_of(evidence), calibration().temperature
    found = []
    for a in decision.alternatives:
        if not a.effects:
            continue
        gain = null.objective - a.evidence.objective
        z = float(np.sqrt(2 * max(gain, 0.0) / temperature))
        found.append(
            {
                "effect": " + ".join(a.effects),
                "gain": round(gain, 1),
                "z": round(z, 2),
                "weight": round(a.probability, 4),
            }
        )
    return found


def amplitudes(decision: Verdict) -> dict[str, dict[str, Any]]:
    """Return the numbers of the verdict's effects with their 90 % intervals; of a class, those of the first."""
    if not decision.effects:
        return {}
    names = decision.best.numbers
    return {
        name: {"value": n.value, "low": n.low, "high": n.high, "unit": n.unit, "in_typical_sizes": n.size}
        for name, n in names.items()
        if name.partition(".")[0] in decision.effects
    }


def error(decision: Verdict, evidence: Evidence, end: float, experiment: Experiment) -> dict[str, Any]:
    """Return the error before and after, on fit and held-out runs, beside the noise [deg/s]."""
    null, best = null_of(evidence), decision.best

    def both(h: HypothesisEvidence) -> dict[str, float | None]:
        return {"fit": h.error["total"], "holdout": h.held_out_error}

    assert experiment.gyro is not None
    noise = float(np.degrees(np.hypot(experiment.gyro.noise, experiment.gyro.resolution / np.sqrt(12))))
    shown = best if decision.effects else null
    return error_record(end, noise, baseline=both(null), with_effect=both(shown))


def error_record(end: float, noise: float, **errors: Any) -> dict[str, Any]:
    """Return errors [deg/s] over the first `end` s of each run, beside the noise, with the words for what they are."""
    return {"unit": "deg/s RMS", "stretch": STRETCH.format(end=end), "noise_floor": noise, **errors}


def gates(decision: Verdict, evidence: Evidence) -> dict[str, Any]:
    """Return what was checked before the verdict."""
    best, null = decision.best, null_of(evidence)
    falls = [null.held_out[run] - best.held_out[run] for run in best.held_out if run in null.held_out]
    return {
        "mean_loss": round(best.loss, 3),
        "mean_loss_of_white_noise": round(WHITE, 3),
        "blocks_above_white": round(float(np.mean(list(best.blocks.values()))), 3),
        "farthest_parameter": round(best.farthest, 2),
        "held_out_gain": [round(fall, 4) for fall in falls],
        "passed": decision.word != "not_trustworthy",
    }
