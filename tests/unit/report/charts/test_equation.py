"""Equations as pictures: every one of the catalogue can be drawn, and one that cannot is shown as it was written."""

import re

import numpy as np
import pytest

from rockref.effects import catalogue
from rockref.report.charts.equation import EDGE, equation_svg
from rockref.report.html.page import Page
from tests.unit.report.page_checks import faults_of

ALL = {**catalogue.EFFECTS, **catalogue.OF_TOSSES, **{kind.question: kind for kind in catalogue.NONE.values()}}


@pytest.mark.parametrize("name", ALL)
def test_every_equation_of_the_catalogue_is_drawn_inside_its_frame(name):
    svg = equation_svg(ALL[name].equation)
    width, height = map(float, re.search(r'viewBox="0 0 (\S+) (\S+)"', svg).groups())
    numbers = np.array(re.findall(r"-?\d+\.\d\d", svg), float).reshape(-1, 2)
    # Control points of curves may stand a little outside of what is drawn; a tenth of a letter is ample.
    assert numbers.min() > -EDGE and (numbers.max(0) < (width + EDGE, height + EDGE)).all()
    assert not faults_of(f"<p>{svg}</p>")


def test_letters_stand_upright():
    """Downwards as SVG counts: the bar of a T is above its foot."""
    d = re.search(r'd="([^"]+)"', equation_svg(r"\mathrm{T}")).group(1)
    points = np.array(re.findall(r"-?\d+\.\d\d", d), float).reshape(-1, 2)
    upper = points[points[:, 1] < points[:, 1].mean()]
    lower = points[points[:, 1] > points[:, 1].mean()]
    assert np.ptp(upper[:, 0]) > np.ptp(lower[:, 0])


@pytest.mark.parametrize("tex", [r"\begin{cases} 1 \end{cases}", r"\frac{1", "", r"\quad"])
def test_what_cannot_be_drawn_is_shown_as_it_was_written(tex):
    assert equation_svg(tex) == ""
    page = Page("title")
    page.add_equation(tex)
    assert f"In TeX: {tex}" in page.html() and not faults_of(page.html())


def test_the_label_is_the_equation_escaped():
    assert 'aria-label="a &lt; b"' in equation_svg("a < b")
