"""The marks of one case: what the verdict said against what was true."""

from __future__ import annotations

import math
from typing import Any

from rockref.blind.cases.blocks import NEAR
from rockref.blind.cases.plan import CONTROL, EARLIER, FAULTY, MATCHED, PAIR, SINGLE, UNLISTED
from rockref.blind.scoring.sizes import covered, size_error, stated

#: Verdicts that say of one or two effects that they are there.
NAMING = ("named", "pair")
#: Verdicts that say that some effect of the catalogue is there.
CLAIMS = (*NAMING, "indicated", "class")
#: Answers that judge nothing by a record: the reader's (exit code 2), and the verdict's.
REFUSALS = ("refused", "not_trustworthy")
#: decided: a class of more members helps nobody.
LARGEST_CLASS = 3
#: decided: held-out runs show an effect where the baseline's error is a tenth above the noise.
SHOWS = 1.10
AXIS = {"main": "x", "transverse": "y", "longitudinal": "z", "x": "x", "y": "y", "z": "z"}


def mark(truth: dict[str, Any], verdict: dict[str, Any]) -> dict[str, Any]:
    """Return marks of one case.

    truth : of `make_case`, with `kind` and `class`; verdict : what `rockref diagnose --json` prints. Marks that have no
    meaning for the kind of case are missing.
    """
    kind, true = EARLIER.get(truth["kind"], truth["kind"]), [e["id"] for e in truth["effects"]]
    word, said = str(verdict.get("verdict", "error")), [str(e) for e in verdict.get("effects") or []]
    right = set(true) | set(truth.get("class") or ())
    found: dict[str, Any] = {
        "name": truth["name"],
        "kind": kind,
        "block": (truth.get("block") or {}).get("family", NEAR),
        "truth": true,
        "sizes": [e["size"] for e in truth["effects"]],
        "forms": [e["form"] for e in truth["effects"]],
        "verdict": word,
        "said": said,
        "wrong_name": word in NAMING and not set(said) <= right,
        "seconds": verdict.get("seconds"),
        "probability": verdict.get("probability"),
        "right": is_right(kind, true, right, word, said),
    }
    if kind == CONTROL:
        found["false_alarm"] = word in CLAIMS or word == "something_else"
        found["false_name"] = word in NAMING
    elif kind in (SINGLE, MATCHED):
        held = word in CLAIMS and true[0] in said and len(said) <= LARGEST_CLASS
        found["in_class"] = held
        found["first"] = held and said[0] == true[0]
        found["named"] = word == "named" and said == true
        found["as_class"] = word == "class" and held
        found["below_limit"] = word == "none" and is_below_limit(truth["effects"][0], verdict)
    elif kind == PAIR:
        found["both"] = word == "pair" and set(said) == set(true)
        found["one"] = word in CLAIMS and bool(set(said) & set(true))
    elif kind == UNLISTED:
        found["abstained"] = word == "something_else"
        found["card"] = found["abstained"] and on_card(truth["effects"], verdict.get("signature") or {})
    elif kind == FAULTY:
        found["refused"] = word in REFUSALS
    if kind in (SINGLE, PAIR, MATCHED) and word in CLAIMS:
        found |= _sizes(truth["effects"], verdict, said)
    if kind in (SINGLE, PAIR):
        found["gap_closed"] = gap_closed(verdict.get("error") or {})
    return found


def is_right(kind: str, true: list[str], right: set[str], word: str, said: list[str]) -> bool:
    """Return whether a verdict is right as it stands, which is what its stated probability is the probability of.

    true : effects that are hidden; right : those that may be named. A class is right if it holds the truth.
    """
    if kind == CONTROL:
        return word == "none"
    if kind == UNLISTED:
        return word == "something_else"
    if kind == FAULTY:
        return word in REFUSALS
    if word == "class":
        return bool(set(said) & right) if kind != PAIR else set(true) <= set(said)
    if kind == PAIR:
        return word in CLAIMS and set(said) == set(true)
    return word in ("named", "indicated") and len(said) == 1 and said[0] in right


def least_seen(limits: dict[str, dict[str, Any]]) -> dict[str, float]:
    """Return the least size, in typical ones, at which each effect would be seen, from the limits of its parameters."""
    least: dict[str, float] = {}
    for name, limit in limits.items():
        effect = name.partition(".")[0]
        least[effect] = min(least.get(effect, math.inf), float(limit["in_typical_sizes"]))
    return least


def is_below_limit(effect: dict[str, Any], verdict: dict[str, Any]) -> bool:
    """Return whether a verdict states, in its detection limits, that an effect of this size could be there unseen."""
    return bool(effect["size"] < least_seen(verdict.get("detection_limits") or {}).get(effect["id"], 0.0))


def on_card(effects: list[dict[str, Any]], signature: dict[str, Any]) -> bool:
    """Return whether axis and phase that a verdict writes on its card are among those that are true."""
    cards = [e["card"] for e in effects if "card" in e]
    axis = AXIS.get(str(signature.get("axis")))
    return any(axis in card["axes"] and signature.get("phase") in card["phases"] for card in cards)


def gap_closed(error: dict[str, Any]) -> float | None:
    """Return share of the gap between baseline and noise floor that is closed on held-out runs; None where there is
    none."""
    try:
        floor = error["noise_floor"]
        floor = float(floor["holdout"] if isinstance(floor, dict) else floor)
        before, after = float(error["baseline"]["holdout"]), float(error["with_effect"]["holdout"])
    except (KeyError, TypeError, ValueError):
        return None
    if not before > SHOWS * floor:
        return None
    return (before - after) / (before - floor)


def _sizes(effects: list[dict[str, Any]], verdict: dict[str, Any], said: list[str]) -> dict[str, Any]:
    """Return errors and coverage of the sizes that are stated, for effects whose form is the catalogue's."""
    errors, inside = [], []
    for effect in effects:
        if effect["form"] != "catalogue" or effect["id"] not in said:
            continue
        entries = stated(verdict.get("amplitudes"), effect["id"])
        error = size_error(effect["id"], effect["parameters"], entries)
        if error is not None:
            errors.append(error)
        inside += covered(effect["id"], effect["parameters"], entries)
    return {"size_errors": errors, "covered": inside}
