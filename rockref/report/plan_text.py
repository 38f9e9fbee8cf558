"""A plan on the terminal: limits, confusion, the next run, repeats against varied releases."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rockref.discover.plan import Plan
from rockref.report.page import Table
from rockref.report.text import print_table

if TYPE_CHECKING:
    from rich.console import Console


def print_plan(console: Console, p: Plan) -> None:
    """Print a plan."""
    for line in sentences(p):
        console.print(line, markup=False, highlight=False, soft_wrap=True)
    print_table(console, limits_table(p))
    print_table(console, confusion_table(p))
    print_table(console, further_table(p))


def sentences(p: Plan) -> list[str]:
    """The plan in a few sentences."""
    o, best, versus = p.outlook, p.further[0], p.comparison()
    unseen = o.undetectable()
    found = [
        f"{len(o.runs)} runs ({', '.join(map(str, o.runs))}): {len(o.effects) - len(unseen)} of {len(o.effects)} "
        f"effects would show at three times their typical size or less."
    ]
    if unseen:
        found.append(f"Not even so: {', '.join(unseen)}.")
    found.append(
        f"The run that would help most next: {best['run']}; limits fall by a factor of {best['limits_fall_by']:.2f} in "
        f"the mean, for {best['helps_most']} by {best['its_limit_falls_by']:.1f}."
    )
    most = max(versus["ratio_of_limits"], key=lambda id: versus["ratio_of_limits"][id])
    found.append(
        f"{len(p.varied.runs)} varied releases against {len(p.repeats.runs)} repeats of one: limits are lower by a "
        f"factor of {versus['median_ratio']:.1f} (median), {versus['ratio_of_limits'][most]:.1f} for {most}; "
        f"{versus['confused_pairs'][1]} against {versus['confused_pairs'][0]} pairs stay confused."
    )
    return found


def limits_table(p: Plan) -> Table:
    """Smallest amplitude that would be seen, effect by effect, with repeats and with varied releases."""
    rows = []
    for name, limit in p.outlook.limits.items():
        unit = "" if limit["unit"] == "1" else limit["unit"]
        typical = limit["in_typical_sizes"]
        others = [o.limits[name]["in_typical_sizes"] for o in (p.repeats, p.varied)]
        rows.append([name, f"{limit['limit']:.3g} {unit}".strip(), *(f"{v:.2g}" for v in (typical, *others))])
    columns = ("number", "limit", "typical sizes", "as repeats", "as varied")
    return Table("Smallest amplitude that would be seen", columns, rows, "The last columns in typical sizes, too.")


def confusion_table(p: Plan) -> Table:
    """Pairs that would not be told apart."""
    rows = [[a, b, f"{c:.3f}"] for a, b, c in p.outlook.confused()]
    return Table("Not told apart by these runs", ("effect", "and", "cosine"), rows)


def further_table(p: Plan) -> Table:
    """What one more run would bring."""
    rows = [
        [
            f["run"] + (" (a repeat)" if f["repeat"] else ""),
            f"{f['limits_fall_by']:.2f}",
            f["helps_most"],
            f"{f['its_limit_falls_by']:.2f}",
            str(f["confused_pairs"]),
        ]
        for f in p.further
    ]
    columns = ("one more run", "limits fall by", "most for", "by", "pairs confused then")
    return Table("The next run", columns, rows, "A trailing t: the block turned by half a turn.")
