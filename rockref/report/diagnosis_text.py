"""A diagnosis on the terminal: the verdict first, then what it rests on."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.effects import catalogue
from rockref.report import tables
from rockref.report.fit_text import quantity
from rockref.report.page import Table
from rockref.report.text import print_table

if TYPE_CHECKING:
    from rich.console import Console

#: What each verdict means, for those who meet it for the first time.
MEANINGS = {
    "none": "No effect of the catalogue is needed to explain these runs.",
    "named": "One effect explains the misfit, on fitted and on held-out runs.",
    "indicated": "One effect explains the fitted runs; the held-out runs neither confirm nor refute it.",
    "class": "Several effects explain these runs alike; only another experiment can tell which.",
    "pair": "Two effects together explain the misfit.",
    "something_else": "The misfit is real, and nothing in the catalogue explains it.",
    "not_trustworthy": "The fit did not pass its own checks: nothing is claimed.",
}


def sentence_of(d: dict[str, Any]) -> str:
    """The verdict in a sentence."""
    return d.get("sentence") or MEANINGS.get(d["verdict"], d["verdict"])


#: What a moment of each parity does.
PARITY_WORDS = {
    "even": "pulling to the same side all the while",
    "odd_in_velocity": "against the motion or with it",
    "odd_in_side": "righting the block or pushing it over",
    "odd_in_both": "other on the way out than on the way back",
}


def looks_like(d: dict[str, Any]) -> str:
    """What the misfit looks like, in a sentence, for a reader who has to think of a cause himself."""
    s = d["signature"]
    parts = [f"about the {s['axis']} axis"]
    if shares := s.get("stretch_shares"):
        parts.append("in free arcs" if shares["free_arc"] >= shares["impact"] else "at main impacts")
    if s.get("parity"):
        parts.append(PARITY_WORDS[s["parity"]])
    if s.get("locked_to") in ("release", "clock"):
        parts.append("again with every release" if s["locked_to"] == "release" else "going on by the clock")
    return f"The misfit is largest {', '.join(parts)}."


def print_diagnosis(console: Console, d: dict[str, Any]) -> None:
    """Print a diagnosis from its JSON record."""
    say(console, f"{d['experiment']}: {d['verdict'].upper().replace('_', ' ')}. {sentence_of(d)}", "bold")
    say(console, MEANINGS.get(d["verdict"], ""))
    if d["verdict"] == "something_else":
        say(console, looks_like(d))
    if d["effects"]:
        say(console, "")
        for id in d["effects"]:
            say(console, f"  {id}: {effect_words(id)}")
    print_table(console, errors_table(d))
    if d["amplitudes"]:
        print_table(console, amplitudes_table(d))
    if d["ranking"]:
        print_table(console, ranking_table(d))
    if d.get("detection_limits"):
        print_table(console, limits_table(d))
    if d.get("confusion"):
        print_table(console, confusion_table(d))
    print_table(console, signature_table(d))
    if d["separating_experiment"]:
        say(console, f"To be sure: {d['separating_experiment']}")
    for sentence in careful(d):
        say(console, f"With care: {sentence}")
    say(console, f"{d['seconds']:.0f} s.", "dim")


def careful(d: dict[str, Any]) -> list[str]:
    """What the gates say that the fit did not pass; that of the bounds stands with the sizes, where there are any."""
    missed = {
        name: gate["sentence"]
        for name, gate in d["gates"].items()
        if isinstance(gate, dict) and not gate.get("passed", True)
    }
    if d["amplitudes"]:
        missed.pop("off_bounds", None)
    return list(missed.values())


def gates_rows(d: dict[str, Any]) -> list[list[str]]:
    """The checks before the verdict and those of the fit behind it, each with what was found, in words."""
    words = {"passed": "a verdict is given"}
    return [[words.get(key, key.replace("_", " ")), in_words(value)] for key, value in d["gates"].items()]


def say(console: Console, text: str, style: str | None = None) -> None:
    """Print a line as it is."""
    console.print(text, style=style, markup=False, highlight=False, soft_wrap=True)


def effect_words(id: str) -> str:
    """The physics of an effect in a sentence."""
    return catalogue.EFFECTS[id].sentence if id in catalogue.EFFECTS else "an effect of the user's own."


def errors_table(d: dict[str, Any]) -> Table:
    """The error before and after, on fit and holdout runs, beside the noise floor."""
    e = d["error"]
    floor = e["noise_floor"]
    rows = []
    for words, key in (("baseline", "baseline"), (with_words(d), "with_effect")):
        if key == "with_effect" and not d["amplitudes"]:
            continue
        values = [e[key].get("fit"), e[key].get("holdout")]
        rows.append([words, *(tables.number(v, 4) for v in values)])
    if len(rows) == 2:
        rows.append(["gap to the noise closed", *(closed(e, use, floor) for use in ("fit", "holdout"))])
    rows.append(["noise floor", tables.number(floor, 4), tables.number(floor, 4)])
    return Table("Error, deg/s RMS", ("", "fit runs", "held-out runs"), rows, f"Over {e['stretch']}.")


def with_words(d: dict[str, Any]) -> str:
    """Return "with drag", or what the members of a class are compared by."""
    shown = d["effects"][:1] if d["verdict"] == "class" else d["effects"]
    return "with " + " and ".join(shown) if shown else "with the nearest candidate"


def closed(e: dict[str, Any], use: str, floor: float) -> str:
    """Which part of the gap between baseline and noise floor is closed."""
    before, after = e["baseline"].get(use), e["with_effect"].get(use)
    if before is None or after is None or before <= floor:
        return "–"
    return f"{100 * (before - after) / (before - floor):.0f} %"


def amplitudes_table(d: dict[str, Any]) -> Table:
    """How large the effects are, with intervals."""
    rows = []
    for name, a in d["amplitudes"].items():
        unit = "" if a["unit"] == "1" else a["unit"]
        rows.append([name, *(number(a[k]) for k in ("value", "low", "high")), unit])
    note = "Intervals of 90 %."
    bounds = d.get("gates", {}).get("off_bounds")
    if bounds and not bounds["passed"]:
        note += f" Take them with care: {bounds['sentence']}"
    return Table("How large", ("number", "value", "low", "high", "unit"), rows, note)


def number(value: float | None) -> str:
    """A number with four figures; infinite (None in the record) as a sign."""
    return "∞" if value is None else quantity(value)


def ranking_table(d: dict[str, Any]) -> Table:
    """The candidates, best first."""
    rows = [
        [r["effect"], tables.number(r["gain"], 0), tables.number(r["z"], 1), tables.number(r["weight"], 3)]
        for r in d["ranking"]
    ]
    note = (
        "Gain: log-likelihood gained over a baseline that was given as many iterations, windows clipped. z: the same "
        "as a number of standard deviations. Weight: share among the candidates. "
        "The rest of the catalogue was tried and not led on."
    )
    return Table("Fitted in full", ("effect", "gain", "z", "weight"), rows, note)


def limits_table(d: dict[str, Any]) -> Table:
    """How large an effect could have been without being seen."""
    rows = [
        [name, quantity(row["value"]), "" if row["unit"] == "1" else row["unit"]]
        for name, row in d["detection_limits"].items()
    ]
    note = (
        "Each number alone, the others of its effect at none. Numbers of one effect that make up for each other, such "
        "as sides that are all a little short, can stay unseen together at more."
    )
    return Table("Could have stayed unseen up to", ("number", "limit", "unit"), rows, note)


#: Cosine from which two candidates are listed as alike; decided: a fifth of either is then left for itself.
ALIKE = 0.9


def confusion_table(d: dict[str, Any]) -> Table:
    """The pairs of candidates that these runs hardly tell apart."""
    pairs = [
        (value, a, b)
        for a, row in d["confusion"].items()
        for b, value in row.items()
        if a < b and value is not None and value > ALIKE
    ]
    rows = [[a, b, f"{value:.3f}"] for value, a, b in sorted(pairs, reverse=True)]
    return Table("Hardly told apart by these runs", ("effect", "and", "cosine"), rows)


#: Words for the entries of a signature.
SIGNATURE_WORDS = {
    "axis": "axis with the largest misfit",
    "phase": "most at",
    "frequency_hz": "frequency (Hz)",
    "loss_at_release": "misfit at the release (1 is noise)",
    "loss_after": "misfit after it (1 is noise)",
    "axis_shares": "shares of the axes",
    "remaining_axis_shares": "shares of the axes in what remains",
    "stretch_shares": "shares of free arcs and of main impacts",
    "parity": "the moment that is missing in free arcs is",
    "parity_shares": "share of it that each parity explains",
    "repeats": "alike in runs that were released alike (0 to 1)",
    "coherence": "coherence of the clearest tone (0 to 1)",
    "locked_to": "goes by",
}


def signature_table(d: dict[str, Any]) -> Table:
    """What the misfit of the baseline looks like."""
    rows = []
    for key, value in d["signature"].items():
        words = SIGNATURE_WORDS.get(key, key.replace("_", " "))
        rows.append([words, in_words(value).replace("_", " ")])
    return Table("What the baseline's misfit looks like", ("sign", "found"), rows, prose=True)


def in_words(value: Any) -> str:
    """A value of the record in a few words."""
    if isinstance(value, dict) and "sentence" in value:
        return value["sentence"] if value.get("passed", True) else f"Not passed. {value['sentence']}"
    if isinstance(value, dict):
        return ", ".join(f"{k} {in_words(v)}" for k, v in value.items())
    if isinstance(value, (list, tuple)):
        return ", ".join(map(in_words, value))
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.3g}"
    return "–" if value is None else str(value)
