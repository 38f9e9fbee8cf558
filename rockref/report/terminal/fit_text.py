"""A fit on the terminal: numbers with intervals, the gates, and the outcome last."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from rockref.discover.evidence.evidence import Number
from rockref.discover.fit_baseline import BaselineFit
from rockref.discover.fit_gates import Gate
from rockref.report.tables.spoken import spoken
from rockref.report.tables.table import Table, figures, with_unit
from rockref.report.terminal.text import print_table, say, say_all

if TYPE_CHECKING:
    from rich.console import Console

#: Numbers of the law that stand on one line.
LINES = (
    ("stiffness", ("K_N", "K_T")),
    ("damping ratios", ("beta_int", "beta_ext")),
    ("friction", ("mu_int", "mu_ext")),
    ("heights", ("delta_long_1", "delta_long_2")),
    ("", ("delta_long_3", "delta_long_4")),
    ("inner points", ("delta_diag",)),
)
#: The outcome of a fit in a sentence.
OUTCOMES = {
    "trustworthy": "Trustworthy: all gates are passed.",
    "effect_missing": "An effect is missing: run rockref diagnose.",
    "not_trustworthy": "Not trustworthy: a gate was not passed.",
    "not_checked": "The gates were not checked.",
}


def with_interval(name: str, n: Number) -> str:
    """Return a number with its 90 % interval in words."""
    said = f"{name} {figures(n.value, 4)} ({figures(n.low, 4)} to {figures(n.high, 4)}) {with_unit(n.unit)}"
    return said.rstrip()


def law_lines(law: Mapping[str, Number]) -> list[str]:
    """Return the numbers of the law, a few on each line."""
    found = []
    for words, names in LINES:
        there = [with_interval(name, law[name]) for name in names if name in law]
        if there:
            found.append(f"  {words:15}{', '.join(there)}")
    return found


def effect_lines(numbers: Mapping[str, Number]) -> list[str]:
    """Return the numbers of effects that all runs share, one on a line."""
    return [f"  {name} = {said(name, n)}" for name, n in numbers.items() if "[" not in name]


def said(name: str, n: Number) -> str:
    """Return a number of an effect with its interval, in the unit in which a person thinks."""
    return str(spoken(name, n.value, n.low, n.high, n.unit))


def estimates_table(found: Mapping[str, Number]) -> Table:
    """Return numbers with 90 % intervals as a table."""
    rows = [
        [name, figures(n.value, 4), figures(n.low, 4), figures(n.high, 4), with_unit(n.unit), f"{n.z:+.2f}"]
        for name, n in found.items()
    ]
    note = "Intervals of 90 %. Last column: distance from the centre of the prior, in its standard deviations."
    return Table("Parameters", ("parameter", "value", "low", "high", "unit", "in priors"), rows, note)


def gates_table(checks: list[Gate]) -> Table:
    """Return the gates, each with what was found and what is allowed."""
    rows = [[g.name, "passed" if g.passed else "FAILED", g.sentence] for g in checks]
    return Table("Gates", ("gate", "", "what was found"), rows, prose=True)


def outcome_lines(found: BaselineFit) -> list[str]:
    """Return the failed gates, the error, and the outcome."""
    said = [f"{gate.name}: {gate.sentence}" for gate in found.gates if not gate.passed]
    error = found.evidence.error["total"]
    said.append(
        f"Error on the fit runs: {error:.3f} deg/s RMS, {100 * (error / found.noise - 1):.0f} % above the noise of "
        f"{found.noise:.3f} deg/s."
    )
    outcome = OUTCOMES[found.outcome]
    if found.run:
        outcome = f"Not trustworthy: run {found.run} contradicts the others. Check its tilt, side and clock."
    return [*said, outcome]


def print_fit(console: Console, found: BaselineFit, full: bool = False) -> None:
    """Print a fit, the outcome last; with tables of all numbers and gates where `full`."""
    with_effects = f" with {', '.join(found.effects)}" if found.effects else ""
    kept = ", from a kept fit" if found.from_store else ""
    say(console, f"{found.experiment.name}: baseline{with_effects}, {found.seconds:.0f} s{kept}.")
    if full:
        print_table(console, estimates_table({**found.evidence.law, **found.evidence.numbers}))
        if found.gates:
            print_table(console, gates_table(found.gates))
    else:
        say_all(console, [*law_lines(found.evidence.law), *effect_lines(found.evidence.numbers)], None)
    say_all(console, outcome_lines(found))
