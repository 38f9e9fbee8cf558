"""A comparison on the terminal: where a model leaves the runs, and by how much, last."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from rockref.discover.compare.models import Comparison
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import stretch_masks
from rockref.report.tables import comparison_tables
from rockref.report.terminal.text import print_table, say, say_all

if TYPE_CHECKING:
    from rich.console import Console

#: Kinds of findings that are told first; decided: from when on, and whether the start is right already, then why.
ORDER = (
    "overturned", "leaves_band", "first_impact", "before_impact", "to_second_impact", "energy", "leak", "amplitude",
    "envelope",
)  # fmt: skip
#: Sentences about all models together, at most; decided: with heads and results they stay within twelve lines.
SENTENCES = 6


def print_comparison(console: Console, c: Comparison, full: bool = False) -> None:
    """Print a comparison, the size of the error last; with all tables and sentences where `full`."""
    runs = f"{len(c.of('fit'))} fit and {len(c.of('holdout'))} held-out runs"
    say(console, f"{c.experiment.name}: {' and '.join(c.names)} beside {runs}, {c.seconds:.0f} s.")
    if full:
        print_tables(console, c)
    told = findings(c)
    for name in (*c.names, None):
        texts = [f for f in told if f.model == name and f.kind != "error_size"]
        if not full:
            texts = sorted((f for f in texts if f.kind in ORDER), key=lambda f: ORDER.index(f.kind))
            texts = texts[: max(1, SENTENCES // len(c.names))] if name is not None else []
        if texts and len(c.names) > 1:
            say(console, f"{name or 'Side by side'}:")
        say_all(console, [f"  {f.text}" for f in texts], None)
    for line in error_lines(c):
        say(console, line, "bold")


def print_tables(console: Console, c: Comparison) -> None:
    """Print what was measured, the errors by stretch and axis, the runs, and the energy."""
    print_table(console, comparison_tables.runs_table(c))
    for k in range(len(c.names)):
        for use in ("fit", "holdout"):
            if c.of(use):
                print_table(console, comparison_tables.errors_table(c, k, use))
        print_table(console, comparison_tables.departures_table(c, k))
    print_table(console, comparison_tables.energy_table(c))


def error_lines(c: Comparison) -> list[str]:
    """Return for each model by which share of the measured rates it is off, up to the second main impact."""
    found = []
    for k, name in enumerate(c.names):
        shares = [
            f"{100 * share:.2g} % on the {words} runs"
            for use, words in (("fit", "fit"), ("holdout", "held-out"))
            if c.of(use) and math.isfinite(share := share_missed(c, k, use))
        ]
        if shares:
            said = " and ".join(shares)
            found.append(f"{name} is off by {said}: its error over the measured rates, up to the second main impact.")
    return found


def share_missed(c: Comparison, model: int, use: str) -> float:
    """Return the error of a model over the measured rates, both as root mean squares up to the second main impact.

    Over the runs of one use and all axes; NaN where no sample of a model is finite.
    """
    error = size = 0.0
    for k in c.of(use):
        run = c.measured[k].run
        assert run.t is not None and run.crv is not None
        masks = stretch_masks(run.t, c.measured[k].features.impacts)
        mask = masks["before"] | masks["between"]
        difference = c.results[model][k].modelled[mask] - run.crv[mask]
        there = np.isfinite(difference).all(axis=1)
        error += float((difference[there] ** 2).sum())
        size += float((run.crv[mask][there] ** 2).sum())
    return math.sqrt(error / size) if size > 0 else float("nan")
