"""The page of a diagnosis: every part of the story, in its order, whole, escaped and small."""

from dataclasses import replace

import pytest

from rockref.discover.compare.models import compare
from rockref.report.html.page import MAX_BYTES, Page
from rockref.report.views.diagnosis_page import add_physics, compared, diagnosis_page, without_notes
from tests.unit.discover import fakes
from tests.unit.report.page_checks import Reader

STORY = [
    "The verdict", "What was measured", "Where the baseline fails", "What was tried", "What explains it",
    "What would make it sure", "The error falling", "Run by run", "In motion", "Where the numbers come from",
]  # fmt: skip


@pytest.fixture(scope="module")
def named():
    d = fakes.diagnosis("named")
    return d, compared(d)


def test_story_in_its_order(named):
    page = diagnosis_page(*named)
    assert [s.title for s in page.sections] == STORY


def test_measured_and_both_models_move(named):
    d, c = named
    assert c.names == ("baseline", "with quadratic_drag")
    page = diagnosis_page(d, c)
    ((_, block),) = [b for b in page.sections[8].blocks if b[0] == "player"]
    assert [b["name"] for b in block["player"].data["bodies"]] == ["measured", "baseline", "with quadratic_drag"]


def test_page_is_whole_escaped_and_small(named, tmp_path):
    d, c = named
    path = diagnosis_page(d, c).write_into(tmp_path / "new")
    text = path.read_text(encoding="utf-8")
    assert len(text.encode()) < MAX_BYTES
    assert "&lt;by half a turn&gt; &amp; repeat." in text and "<by half" not in text
    reader = Reader()
    reader.feed(text)
    assert not reader.faults and not reader.open
    assert len(reader.ids) == len(set(reader.ids))
    assert {link[1:] for link in reader.links if link.startswith("#")} <= set(reader.ids)
    for number in ("0.2500", "0.0800", "0.38", "512"):
        assert number in text, number


@pytest.fixture(scope="module")
def plain_comparison(named):
    d, c = named
    return compare(d.experiment, [c.models[0]], ["baseline"])


@pytest.mark.parametrize("verdict", ["none", "something_else", "not_trustworthy"])
def test_without_an_effect_there_is_one_model_and_no_amplitude(named, plain_comparison, verdict):
    d = fakes.diagnosis(verdict, named[0].experiment)
    text = diagnosis_page(d, plain_comparison).html()
    assert "How large" not in text and "Nothing of the catalogue." in text


@pytest.mark.parametrize("number, drawn", [(1, False), (2, True)])
def test_gains_are_drawn_where_there_are_some_to_compare(named, number, drawn):
    """One dot on an axis of its own says nothing."""
    d, c = named
    page = diagnosis_page(replace(d, ranking=d.ranking[:number]), c)
    (tried,) = [s for s in page.sections if s.title == "What was tried"]
    assert [kind for kind, _ in tried.blocks].count("figure") == drawn
    assert "Alternatives" in page.html()


def test_candidates_that_nobody_refitted_have_no_table(named):
    d, c = named
    text = diagnosis_page(replace(d, ranking=[]), c).html()
    assert "No candidate was refitted." in text and "Alternatives" not in text


def test_limits_and_confusion_stand_where_they_are_known(named):
    d, c = named
    assert "Would be detected above" not in diagnosis_page(d, c).html()
    limits = {"adhesion.force": {"value": 4.5, "unit": "N"}}
    confusion = {"adhesion": {"plate_tilt": 0.97}}
    text = diagnosis_page(replace(d, detection_limits=limits, confusion=confusion), c).html()
    assert "Would be detected above" in text and "Hardly told apart" in text and "0.970" in text


def test_shares_of_the_axes_are_drawn_before_and_after_the_fit(named):
    d, c = named

    def drawn(**signature):
        text = diagnosis_page(replace(d, signature=signature), c).html()
        return "Shares of the axes in the misfit" in text, "after the best fit" in text

    after = {"main": 0.2, "transverse": 0.5, "longitudinal": 0.3}
    assert drawn(**d.signature) == (True, False)
    assert drawn(**d.signature, remaining_axis_shares=after) == (True, True)
    assert drawn(axis="main")[0] is False


def test_an_effect_of_the_user_s_own_is_told_without_an_equation(monkeypatch):
    class Mine:
        sentence, equation, source = "", "", ""

    monkeypatch.setattr("rockref.effects.catalogue.find", lambda id: Mine)
    page = Page("t")
    add_physics(page, "mine")
    assert [b for s in page.sections for b in s.blocks] == [("text", "An effect of the user's own.")]


def test_without_an_effect_the_baseline_alone_is_compared(named):
    d, _ = named
    alone = compared(replace(fakes.diagnosis("none", d.experiment)))
    assert alone.names == ("baseline",)
    noted = d.model.replace(origin={"tilt_offset": 1e-4, "made_by": "x"})
    assert without_notes(noted).origin == {"made_by": "x"}
