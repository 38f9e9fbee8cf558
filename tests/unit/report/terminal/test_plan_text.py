"""A plan in words and tables says what its record says."""

import pytest

from rockref.report.terminal.plan_text import counted, print_plan, sentences
from tests.printed import printed
from tests.unit.discover import fakes


@pytest.fixture(scope="module")
def plan():
    return fakes.planned()


@pytest.fixture(scope="module")
def shown(plan):
    return printed(print_plan, plan, True, width=400)


def test_the_next_run_is_the_first_of_the_record(plan, shown):
    best = plan.to_dict()["further_runs"][0]
    assert f"The run that would help most next: {best['run']} (tilt" in shown
    assert f"for {best['helps_most']} by {100 * (1 - 1 / best['its_limit_falls_by']):.0f} %." in shown
    assert "0.117 (a repeat)" in shown and "0.117t" in shown


def test_every_limit_is_there_with_its_unit_and_size(plan, shown):
    limits = plan.to_dict()["limits"]
    assert set(limits) == {"viscous_friction.c", "rolling_resistance.lever"}
    for name, limit in limits.items():
        (row,) = [line for line in shown.splitlines() if line.startswith(name)]
        assert f"{limit['limit']:.3g} {limit['unit']}" in row and f"{limit['in_typical_sizes']:.2g}" in row


def test_what_is_confused_or_unseen_is_said(plan, shown):
    found = plan.to_dict()
    assert [p["effects"] for p in found["confused"]] == [["viscous_friction", "rolling_resistance"]]
    (row,) = [line for line in shown.splitlines() if line.startswith("viscous_friction ")]
    assert row.split() == ["viscous_friction", "rolling_resistance", f"{found['confused'][0]['cosine']:.3f}"]
    unseen = found["undetectable"]
    seen = len(plan.outlook.effects) - len(unseen)
    assert f"{seen} of 2 effects would show" in shown
    assert ("These would not: " + ", ".join(unseen) in shown) == bool(unseen)


def test_repeats_are_set_against_varied_releases(plan, shown):
    versus = plan.to_dict()["repeats_against_varied"]
    assert f"lower by a factor of {versus['median_ratio']:.1f} (median)" in shown
    with_repeats, varied = versus["confused_pairs"]
    assert f"{counted(varied, 'pair')} of effects would be confused, {with_repeats} with the repeats." in shown


def test_effects_that_would_not_show_are_named(plan, monkeypatch):
    monkeypatch.setattr(type(plan.outlook), "undetectable", lambda self: ["rolling_resistance"])
    first, second, *_ = sentences(plan)
    assert "1 of 2 effects would show" in first
    assert second == "These would not: rolling_resistance."
    monkeypatch.setattr(type(plan.outlook), "undetectable", lambda self: [])
    assert "2 of 2 effects would show" in sentences(plan)[0] and "would not" not in " ".join(sentences(plan))


def test_the_page_says_the_same_at_a_glance(plan):
    from rockref.report.views.plan_page import plan_page
    from tests.unit.report.page_checks import faults_of

    page = plan_page(plan)
    text = page.html()
    assert faults_of(text) == [] and "<script" not in text
    assert page.card["card"].next_step == sentences(plan)[-1] and "rolling_resistance.lever" in text
