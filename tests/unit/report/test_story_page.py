"""The story of an experiment as sections of another page."""

from dataclasses import replace

import pytest

from rockref.discover.story import Journey
from rockref.report.diagnosis_page import compared
from rockref.report.page import Page
from rockref.report.story_page import add_story
from tests.unit.discover import fakes
from tests.unit.report.page_checks import faults_of

ERRORS = ["The error before and after", "The model as it grew"]


@pytest.fixture(scope="module")
def found():
    d = fakes.diagnosis("named")
    return d, compared(d)


@pytest.mark.parametrize("added", [True, False])
def test_the_error_before_and_after_stands_there_where_something_was_added(found, added):
    d, c = found
    page = Page("A story")
    add_story(page, Journey(d, fakes.addition(d.experiment) if added else None, c))
    titles = [s.title for s in page.sections]
    assert [t for t in titles if t in ERRORS] == (ERRORS if added else [])
    # Sections of a diagnosis have the experiment's name before them, for there may be several on a page.
    assert titles[0] == "synthetic: The verdict" and sum(t.startswith("synthetic: ") for t in titles) == 9
    assert faults_of(page.html()) == []


def test_curves_beyond_their_room_are_left_out_and_named(found):
    d, c = found
    page = Page("A story")
    add_story(page, Journey(replace(d), None, c), room=1)
    assert "Left out, to keep the page small: curves of run" in page.html()
