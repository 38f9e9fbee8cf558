"""A diagnosis on the terminal: what it rests on, the error before and after, and the verdict last."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.effects import catalogue
from rockref.report.tables.spoken import spoken_amplitudes
from rockref.report.tables.table import Table, figures, number, table_of, with_unit
from rockref.report.terminal.text import print_table, say, say_all

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
    """Return the verdict in a sentence."""
    return d.get("sentence") or MEANINGS.get(d["verdict"], d["verdict"])


#: What a moment of each parity does.
PARITY_WORDS = {
    "even": "pulling to the same side all the while",
    "odd_in_velocity": "against the motion or with it",
    "odd_in_side": "righting the block or pushing it over",
    "odd_in_both": "other on the way out than on the way back",
}


def looks_like(d: dict[str, Any]) -> str:
    """Return what the misfit looks like, in a sentence, for a reader who has to think of a cause himself."""
    s = d["signature"]
    parts = [f"about the {s['axis']} axis"]
    if shares := s.get("stretch_shares"):
        parts.append("in free arcs" if shares["free_arc"] >= shares["impact"] else "at main impacts")
    if s.get("parity"):
        parts.append(PARITY_WORDS[s["parity"]])
    if s.get("locked_to") in ("release", "clock"):
        parts.append("again with every release" if s["locked_to"] == "release" else "going on by the clock")
    return f"The misfit is largest {', '.join(parts)}."


def print_diagnosis(console: Console, d: dict[str, Any], full: bool = False) -> None:
    """Print a diagnosis from its JSON record, the verdict last; with all tables where `full`."""
    kept = ", kept from an earlier command" if d.get("from_kept_diagnosis") else ""
    say(console, f"{d['experiment']}: diagnosed in {d['seconds']:.0f} s{kept}.")
    if full:
        print_tables(console, d)
    else:
        say_all(console, alternative_lines(d), None)
    if d["verdict"] == "something_else":
        say(console, looks_like(d))
    told = [f"  {id}: {effect_words(id)}" for id in d["effects"]] + size_lines(d) + error_lines(d)
    told += [f"With care: {sentence}" for sentence in careful(d)[: None if full else 1]]
    if d["separating_experiment"] and (full or d["verdict"] in ("class", "indicated")):
        told.append(f"To be sure: {d['separating_experiment']}")
    say_all(console, [*told, verdict_line(d)])


def verdict_line(d: dict[str, Any]) -> str:
    """Return the verdict, how sure it is, and how large the effect is."""
    probability = d.get("probability")
    sure = "" if probability is None or d["verdict"] in UNSURE else f" (probability {probability:.2f})"
    return f"{d['verdict'].upper().replace('_', ' ')}{sure}. {answer(d)}"


def answer(d: dict[str, Any]) -> str:
    """Return the verdict in a sentence, and the size: the numbers of the effect that these runs determine."""
    if len(d["effects"]) != 1:
        return sentence_of(d)
    sizes = spoken_amplitudes(d["amplitudes"], SIZES)
    if len(sizes) == 1:
        return f"{sentence_of(d)} Its size is {sizes[0]}."
    known = [s for s in sizes if s.is_determined]
    told = " and ".join(f"{s.name.partition('.')[2]} {s}" for s in known[:2])
    return sentence_of(d) + (f" Its size: {told}." if told else "")


def print_tables(console: Console, d: dict[str, Any]) -> None:
    """Print all that a diagnosis rests on."""
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


#: Verdicts whose probability would say nothing: no hypothesis explains the runs.
UNSURE = ("something_else", "not_trustworthy")
#: Alternatives and sizes that are shown without --full; decided: with all else they fit twelve lines.
SHOWN, SIZES = 2, 3


def alternative_lines(d: dict[str, Any]) -> list[str]:
    """Return the most probable sets of effects on a line each."""
    return [
        f"  {r['effect']}: probability {r['weight']:.3f}, {number(r['gain'], 0)} nat better than the baseline"
        for r in d["ranking"][:SHOWN]
    ]


def size_lines(d: dict[str, Any]) -> list[str]:
    """Return how large each effect is, with its interval."""
    sizes = spoken_amplitudes(d["amplitudes"], SIZES)
    return [f"  {s.name} = {s}{f': {s.meaning}' if s.meaning else ''}" for s in sizes]


#: Error over the noise from which there is a gap to be closed; decided: noise is known to a few per cent.
GAP, NOTHING = 1.05, "–"


def error_lines(d: dict[str, Any]) -> list[str]:
    """Return the error before and after, beside the noise."""
    e, found = d["error"], []
    for words, use in (("fit", "fit"), ("held-out", "holdout")):
        before, after = e["baseline"].get(use), e["with_effect"].get(use)
        if before is None:
            continue
        if not d["amplitudes"] or after is None:
            found.append(f"{words} runs {before:.3f}")
            continue
        gap = closed(e, use, e["noise_floor"])
        gone = "" if gap == NOTHING else f" ({gap} of the excess gone)"
        found.append(f"{words} runs {before:.3f} before, {after:.3f} after{gone}")
    return [f"Error in deg/s, where noise alone makes {e['noise_floor']:.3f}: {'; '.join(found)}."] if found else []


def careful(d: dict[str, Any]) -> list[str]:
    """Return what failed gates say; that of the bounds stands with the sizes, where there are any."""
    missed = {
        name: gate["sentence"]
        for name, gate in d["gates"].items()
        if isinstance(gate, dict) and not gate.get("passed", True)
    }
    if d["amplitudes"]:
        missed.pop("off_bounds", None)
    return list(missed.values())


def gates_rows(d: dict[str, Any]) -> list[list[str]]:
    """Return the checks before the verdict and those of the fit behind it, each with what was found, in words."""
    words = {"passed": "a verdict is given"}
    return [[words.get(key, key.replace("_", " ")), in_words(value)] for key, value in d["gates"].items()]


def effect_words(id: str) -> str:
    """Return the physics of an effect in a sentence."""
    return catalogue.EFFECTS[id].sentence if id in catalogue.EFFECTS else "an effect of the user's own."


def errors_table(d: dict[str, Any]) -> Table:
    """Return the error before and after, on fit and holdout runs, beside the noise floor."""
    e = d["error"]
    floor = e["noise_floor"]
    rows = []
    for words, key in (("baseline", "baseline"), (with_words(d), "with_effect")):
        if key == "with_effect" and not d["amplitudes"]:
            continue
        values = [e[key].get("fit"), e[key].get("holdout")]
        rows.append([words, *(number(v, 4) for v in values)])
    if len(rows) == 2:
        rows.append(["gap to the noise closed", *(closed(e, use, floor) for use in ("fit", "holdout"))])
    rows.append(["noise floor", number(floor, 4), number(floor, 4)])
    return Table("Error, deg/s RMS", ("", "fit runs", "held-out runs"), rows, f"Over {e['stretch']}.")


def with_words(d: dict[str, Any]) -> str:
    """Return "with drag", or what the members of a class are compared by."""
    shown = d["effects"][:1] if d["verdict"] == "class" else d["effects"]
    return "with " + " and ".join(shown) if shown else "with the nearest candidate"


def closed(e: dict[str, Any], use: str, floor: float) -> str:
    """Return which part of the gap between baseline and noise floor is closed; a dash where there is hardly one."""
    before, after = e["baseline"].get(use), e["with_effect"].get(use)
    if before is None or after is None or before < GAP * floor:
        return NOTHING
    return f"{100 * min(1.0, (before - after) / (before - floor)):.0f} %"


def amplitudes_table(d: dict[str, Any]) -> Table:
    """Return how large the effects are, with intervals."""
    rows = []
    for name, a in d["amplitudes"].items():
        rows.append([name, *(figures(a[k], 4) for k in ("value", "low", "high")), with_unit(a["unit"])])
    note = "Intervals of 90 %."
    bounds = d.get("gates", {}).get("off_bounds")
    if bounds and not bounds["passed"]:
        note += f" Take them with care: {bounds['sentence']}"
    return Table("How large", ("number", "value", "low", "high", "unit"), rows, note)


def ranking_table(d: dict[str, Any]) -> Table:
    """Return the candidates, best first."""
    columns = {
        "effect": lambda r: r["effect"],
        "gain": lambda r: number(r["gain"], 0),
        "z": lambda r: number(r["z"], 1),
        "weight": lambda r: number(r["weight"], 3),
    }
    note = (
        "Gain: log posterior gained over the null model [nat]. z: the same as a number of standard deviations. "
        "Weight: probability. All other effects were tested and dropped."
    )
    return table_of(d["ranking"], "Alternatives", columns, note)


def limits_table(d: dict[str, Any]) -> Table:
    """Return how large an effect could have been without being seen."""
    rows = [[name, figures(row["value"], 4), with_unit(row["unit"])] for name, row in d["detection_limits"].items()]
    note = (
        "Each number alone, the others of its effect absent. Numbers of one effect that trade with each other, such "
        "as sides that are all a little short, can stay undetected together above the limit."
    )
    return Table("Would be detected above", ("number", "limit", "unit"), rows, note)


#: Cosine from which two candidates are listed as alike; decided: a fifth of either is then left for itself.
ALIKE = 0.9


def confusion_table(d: dict[str, Any]) -> Table:
    """Return the pairs of candidates that these runs hardly tell apart."""
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
    """Return what the misfit of the baseline looks like."""
    rows = []
    for key, value in d["signature"].items():
        if value is None:
            continue
        words = SIGNATURE_WORDS.get(key, key.replace("_", " "))
        rows.append([words, in_words(value).replace("_", " ")])
    return Table("What the baseline's misfit looks like", ("sign", "found"), rows, prose=True)


def in_words(value: Any) -> str:
    """Return a value of the record in a few words."""
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
