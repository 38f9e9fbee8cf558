"""A comparison as tables of texts, for the terminal and for the page alike."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from rockref.discover.compare.models import Comparison, MeasuredRun
from rockref.discover.compare.sentences_shape import LEDGER_SHARE
from rockref.discover.compare.stretches import AXES, STRETCH_WORDS, STRETCHES
from rockref.model.channel import DEGREES
from rockref.report.tables.table import Table, number, table_of

#: Stretches by the main impacts that bound them, and units, where a line is short.
STRETCH_SHORT = {"before": "to 1st impact", "between": "1st to 2nd", "after": "after 2nd"}
UNITS = ("(deg/s)", "/ noise", "/ spread")


def run_name(comparison: Comparison, k: int) -> str:
    """Return "01 (fit)" for the run at this place."""
    run = comparison.measured[k].run
    return f"{run.id} ({run.use})"


def runs_table(c: Comparison) -> Table:
    """Return what was measured, run by run."""
    impact = [[*m.features.impacts.times, math.nan, math.nan] for m in c.measured]
    columns = {
        "run": lambda k: run_name(c, k),
        "tilt (rad)": lambda k: number(c.measured[k].run.release_tilt, 3),
        "turned (deg)": lambda k: number(math.degrees(c.measured[k].run.block_turned), 0),
        "1st main impact (s)": lambda k: number(impact[k][0], 4),
        "2nd (s)": lambda k: number(impact[k][1], 4),
        "main impacts": lambda k: str(len(impact[k]) - 2),
        "noise X / Y / Z (deg/s)": lambda k: " / ".join(number(v, 3) for v in c.measured[k].noise * DEGREES),
        "repeats": lambda k: repeats_of(c.measured[k]),
    }
    note = (
        "Repeats: whether runs with the same release give the run-to-run spread, or those of another release lend it."
    )
    return table_of(range(len(c.measured)), f"Runs of {c.experiment.name}", columns, note)


def repeats_of(m: MeasuredRun) -> str:
    """Return whose repeats give the run-to-run spread of a run."""
    return "none" if m.repeats is None else "borrowed" if m.borrowed else "own"


def errors_table(c: Comparison, model: int, use: str | None = None) -> Table:
    """Return error of one model by stretch and axis in three units: fit and holdout runs side by side, or those of one
    use (narrow, for a terminal)."""
    uses = [one for one in ("fit", "holdout") if c.of(one) and use in (None, one)]
    names = STRETCH_WORDS if use is None else STRETCH_SHORT
    columns = ["stretch", "axis"]
    for one in uses:
        columns += [f"{one} (deg/s)", f"{one} / noise", f"{one} / spread"] if use is None else list(UNITS)
    rows = []
    for stretch in STRETCHES:
        for axis in AXES:
            row = [names[stretch], axis]
            for one in uses:
                row += [
                    number(DEGREES * c.rms(model, stretch, axis, one), 3),
                    number(mean_of(c, model, one, stretch, axis, "in_noise"), 1),
                    number(mean_of(c, model, one, stretch, axis, "in_spread"), 1),
                ]
            rows.append(row)
    note = (
        "RMS over the runs, after the release tilt was moved within its uncertainty to meet the first main "
        "impact. / noise: 1 is a perfect model. / spread: standard deviations between repeats, which differ by 1.4."
    )
    of_use = "" if use is None else f", {use} runs"
    # Below the last table of the model, once.
    last = use is None or use == "holdout" or not c.of("holdout")
    return Table(f"Error of {c.names[model]}{of_use}", columns, rows, note if last else "")


def mean_of(c: Comparison, model: int, use: str | None, stretch: str, axis: str, name: str) -> float | None:
    """Return the RMS over runs of one attribute of the errors, or None."""
    errors = [c.results[model][k].error(stretch, axis) for k in c.of(use)]
    values = [v for e in errors if e is not None and (v := getattr(e, name)) is not None]
    return float(np.sqrt(np.mean(np.square(values)))) if values else None


def departures_table(c: Comparison, model: int) -> Table:
    """Run by run: instants, and where the model leaves the band."""
    results = c.results[model]
    gone = [r.leaves_band for r in results]
    columns: dict[str, Callable[[int], str]] = {
        "run": lambda k: run_name(c, k),
        "tilt moved by (mrad)": lambda k: number(1e3 * results[k].tilt_offset, 2, plus=True),
        "1st impact (ms)": lambda k: late([p.error for p in results[k].impacts[:1]]),
        "1st to 2nd (ms)": lambda k: late([p.aligned_error for p in results[k].impacts[1:2]]),
        "leaves the band (s)": lambda k: "never" if (d := gone[k]) is None else number(d.time, 3),
        "axis": lambda k: "" if (d := gone[k]) is None else d.axis,
        "points touching": lambda k: "" if (d := gone[k]) is None else ", ".join(name for name, _ in d.points),
    }
    if any(r.overturned for r in results):
        columns["fell over"] = lambda k: "yes" if results[k].overturned else "no"
    note = (
        "1st impact: model minus measured at the stated tilt. 1st to 2nd: the same after the tilt was moved. "
        "Band: three times what noise and another run would differ by, over 50 ms."
    )
    return table_of(range(len(results)), f"Run by run: {c.names[model]}", columns, note)


def late(errors: list[float]) -> str:
    """Return by how many ms an impact is late, of none or one [s]."""
    return number(1e3 * errors[0] if errors else None, 1, plus=True)


def impacts_table(c: Comparison, model: int, k: int) -> Table:
    """Return the main impacts of one run: times and losses."""
    columns = {
        "main impact": lambda p: str(p.number),
        "measured (s)": lambda p: number(p.measured, 4),
        "model (s)": lambda p: number(p.model, 4),
        "aligned error (ms)": lambda p: number(1e3 * p.aligned_error, 1, plus=True),
        "measured loss (mJ)": lambda p: number(1e3 * p.loss_measured, 1),
        "model loss (mJ)": lambda p: number(1e3 * p.loss_model, 1),
    }
    return table_of(c.results[model][k].impacts, f"Main impacts of run {run_name(c, k)}: {c.names[model]}", columns)


def energy_table(c: Comparison) -> Table:
    """Return shares of energy lost, measured and modelled, means over runs."""
    rows = []
    parts = (("cycle", "per cycle"), ("impact", "per main impact"), ("free", "in a free arc"))
    for part, words in parts:
        row = [words]
        measured = [getattr(r.losses_measured, part) for r in c.results[0]]
        row += _mean_and_scatter(measured)
        for results in c.results:
            row += _mean_and_scatter([getattr(r.losses_model, part) for r in results])
        rows.append(row)
    columns = ["share of the energy lost (%)", "measured", "scatter"]
    for name in c.names:
        columns += [name, "scatter"]
    note = (
        "Means over the runs and standard deviations between them. Per impact and in a free arc the ledger itself is "
        f"sure to {100 * LEDGER_SHARE['impact']:.1f} points: what it gives too much to one is missing in the other."
    )
    return Table("Energy lost", columns, rows, note)


def _mean_and_scatter(values: list[float]) -> list[str]:
    known = 100.0 * np.array([v for v in values if math.isfinite(v)])
    if not len(known):
        return ["\u2013", "\u2013"]
    return [number(float(known.mean()), 2), number(float(known.std(ddof=1)), 2) if len(known) > 1 else "\u2013"]
