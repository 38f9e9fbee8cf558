"""What is missing in the model of tosses, effect by effect: learned on the fit tosses, proven on the held-out ones."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.tosses.body import nominal_model
from rockref.discover.tosses.compare import measured
from rockref.discover.tosses.errors import Errors, errors
from rockref.discover.tosses.first_guess import first_guesses
from rockref.discover.tosses.fit import HORIZONS, TossFit
from rockref.discover.tosses.fitting import LEAST_TOSSES, at_values, by_start, enough, unfitted, values
from rockref.discover.tosses.gates import floor_of, off_bounds, paired, step_small, total, uses_agree
from rockref.discover.tosses.parameters import CANDIDATES, apply
from rockref.discover.tosses.predict import predict
from rockref.discover.tosses.together import STAGES, Stair, all_together, way_down
from rockref.effects import catalogue
from rockref.measure.records.release import FIT, HOLDOUT
from rockref.measure.records.toss import Tosses
from rockref.measure.tosses.flight import Poses, side_by_side

#: Most iterations of the law's own fit and of the last polish; an iteration that gains no more ends a fit.
FIRST_ITERATIONS, LAST_ITERATIONS = 16, 12
#: Share of a rung's gain that stays without its effect, from which on the others could stand for it; decided.
TAKEN_OVER = 0.95


@dataclass
class Step:
    """One rung of the staircase: the effect that was added, what it gains on the fit tosses, and the fitted model.

    gain : share of the objective by which the effect lowers it on its rung.
    taken_over : share of this gain that stays without the effect if all other candidates are in the model.
    """

    effect: str
    fit: TossFit
    z: np.ndarray
    gain: float = 0.0
    taken_over: float = 0.0
    verdict: str = ""
    holdout: dict[str, Errors] = field(default_factory=dict)
    fitted: Errors | None = None
    proof: dict[str, Any] = field(default_factory=dict)

    @property
    def model(self) -> Model:
        """Return the fitted model."""
        return self.fit.model(self.z)

    def values(self) -> dict[str, dict[str, Any]]:
        """Return every number of the fit with its unit."""
        return values(self.fit.parameters, self.z)


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
    not_needed: tuple[str, ...] = ()
    confusion: dict[str, dict[str, float]] = field(default_factory=dict)

    @property
    def model(self) -> Model:
        """Return the model of the last rung that the held-out tosses do not speak against."""
        good = [s for s in self.steps if s.verdict != "none"]
        return (good or self.steps)[-1].model

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""
        return {
            "experiment": self.tosses.name,
            "kind": "toss",
            "verdict": self.verdict,
            "effects": list(self.effects),
            "not_needed": list(self.not_needed),
            "sentence": self.sentence,
            "nominal_holdout": {k: e.summary() for k, e in self.nominal.items()},
            "staircase": [rung(s) for s in self.steps],
            "floor": self.floor,
            "measured_without_contact_model": self.measured,
            "agreement": self.agreement,
            "confusion": self.confusion,
            "gates": self.gates,
            "seconds": round(self.seconds, 1),
            "sha256": self.tosses.sha256,
        }


def rung(s: Step) -> dict[str, Any]:
    """Return one step as plain numbers."""
    return {
        "added": s.effect or "the law, its contact fitted",
        "verdict": s.verdict,
        "gain_percent": round(100 * s.gain, 2),
        "taken_over_by_others_percent": round(100 * s.taken_over, 1),
        "fit": s.fitted.summary() if s.fitted else {},
        "holdout": {k: e.summary() for k, e in s.holdout.items()},
        "proof": s.proof,
        "parameters": s.values(),
    }


def diagnose(
    tosses: Tosses,
    model: Model | None = None,
    candidates: Sequence[str] | None = None,
    stages: Sequence[tuple[int, int]] = STAGES,
    progress: Callable[[str], None] | None = None,
) -> TossDiagnosis:
    """Fit all candidates together, take away what is not needed, and show the held-out tosses what each one does.

    Parameters
    ----------
    tosses : with their marks.  model : what to start from; by default the plain law with stated values.
    candidates : effects that may be missing; by default all that tosses are asked about.
    stages : frames and most iterations of the joint fit.  progress : called with a line at every stage.

    Raises
    ------
    InputError
        E-SIZE, where there are too few tosses on either side.
    """
    started = time.perf_counter()
    say = progress or (lambda line: None)
    fitted, kept = (enough(tosses, use, f"A verdict needs {LEAST_TOSSES} of each.") for use in (FIT, HOLDOUT))
    given = model or nominal_model(tosses)
    base, own = unfitted(given)
    poses = side_by_side(fitted, tosses.rate)
    found = measured(fitted, tosses, base)
    fit = TossFit(base, tuple(own), poses, tosses.width, log=say)
    law = Stair(fit, *fit.run(at_values(fit.parameters, own), FIRST_ITERATIONS))
    steps = [Step("", law.fit, law.z)]
    confusion: dict[str, dict[str, float]] = {}
    others = [id for id in (candidates or tuple(CANDIDATES)) if id not in own]
    if not at_the_floor(steps[0], say):
        say("all candidates together")
        full = all_together(law, others, first_guesses(found, base), stages)
        say("the way down")
        stairs = way_down(full, tuple(own), say)
        confusion = stairs[0].confusion
        steps = rungs(stairs, law, say)
    held = side_by_side(kept, tosses.rate)
    say("the held-out tosses")
    result = conclude(tosses, given, steps, poses, held, found, started)
    not_needed = tuple(id for id in others if id not in steps[-1].fit.effects)
    return replace(result, not_needed=not_needed, confusion=confusion)


def rungs(stairs: list[Stair], law: Stair, say: Callable[[str], None]) -> list[Step]:
    """Return the way down, seen from below: from the law to the model of which every effect is needed."""
    costs = stairs[0].costs
    low = min((stairs[-1], law), key=lambda s: left_over(s.fit, s.z))
    steps = [Step("", low.fit, low.z)]
    for below, stair in zip(stairs[:0:-1], stairs[-2::-1], strict=True):
        (effect,) = set(stair.fit.effects) - set(below.fit.effects)
        gain = below.objective - stair.objective
        over = 1 - costs[effect] / gain if gain > 0 else 1.0
        steps.append(Step(effect, stair.fit, stair.z, gain / below.objective, float(np.clip(over, 0, 1))))
    say("the last polish")
    steps[-1].z, _ = steps[-1].fit.run(steps[-1].z, LAST_ITERATIONS, (HORIZONS[-1],))
    return steps


def left_over(fit: TossFit, z: np.ndarray) -> float:
    """Return the error of a fit's own tosses, position [%] plus rotation [deg]."""
    return total(errors(predict(fit.model(z), fit.poses), fit.poses, fit.width))


def at_the_floor(last: Step, say: Callable[[str], None]) -> bool:
    """Return whether the fit tosses are predicted as well as their uncertain starts allow: nothing is left to learn."""
    floor = floor_of(last.model, last.fit.poses, last.fit.width)
    left = left_over(last.fit, last.z)
    low = floor["position_percent"] + floor["rotation_deg"]
    if left < low:
        say(f"  error {left:.2f} is below the floor of the starts, {low:.2f}")
    return left < low


def conclude(
    tosses: Tosses, base: Model, steps: list[Step], poses: Poses, held: Poses, found: dict[str, Any], started: float
) -> TossDiagnosis:
    """Return the held-out tosses, rung by rung, and the verdict."""
    nominal = by_start(base, held, tosses.width)
    for i, step in enumerate(steps):
        step.holdout = by_start(step.model, held, tosses.width)
        step.fitted = errors(predict(step.model, poses), poses, tosses.width)
        before = nominal["flight"] if i == 0 else steps[i - 1].holdout["flight"]
        step.proof = paired(before, step.holdout["flight"], len(steps) - 1)
        step.verdict = word(step)
    proven = tuple(s.effect for s in steps[1:] if s.verdict in ("named", "class"))
    last = steps[-1]
    assert last.fitted is not None
    checks = [
        step_small(last.model, held, tosses.width), off_bounds(last.fit, last.z),
        uses_agree(last.fitted, last.holdout["flight"]),
    ]  # fmt: skip
    verdict, sentence = words(steps, proven)
    failed = [gate["name"] for gate in checks if not gate["passed"]]
    if failed:
        verdict, sentence = "not_trustworthy", f"Not to be trusted: {', '.join(failed)} not passed. {sentence}"
    return TossDiagnosis(
        tosses, verdict, proven, sentence, steps, nominal, floor_of(last.model, held, tosses.width), found,
        agreement(last, found, last.fit.base), checks,
        time.perf_counter() - started,
    )  # fmt: skip


def word(step: Step) -> str:
    """Return the verdict of one rung: named, class (the others could stand for it), indicated (held-out tosses do not
    tell), none."""
    if not step.effect:
        return ""
    if step.proof["high"] < 0:
        return "none"
    if step.proof["low"] <= 0:
        return "indicated"
    return "class" if step.taken_over > TAKEN_OVER else "named"


def words(steps: list[Step], proven: tuple[str, ...]) -> tuple[str, str]:
    """Return the verdict and its sentence."""
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
    """Return what the contact model's fit and the measurements without a contact model say of the same quantity."""
    values = step.values()
    arcs = found.get("flight_arcs", {}).get("values", {})
    rows = []
    for axis in "xyz":
        name = f"mass_eccentricity.{axis}"
        if name in values and f"centre_{axis}" in arcs:
            # The arcs see the centre of mass from the tracked point: the tag frame's offset is part of it.
            both = values[name]["value"] + values.get(f"tag_frame.{axis}", {"value": 0.0})["value"]
            rows.append(_row(f"centre of mass, {axis}", "m", both, arcs[f"centre_{axis}"], "flight arcs"))
    balance = found.get("measured_centre", {}).get("impulse_balance", {}).get("values", {})
    J = np.diag(np.asarray(apply(base, (), np.zeros(0)).body()[0].inertia))
    for k, axis in enumerate(("xx", "yy", "zz")):
        name = f"inertia_deviation.{axis}"
        if name in values and f"inertia_{axis}" in balance:
            other = {key: value * float(base.mass) for key, value in balance[f"inertia_{axis}"].items()}
            how = "impulse balance of the first impact"
            rows.append(_row(f"inertia, {axis}", "kg m2", values[name]["value"] * J[k], other, how))
    corner = found.get("measured_centre", {}).get("corner", {}).get("values", {})
    if "friction" in corner:
        how = "impulse ratio of sliding corners"
        rows.append(_row("friction", "1", values["mu"]["value"], corner["friction"], how))
    return rows


def _row(what: str, unit: str, contact: float, other: dict[str, float], how: str) -> dict[str, Any]:
    return {
        "quantity": what, "unit": unit, "with_contact_model": float(contact), "without": float(other["value"]),
        "standard_error": float(other["se"]), "how": how,
    }  # fmt: skip


def sentences() -> dict[str, str]:
    """Return the physics of every candidate in a sentence."""
    return {id: catalogue.find(id).sentence for id in CANDIDATES}
