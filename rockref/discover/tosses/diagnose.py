"""What is missing in the model of tosses, several effects deep: learn on the fit tosses, prove on the held-out ones."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import nominal_model
from rockref.discover.tosses.compare import measured
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.first_guess import first_guesses, guessed
from rockref.discover.tosses.fit import HORIZONS, TossFit, cut, picked
from rockref.discover.tosses.gates import floor_of, paired, step_small, total
from rockref.discover.tosses.parameters import CANDIDATES, apply
from rockref.discover.tosses.predict import predict
from rockref.discover.verdict import RIVAL
from rockref.effects import catalogue
from rockref.measure.experiment import FIT, HOLDOUT
from rockref.measure.flight import Poses, side_by_side
from rockref.measure.tosses import Tosses
from rockref.model.errors import InputError

#: At most so many effects are added one after the other.
DEEPEST = 8
#: Share of the objective that an effect must gain on the fit tosses; decided: what ten numbers gain on 200 tosses by
#: luck is a hundredth, and what is smaller matters to nobody's simulation.
LEAST_GAIN = 0.01
#: Candidates that are refitted after the screen; iterations of such a refit, of the winner, and of the first and the
#: last rung. An iteration ends a fit that gains no more.
REFITTED, REFIT_ITERATIONS, ITERATIONS, FIRST_ITERATIONS = 2, 5, 12, 16
#: Frames over which candidates compete: all that moves, since friction shows in the slide that ends a toss.
LONG = HORIZONS[-1]
#: Candidates compete on every so many tosses.
SKIPPED = 2
#: How many of the small ones are fitted together at the end, and how the rung begins.
TOGETHER, SMALL = 10, "small ones together: "
#: Least tosses on either side for a verdict (decided: below it the bootstrap of a mean with heavy tails means little).
LEAST_TOSSES = 8


@dataclass
class Step:
    """One rung of the staircase: the effect that was added, its rivals on the fit tosses, and the fitted model."""

    effect: str
    gains: dict[str, float]
    fit: TossFit
    z: np.ndarray
    objective: float
    verdict: str = ""
    holdout: dict[str, Errors] = field(default_factory=dict)
    fitted: Errors | None = None
    proof: dict[str, Any] = field(default_factory=dict)

    @property
    def model(self) -> Model:
        """The fitted model."""
        return self.fit.model(self.z)

    def values(self) -> dict[str, dict[str, Any]]:
        """Every number of the fit with its unit."""
        return {
            p.name: {"value": p.value(float(zi)), "unit": p.unit}
            for p, zi in zip(self.fit.parameters, self.z, strict=True)
        }


@dataclass
class TossDiagnosis:
    """The result; `to_dict()` is what `rockref diagnose --json` prints for tosses."""

    tosses: Tosses
    verdict: str
    effects: tuple[str, ...]
    sentence: str
    steps: list[Step]
    nominal: dict[str, Errors]
    floor: dict[str, float]
    measured: dict[str, Any]
    agreement: list[dict[str, Any]]
    gates: list[dict[str, Any]]
    seconds: float

    @property
    def model(self) -> Model:
        """The last model whose effects were all proven."""
        good = [s for s in self.steps if s.verdict != "none"]
        return (good or self.steps)[-1].model

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
        return {
            "experiment": self.tosses.name,
            "kind": "toss",
            "verdict": self.verdict,
            "effects": list(self.effects),
            "sentence": self.sentence,
            "nominal_holdout": {k: e.summary() for k, e in self.nominal.items()},
            "staircase": [rung(s) for s in self.steps],
            "floor": self.floor,
            "measured_without_contact_model": self.measured,
            "agreement": self.agreement,
            "gates": self.gates,
            "seconds": round(self.seconds, 1),
            "sha256": self.tosses.sha256,
        }


def rung(s: Step) -> dict[str, Any]:
    """One step as plain numbers."""
    return {
        "added": s.effect or "the law, its contact fitted",
        "verdict": s.verdict,
        "gains_percent": {k: round(100 * g, 2) for k, g in s.gains.items()},
        "objective": round(s.objective, 4),
        "fit": s.fitted.summary() if s.fitted else {},
        "holdout": {k: e.summary() for k, e in s.holdout.items()},
        "proof": s.proof,
        "parameters": s.values(),
    }


def diagnose(
    tosses: Tosses,
    model: Model | None = None,
    deepest: int = DEEPEST,
    progress: Callable[[str], None] | None = None,
) -> TossDiagnosis:
    """Add the effect that explains most, again and again, until none explains enough; then look at the held-out tosses.

    Parameters
    ----------
    tosses : with their marks.  model : what to start from; by default the plain law with stated values.
    deepest : most effects.  progress : called with a line at every stage.

    Raises
    ------
    InputError
        E-SIZE, where there are too few tosses on either side.
    """
    begun = time.perf_counter()
    say = progress or (lambda line: None)
    for use in (FIT, HOLDOUT):
        if len(tosses.used(use)) < LEAST_TOSSES:
            raise InputError(
                "E-SIZE", str(tosses.path), f"has {len(tosses.used(use))} tosses of use {use}",
                f"A verdict needs {LEAST_TOSSES} of each.",
            )  # fmt: skip
    base = model or nominal_model(tosses)
    poses = side_by_side(tosses.used(FIT), tosses.rate)
    found = measured(tosses.used(FIT), tosses, base)
    guesses = first_guesses(found, base)
    fit = TossFit(base, (), poses, tosses.width, log=say)
    z, objective = fit.run(np.zeros(len(fit.parameters)), FIRST_ITERATIONS)
    steps = [Step("", {}, fit, z, objective)]
    while len(steps) <= deepest and not at_the_floor(steps[-1], say):
        step = look_further(steps[-1], guesses, say)
        if step is None:
            steps += small_ones(steps[-1], say)
            break
        steps.append(step)
        say(f"{step.effect}: {steps[-2].objective:.3f} -> {step.objective:.3f}")
    held = side_by_side(tosses.used(HOLDOUT), tosses.rate)
    say("the held-out tosses")
    return conclude(tosses, base, steps, poses, held, found, begun)


def look_further(last: Step, guesses: dict[str, float], say: Callable[[str], None]) -> Step | None:
    """The next rung, or None where no candidate gains enough on the fit tosses."""
    promised = screen(last)
    order = sorted(promised, key=lambda id: promised[id][0])
    say("  screen: " + ", ".join(f"{id} {promised[id][0]:.3f}" for id in order[:6]))
    if not order:
        return None
    poses = some(last.fit.poses)
    weight = last.fit.frame_weights(last.z, cut(poses, LONG))
    _, plain = replace(last.fit, poses=poses).run(last.z, REFIT_ITERATIONS, (LONG,), weight)
    found = {}
    for id in dict.fromkeys((*order[:REFITTED], *(id for id in order if told(id, guesses)))):
        fit = TossFit(last.fit.base, (*last.fit.effects, id), poses, last.fit.width, log=say)
        measured_start = guessed(promised[id][1], fit.parameters, id, guesses)
        begins = [promised[id][1]] if id in order[:REFITTED] else []
        begins += [measured_start] if measured_start is not None else []
        ends = [fit.run(z, REFIT_ITERATIONS, (LONG,), weight) for z in begins]
        found[id] = min(ends, key=lambda end: end[1])
    gains = {id: 1 - f[1] / plain for id, f in found.items()}
    best = max(gains, key=lambda id: gains[id])
    if gains[best] < LEAST_GAIN:
        say(f"  {best} gains {gains[best]:.1%}: not enough")
        return None
    fit = TossFit(last.fit.base, (*last.fit.effects, best), last.fit.poses, last.fit.width, log=say)
    return Step(best, gains, fit, *fit.run(found[best][0], ITERATIONS, (LONG,)))


def told(id: str, guesses: dict[str, float]) -> bool:
    """Whether something was measured of an effect without a contact model."""
    return any(name.startswith(id + ".") for name in guesses)


def some(poses: Poses) -> Poses:
    """The tosses on which candidates compete."""
    return picked(poses, np.arange(0, len(poses.x), SKIPPED))


def at_the_floor(last: Step, say: Callable[[str], None]) -> bool:
    """Whether the fit tosses are predicted as well as their uncertain starts allow: nothing is left to learn."""
    floor = floor_of(last.model, last.fit.poses, last.fit.width)
    left = total(errors(predict(last.model, last.fit.poses), last.fit.poses, last.fit.width))
    low = floor["position_percent"] + floor["rotation_deg"]
    if left < low:
        say(f"  error {left:.2f} is below the floor of the starts, {low:.2f}")
    return left < low


def small_ones(last: Step, say: Callable[[str], None]) -> list[Step]:
    """The last rung: the candidates that are each too small to be named, fitted together; none where there are none."""
    promised = screen(last)
    if not promised:
        return []
    order = sorted(promised, key=lambda id: promised[id][0])[:TOGETHER]
    fit = TossFit(last.fit.base, (*last.fit.effects, *order), last.fit.poses, last.fit.width, log=say)
    z = np.concatenate([last.z, *[promised[id][1][len(last.z) :] / len(order) for id in order]])
    return [Step(SMALL + ", ".join(order), {}, fit, *fit.run(z, FIRST_ITERATIONS, (LONG,)))]


def screen(last: Step) -> dict[str, tuple[float, np.ndarray]]:
    """Every candidate on top of a step: the best objective that one descent of all numbers reaches, and where."""
    fit, z = last.fit, last.z
    poses = cut(some(fit.poses), LONG)
    weight = fit.frame_weights(z, poses)
    known = fit.slopes(z, poses, weight)
    found = {}
    for id in CANDIDATES:
        if id in fit.effects:
            continue
        wider = TossFit(fit.base, (*fit.effects, id), poses, fit.width)
        wide = np.concatenate([z, np.zeros(len(wider.parameters) - len(z))])
        found[id] = wider.descend(wide, poses, weight, wider.slopes(wide, poses, weight, known))
    return {id: (now, wide) for id, (wide, now) in found.items()}


def conclude(
    tosses: Tosses, base: Model, steps: list[Step], poses: Poses, held: Poses, found: dict[str, Any], begun: float
) -> TossDiagnosis:
    """The held-out tosses, rung by rung, and the verdict."""
    nominal = {start: errors(predict(base, held, start), held, tosses.width) for start in ("flight", "raw")}
    for i, step in enumerate(steps):
        step.holdout = {
            start: errors(predict(step.model, held, start), held, tosses.width) for start in ("flight", "raw")
        }
        step.fitted = errors(predict(step.model, poses), poses, tosses.width)
        before = nominal["flight"] if i == 0 else steps[i - 1].holdout["flight"]
        step.proof = paired(before, step.holdout["flight"])
        step.verdict = word(step)
    proven = tuple(s.effect for s in steps[1:] if s.verdict in ("named", "class"))
    verdict, sentence = words(steps, proven)
    last = steps[-1]
    return TossDiagnosis(
        tosses, verdict, proven, sentence, steps, nominal, floor_of(last.model, held, tosses.width), found,
        agreement(last, found, base), [step_small(last.model, held, tosses.width)], time.perf_counter() - begun,
    )  # fmt: skip


def word(step: Step) -> str:
    """The verdict of one rung: named, class (a rival gains as much), indicated (held-out tosses do not tell), none."""
    if not step.effect:
        return ""
    if step.proof["high"] < 0:
        return "none"
    if step.proof["low"] <= 0 or step.effect.startswith(SMALL):
        return "indicated"
    best = step.gains[step.effect]
    near = [id for id, g in step.gains.items() if id != step.effect and g > RIVAL * best]
    return "class" if near else "named"


def words(steps: list[Step], proven: tuple[str, ...]) -> tuple[str, str]:
    """The verdict and its sentence."""
    if not proven:
        return "none", "No effect of the catalogue makes the held-out tosses better."
    named = " and then ".join(proven)
    verdict = "named" if len(proven) != 2 else "pair"
    if len(proven) == 1 and next(s for s in steps if s.effect == proven[0]).verdict == "class":
        verdict = "class"
    a, b = (total(steps[k].holdout["flight"]) for k in (0, -1))
    return (
        verdict,
        f"Missing, in the order of what they explain: {named}; the held-out error falls from {a:.1f} to {b:.1f}.",
    )


def agreement(step: Step, found: dict[str, Any], base: Model) -> list[dict[str, Any]]:
    """What the contact model's fit and the measurements without a contact model say of the same quantity."""
    values = step.values()
    arcs = found.get("flight_arcs", {}).get("values", {})
    rows = []
    for axis in "xyz":
        name = f"mass_eccentricity.{axis}"
        if name in values and f"centre_{axis}" in arcs:
            # The arcs see the centre of mass from the tracked point: the tag frame's offset is part of it.
            both = values[name]["value"] + values.get(f"tag_frame.{axis}", {"value": 0.0})["value"]
            other = arcs[f"centre_{axis}"]
            rows.append(_row(f"centre of mass, {axis}", "m", both, other["value"], other["se"], "flight arcs"))
    balance = found.get("measured_centre", {}).get("impulse_balance", {}).get("values", {})
    J = np.diag(np.asarray(apply(base, (), np.zeros(0)).body()[0].inertia))
    for k, axis in enumerate(("xx", "yy", "zz")):
        name = f"inertia_deviation.{axis}"
        if name in values and f"inertia_{axis}" in balance:
            other = balance[f"inertia_{axis}"]
            m = float(base.mass)
            rows.append(
                _row(f"inertia, {axis}", "kg m2", values[name]["value"] * J[k], other["value"] * m, other["se"] * m,
                     "impulse balance of the first impact")
            )  # fmt: skip
    corner = found.get("measured_centre", {}).get("corner", {}).get("values", {})
    if "friction" in corner:
        c = corner["friction"]
        rows.append(
            _row("friction", "1", values["mu"]["value"], c["value"], c["se"], "impulse ratio of sliding corners")
        )
    return rows


def _row(what: str, unit: str, contact: float, other: float, se: float, how: str) -> dict[str, Any]:
    return {
        "quantity": what, "unit": unit, "with_contact_model": float(contact), "without": float(other),
        "standard_error": float(se), "how": how,
    }  # fmt: skip


def sentences() -> dict[str, str]:
    """The physics of every candidate in a sentence."""
    return {id: catalogue.find(id).sentence for id in CANDIDATES}
