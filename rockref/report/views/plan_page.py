"""The page of `rockref plan`: what planned runs could show, and the run that would help most."""

from __future__ import annotations

from rockref.discover.plan import Plan
from rockref.report.html.page import Page
from rockref.report.terminal.plan_text import (
    confusion_table,
    counted,
    further_table,
    limit_lines,
    limits_table,
    sentences,
)
from rockref.report.views.card import Card, Fact


def plan_page(p: Plan) -> Page:
    """Return the page."""
    *rest, last = sentences(p)
    o, best = p.outlook, p.further[0]
    seen = len(o.effects) - len(o.undetectable())
    page = Page(f"What {counted(len(o.runs), 'planned run')} could show", last)
    facts = [
        Fact("Releases (tilt in rad)", ", ".join(map(str, o.runs)), ["t: the block turned by 180 degrees"]),
        Fact("Pairs not told apart", str(len(o.confused()))),
        Fact(
            "One more run", best["run"], [f"limits fall by {100 * (1 - 1 / best['limits_fall_by']):.0f} % in the mean"]
        ),
    ]
    page.set_card(Card("plan", f"{seen} of {len(o.effects)} effects would show", rest[0], facts, next_step=last))
    page.add_section("In words", rest)
    page.add_sentences([line.strip() for line in limit_lines(p)], "The effects that are hardest to see")
    page.add_section("Smallest sizes")
    page.add_table(limits_table(p))
    page.add_section("What would be confused")
    page.add_table(confusion_table(p))
    page.add_section("The next run")
    page.add_table(further_table(p))
    return page
