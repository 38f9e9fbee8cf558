"""Which effect is missing: candidates refitted under the same budget, confirmed on held-out runs, and a verdict."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover import window_rules as rules
from rockref.discover.compare.models import baseline_model
from rockref.discover.fit.beside import side_by_side
from rockref.discover.fit.errors import FIT_STRETCH
from rockref.discover.fit.evidence import Losses, held_gains, held_out, rms_deg_s
from rockref.discover.fit.families import (
    Family,
    amplitudes,
    far_fetched,
    gain_between,
    gain_over,
    loud,
    mean_loss,
    refit,
    room,
    same_windows,
    size_of,
    structured,
)
from rockref.discover.fit.gates import Gate, gradient_small, off_bounds, runs_agree, step_small
from rockref.discover.fit.information import information
from rockref.discover.fit.search import FRESH, Setup, baseline
from rockref.discover.looking.fewer import needed, stood_in_for
from rockref.discover.looking.look import POLISH, TOO_FAR, Look, doubt_trifle, duel, look_further
from rockref.discover.looking.presearch import STRONG, suspects
from rockref.discover.looking.two import leaves_too_much, settled_by_two
from rockref.discover.looking.winning import finished, to_the_end, upheld
from rockref.discover.on_this_data import seen_by
from rockref.discover.plan import switches_of
from rockref.discover.separating import separating_run
from rockref.discover.signature import signature
from rockref.discover.windows.clipped import flat_tops
from rockref.discover.windows.on_time import gyro_of
from rockref.discover.windows.opened import opened
from rockref.discover.windows.own import known_own
from rockref.effects import catalogue
from rockref.measure.experiment import Experiment

#: The plain baseline is built on unless a suspect of the presearch, on windows of its own, fits better by this factor
#: of mean loss (decided).
NO_WORSE = 1.1
#: Share of structured windows above which what the release suggested is doubted (decided: right sensors left 0 to 6 %).
#: It stays if the baseline's mean loss is larger by this factor (decided).
DOUBTFUL, FAR_WORSE = 0.2, 2.0
#: Prior deviations beyond which nothing is begun that the releases suggest (decided).
FARTHEST = 3.0
#: What must be left for a suspect that was set aside to get a course of its own, and by how much that has to do better
#: (decided: of a push beside another contact the plain course left 1585 units).
ANOTHER_COURSE, BETTER_COURSE = 350.0, 300.0


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


def diagnose(
    path: str | Path,
    model: Model | None = None,
    seed: int = 0,
    workers: int | None = None,
    end: float = 3.0,
    progress: Callable[[str], None] | None = None,
    own: Sequence[str] = (),
) -> Diagnosis:
    """Learn which effect is missing from an experiment's fit runs, and prove it on its held-out runs.

    Parameters
    ----------
    path : experiment folder; model : starts from it in place of the nominal baseline; seed : of the random restarts
    workers : threads; end : seconds used of each run; progress : called with a line at every stage
    own : effects of the user's own that are tried with the catalogue's, each path/to/file.py:Class.

    Raises
    ------
    InputError
        where the experiment or an effect cannot be used.
    """
    begun = time.perf_counter()
    say = progress or (lambda line: None)
    known = known_own(own)
    experiment, held = opened(path)
    base = baseline_model(experiment, model)
    setup = Setup(experiment, experiment.fit_runs(), base, end, seed, workers, say, own=known)
    setup, sets, seen = suspects(setup)
    null, start, aside = beginning(setup, sets, seen)
    begun_with = (start, aside)
    start, looks = (start, []) if blinded(seen, start) else grown(setup, start, seed, say)
    if aside is not None and room(start) > ANOTHER_COURSE:
        start, looks = better_course(start, looks, *grown(setup, aside, seed, say), say)
    start = proven(setup, held, start, looks, say)
    if start.effects and any(start is family for family in begun_with):
        # What the release named, and no look has added to, has not been fitted to its end.
        start = finished(setup, start, seed)
    if len(start.effects) == 2:
        start = needed(setup, start, looks, seed, say)
    if looks and not looks[0].kept.effects:
        null = looks[0].kept
        if len(start.effects) == 2:
            start = stood_in_for(setup, looks, start, seed, say)
    if not start.effects:
        # Nothing was found: the baseline itself has to be taken down to what it can reach before that is said.
        null = start = refit(null, 2 * POLISH, seed)
    return conclude(setup, held, null, start, looks, seen, begun)


def beginning(setup: Setup, sets: list[tuple[str, ...]], seen: dict) -> tuple[Family, Family, Family | None]:
    """The plain baseline, what is built on (it, or a suspect of the releases that does better), and who was set aside.

    Where the releases are far from the baseline and a suspect explains them, the baseline gets few iterations at first.
    """

    def begun(own: Setup, effects: tuple[str, ...]) -> Family:
        hopeless = not effects and bool(seen.get("starts")) and seen["loss"] > STRONG
        z = np.zeros(len(setup.parameters(effects)))
        known = seen.get("starts", {}).get(effects, seen["z"])
        most = [FARTHEST * max(p.prior, 1.0) for p in setup.parameters(effects)[: len(known)]]
        known = np.clip(known, np.negative(most), most)
        z[: len(known)] = 0 if hopeless else known
        return Family(effects, *baseline(own, effects, z, iterations=(2, 1) if hopeless else FRESH))

    families = side_by_side(setup, begun, sets)
    null, start = families[0], min(families, key=mean_loss)
    if "flat_top" in seen:
        # Nobody has to infer this: it is in the records.
        return null, next(f for f in families if f.effects == ("gyro_saturation",)), None
    suspect = min(families[1:], key=mean_loss, default=None)
    if start.effects and structured(start) > DOUBTFUL:
        # A sensor that explains the release and not what follows may stand in for a load: the baseline gets its turn.
        null = Family((), *baseline(setup))
        start = start if mean_loss(null) > FAR_WORSE * mean_loss(start) else null
    if same_windows(null, start):
        better = gain_over(null, start) > rules.DETECTED
    else:
        better = mean_loss(start) * NO_WORSE < mean_loss(null)
    return (null, start, None) if better else (null, null, suspect)


def blinded(seen: dict, start: Family) -> bool:
    """Whether flat tops in the records leave so many windows without a state that no second effect could be told."""
    return "flat_top" in seen and structured(start) > rules.UNEXPLAINED


def better_course(
    start: Family, looks: list[Look], other: Family, others: list[Look], say: Callable[[str], None]
) -> tuple[Family, list[Look]]:
    """Of what grew from the plain baseline and from a suspect that was set aside the one that explains more.

    A release that is pushed explains the releases, and nothing of what follows where the contact is another one, too;
    from the baseline a drift took its place.
    """
    gain = gain_between(start, other)
    say(f"  {' + '.join(other.effects)} in the place of {' + '.join(start.effects) or 'nothing'}: gain {gain:.0f}")
    return (other, others) if gain > BETTER_COURSE else (start, looks)


def grown(setup: Setup, start: Family, seed: int, say: Callable[[str], None]) -> tuple[Family, list[Look]]:
    """Effects added one at a time, or two at once, as long as they are there, stand against their rivals, and settle
    what was left."""
    looks: list[Look] = []
    while len(start.effects) < rules.MOST_EFFECTS and (not start.effects or room(start) > rules.SECOND_ROOM):
        look, second = look_further(setup, start, seed, say), bool(start.effects)
        looks.append(look)
        doubt_trifle(look, second, seed, say)
        if not look.order or not rules.is_detected(look.gains[look.order[0].effects[-1]], np.inf, second):
            start = min(start, look.kept, key=mean_loss) if second else start
            break
        wider = look.order[0] if look.in_full else duel(setup, look, say)
        found = upheld(look, wider, second, seed, say)
        if found is None:
            # The family may have been begun anew where a rival ended, and be better there.
            start = min(start, look.kept, key=mean_loss) if second else start
            break
        alone = not second and leaves_too_much(look, found)
        if alone and (pair := settled_by_two(setup, look, found, seed, say)) is not None:
            look, found, second, alone = pair, pair.order[0], True, False
            looks.append(look)
        wider = to_the_end(setup, look, found, second, seed, say)
        say(f"  {' + '.join(wider.effects)}: structured {structured(wider):.3f}, room {room(wider):.0f}")
        if start.effects and not rules.settles(structured(start), structured(wider)):
            break
        start = wider
        # What two at once do not settle one more on top of the first does not, if that leaves most windows.
        nothing_settles = alone and structured(start) > TOO_FAR
        if nothing_settles or rules.is_hopeless(structured(start), look.gains[start.effects[-1]], room(start)):
            break
    return start, looks


def proven(setup: Setup, experiment: Experiment, pair: Family, looks: list[Look], say: Callable[[str], None]) -> Family:
    """A pair, or its first effect alone where the second leaves more than it gains, or is not told apart from a rival,
    or gains little and the held-out runs say no.

    Effects that were found together at the release are left as they are.
    """
    if len(pair.effects) < 2 or not looks or len(looks[-1].kept.effects) != 1:
        return pair
    alone, gains, second = looks[-1].kept, looks[-1].gains, pair.effects[-1]
    gain = gains[second]
    if rules.is_not_it(gain, room(pair)):
        say(f"  {second} gains {gain:.0f} units and leaves {room(pair):.0f}")
        return alone
    if rivals := [id for id, g in gains.items() if id not in pair.effects and g > rules.told_apart(gain)]:
        say(f"  {second} is not told apart from {', '.join(rivals)}")
        return alone
    if gain > rules.PLAIN_SECOND:
        return pair
    if rules.is_small(gain, room(alone)):
        return alone

    def fitted(f: Family) -> Losses:
        return Losses(f.point.loss, f.fit.series.count, f.fit.series.run_of)

    def held(f: Family) -> Losses:
        return held_out(setup, f.fit, f.point, experiment, f.effects)

    on_fitted = float(np.mean(held_gains(fitted(alone), fitted(pair), rules.SHOWN)))
    on_held = held_gains(held(alone), held(pair), rules.SHOWN)
    say(f"  {second}: the loss falls by {on_fitted:.3f}, held out by {' '.join(f'{g:.3f}' for g in on_held)}")
    return pair if rules.is_proven(on_fitted, on_held) else alone


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
    looks = looks or [Look(final, [], {})]
    unfruitful = looks[-1].kept.effects != () and final.effects == looks[-1].kept.effects
    look = looks[-2] if unfruitful and len(looks) > 1 else looks[-1]
    checks = checked(final)
    facts = rules.Facts(
        effects=final.effects,
        sizes={e: size_of(final, e) for e in final.effects},
        gains=look.gains,
        bad=structured(final),
        median=float(np.median(2 * final.point.loss / final.fit.series.count)),
        held_gain=held_gains(plain, with_effect),
        by_run={r.id: structured(final, i) for i, r in enumerate(setup.runs)},
        room=room(final),
        clipped=clipped(experiment, seen),
        loud=(loud(final.point.loss, final.fit.series.count), loud(with_effect.loss, with_effect.count)),
        off=checks["off_bounds"].value,
        agree=checks["runs_agree"].passed,
        far_fetched=far_fetched(look.order, final),
        odds=checks["runs_agree"].value if checks["gradient_small"].value < rules.UNENDED else 0.0,
    )
    decision = rules.decide(facts)
    if unfruitful and decision.verdict in ("named", "indicated"):
        others = {e: gain for e, gain in looks[-1].gains.items() if e not in final.effects}
        decision.sentence += rules.left_over(others, facts.room)
    kept = decision.effects if decision.verdict in ("named", "indicated", "pair", "class") else ()
    card = signature(null.fit, null.point, final.fit, final.point)
    noise = float(np.degrees(gyro_of(setup.experiment).noise))
    shown = final if kept else null
    had = (*shown.effects, *(e.id for e in setup.base.active_effects()))
    limits, confusion = seen_by(setup, shown.fit, shown.point, had)
    if decision.verdict == "none":
        decision.sentence += rules.unseen(limits)
    checks = checks if shown is final else checked(shown)
    return Diagnosis(
        experiment=experiment,
        verdict=decision.verdict,
        effects=decision.effects,
        ranking=rules.ranking(ranked_by(null, final, look)),
        amplitudes=amplitudes(final) if kept else {},
        error={
            "unit": "deg/s RMS",
            "stretch": FIT_STRETCH.format(end=setup.end),
            "noise_floor": noise,
            "baseline": {"fit": rms_deg_s(null.fit, null.point), "holdout": plain.rms},
            "with_effect": {
                "fit": rms_deg_s(shown.fit, shown.point),
                "holdout": with_effect.rms if kept else plain.rms,
            },
        },
        separating_experiment=to_be_sure(setup, null, final, decision),
        signature=card,
        gates=rules.gates(facts, decision) | {name: g.to_dict() for name, g in checks.items()},
        detection_limits=limits,
        confusion=confusion,
        sentence=decision.sentence,
        seconds=time.perf_counter() - begun,
        model=shown.fit.models(shown.point.z)[0][0],
    )


def checked(family: Family) -> dict[str, Gate]:
    """The gates of a family by their names; those that need no other fit."""
    fit, point = family.fit, family.point
    found = information(fit, point)
    gates = (gradient_small(fit, point, found), step_small(fit, point), off_bounds(fit, point))
    return {g.name: g for g in (*gates, runs_agree(fit, point, found))}


def ranked_by(null: Family, final: Family, look: Look) -> dict[str, float]:
    """Gain of every effect, by which it is ranked: that of the last look.

    What was there before that look counts with what all gain over the plain baseline, and not with what it had in the
    look, where it may have stood as a second effect.
    """
    before = [e for e in final.effects if e not in look.gains or e != final.effects[-1]]
    return look.gains | {e: gain_between(null, final) for e in before}


def clipped(experiment: Experiment, seen: dict) -> bool:
    """Whether the held-out records are cut flat at the same rate as the fitted ones."""
    if "flat_top" not in seen:
        return False
    held = flat_tops(experiment, experiment.holdout_runs())
    return held is not None and abs(held - seen["flat_top"]) < 2 * gyro_of(experiment).resolution


def to_be_sure(setup: Setup, null: Family, final: Family, decision: rules.Decision) -> str:
    """The experiment that would tell the members of a class apart, by simulation; else what the catalogue advises."""
    if decision.verdict == "class":
        own = {p.name: zi for p, zi in zip(final.fit.parameters, final.point.z, strict=True)}
        switches = switches_of(catalogue.find(decision.effects[0]))
        model = null.fit.models(null.point.z)[0][0]
        size = np.array([own.get(p.name, 0.0) for p in switches])
        if found := separating_run(setup, model, decision.effects, size):
            return found
    return rules.separating(decision)
