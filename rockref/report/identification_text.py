"""An identification in words and tables, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.model.parameters import TABLE_3_1
from rockref.report.page import Table
from rockref.report.text import print_table

if TYPE_CHECKING:
    from rich.console import Console


def print_identification(console: Console, result: dict[str, Any]) -> None:
    """Print what an identification found (`rockref.identify.outcome.record`)."""
    for sentence in sentences(result):
        console.print(sentence, highlight=False, markup=False)
    for table in (parameters_table(result), terms_table(result), runs_table(result)):
        print_table(console, table)


def sentences(result: dict[str, Any]) -> list[str]:
    """What was found, in words."""
    search, squares = result["search"], result["least_squares"]
    floor = "at the noise floor" if squares["at_noise_floor"] else "above the noise floor"
    text = [
        f"{search['simulations']} simulations brought the cost to {search['cost']:.4g}; least squares end {floor} "
        f"(mean square of the residual over the noise: {squares['chi2']:.3g})."
    ]
    unknown = [name for name, known in squares["determined"].items() if not known]
    if not squares["at_noise_floor"]:
        text.append(
            "Above the noise floor nothing is determined: this is a wrong valley, or the model lacks something."
        )
    elif unknown:
        text.append(f"Not determined within half the last digit of Table 3.1: {', '.join(unknown)}.")
    for a, b, r in squares["trade_offs"][:6]:
        text.append(f"{a} and {b} trade off (correlation {r:+.2f}).")
    return text


def parameters_table(result: dict[str, Any]) -> Table:
    """Values with errors, beside Table 3.1."""
    squares, rows = result["least_squares"], []
    for name, value in squares["values"].items():
        of_runs = [e for n, e in squares["errors"].items() if n.startswith(f"{name} of")]
        error = squares["errors"].get(name, max(of_runs) if of_runs else float("nan"))
        given = TABLE_3_1.get(name)
        stated = f"{given.value:.4g}" if given else ""
        in_digits = f"{error / given.precision:.2g}" if given else ""
        rows.append([name, f"{value:.5g}", f"{error:.2g}", in_digits, stated, given.unit if given else ""])
    columns = ("parameter", "found", "error", "in last digits", "Table 3.1", "unit")
    return Table("Parameters", columns, rows)


def terms_table(result: dict[str, Any]) -> Table:
    """The terms of the cost at the end of the search, with their weights."""
    search = result["search"]
    runs = list(search["terms"])
    rows = [
        [term.replace("_", " "), f"{weight:g}", *(f"{search['terms'][run][term]:.3g}" for run in runs)]
        for term, weight in search["weights"].items()
        if all(search["terms"].values())
    ]
    return Table("Cost after the search, term by term", ("term", "weight", *(f"run {r}" for r in runs)), rows)


def runs_table(result: dict[str, Any]) -> Table:
    """Every run up to its second main impact."""
    rows = [
        [
            r["run"],
            r["use"],
            f"{r['release_tilt_rad']:.5f}",
            *(f"{v:.3f}" for v in r["rms_deg_s"]),
            f"{r['rms_over_noise']:.2f}",
            f"{r['rms_over_noise_as_stated']:.2f}",
        ]
        for r in result["runs"]
    ]
    columns = ("run", "use", "tilt (rad)", "main (deg/s)", "transverse", "longitudinal", "over noise", "tilt as stated")
    note = "Quadratic means of model minus measured up to the second main impact; 1 is the noise floor."
    return Table("Runs", columns, rows, note)
