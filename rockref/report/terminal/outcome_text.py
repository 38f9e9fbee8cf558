"""What the outcomes of shaken tests say is missing, on the terminal: a table of candidates, and the answer, last."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.report.tables.spoken import SPOKEN
from rockref.report.tables.table import Table
from rockref.report.terminal.text import print_table, say

if TYPE_CHECKING:
    from rich.console import Console


def candidates_table(record: dict[str, Any]) -> Table:
    """Return every candidate: its size with a 90 % interval, and how much less the outcomes surprise with it."""
    hypotheses = record["evidence"]["hypotheses"]
    null = next(h for h in hypotheses if not h["effects"])
    rows = []
    for h in sorted(hypotheses, key=lambda h: h["loss"]):
        size = "-"
        for n in h["numbers"].values():
            unit, scale = SPOKEN.get(n["unit"], (n["unit"], 1.0))
            size = f"{scale * n['value']:.3g} ({scale * n['low']:.3g} to {scale * n['high']:.3g}) {unit}".rstrip()
        if set(h["effects"]) & set(record["evidence"]["signature"].get("open_ends", ())):
            size += ", no further tried"
        held = "-"
        if h["held_out"]:
            held = f"{sum(null['held_out'].values()) - sum(h['held_out'].values()):+.3f}"
        name = " ".join(h["effects"]) or "the model as it is"
        rows.append([name, size, f"{null['loss'] - h['loss']:+.3f}", held])
    head = ("candidate", "size, 90 %", "gain (nat an outcome)", "on held-out motions")
    return Table(
        "What may be missing", head, rows, "Each alone, at its most probable size; the best fitting one first."
    )


def print_outcomes(console: Console, record: dict[str, Any]) -> None:
    """Print a diagnosis from outcomes, the answer last."""
    samples = record["evidence"]["samples"]
    held = sum(record["evidence"]["held_out_samples"].values())
    say(console, f"{record['evidence']['experiment']}: {samples} outcomes fitted, {held} of other motions held out.")
    print_table(console, candidates_table(record))
    ranked = [f"{' '.join(a['effects']) or 'nothing'} {a['probability']:.2f}" for a in record["alternatives"][:4]]
    say(console, f"Probabilities: {', '.join(ranked)}.")
    say(console, record["sentence"], "bold")
