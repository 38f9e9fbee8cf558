"""`rockref reproduce earthquake`: the calibrated block beside its symmetric twin in earthquakes, on one page."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from rockref.jobs.folder_lock import alone_in
from rockref.model.problem import GRAVITY
from rockref.model.storage import write_text
from rockref.report.charts import style
from rockref.report.charts.figures import new_figure, rendered
from rockref.report.html.page import Page
from rockref.report.output import made_folder, usable_folder
from rockref.report.tables.table import Table
from rockref.report.terminal.shaken_text import interval
from rockref.report.views.shaken_page import DPI
from rockref.shake import defects
from rockref.shake.statistics.campaign import least_difference

#: What the authors state; the number of their levels and their signals are not public.
STATED = (
    "The authors state: under 2000 artificial bidirectional signals the imperfections slightly increase the "
    "probabilities of rocking and of overturning, in a narrow range of peak ground acceleration (MATEC Web of "
    "Conferences 24, 09004, 2015)."
)
#: Signals of a study that goes through once, with a step at which shares are rough.
QUICK = 20, 4e-5


def reproduce_earthquake(
    folder: Path, signals: int | None, step: float | None, quick: bool, workers: int | None, say: Callable[[str], None]
) -> Path:
    """Make the study in `folder` and return its page; what is done is kept there.

    signals : in all, by default the authors' 2000;  step [s], by default the source's

    Raises InputError: E-WRITE, E-BUSY, E-ENSEMBLE.
    """
    usable_folder(folder)
    number, length = signals or (QUICK[0] if quick else defects.SIGNALS), step or (QUICK[1] if quick else defects.STEP)
    with alone_in(made_folder(folder)):
        found = defects.study(folder, number, length, workers, say)
        record = found.to_dict()
        write_text(folder / "earthquake.json", json.dumps(record, indent=1) + "\n")
        page = Page("Defects of the feet in an earthquake", " ".join(sentences(found)))
        page.add_section("Side by side", [STATED])
        page.add_figure(
            rendered(levels_figure(found), "png", DPI),
            "Share that fell over PGA with its Wilson interval, and below it the difference with its interval.",
        )
        page.add_table(levels_table(found))
        page.add_section("How", how(found))
        page.add_provenance({"signals": sum(a.signals for a in found.levels), "step_s": found.step})
        return page.write_into(folder)


def sentences(found: defects.Defects) -> list[str]:
    """Return the answer in sentences."""
    signals, (one, other), fell = sum(a.signals for a in found.levels), found.discordant, found.fell_more
    answer = "A difference in falls is not shown."
    if fell.low > 0 or fell.high < 0:
        answer = f"The calibrated block falls {'more' if fell.low > 0 else 'less'} often than its symmetric twin."
    said = [
        f"{answer} Over {signals} signals the share that falls, calibrated less symmetric, is "
        f"{interval(vars(fell), '+')}, and the share that rocks {interval(vars(found.rocked_more), '+')}."
    ]
    said.append(f"In {one} signals only the calibrated block fell, in {other} only the symmetric one.")
    told = [f"{a.pga:g}" for a in found.levels if a.fell_more.low > 0 or a.fell_more.high < 0]
    where = f"at {', '.join(told)} m/s2" if told else "at no level"
    said.append(
        f"Taken alone, the difference in falls is told from zero {where}. Of ten intervals of 95 % one or more miss "
        "zero by chance in four cases of ten."
    )
    return said


def how(found: defects.Defects) -> list[str]:
    """Return what was computed, in sentences."""
    each = found.levels[0].signals
    return [
        f"Both blocks stand on the plate of each signal, at a step of {found.step:g} s; a block has rocked where it "
        f"tilted by more than {np.degrees(defects.ROCKED):.2f} degrees, a tenth of the angle of balance, and has "
        "fallen beyond 45 degrees. The twin has its four feet at the mean height of the calibrated ones.",
        f"A signal is noise of Kanai and Tajimi (2.5 Hz, damping 0.6, no slow motion below {defects.LOW_CUT:g} Hz), "
        f"independent along x and y, that rises for {defects.RISE:g} s, is strong for {defects.STRONG:g} s and decays; "
        "it is scaled to the PGA of its level. Signals differ from level to level and are the same for both "
        "blocks. The authors' own spectrum, length and levels are not public.",
        f"Intervals of 95 %: Wilson's of a share, Bonett and Price's of a difference of paired shares. Unpaired, "
        f"{each} signals a level would see a difference of {least_difference(0.5, each):.2f} beside one half.",
    ]


def levels_table(found: defects.Defects) -> Table:
    """Return counts of both blocks and the paired differences, level by level."""
    rows = [
        [
            f"{a.pga:.2f}", f"{a.pga / GRAVITY:.3f}", str(a.signals), f"{a.fell[0]}, {a.fell[1]}",
            interval(vars(a.fell_more), "+"), f"{a.rocked[0]}, {a.rocked[1]}", interval(vars(a.rocked_more), "+"),
        ]
        for a in found.levels
    ]  # fmt: skip
    head = ("PGA (m/s2)", "(g)", "signals", "fell", "difference", "rocked", "difference")
    return Table("Calibrated, symmetric", head, rows, "Difference of shares, calibrated less symmetric.")


def levels_figure(found: defects.Defects) -> Any:
    """Draw the shares that fell and their differences over PGA."""
    figure = new_figure(7.0, 5.6)
    shares, below = figure.subplots(2, 1, sharex=True, height_ratios=[1.5, 1.0])
    pga = np.array([a.pga for a in found.levels])
    for k, name in enumerate(defects.NAMES):
        share = np.array([a.fell[k] / a.signals for a in found.levels])
        ends = np.array([a.to_dict()["fell_interval"][k] for a in found.levels])
        # Bands and not bars: bars beside one another would shift the curves, and a shift is what is looked for.
        shares.fill_between(pga, *ends.T, color=style.colour(k), alpha=0.2, lw=0)
        shares.plot(pga, share, "os"[k] + "-", ms=4, lw=0.9, color=style.colour(k), label=name)
    shares.set_ylabel("share that fell")
    shares.set_ylim(-0.03, 1.03)
    shares.legend(loc="upper left", frameon=False, fontsize=8)
    more = np.array([[a.fell_more.mean, a.fell_more.low, a.fell_more.high] for a in found.levels])
    below.errorbar(pga, more[:, 0], np.abs(more[:, 1:] - more[:, :1]).T, fmt="o", ms=4, lw=0.9, color=style.INK)
    below.axhline(0.0, color=style.GREY, lw=0.8)
    below.set_ylabel("calibrated less symmetric")
    below.set_xlabel("PGA (m/s2)")
    return figure
