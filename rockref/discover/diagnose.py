"""Which effect is missing: candidates refitted under the same budget, confirmed on held-out runs, and a verdict."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover import verdict as rules
from rockref.discover.candidates import SHAPES, kinds, value_of
from rockref.discover.evidence import HeldOut, clipped_gain, held_out, rms_deg_s
from rockref.discover.fit import Fit, Point
from rockref.discover.gates import gradient_small, off_bounds, runs_agree, step_small
from rockref.discover.information import information
from rockref.discover.on_this_data import seen_by
from rockref.discover.presearch import STRONG, suspects
from rockref.discover.search import Setup, Trial, baseline, screen
from rockref.discover.signature import signature
from rockref.discover.windows import gyro_of
from rockref.measure.experiment import FIT, HOLDOUT, Experiment, load_experiment

#: Candidates that are refitted after the screen, and iterations of their refit and of the baseline's.
REFITTED, ITERATIONS = 6, 3
#: Further iterations of the family that is gone on with, and whose sizes are read.
POLISH = 4
#: Iterations of both stages of a fit from the nominal parameters.
FRESH = (8, 6)
#: The plain baseline is built on unless a suspect of the presearch, on windows of its own, fits better by this factor
#: of mean loss (decided).
NO_WORSE = 1.1
#: Trials whose one step gained less, and promises less, than this are not refitted (but for the three best of them).
WORTH_A_REFIT = 120.0


@dataclass
class Diagnosis:
    """The result: `to_dict()` is what `rockref diagnose --json` prints."""

    experiment: Experiment
    verdict: str
    effects: tuple[str, ...]
    ranking: list[dict[str, Any]]
    amplitudes: dict[str, dict[str, Any]]
    error: dict[str, Any]
    separating_experiment: str
    signature: dict[str, Any]
    gates: dict[str, Any]
    sentence: str
    seconds: float
    model: Model
    detection_limits: dict[str, dict[str, Any]] = field(default_factory=dict)
    confusion: dict[str, dict[str, float]] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        from rockref.discover.provenance import versions

        return {
            "experiment": self.experiment.name,
            "verdict": self.verdict,
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
            "seconds": round(self.seconds, 1),
            "versions": versions(self.experiment),
        }


@dataclass
class Family:
    """A fitted model family: which effects, the fit and where it stands."""

    effects: tuple[str, ...]
    fit: Fit
    point: Point


def baseline_model(experiment: Experiment, model: Model | None = None) -> Model:
    """The model that the experimenter starts from, with the block of the experiment."""
    base = model or (Model.table_3_1() if experiment.baseline == "eight_points" else Model.four_points())
    return base.replace(mass=experiment.mass, width=experiment.width, depth=experiment.width, height=experiment.height)


def refit(family: Family, iterations: int, seed: int) -> Family:
    """Go on from where a family stands; the baseline and every candidate get the same iterations."""
    rng = np.random.default_rng(seed)
    return Family(family.effects, family.fit, family.fit.run(family.point, iterations, rng))


def amplitudes(family: Family) -> dict[str, dict[str, Any]]:
    """Value, 90 % interval and unit of each parameter of the family's effects."""
    fit, point = family.fit, family.point
    H, _, _ = fit.normal_equations(point)
    covariance = np.linalg.inv(H + np.diag(1 / fit.prior**2))
    found = {}
    for i, p in enumerate(fit.parameters):
        if "." not in p.name:
            continue
        half = 1.645 * rules.INTERVAL * float(np.sqrt(max(covariance[i, i], 0.0)))
        half = float(np.hypot(half, rules.SYSTEMATIC * point.z[i]))
        ends = sorted((value_of(p, point.z[i] - half), value_of(p, point.z[i] + half)))
        found[p.name] = {
            "value": value_of(p, point.z[i]), "low": ends[0], "high": ends[1], "unit": p.unit,
            "in_typical_sizes": float(point.z[i]),
        }  # fmt: skip
    return found | vibration_amplitude(found)


def vibration_amplitude(found: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """The amplitude of a base vibration, from the cosine and sine parts of the runs: their mean, and their spread."""
    parts = [[row["value"] for name, row in found.items() if f".{part}[" in name] for part in ("cosine", "sine")]
    if not parts[0]:
        return {}
    sizes = np.hypot(*np.array(parts))
    value, half = (
        float(sizes.mean()),
        float(1.645 * sizes.std() / np.sqrt(len(sizes)) + rules.SYSTEMATIC * sizes.mean()),
    )
    return {"base_vibration.amplitude": {"value": value, "low": value - half, "high": value + half, "unit": "m/s2"}}


def size_of(family: Family, effect: str | None = None) -> float:
    """Largest switch of an effect (by default the last one) in typical sizes; what only shapes it does not count."""
    effect = effect or family.effects[-1]
    z = [
        abs(zi)
        for p, zi in zip(family.fit.parameters, family.point.z, strict=True)
        if p.name.startswith(effect + ".")
        and tuple(p.name.split(".")) not in SHAPES
        and p.name not in ("base_vibration.frequency", "base_vibration.direction")
    ]
    return float(max(z, default=0.0))


def diagnose(
    path: str | Path,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = 3.0,
    progress: Callable[[str], None] | None = None,
) -> Diagnosis:
    """Learn which effect is missing from an experiment's fit runs, and prove it on its held-out runs.

    Parameters
    ----------
    path : experiment folder; model : starts from it in place of the nominal baseline; seed : of the random restarts
    workers : threads; end : seconds used of each run; progress : called with a line at every stage.

    Raises
    ------
    InputError
        where the experiment cannot be used.
    """
    begun = time.perf_counter()
    say = progress or (lambda line: None)
    experiment = load_experiment(path, uses=(FIT,))
    setup = Setup(experiment, experiment.fit_runs(), baseline_model(experiment, model), end, seed, workers, say)
    setup, sets, seen = suspects(setup)
    families = []
    for effects in sets:
        hopeless = not effects and bool(seen.get("starts")) and seen["loss"] > STRONG
        z = np.zeros(len(setup.parameters(effects)))
        known = np.clip(seen.get("starts", {}).get(effects, seen["z"]), -3, 3)
        z[: len(known)] = 0 if hopeless else known
        fit, point = baseline(setup, effects, z, iterations=(2, 1) if hopeless else (6, 5))
        families.append(Family(effects, fit, point))
    null = families[0]
    start = min(families, key=mean_loss)
    if same_windows(null, start):
        better = gain_over(null, start) > rules.DETECTED
    else:
        better = mean_loss(start) * NO_WORSE < mean_loss(null)
    start = start if better else null
    looks = []
    while len(start.effects) < rules.MOST_EFFECTS and (not start.effects or room(start) > rules.SECOND_ROOM):
        look = look_further(setup, experiment, start, seed, say)
        looks.append(look)
        if not look.order:
            break
        winner = look.order[0]
        if not rules.is_detected(look.gains[winner.effects[-1]], size_of(winner), second=bool(start.effects)):
            break
        wider = duel(setup, look, say)
        if room(wider) > rules.SECOND_ROOM / 2:
            wider = refit(wider, POLISH, seed)
        say(f"  {' + '.join(wider.effects)}: structured {structured(wider):.3f}, room {room(wider):.0f}")
        if start.effects and not rules.settles(structured(start), structured(wider)):
            break
        start = wider
        if structured(start) > rules.HOPELESS:
            break
    if looks and not looks[0].kept.effects:
        null = looks[0].kept
    if not start.effects:
        # Nothing was found: the baseline itself has to be taken down to what it can reach before that is said.
        null = start = refit(null, 2 * POLISH, seed)
    held = load_experiment(path, uses=(FIT, HOLDOUT))
    return conclude(setup, held, null, start, looks, seen, begun)


def structured(family: Family, run: int | None = None) -> float:
    """Share of the windows (of one run, if given) that the family leaves structured."""
    series = family.fit.series
    mine = slice(None) if run is None else series.run_of == run
    return float(np.mean((2 * family.point.loss / series.count > 1.5)[mine]))


def room(family: Family) -> float:
    """What any further effect could gain: the loss above noise, each window's clipped as in a gain."""
    count = family.fit.series.count
    return clipped_gain(family.point.loss, rules.NOISE * count / 2, count)


def mean_loss(family: Family) -> float:
    """Mean over the windows of the loss; 1 is noise."""
    return float(np.mean(2 * family.point.loss / family.fit.series.count))


@dataclass
class Look:
    """Candidates on top of a family: the family refitted, the candidates by gain, their gains, all that were tried."""

    kept: Family
    order: list[Family]
    gains: dict[str, float]
    trials: list[Trial]


def look_further(setup: Setup, experiment: Experiment, start: Family, seed: int, say) -> Look:
    """Screen all candidates on top of a family, refit the best, and the family itself with the same budget."""
    had = (e.id for e in setup.base.active_effects())
    candidates = kinds(experiment.baseline, (*start.effects, *had, "base_vibration", "gyro_saturation"))
    trials = screen(start.fit, start.point, candidates, setup, start.effects)
    kept = refit(start, ITERATIONS, seed + 1)
    worth = [t for i, t in enumerate(trials[:REFITTED]) if i < 3 or max(t.gain, t.predicted) > WORTH_A_REFIT]
    refitted = [refit(Family(t.effects, t.fit, t.point), ITERATIONS, seed + 1) for t in worth]
    gains = {f.effects[-1]: gain_over(kept, f) for f in refitted}
    order = sorted(refitted, key=lambda f: -gains[f.effects[-1]])
    for f in order:
        id = f.effects[-1]
        say(f"  {id}: gain {gains[id]:.0f}, size {size_of(f):.2f}")
    return Look(kept, order, gains, trials)


def duel(setup: Setup, look: Look, say) -> Family:
    """The winner of a look and its near rivals, each fitted once more from the nominal parameters; gains are mended."""
    near = rules.RIVAL_BEFORE_DUEL * look.gains[look.order[0].effects[-1]]
    fitted = []
    for family in look.order[:3]:
        if look.gains[family.effects[-1]] < near:
            continue
        fitted.append(min(family, afresh(setup, family), key=mean_loss))
        look.gains[family.effects[-1]] = max(gain_between(look.kept, fitted[-1]), 0.0)
        say(f"  duel: {family.effects[-1]} {look.gains[family.effects[-1]]:.0f}")
    look.order = sorted(fitted, key=lambda f: -look.gains[f.effects[-1]])
    return look.order[0]


def afresh(setup: Setup, family: Family) -> Family:
    """A family fitted from the nominal parameters and the sizes of its effects.

    What it started from was bent to make up for the effect, and holds it back.
    """
    z = np.array([zi if "." in p.name else 0.0 for p, zi in zip(family.fit.parameters, family.point.z, strict=True)])
    return Family(family.effects, *baseline(setup, family.effects, z, iterations=FRESH))


def gain_between(kept: Family, other: Family) -> float:
    """The gain, also where a sensor effect has moved the cuts of the windows."""
    if same_windows(kept, other):
        return gain_over(kept, other)
    return 0.5 * other.fit.series.count.sum() * mean_loss(kept) - other.point.objective


def same_windows(one: Family, other: Family) -> bool:
    """Whether two families were compared on the same windows (a sensor effect moves the cuts)."""
    a, b = one.fit.series, other.fit.series
    return len(a.start) == len(b.start) and bool(np.all(a.start == b.start) and np.all(a.stop == b.stop))


def gain_over(kept: Family, other: Family) -> float:
    """What a family gains over another one on the same windows, priors included."""
    gain = clipped_gain(kept.point.loss, other.point.loss, kept.fit.series.count)
    return gain - (other.point.penalty - kept.point.penalty)


def conclude(
    setup: Setup, experiment: Experiment, null: Family, final: Family, looks: list[Look], seen: dict, begun: float
) -> Diagnosis:
    """Held-out runs, verdict, sizes, errors and the story's other parts, from the fits."""
    plain = held_out(setup, null.fit, null.point, experiment, null.effects)
    with_effect = (
        plain
        if final is null or not final.effects
        else held_out(setup, final.fit, final.point, experiment, final.effects)
    )
    looks = looks or [Look(final, [], {}, [])]
    unfruitful = len(looks) > 1 and looks[-1].kept.effects != () and final.effects == looks[-1].kept.effects
    look = looks[-2] if unfruitful else looks[-1]
    facts = rules.Facts(
        effects=final.effects,
        sizes={e: size_of(final, e) for e in final.effects},
        gains=look.gains,
        bad=structured(final),
        median=float(np.median(2 * final.point.loss / final.fit.series.count)),
        held_gain=held_gains(plain, with_effect),
        held_floor=float(np.median(2 * plain.loss / plain.count)),
        at_start=() if not looks or looks[0].kept.effects == () else looks[0].kept.effects,
        by_run={r.id: structured(final, i) for i, r in enumerate(setup.runs)},
    )
    decision = rules.decide(facts)
    kept = decision.effects if decision.verdict in ("named", "indicated", "pair", "class") else ()
    card = signature(null.fit, null.point, final.fit, final.point)
    total = {id: max(g, 0.0) for id, g in look.gains.items()}
    noise = float(np.degrees(gyro_of(setup.experiment).noise))
    shown = final if kept else null
    had = (*shown.effects, *(e.id for e in setup.base.active_effects()))
    limits, confusion = seen_by(setup, shown.fit, shown.point, had)
    found = information(shown.fit, shown.point)
    checks = (gradient_small(shown.fit, shown.point, found), step_small(shown.fit, shown.point),
              off_bounds(shown.fit, shown.point), runs_agree(shown.fit, shown.point, found))  # fmt: skip
    return Diagnosis(
        experiment=experiment,
        verdict=decision.verdict,
        effects=decision.effects,
        ranking=rules.ranking(look.gains, facts),
        amplitudes=amplitudes(final) if kept else {},
        error={
            "unit": "deg/s RMS",
            "stretch": f"windows of 50 to 90 ms over the first {setup.end:g} s of each run, each restarted from the "
            "reconstructed state; the worst tenth of the windows left out",
            "noise_floor": noise,
            "baseline": {"fit": rms_deg_s(null.fit, null.point), "holdout": plain.rms},
            "with_effect": {
                "fit": rms_deg_s(shown.fit, shown.point),
                "holdout": with_effect.rms if kept else plain.rms,
            },
        },
        separating_experiment=rules.separating(decision, total),
        signature=card,
        gates=rules.gates(facts, decision) | {g.name: g.to_dict() for g in checks},
        detection_limits=limits,
        confusion=confusion,
        sentence=decision.sentence,
        seconds=time.perf_counter() - begun,
        model=shown.fit.models(shown.point.z)[0][0],
    )


def held_gains(plain: HeldOut, other: HeldOut) -> list[float]:
    """Gain on each held-out run, per thousand samples of one axis; the windows may be cut differently."""
    found = []
    for i in np.unique(plain.run_of):
        a, b = plain.run_of == i, other.run_of == i
        worse = np.minimum(2 * plain.loss[a] / plain.count[a], 3.0)
        better = np.minimum(2 * other.loss[b] / other.count[b], 3.0)
        found.append(float(np.mean(worse) - np.mean(better)))
    return found
