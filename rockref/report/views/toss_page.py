"""Tosses on a page: tables, and pictures of where models fail and how the error falls."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rockref.discover.tosses.compare import PUBLISHED
from rockref.discover.tosses.diagnose import sentences
from rockref.model.storage import write_bytes
from rockref.report.charts.figures import rendered
from rockref.report.html.page import Page
from rockref.report.output import made_folder
from rockref.report.tables.table import Table
from rockref.report.terminal import toss_text

INK, SECOND, PALE = "#1f4e79", "#c05a00", "#9aa5b1"
#: Dots an inch of the pictures; decided: ten inches make 1100, as wide as the page is read, and a tenth of a megabyte.
DPI = 110


def write_toss_comparison(record: dict[str, Any], folder: Path) -> Path:
    """Write ``index.html`` for a comparison; returns its path."""
    page = Page(f"Tosses: {record['experiment']}", "Models beside measured tosses of a rigid block.")
    page.add_section("How far off")
    page.add_table(toss_text.errors_table(record))
    page.add_section("Where")
    add_stretches(page, [r for r in record["rows"] if r["start"] == "flight"])
    page.add_section("What the tosses say by themselves")
    page.add_table(toss_text.measured_table(record["measured"]))
    page.add_provenance({"experiment": record["experiment"], "sha256 of the table": record["sha256"]})
    return page.write_into(folder)


def write_toss_diagnosis(record: dict[str, Any], folder: Path) -> Path:
    """Write ``index.html`` and ``staircase.png`` for a diagnosis; returns the page's path."""
    page = Page(f"What is missing: {record['experiment']}", record["sentence"])
    add_diagnosis(page, record)
    write_bytes(made_folder(folder) / "staircase.png", staircase_picture(record))
    page.add_provenance({"experiment": record["experiment"], "sha256 of the table": record["sha256"]})
    return page.write_into(folder)


def add_diagnosis(page: Page, record: dict[str, Any]) -> None:
    """Add the sections of a diagnosis."""
    page.add_section(
        "The staircase",
        "All effects were fitted together, and what is not needed was taken away, the least needed first. Seen from "
        "below each step adds one; the numbers of all the others were fitted anew with it.",
    )
    page.add_figure(
        staircase_picture(record),
        "Held-out error after each added effect; the dashed line is the floor that the starts' uncertainty sets.",
    )
    page.add_table(toss_text.staircase_table(record))
    said = sentences()
    page.add_sentences([f"{s['added']}: {said[s['added']]}" for s in record["staircase"] if s["added"] in said])
    page.add_section(
        "Two ways to one number",
        "The fit sees impacts through a contact model; flight arcs and the balance of momenta need none.",
    )
    page.add_table(toss_text.agreement_table(record))
    page.add_table(toss_text.measured_table(record["measured_without_contact_model"]))
    page.add_section(
        "What these tosses can tell",
        "Cosines near one: what one effect does to these tosses the other can do too, the law's numbers moving along.",
    )
    if record["confusion"]:
        page.add_table(toss_text.confusion_table(record))
    page.add_table(toss_text.gates_table(record))
    page.add_section("The numbers")
    last = record["staircase"][-1]
    rows = tuple((k, f"{v['value']:.5g}", v["unit"]) for k, v in last["parameters"].items())
    page.add_table(Table("Parameters of the last step", ("parameter", "value", "unit"), rows))


def add_stretches(page: Page, rows: list[dict[str, Any]]) -> None:
    """Add where the errors of some rows of comparisons grow: a picture of the last use among them, and every table."""
    use = rows[-1]["use"]
    page.add_figure(
        stretches_picture([row for row in rows if row["use"] == use]),
        "How much the mean error grows over each part of a toss, and how much of its energy the toss loses there; "
        f"{use} tosses, start from the flight.",
    )
    for row in rows:
        page.add_table(toss_text.stretches_table(row))
    page.add_table(toss_text.sliding_table([row for row in rows if row["use"] == use]))


def stretches_picture(rows: list[dict[str, Any]]) -> bytes:
    """Return PNG: bars by stretch of the growth of the errors and of the energy lost; one colour a model, measured in
    grey."""
    names = [s["stretch"] for s in rows[0]["stretches"]]
    bars: list[list[tuple[str, str, list[float]]]] = [[], [], []]
    for row, color in zip(rows, (SECOND, INK, "#5b8c5a", "#7a4e8a"), strict=False):
        for part, key in zip(bars, ("position_percent", "rotation_deg"), strict=False):
            part.append((row["model"], color, [s["growth"][key] for s in row["stretches"]]))
        bars[2].append((row["model"], color, [s["energy_lost"]["model_percent"] for s in row["stretches"]]))
    bars[2].insert(0, ("measured", PALE, [s["energy_lost"]["measured_percent"] for s in rows[-1]["stretches"]]))
    figure, axes = _panels(3, 10, 1.2 + 0.35 * len(names))
    labels = (
        "position error grows by, % of width",
        "rotation error grows by, deg",
        "energy lost, % of all that is lost",
    )
    for axis, part, label in zip(axes, bars, labels, strict=True):
        thick = 0.8 / len(part)
        for k, (name, color, values) in enumerate(part):
            at = [i + (k - (len(part) - 1) / 2) * thick for i in range(len(names))]
            axis.barh(at, values, thick, color=color, label=name)
        axis.set_yticks(range(len(names)), names, fontsize=8)
        axis.set_xlabel(label, fontsize=9)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    axes[0].invert_yaxis()
    figure.legend(
        *axes[2].get_legend_handles_labels(), loc="outside upper center", ncols=len(bars[2]), frameon=False, fontsize=8
    )
    return rendered(figure, "png", DPI)


def _panels(count: int, width: float, height: float) -> tuple[Any, Any]:
    """Return a figure [inches] with panels side by side over one ordinate; no window system is asked for."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    return figure, figure.subplots(1, count, sharey=True)


def staircase_picture(record: dict[str, Any]) -> bytes:
    """Return PNG: mean position and rotation error on the held-out tosses, from both starts, over the added effects."""
    steps = record["staircase"]
    names = ["stated values", "contact fitted"] + ["+ " + s["added"].replace("_", " ") for s in steps[1:]]
    rows = range(len(names))
    figure, axes = _panels(2, 10, 1.6 + 0.28 * len(names))
    labels = ("position error, % of width", "rotation error, deg")
    for k, (axis, key, unit) in enumerate(zip(axes, ("position_percent", "rotation_deg"), labels, strict=True)):
        for start, color, mark in (("raw", PALE, "s"), ("flight", INK, "o")):
            x = [record["nominal_holdout"][start][key]["mean"]] + [s["holdout"][start][key]["mean"] for s in steps]
            axis.plot(x, rows, mark + "-", color=color, label=f"start: {start}")
        axis.axvline(record["floor"][key], color=INK, ls="--", lw=1, label="floor of the starts")
        axis.axvline(min(v[2 * k] for v in PUBLISHED.values()), color=SECOND, lw=1, label="best published (raw)")
        axis.set_yticks(rows, names, fontsize=8)
        axis.set_xlabel(unit)
        axis.set_xlim(left=0)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
    axes[0].invert_yaxis()
    figure.legend(*axes[0].get_legend_handles_labels(), loc="outside upper center", ncols=4, frameon=False, fontsize=8)
    return rendered(figure, "png", DPI)
