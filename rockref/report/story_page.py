"""The story of one experiment on a page that others build too: compared, diagnosed, added, the error falling."""

from __future__ import annotations

from rockref.discover.diagnosis_record import plain
from rockref.discover.story import Journey
from rockref.report.addition_page import add_errors
from rockref.report.diagnosis_page import add_diagnosis
from rockref.report.page import Page


def add_story(page: Page, journey: Journey, room: int = 400_000) -> None:
    """Add the sections of a journey; `room` in bytes is for the curves of its runs."""
    d = journey.diagnosis
    add_diagnosis(page, plain(d.to_dict()), journey.comparison, prefix=d.experiment.name, room=room)
    if journey.addition is not None:
        add_errors(page, journey.addition)
