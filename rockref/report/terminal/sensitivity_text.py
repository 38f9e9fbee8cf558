"""A sensitivity study in words and tables, for a terminal and for pages."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rockref.model.parameters import TABLE_3_1
from rockref.report.tables.table import Table
from rockref.report.terminal.text import print_table
from rockref.studies.sensitivity_study import AXES

if TYPE_CHECKING:
    from rich.console import Console

FAMILIES = {
    "time_step": "time step",
    "last_digits": "±0.5 of the last digit, release angle kept",
    "release_angle": "release angle ±0.08°, first impacts laid over one another",
}


def print_sensitivity(console: Console, result: dict[str, Any]) -> None:
    """Print what a study found (`rockref.studies.sensitivity_study.record`)."""
    for sentence in sentences(result):
        console.print(sentence, highlight=False, markup=False)
    for table in (horizons_table(result), digits_table(result)):
        print_table(console, table)


def sentences(result: dict[str, Any]) -> list[str]:
    """Return how predictable the block is, in words."""
    g = result["growth"]
    factor, spread = g["factor_per_impact"], g["spread_factor"]
    said = [
        f"A small difference grows {factor:.3g} times from one main impact to the next (one standard deviation over "
        f"{g['runs']} differences: from {factor / spread:.2g} to {factor * spread:.3g}): {g['digits_per_impact']:.2f} "
        "decimal digits are lost at each impact."
    ]
    acting = [d["name"] for d in result["significant_digits"]]
    if left_out := [name for name in TABLE_3_1 if name not in acting]:
        said.append(f"Without digits, since they are zero or change nothing in this model: {', '.join(left_out)}.")
    if all(d["change_stated"] == 0 for d in result["significant_digits"]):
        said.append(
            "The block stays in its plane: the digits, which are read off the two other axes, say nothing of it."
        )
    return said


def horizons_table(result: dict[str, Any]) -> Table:
    """Return the table of times until which responses agree."""
    rows = []
    for name, words in FAMILIES.items():
        f = result["families"][name]
        for key, share in (("agree_to_0.1_until_s", "a tenth"), ("agree_to_0.5_until_s", "a half")):
            times = [f[key][axis] for axis in AXES]
            end = f"beyond {f['duration_s']:.1f}"
            rows.append([words, share, *(end if t is None else f"{t:.2f}" for t in times)])
    note = "RMS of the difference over 0.1 s, in parts of the RMS of the motion about the axis."
    columns = ("what is changed", "agree to", "main (s)", "transverse (s)", "longitudinal (s)")
    return Table("Until when responses agree", columns, rows, note)


def percent(change: float | None, places: int) -> str:
    """Return a change of the response as it is shown; None is infinite."""
    return "∞" if change is None else f"{100 * change:.{places}f} %"


def digits_table(result: dict[str, Any]) -> Table:
    """Return the significant digits of Table 3.1, as stated and by the definition."""
    rows = [
        [
            d["name"],
            f"{d['value']:.4g}",
            str(d["stated"]),
            percent(d["change_stated"], 0),
            str(d["found"]),
            percent(d["change"], 1),
        ]
        for d in result["significant_digits"]
    ]
    endless = any(None in (d["change_stated"], d["change"]) for d in result["significant_digits"])
    note = (
        "Change: of the response up to the second main impact when the value is off by half of its last digit, about "
        "the axis that changes more, transverse or longitudinal. Found: the fewest digits that change it by less than "
        "a tenth." + (" ∞: about an axis with no motion before, or the tilt is impossible." if endless else "")
    )
    columns = ("parameter", "value", "digits stated", "change", "digits found", "change")
    return Table("Significant digits of Table 3.1", columns, rows, note)
