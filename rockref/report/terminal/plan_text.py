"""A plan on the terminal: what would be hard to see, what would be confused, and the run that helps most, last."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rockref.discover.plan import Plan
from rockref.report.tables.spoken import spoken
from rockref.report.tables.table import Table, figures, table_of, with_unit
from rockref.report.terminal.text import print_table, say_all

if TYPE_CHECKING:
    from rich.console import Console

#: Limits that are shown without --full, those of the effects that are hardest to see, and confused pairs; decided: with
#: all else they fit twelve lines.
SHOWN, PAIRS = 4, 3


def print_plan(console: Console, p: Plan, full: bool = False) -> None:
    """Print a plan, the run that helps most last; with all tables where `full`."""
    *rest, last = sentences(p)
    if full:
        print_table(console, limits_table(p))
        print_table(console, confusion_table(p))
        print_table(console, further_table(p))
    brief = [] if full else [*limit_lines(p), *confusion_lines(p)]
    say_all(console, [*rest[:-1], *brief, rest[-1], last])


def sentences(p: Plan) -> list[str]:
    """Return the plan in a few sentences: what would show, repeats against varied releases, and the next run."""
    o, best, versus = p.outlook, p.further[0], p.comparison()
    unseen = o.undetectable()
    found = [
        f"{counted(len(o.runs), 'run')} ({', '.join(map(str, o.runs))}): "
        f"{len(o.effects) - len(unseen)} of {len(o.effects)} effects would show at three times their typical size or "
        "less."
    ]
    if unseen:
        found.append(f"These would not: {', '.join(unseen)}.")
    before, after = versus["confused_pairs"]
    most = max(versus["ratio_of_limits"], key=lambda id: versus["ratio_of_limits"][id])
    found.append(
        f"{len(p.varied.runs)} varied releases in place of {len(p.repeats.runs)} repeats of one: limits are lower by a "
        f"factor of {versus['median_ratio']:.1f} (median), {versus['ratio_of_limits'][most]:.1f} for {most}; "
        f"{counted(after, 'pair')} of effects would be confused, {before} with the repeats."
    )
    found.append(
        f"The run that would help most next: {best['run']} (tilt in rad, t: turned by 180 degrees). Limits fall by "
        f"{100 * (1 - 1 / best['limits_fall_by']):.0f} % in the mean, for {best['helps_most']} by "
        f"{100 * (1 - 1 / best['its_limit_falls_by']):.0f} %."
    )
    return found


def counted(number: int, noun: str) -> str:
    """Return a number with its noun, as "1 run" or "2 runs"."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def limit_lines(p: Plan) -> list[str]:
    """Return the smallest sizes that would be seen of the effects that are hardest to see."""
    ranked = sorted(p.outlook.limits.items(), key=lambda item: -item[1]["in_typical_sizes"])
    return [
        f"  {name} would be seen from {said_limit(name, limit)} on, {limit['in_typical_sizes']:.2g} times its typical "
        "size"
        for name, limit in ranked[:SHOWN]
    ]


def said_limit(name: str, limit: dict) -> str:
    """Return a limit in the unit in which a person thinks; a plain number as it is."""
    if limit["unit"] == "1":
        return figures(limit["limit"])
    return spoken(name, limit["limit"], None, None, limit["unit"]).size


def confusion_lines(p: Plan) -> list[str]:
    """Return in one line the pairs that these runs would hardly tell apart, worst first."""
    pairs = p.outlook.confused()
    if not pairs:
        return []
    more = f", and {len(pairs) - PAIRS} pairs more" if len(pairs) > PAIRS else ""
    return [f"Not told apart: {', '.join(f'{a} and {b}' for a, b, _ in pairs[:PAIRS])}{more}."]


def limits_table(p: Plan) -> Table:
    """Return smallest amplitude that would be seen, effect by effect, with repeats and with varied releases."""
    rows = []
    for name, limit in p.outlook.limits.items():
        unit = with_unit(limit["unit"])
        typical = limit["in_typical_sizes"]
        others = [o.limits[name]["in_typical_sizes"] for o in (p.repeats, p.varied)]
        rows.append([name, f"{limit['limit']:.3g} {unit}".strip(), *(f"{v:.2g}" for v in (typical, *others))])
    columns = ("number", "limit", "typical sizes", "as repeats", "as varied")
    return Table("Smallest amplitude that would be seen", columns, rows, "The last columns in typical sizes, too.")


def confusion_table(p: Plan) -> Table:
    """Return pairs that would not be told apart."""
    rows = [[a, b, f"{c:.3f}"] for a, b, c in p.outlook.confused()]
    return Table("Not told apart by these runs", ("effect", "and", "cosine"), rows)


def further_table(p: Plan) -> Table:
    """Return what one more run would bring."""
    columns = {
        "one more run": lambda f: f["run"] + (" (a repeat)" if f["repeat"] else ""),
        "limits fall by": lambda f: f"{f['limits_fall_by']:.2f}",
        "most for": lambda f: f["helps_most"],
        "by": lambda f: f"{f['its_limit_falls_by']:.2f}",
        "pairs confused then": lambda f: str(f["confused_pairs"]),
    }
    return table_of(p.further, "The next run", columns, "A trailing t: the block turned by half a turn.")
