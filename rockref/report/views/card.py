"""The head of a page: what was found, how large it is, what it takes off the error, and what to measure next."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import Comparison, baseline_model
from rockref.discover.hypotheses.law import law_parameters
from rockref.effects import catalogue
from rockref.report.html.trial import Trial, trial
from rockref.report.tables.spoken import Spoken, spoken, spoken_amplitudes
from rockref.report.terminal import addition_text, diagnosis_text

if TYPE_CHECKING:
    from rockref.discover.add_effect import Addition
    from rockref.discover.diagnose import Diagnosis


@dataclass(frozen=True)
class Fact:
    """One number of a card: what it is, the number, and smaller lines about it."""

    label: str
    value: str
    notes: Sequence[str] = ()


@dataclass(frozen=True, eq=False)
class Card:
    """What a page says at a glance.

    kicker : the verdict;  name : of the effect;  sentence : the answer, with its size;  about : the physics
    facts, trial, next_step;  picture, keys, caption : of a run, where there is no trial, drawn without a script
    """

    kicker: str
    name: str
    sentence: str
    facts: Sequence[Fact] = ()
    trial: Trial | None = None
    next_step: str = ""
    picture: str = ""
    keys: str = ""
    caption: str = ""
    about: str = ""
    next_label: str = "What to measure next"


def card_of_diagnosis(record: dict[str, Any], c: Comparison) -> Card:
    """Return the card of a diagnosis (its JSON record); c compares the baseline and what was found."""
    effects = record["effects"]
    verdict, probability = record["verdict"], record.get("probability")
    kicker = verdict.replace("_", " ")
    if probability is not None and verdict not in diagnosis_text.UNSURE:
        kicker += f" · probability {probability:.2f}"
    sizes = spoken_amplitudes(record["amplitudes"], diagnosis_text.SIZES)
    drawn = trial(c, effects[:1] if verdict == "class" else effects)
    return finished(
        kicker=kicker,
        name=" or ".join(effects) if verdict == "class" else " and ".join(effects) or "no effect",
        sentence=diagnosis_text.answer(record),
        about=about(record),
        facts=[*size_facts(sizes), *error_facts(record["error"], bool(record["amplitudes"]))],
        drawn=drawn,
        next_step=record["separating_experiment"] or WITHOUT[verdict],
    )


def card_of_addition(a: Addition, c: Comparison) -> Card:
    """Return the card of an effect that was added; c compares the model before and after."""
    sizes = [spoken(name, n.value, n.low, n.high, n.unit) for name, n in a.own_numbers.items()]
    error: dict[str, Any] = {"noise_floor": a.noise}
    for key, state in (("baseline", a.before), ("with_effect", a.after)):
        error[key] = {use: None if (e := getattr(state, use)) is None else e["total"] for use in ("fit", "holdout")}
    kind = catalogue.find(a.effect)
    return finished(
        kicker=f"added to {' + '.join(a.before.effects) or 'the baseline'}",
        name=a.effect,
        sentence=" ".join([*([f"Its size is {sizes[0]}."] if len(sizes) == 1 else []), *addition_text.lines(a)[-1:]]),
        about=kind.sentence or "An effect of the user's own.",
        facts=[*size_facts(sizes[: diagnosis_text.SIZES]), *error_facts(error, True)],
        drawn=trial(c, [a.effect]),
        next_step=kind.experiment,
    )


def finished(
    kicker: str, name: str, sentence: str, about: str, facts: Sequence[Fact], drawn: Trial, next_step: str
) -> Card:  # fmt: skip
    """Return a card with the picture of its run."""
    picture, keys = drawn.picture()
    return Card(kicker, name, sentence, facts, drawn, next_step, picture, keys, about=about)


#: What to measure next where a verdict advises no experiment.
WITHOUT = {
    "none": "Nothing is needed. Another tilt, or the block turned by 180 degrees, would show smaller effects: ask "
    "rockref plan.",
    "named": "Repeat the release at another tilt: the effect has to explain it, too.",
    "indicated": "Repeat the release at another tilt, and hold the run out.",
    "class": "Release the block from another tilt and turned by 180 degrees: ask rockref plan.",
    "pair": "Repeat the release at another tilt: both effects have to explain it, too.",
    "something_else": "Repeat one release five times: what comes back is the block's, what does not is the way it is "
    "released.",
    "not_trustworthy": "Check tilt, side and clock of the run that contradicts the others, or measure it again.",
}  # fmt: skip


def about(record: dict[str, Any]) -> str:
    """Return the physics of one effect of the catalogue, what an unlisted one looks like, or nothing."""
    if len(record["effects"]) == 1 and record["effects"][0] in catalogue.EFFECTS:
        return catalogue.EFFECTS[record["effects"][0]].sentence
    return diagnosis_text.looks_like(record) if record["verdict"] == "something_else" else ""


def size_facts(sizes: Sequence[Spoken]) -> list[Fact]:
    """Return the sizes of an effect with their intervals."""
    return [
        Fact(
            "Size" if len(sizes) == 1 else f"Size, {s.name.partition('.')[2]}",
            s.size,
            [f"90 %: {s.low} to {s.high}", *([s.meaning] if s.meaning else [])],
        )
        for s in sizes
    ]


def error_facts(error: dict[str, Any], with_effect: bool) -> list[Fact]:
    """Return the error before and after on held-out runs, or on fit runs where none was held out."""
    use, words = ("holdout", "held-out") if error["baseline"].get("holdout") is not None else ("fit", "fit")
    before, after, noise = error["baseline"].get(use), error["with_effect"].get(use), error["noise_floor"]
    if before is None:
        return []
    label = f"Error on the {words} runs"
    if not with_effect or after is None:
        return [Fact(label, f"{before:.3f} deg/s", [f"noise alone: {noise:.3f}"])]
    gone = diagnosis_text.closed(error, use, noise)
    notes = [] if gone == diagnosis_text.NOTHING else [f"{gone} of the excess gone"]
    return [Fact(label, f"{before:.3f} → {after:.3f} deg/s", [f"noise alone: {noise:.3f}", *notes])]


def fitted_baseline(d: Diagnosis) -> Model:
    """Return the baseline with the numbers that fit it best without any effect; the nominal one where none are kept."""
    model = baseline_model(d.experiment)
    null = None if d.evidence is None else d.evidence.of(d.evidence.carried)
    for p in law_parameters(model):
        if null is not None and p.name in null.law:
            model = p.set(model, p.value(float(np.clip(null.law[p.name].z, p.least, p.most))))
    return model
