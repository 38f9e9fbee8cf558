"""Whether runs are those of the law with other inputs: feet that never slide, whose anchors are kept, that nobody
has tied, or that remember what another foot has done.

Such an input stands for a decision of the law. A run that is wrong, and equals what the law makes of another
input, tells that decision, whichever rule the run is to show.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from rockref.conformance.backends import call, richardson
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.rows_of_the_law import SAME, WRONG, off, rows_of_the_law
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.vectors import Vector

Answers = Sequence[tuple[Vector, dict[str, Any]]]
#: Beyond every cone.
HELD = {"mu": 2.0**40, "mu_0": 2.0**40}
#: Rules, in words, and the inputs that stand for another law; numbers for all feet.
INPUTS: tuple[tuple[str, str, dict[str, float | bool]], ...] = (
    ("T6", "no foot slid before the start", {"sliding": False}),
    ("T2", "feet never slide", HELD),
    ("T5", "feet that touch anew keep an old anchor", {"anchored": True}),
)
#: No foot is tied at the start, and feet are tied where they touch from there on; no spring of friction, of which the
#: first step is the same.
UNTIED: tuple[str, dict[str, float | bool]] = ("no foot was tied before the start", {"anchored": False})
NO_SPRING = {"K_T": 2.0**-60}
#: What a foot remembers, by rule and in words; and what it may take for it: another foot's, mostly.
MEMORY = (
    ("T5", "anchored", "flags of touching"), ("T5", "s", "anchors"), ("T6", "sliding", "flags of sliding"),
)  # fmt: skip
OTHER_FEET: tuple[tuple[str, Callable[[np.ndarray, dict[str, Any]], np.ndarray]], ...] = (
    ("of the foot before", lambda a, q: np.roll(a, 1, axis=0)),
    ("of the foot after", lambda a, q: np.roll(a, -1, axis=0)),
    ("from the last foot to the first", lambda a, q: a[::-1]),
    ("of the first half", lambda a, q: a[np.arange(len(a)) % max(len(a) // 2, 1)]),
    ("of the first foot", lambda a, q: np.repeat(a[:1], len(a), axis=0)),
    ("of the opposite sign", lambda a, q: ~a if a.dtype == bool else -a),
    ("with their coordinates exchanged", lambda a, q: a[..., ::-1] if a.ndim > 1 else a),
    ("where they are, if they slid", lambda a, q: np.where(q["sliding"][:, None], places(q), a) if a.ndim > 1 else a),
)
READ = "The runs are those of the law where feet have the {} {}."
#: Rules that a wrong memory of the feet may seem to be.
OF_FRICTION = ("T5", "T1", "T2", "T6", "T3")
#: What the first evaluation alone decides of a run of one step: the rates have seen a second one, which remembers
#: otherwise again.
OF_THE_START = ("x", "Lambda")
#: A share of the wrong runs of one step that another foot's memory has to explain. Decided: those that it does not are
#: wrong of several feet in ways that cancel.
NEARLY_ALL = 0.8
#: Feet that push by nothing, wherever they are.
NO_PUSH = {"K_N": 2.0**-60, "C_N": 2.0**-60}
NOWHERE = "No foot pushes in any run: they are not where they should be."
#: A run is explained where this share at most is left of what it is off by. Decided: integrators lose a hundred
#: thousandth of what sixteen steps show.
LEFT = 1e-2
#: So many runs have to be explained, and this share of those that are wrong. Decided: no other mistake gives the same
#: rows twice by chance.
SOME, MOST = 2, 0.5
SAYS = "The runs are those of the law where {}."
#: So many stretched feet have to be wrong, and so many right, for an anchor to be given up by some. Decided.
FEET = 3
GIVEN_UP = "Some stretched feet have the friction of feet that touch anew, and others are right: anchors are given up."


def rule_as_if(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return the rule of the input that makes the law's runs those that are wrong, and a sentence; its own rule and ""
    where none does."""
    failed = {c.vector for c in checks if c.failed and c.weighed and not c.follows and c.layer == check.layer}
    wrong = [(v, out) for v, out in answers if v.id in failed]
    for rule, words, inputs in INPUTS:
        count = sum(is_explained(v, out, inputs) for v, out in wrong)
        if count >= SOME and count >= MOST * len(wrong):
            return rule, SAYS.format(words)
    return check.rule, ""


def rule_of_other_feet(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return the rule of what feet remember, and a sentence, where nearly all wrong runs of one step, the one that is
    told among them, are those of the law whose feet read it from another foot, and not as many those without springs
    of friction; its own rule and "" elsewhere."""
    failed = {c.vector for c in checks if c.failed and c.weighed and not c.follows and c.layer == "L5s"}
    single = [(v, out) for v, out in answers if v.id in failed and len(rows_of_the_law(v.id)) == 2]
    told = [(v, out) for v, out in single if v.id == check.vector]
    if check.rule not in OF_FRICTION or check.layer != "L5s" or not told:
        return check.rule, ""
    unsprung = sum(is_explained(v, out, NO_SPRING, OF_THE_START) for v, out in single)
    # Where springs of friction are right in other runs, none is missing.
    wrong = {c.vector for c in checks if c.failed}
    sprung = sum(v.layer == "L5s" and v.id not in wrong and is_stretched(v) for v, _ in answers) >= FEET
    for rule, name, words in MEMORY:
        for whose, read in OTHER_FEET:
            inputs = {name: read}
            if not all(is_explained(v, out, inputs, OF_THE_START) for v, out in told):
                continue
            explained = [v for v, out in single if is_explained(v, out, inputs, OF_THE_START)]
            # The direction of feet that slide is that of an anchor elsewhere, or of another sliding force.
            if rule == "T5" and sum(feet_stick(v) for v in explained) < SOME:
                continue
            count = len(explained)
            if count >= max(SOME, unsprung, NEARLY_ALL * len(single)) and (sprung or count - unsprung >= SOME):
                return rule, READ.format(words, whose)
    return check.rule, ""


def rule_of_untied_feet(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return T5, and a sentence, where the runs that are wrong are those of the law whose feet are not tied at the
    start, and fewer those without springs of friction, or stretched springs are right in others; its own rule and ""
    elsewhere."""
    words, inputs = UNTIED
    failed = {c.vector for c in checks if c.failed and c.weighed and not c.follows and c.layer == check.layer}
    wrong = [(v, out) for v, out in answers if v.id in failed]
    told = [(v, out) for v, out in wrong if v.id == check.vector]
    if check.rule not in ("T1", "T5") or not all(is_explained(v, out, inputs) for v, out in told):
        return check.rule, ""
    untied, unsprung = (sum(is_explained(v, out, made) for v, out in wrong) for made in (inputs, NO_SPRING))
    # In a single step nothing but the start decides: no such run may be another one.
    single = [(v, out) for v, out in wrong if v.layer == "L5s" and len(rows_of_the_law(v.id)) == 2]
    if untied < max(SOME, MOST * len(wrong)) or not all(is_explained(v, out, inputs) for v, out in single):
        return check.rule, ""
    if untied - unsprung >= SOME:
        return "T5", SAYS.format(words)
    right = [v for v, _ in answers if v.layer == check.layer and v.id not in failed]
    return ("T5", GIVEN_UP) if sum(is_stretched(v) for v in right) >= FEET else (check.rule, "")


def feet_stick(vector: Vector) -> bool:
    """Return whether a foot should stick at the start of a run, and is dragged at."""
    feet = rows_of_the_law(vector.id)[0].feet
    return feet is not None and bool(np.any(feet["touching"] & feet["dragged"] & ~feet["slides"]))


def places(q: dict[str, Any]) -> np.ndarray:
    """Return where feet (n, 2) [m] are along the plate at a start."""
    return np.asarray((q["x"] + q["P"] @ q["Lambda"].T)[:, :2])


def is_stretched(vector: Vector) -> bool:
    """Return whether springs that are tied at the start move the block of a run, or turn it."""
    tied, untied = law(vector), law(vector, UNTIED[1])
    return any(float(np.max(np.abs(tied[key] - untied[key]))) > SAME for key in ("x", "Lambda"))


def rule_of_feet_that_never_push(answers: Answers, checks: Sequence[Check], check: Check) -> tuple[str, str]:
    """Return K1, and a sentence, where every run whose normal forces are asked is that of a block on which no foot
    pushes; its own rule and "" elsewhere. A wrong force law leaves some force."""
    asked = [(v, out) for v, out in answers if v.layer == check.layer and v.rule == "N1" and "x@1" in v.expect]
    if check.rule != "N1" or not all(is_explained(v, out, NO_PUSH) for v, out in asked if v.id == check.vector):
        return check.rule, ""
    pushed = [(v, out) for v, out in asked if np.max(np.abs(law(v)["x"] - law(v, NO_PUSH)["x"])) > SAME]
    sure = len(pushed) >= SOME and all(is_explained(v, out, NO_PUSH) for v, out in pushed)
    return ("K1", NOWHERE) if sure else (check.rule, "")


def is_explained(
    vector: Vector, out: dict[str, Any], inputs: dict[str, Any], keys: Sequence[str] = ("x", "Lambda", "W")
) -> bool:
    """Return whether the rows of a run are nearer to the law's with other inputs than they are to the law's, by far.

    keys : what is looked at
    """
    right, other = law(vector), law(vector, inputs)
    off = left = 0.0
    for key in keys:
        try:
            got = np.asarray(out[key], float)
            off += float(np.sum((got - right[key]) ** 2))
            left += float(np.sum((got - other[key]) ** 2))
        except (KeyError, TypeError, ValueError):
            return False
    return bool(np.sqrt(left) <= LEFT * np.sqrt(off) and np.sqrt(off) > SAME)


def given_up(answers: Answers) -> bool:
    """Return whether all stretched feet that should stick and are wrong at a start have the friction of feet that touch
    anew, and others are right."""
    wrong = right = 0
    for vector, out in answers:
        rows = rows_of_the_law(vector.id) if vector.layer == "L5s" else ()
        feet = rows[0].feet if rows else None
        at_fault = None if feet is None else off(out, 0, rows[0])
        if feet is None or at_fault is None or np.any(at_fault[:, 2]):
            continue
        bad = np.any(at_fault, axis=-1)
        tied = feet["touching"] & ~feet["new"] & feet["spring"] & ~feet["slides"]
        right += int(np.sum(tied & ~bad))
        if not np.any(tied & bad):
            continue
        anew = law(vector, {"anchored": False, "sliding": False})["F"][0]
        apart = np.abs(np.asarray(out["F"], float)[0] - anew)[tied & bad]
        if not np.max(apart) <= WRONG * max(1.0, float(np.max(np.abs(anew)))):
            return False
        wrong += len(apart)
    return min(wrong, right) >= FEET


def law(vector: Vector, inputs: dict[str, Any] | None = None) -> dict[str, Any]:
    """Return the law's own answer to a run, with other inputs: a number for all feet, or what makes them of the own."""
    given = vector.inputs
    q = {
        k: a(given[k], given) if callable(a) else np.full(np.shape(given[k]), a)[()] for k, a in (inputs or {}).items()
    }
    ask = richardson.ask if vector.layer == "LS" else call.ask
    return ask(NumpyEngine(), replace(vector, inputs=given | q))
