"""The card in a browser: switch and slider move the curve, the evidence unfolds, at every size, on paper, dark."""

import numpy as np
import pytest

from rockref.report.html.trial import OPTIMUM
from rockref.report.views.diagnosis_page import compared, diagnosis_page
from tests.acceptance.browser import Browser, find_browser
from tests.unit.discover import fakes
from tests.unit.report.page_checks import faults_of

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on this machine: apt install chromium"),
]


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    d = fakes.diagnosis("named")
    made = diagnosis_page(d, compared(d))
    assert faults_of(made.html()) == []
    return made.write(tmp_path_factory.mktemp("card") / "index.html"), made.card["card"].trial


@pytest.fixture(scope="module")
def browser(page, tmp_path_factory):
    with Browser(tmp_path_factory.mktemp("profile")) as opened:
        opened.open(page[0])
        yield opened


CARD = "rockref.cards[0]"
DIAL = "document.querySelector('.dial')"
SLIDER, SWITCH = f"{DIAL}.querySelector('[type=range]')", f"{DIAL}.querySelector('[role=switch]')"
SAID = "document.querySelector('.dial output').textContent"


def curve(browser):
    return np.array(browser.evaluate(f"{CARD}.plot.data[3]"), float)


def test_the_run_is_drawn_where_the_difference_shows(browser, page):
    assert browser.complaints() == [] and browser.requests() == [page[0].as_uri()]
    view = browser.evaluate(f"[{CARD}.plot.scales.x.min, {CARD}.plot.scales.x.max]")
    assert view == pytest.approx(page[1].view, abs=1e-6)
    assert np.abs(curve(browser) - page[1].after[:, page[1].axis]).max() < 0.01


def test_the_switch_takes_the_effect_off_and_on(browser, page):
    (dial,) = page[1].dials
    browser.click(SWITCH)
    assert np.abs(curve(browser) - dial.rates[0][:, page[1].axis]).max() < 0.01
    assert browser.evaluate(SAID).startswith("none (off)")
    browser.click(SWITCH)
    assert np.abs(curve(browser) - dial.rates[OPTIMUM][:, page[1].axis]).max() < 0.01
    assert "(as found)" in browser.evaluate(SAID)


def test_the_slider_goes_through_the_sizes(browser, page):
    (dial,) = page[1].dials
    for start, share, place in ((0.5, 0.99, 8), (0.98, 0.26, 2), (0.26, 0.5, OPTIMUM)):
        browser.drag(SLIDER, start, share)
        assert browser.evaluate(f"{CARD}.state.at[0]") == place
        assert np.abs(curve(browser) - dial.rates[place][:, page[1].axis]).max() < 0.01
        assert browser.evaluate(SAID).startswith(dial.sizes[place])


def test_the_evidence_is_folded_and_a_link_into_it_opens_it(browser):
    assert browser.evaluate("document.querySelector('.evidence').open") is False
    browser.evaluate("location.hash = '#run-by-run'")
    browser.settle()
    assert browser.evaluate("document.querySelector('.evidence').open") is True
    states = browser.evaluate("[...document.querySelectorAll('.curves, .player')].map(f => f.dataset.state)")
    assert len(states) >= 2 and set(states) == {"ready"} and browser.complaints() == []


@pytest.mark.parametrize("width", [400, 1200, 1900])
def test_nothing_is_wider_than_the_window(browser, width):
    browser.resize(width, 900)
    assert browser.evaluate("document.documentElement.scrollWidth") <= width
    assert browser.evaluate(f"Math.abs({CARD}.plot.width - document.querySelector('.trial .live').clientWidth)") <= 2


def test_paper_has_the_picture_and_no_tools(browser):
    shown = "[...document.querySelectorAll('.card .static, .card .tools, .card .live')].map(e => e.offsetHeight > 0)"
    browser.look(media="print")
    assert browser.evaluate(shown) == [False, False, True]
    browser.look(scheme="dark")
    assert browser.evaluate("getComputedStyle(document.body).color") != "rgb(31, 35, 40)"
    browser.look()
