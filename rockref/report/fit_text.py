"""A fit on the terminal: parameters with intervals, and the gates."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rockref.discover.fit.fitted import Estimate
from rockref.discover.fit.gates import Gate
from rockref.discover.fitting import Fitted
from rockref.report.page import Table
from rockref.report.text import print_table

if TYPE_CHECKING:
    from rich.console import Console


def quantity(value: float) -> str:
    """A number with four figures, as people write it."""
    size = abs(value)
    return f"{value:.4g}" if size == 0 or 1e-3 <= size < 1e5 else f"{value:.3e}"


def estimates_table(found: list[Estimate]) -> Table:
    """Numbers found, with 90 % intervals."""
    rows = [
        [e.name, quantity(e.value), quantity(e.low), quantity(e.high), "" if e.unit == "1" else e.unit, f"{e.z:+.2f}"]
        for e in found
    ]
    note = "Intervals of 90 %. Last column: distance from the centre of the prior, in its standard deviations."
    return Table("Parameters", ("parameter", "value", "low", "high", "unit", "in priors"), rows, note)


def gates_table(checks: list[Gate]) -> Table:
    """The gates, each with what was found and what is allowed."""
    rows = [[g.name, "passed" if g.passed else "FAILED", g.sentence] for g in checks]
    return Table("Gates", ("gate", "", "what was found"), rows, prose=True)


def print_fit(console: Console, found: Fitted) -> None:
    """Print a fit: parameters, gates, and how large the error is against the noise."""
    with_effects = f" with {', '.join(found.effects)}" if found.effects else ""
    console.print(
        f"{found.experiment.name}: baseline{with_effects}, {found.errors.total:.3f} deg/s RMS on the fit runs; "
        f"noise floor {found.errors.noise:.3f}.",
        markup=False, highlight=False, soft_wrap=True,
    )  # fmt: skip
    print_table(console, estimates_table(found.estimates))
    if found.gates:
        print_table(console, gates_table(found.gates))
        if not found.passed:
            console.print("Not trustworthy: a gate was not passed.", style="bold", markup=False)
