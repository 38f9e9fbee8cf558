"""Outcomes on a shake table on the terminal: scores, distances, what repeats allow, and the answer, last."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.report.tables.spoken import SPOKEN
from rockref.report.tables.table import Table, table_of
from rockref.report.terminal.text import print_table, say

if TYPE_CHECKING:
    from rich.console import Console


#: decided: below the usual 5 % two distributions are said to differ.
DIFFERENT = 0.05


def interval(found: dict[str, float], sign: str = "") -> str:
    """Return a mean with its interval."""
    return f"{found['mean']:{sign}.3f} ({found['low']:{sign}.3f} to {found['high']:{sign}.3f})"


def scores_table(record: dict[str, Any]) -> Table:
    """Return log loss, Brier score and accuracy of every prediction."""
    columns = {
        "prediction": lambda p: p["name"],
        "log loss (nat)": lambda p: interval(p["log_loss"]),
        "more than the first": lambda p: "" if p["more"] is None else interval(p["more"], "+"),
        "Brier score": lambda p: interval(p["brier"]),
        "accuracy": lambda p: interval(p["accuracy"]),
    }
    note = "In brackets 95 % from resampled motions. What is fitted or chosen has not seen the motion that it predicts."
    return table_of(record["predictions"], "Predictions of falls", columns, note)


def distances_table(record: dict[str, Any]) -> Table:
    """Return how far the maxima of models lie from the measured ones."""
    columns = {
        "largest": lambda d: f"{d['quantity']}, {d['name']}",
        "tests, runs": lambda d: f"{d['tests']}, {d['runs']}",
        "KS": lambda d: f"{d['ks']:.3f}",
        "both bands": lambda d: f"{d['band']:.3f}, {'beyond' if d['ks'] > d['band'] else 'within'}",
        "energy distance": lambda d: f"{SPOKEN[d['unit']][1] * d['energy_distance']:.3g} {SPOKEN[d['unit']][0]}",
        "p": lambda d: f"{d['p_value']:.3f}",
    }
    note = (
        "KS: the largest gap of the distribution functions; p: whole motions exchanged between the tests and one run "
        "of each. A fall counts as a tilt of 45 deg; slide and twist are of what stood."
    )
    return table_of(record["maxima"], "Distributions of maxima", columns, note)


def ceiling_line(record: dict[str, Any]) -> str:
    """Return what repeats allow, in a sentence; empty where no test repeats another."""
    r = record["repeats"]
    if r is None:
        return ""
    return (
        f"Repeats agree in {r['agree']} of {r['pairs']} pairs: of such tests no prediction expects an accuracy above "
        f"{r['best_accuracy']:.3f} ({r['low']:.3f} to {r['high']:.3f}), a Brier score below {r['least_brier']:.3f} or "
        f"a log loss below {r['least_log_loss']:.3f}."
    )


def answers(record: dict[str, Any]) -> list[str]:
    """Return the answer, a sentence a prediction beside the first, or a distribution where no outcomes are known."""
    found = []
    first, *others = record["predictions"] or [None]
    for p in others:
        low, high = p["more"]["low"], p["more"]["high"]
        said = "worse than" if low > 0 else "better than" if high < 0 else "not told apart from"
        found.append(
            f"{p['name']}: log loss {p['log_loss']['mean']:.3f}, {said} the {first['name']} "
            f"({interval(p['more'], '+')})."
        )
    if not others and first is not None:
        found.append(f"{first['name']}: log loss {interval(first['log_loss'])}.")
    # Both sides exchange whole motions: m of them make 2^(m - 1) different distances, and that of the tests is one.
    least = 2.0 ** (1 - record["motions"])
    few = f"; {record['motions']} motions allow none below {least:.3f}" if least >= DIFFERENT else ""
    for d in record["maxima"]:
        gap = "differs from" if d["p_value"] < DIFFERENT else "is not told apart from"
        found.append(f"Largest {d['quantity']} of {d['name']} {gap} the measured one (p = {d['p_value']:.3f}{few}).")
    return found


def print_shaken(console: Console, record: dict[str, Any]) -> None:
    """Print a comparison, the answer last."""
    fell = "" if record["fell"] is None else f", {record['fell']} fell"
    runs = f"; {record['runs_a_test']} runs a test and model" if "runs_a_test" in record else ""
    say(console, f"{record['experiment']}: {record['tests']} tests of {record['motions']} motions{fell}{runs}.")
    if record["predictions"]:
        print_table(console, scores_table(record))
    if record["maxima"]:
        print_table(console, distances_table(record))
    if line := ceiling_line(record):
        say(console, line)
    for line in answers(record):
        say(console, line, "bold")
