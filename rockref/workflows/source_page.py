"""The one page of `rockref reproduce`: the source's figures, tables and stated facts beside ours."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from rockref.model.parameters import TABLE_3_1
from rockref.report.html.page import Page
from rockref.report.tables.table import Table
from rockref.report.terminal import identification_text, sensitivity_text


def source_page(results: dict[str, Any], pictures: dict[str, bytes], provenance: dict[str, Any]) -> Page:
    """Return the page of the results by study, those that there are, and the pictures (PNG) by name."""
    page = Page("The source, reproduced", "The studies of the source made again with the law, beside what it states.")
    sections: dict[str, Callable[[Page, Any, dict[str, bytes]], None]] = {
        "response": _response,
        "sensitivity": _sensitivity,
        "identification": _identification,
        "twins": _twins,
        "reduction": _reduction,
        "scenarios": _scenarios,
    }
    for name, add in sections.items():
        if name in results:
            add(page, results[name], pictures)
    page.add_section("Where this comes from")
    page.add_provenance(provenance)
    return page


def _response(page: Page, result: dict[str, Any], pictures: dict[str, bytes]) -> None:
    page.add_section("The response of Table 3.1", "Released at 0.1170 rad, step 1e-5 s, compiled engine.")
    page.add_figure(
        pictures["figure_3_4_whole"], "Three rates and the contacts of each point; Housner's model in grey."
    )
    page.add_figure(pictures["figure_3_4_zooms"], "The same about the first impact, between two, and late.")
    page.add_table(facts_table(result["facts"]))


def facts_table(facts: Sequence[dict[str, Any]]) -> Table:
    """Return stated facts beside ours."""
    verdict = {True: "yes", False: "no", None: ""}
    rows = [[f["what"], f["stated"], f["ours"], verdict[f["agrees"]]] for f in facts]
    note = "A fact without a verdict is one for which the source gives no number, or of the experiment alone."
    return Table(
        "What the source states, and what the law gives", ("fact", "source", "here", "agrees"), rows, note, True
    )


def _sensitivity(page: Page, result: dict[str, Any], pictures: dict[str, bytes]) -> None:
    page.add_section("Sensitivity", sensitivity_text.sentences(result))
    for name, words in (
        ("figure_3_5_time_step", "Several time steps: the early motion is the same, the late one is not."),
        ("figure_3_6_last_digits", "Eleven parameters off by half of their last digit, at random."),
        ("figure_3_7_release_angle", "One millimetre of wire more or less shifts the response in time."),
        ("growth_of_differences", "How small differences of the release grow from arc to arc."),
    ):
        page.add_figure(pictures[name], words)
    page.add_table(sensitivity_text.horizons_table(result))
    page.add_table(sensitivity_text.digits_table(result))


def _identification(page: Page, result: dict[str, Any], pictures: dict[str, bytes]) -> None:
    page.add_section("Identification on the control experiment", identification_text.sentences(result))
    page.add_table(identification_text.parameters_table(result))
    page.add_table(identification_text.terms_table(result))
    page.add_table(identification_text.runs_table(result))


def _twins(page: Page, rows: Sequence[dict[str, Any]], pictures: dict[str, bytes]) -> None:
    floor = sum(row["at_floor"] for row in rows)
    page.add_section(
        "Twin experiments",
        f"Records made by Table 3.1 itself, with a tenth of the step and the noise of a gyroscope, {len(rows)} seeds. "
        f"{floor} of {len(rows)} fits end at the noise floor.",
    )
    page.add_figure(pictures["twins"], "Error of each parameter in units of the last digit of Table 3.1.")
    page.add_table(twins_table(rows))


def twins_table(rows: Sequence[dict[str, Any]]) -> Table:
    """Return a row a seed: error in last digits by parameter; in brackets what the data do not determine."""
    names = list(TABLE_3_1)
    body = []
    for row in rows:
        cells = []
        for name in names:
            p = row["parameters"][name]
            text = f"{p['off']:+.2f}"
            cells.append(text if p["determined"] else f"({text})")
        pairs = "; ".join(f"{a} / {b} {r:+.2f}" for a, b, r in row["trade_offs"][:4])
        floor = "yes" if row["at_floor"] else "no"
        body.append([str(row["seed"]), f"{row['chi2']:.3f}", f"{row['chi2_of_the_truth']:.3f}", floor, *cells, pairs])
    note = (
        "Found minus true in units of the last digit of Table 3.1; in brackets, where the fit says that the data do "
        "not determine it to half a digit, or has not reached the noise floor. Chi2: mean square of the residual over "
        "the noise, of the fit and of the true parameters, whose step is twice that of the record."
    )
    columns = ("seed", "chi2", "of the truth", "at floor", *names, "trade off")
    return Table("Twin experiments", columns, body, note)


def _reduction(page: Page, result: dict[str, Any], pictures: dict[str, bytes]) -> None:
    out = sum(g["comes_out"] for g in result["groups"])
    page.add_section(
        "From 54 genes to 12",
        f"{result['simulations']} simulations with 54 genes; cost {result['cost']:.3g}. Of the {len(result['groups'])} "
        f"groups that the source makes one number, {out} came out of this search by themselves.",
    )
    page.add_figure(pictures["reduction"], "Genes of the best chromosome by group; damping as ratio beta.")
    page.add_table(reduction_table(result))


def reduction_table(result: dict[str, Any]) -> Table:
    """Return the groups of the source's reduction, and how far they came out."""
    rows = [
        [
            g["group"],
            str(len(g["genes"])),
            f"{g['correlation']:+.2f}",
            f"{g['others']:.2f}",
            f"{g['spread']:.2f}",
            f"{g['chance']:.2f}",
            "yes" if g["comes_out"] else "no",
        ]
        for g in result["groups"]
    ]
    note = (
        "Correlation of the members' changes from generation to generation, mean; with the rest (absolute); spread of "
        "the last values in parts of the range, and of numbers drawn at random. It comes out where the spread is below "
        "half of chance and the members move together more than with the rest."
    )
    columns = ("group", "genes", "together", "with the rest", "spread", "chance", "comes out")
    return Table("The reduction (3.7) to (3.9)", columns, rows, note)


def _scenarios(page: Page, rows: Sequence[dict[str, Any]], pictures: dict[str, bytes]) -> None:
    page.add_section(
        "The models that failed",
        "Four contact points with each defect that the source's authors tried first, fitted with the same budget to a "
        "reference made by the eight-point model, which stands in the first row.",
    )
    page.add_figure(pictures["scenarios"], "The eight-point model and the best of the others at their best.")
    page.add_table(scenarios_table(rows))


def scenarios_table(rows: Sequence[dict[str, Any]]) -> Table:
    """Return the best error of each scenario, and whether it returns to the plane."""
    body = [
        [
            row["name"],
            str(row["genes"]),
            f"{row['cost']:.3f}",
            *(f"{v:.2f}" for v in row["rms_deg_s"]),
            "no" if row["quasi_2d_from"] is None else f"from {row['quasi_2d_from']:.1f} s",
        ]
        for row in rows
    ]
    columns = ("model", "genes", "best cost", "main (deg/s)", "transverse", "longitudinal", "returns to the plane")
    return Table("Best error with the same budget", columns, body, "Errors up to the second main impact, RMS.")
