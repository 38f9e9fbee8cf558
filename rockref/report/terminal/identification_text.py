"""An identification in words and tables, for a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.model.parameters import TABLE_3_1
from rockref.report.tables.table import Table, table_of
from rockref.report.terminal.text import print_table, say_all

if TYPE_CHECKING:
    from rich.console import Console

#: Parameters that are listed without --full, how many on a line, and pairs of them; decided: all fits twelve lines.
LISTED, ON_A_LINE, TRADE_OFFS = 12, 3, 3


def print_identification(console: Console, result: dict[str, Any], full: bool = False) -> None:
    """Print what an identification found (`rockref.identify.outcome.record`), the error last; tables where `full`."""
    if full:
        for table in (parameters_table(result), terms_table(result), runs_table(result)):
            print_table(console, table)
    else:
        say_all(console, parameter_lines(result), None)
    say_all(console, sentences(result))


def sentences(result: dict[str, Any]) -> list[str]:
    """Return what was found, in words; the outcome last."""
    search, squares = result["search"], result["least_squares"]
    text = [f"{search['simulations']} simulations brought the cost to {search['cost']:.4g}."]
    unknown = [name for name, known in squares["determined"].items() if not known]
    if squares["at_noise_floor"] and unknown:
        text.append(f"Not determined within half the last digit of Table 3.1: {', '.join(unknown)}.")
    pairs = [f"{a} and {b} (correlation {r:+.2f})" for a, b, r in squares["trade_offs"][:TRADE_OFFS]]
    if pairs:
        text.append(f"Numbers that trade off: {'; '.join(pairs)}.")
    if squares["at_noise_floor"]:
        held = [run["rms_over_noise"] for run in result["runs"] if run["use"] == "holdout"]
        on_held = f", at most {100 * (max(held) - 1):.0f} % on a held-out run" if held else ""
        text.append(
            f"The model is at the noise floor: its error is {100 * (squares['chi2'] ** 0.5 - 1):.0f} % above the "
            f"noise{on_held}."
        )
    else:
        text.append(
            f"The model is above the noise floor (mean square of the residual over the noise: {squares['chi2']:.3g}). "
            "Nothing is determined: this is a wrong valley, or the model lacks something."
        )
    return text


def parameter_lines(result: dict[str, Any]) -> list[str]:
    """Return the values with their errors, a few on each line."""
    squares = result["least_squares"]
    found = []
    for name, value in list(squares["values"].items())[:LISTED]:
        given, error = TABLE_3_1.get(name), squares["errors"].get(name)
        unit = f" {given.unit}" if given and given.unit not in ("", "1") else ""
        found.append(f"{name} {value:.4g}{'' if error is None else f' ± {error:.2g}'}{unit}")
    lines = [f"  {', '.join(found[k : k + ON_A_LINE])}" for k in range(0, len(found), ON_A_LINE)]
    left = len(squares["values"]) - LISTED
    return lines + ([f"  and {left} more, with --full"] if left > 0 else [])


def parameters_table(result: dict[str, Any]) -> Table:
    """Return values with errors, beside Table 3.1."""
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
    """Return the terms of the cost at the end of the search, with their weights."""
    search = result["search"]
    runs = list(search["terms"])
    rows = [
        [term.replace("_", " "), f"{weight:g}", *(f"{search['terms'][run][term]:.3g}" for run in runs)]
        for term, weight in search["weights"].items()
        if all(search["terms"].values())
    ]
    return Table("Cost after the search, term by term", ("term", "weight", *(f"run {r}" for r in runs)), rows)


def runs_table(result: dict[str, Any]) -> Table:
    """Return every run up to its second main impact."""
    columns = {
        "run": lambda r: r["run"],
        "use": lambda r: r["use"],
        "tilt (rad)": lambda r: f"{r['release_tilt_rad']:.5f}",
        "main (deg/s)": lambda r: f"{r['rms_deg_s'][0]:.3f}",
        "transverse": lambda r: f"{r['rms_deg_s'][1]:.3f}",
        "longitudinal": lambda r: f"{r['rms_deg_s'][2]:.3f}",
        "over noise": lambda r: f"{r['rms_over_noise']:.2f}",
        "tilt as stated": lambda r: f"{r['rms_over_noise_as_stated']:.2f}",
    }
    note = "RMS of model minus measured up to the second main impact; 1 is the noise floor."
    return table_of(result["runs"], "Runs", columns, note)
