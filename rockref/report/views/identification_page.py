"""The page of `rockref identify`: whether the model came down to the noise, and its parameters."""

from __future__ import annotations

from typing import Any

from rockref.report.html.page import Page
from rockref.report.terminal.identification_text import parameters_table, runs_table, sentences, terms_table
from rockref.report.views.card import Card, Fact


def identification_page(result: dict[str, Any]) -> Page:
    """Return the page of a record (`rockref.identify.outcome.record`)."""
    *rest, last = sentences(result)
    squares, search = result["least_squares"], result["search"]
    floor = squares["at_noise_floor"]
    excess = 100 * (squares["chi2"] ** 0.5 - 1)
    facts = [
        Fact("Error above the noise", f"{excess:.0f} %" if floor else f"{squares['chi2'] ** 0.5:.1f} times the noise"),
        Fact("Simulations", str(search["simulations"])),
        Fact(
            "Parameters that are determined", f"{sum(squares['determined'].values())} of {len(squares['determined'])}"
        ),
    ]
    held = [r["rms_over_noise"] for r in result["runs"] if r["use"] == "holdout"]
    if held:
        notes = ["the largest, up to the second main impact"]
        facts.insert(1, Fact("Held-out runs", f"{max(held):.2f} times the noise", notes))
    page = Page("The parameters of the law", last)
    name = "at the noise floor" if floor else "above the noise floor"
    then = (
        "Compare the model with all runs: rockref compare." if floor else "Look for a missing effect: rockref diagnose."
    )
    page.set_card(Card("identification", name, last, facts, next_step=then, next_label="Next"))
    page.add_section("In words", [*rest, last])
    page.add_section("Parameters")
    page.add_table(parameters_table(result))
    page.add_section("The cost")
    page.add_table(terms_table(result))
    page.add_section("Runs")
    page.add_table(runs_table(result))
    return page
