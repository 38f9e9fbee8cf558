"""The demonstration as a person meets it: the command, the lines, the page, and the page in a browser."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rockref.workflows.demo import EXPERIMENTS
from tests.acceptance.browser import Browser, find_browser
from tests.shipped import ROOT, shortened
from tests.unit.report.page_checks import faults_of

# Up to just behind the second main impact, between which and the first the model fails.
SECONDS = 1.5


@pytest.fixture(scope="module", params=["short", pytest.param("whole", marks=pytest.mark.slow)])
def demo(tmp_path_factory, request):
    """The demonstration of the shipped experiment, and of the beginning of two of its runs."""
    out, more = tmp_path_factory.mktemp("demo"), []
    if request.param == "short":
        (name,) = EXPERIMENTS
        data = tmp_path_factory.mktemp("data")
        shortened(data / name, ROOT / "data/experiments" / name, ("01", "03"), SECONDS)
        more = ["--data", str(data)]
    command = [str(Path(sys.executable).with_name("rockref")), "demo", "--output", str(out), *more]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=1800)
    assert done.returncode == 0, done.stderr
    return out, done.stdout, done.stderr


def test_the_lines_that_matter_and_the_place_of_the_page(demo):
    out, printed, _ = demo
    lines = [line for line in printed.splitlines() if line.startswith("- ")]
    # One about the model, two about the experiment, the verdict, its size, the errors on fit and held-out runs.
    assert len(lines) == 7
    last = printed.split("\n\n")[-1].splitlines()
    assert len(last) == 3 and last[-1] == f"The lab, to find it yourself: {out / 'lab.html'}"
    assert (out / "lab.html").is_file()
    assert "main impacts at 0.5104" in lines[0]
    assert lines[1].startswith("- mystery-05: The model leaves the band")
    assert "rolling_resistance is missing" in lines[3] and "lever" in lines[4]
    assert lines[5].startswith("- Fit runs: error") and lines[6].startswith("- Held-out runs: error")
    assert f"The page: {out / 'index.html'}" in printed


def test_without_a_terminal_a_stage_is_a_line(demo):
    said = [line for line in demo[2].splitlines() if line[1:3] == "/4"]
    parts = list(dict.fromkeys(" ".join(line.split()[:2]).rstrip(":") for line in said))
    assert parts == ["1/4 diagnosing", "2/4 adding", "3/4 comparing", "4/4 writing"]
    assert any("comparing" in line and "effects" in line for line in said)


def test_the_page_tells_five_things_and_begins_with_the_picture(demo):
    page = (demo[0] / "index.html").read_text(encoding="utf-8")
    titles = ["The block rocks", "Where the model fails", "The missing effect", "The error falls"]
    places = [page.index(f'-h">{title}</h2>') for title in [*titles, "A run that no fit has seen"]]
    assert places == sorted(places)
    assert page.index('<figure class="player"') < page.index('<figure class="curves"')


def test_page_is_whole_small_and_asks_for_nothing(demo):
    data = (demo[0] / "index.html").read_bytes()
    assert len(data) < 2_000_000
    assert faults_of(data.decode("utf-8")) == []


def test_figures_lie_beside_the_page(demo):
    assert len(list(demo[0].glob("*.png"))) == len(list(demo[0].glob("*.svg"))) == 2 * len(EXPERIMENTS)


needs_browser = pytest.mark.skipif(find_browser() is None, reason="no Chromium on this machine: apt install chromium")


@pytest.fixture(scope="module")
def browser(demo, tmp_path_factory):
    with Browser(tmp_path_factory.mktemp("profile")) as opened:
        opened.open(demo[0] / "index.html")
        yield opened


CURVES = "document.querySelectorAll('figure.curves')[0]"
PLAYER = "document.querySelector('figure.player')"


@needs_browser
def test_page_runs_without_complaint_and_asks_for_nothing_else(browser, demo):
    assert browser.complaints() == []
    assert browser.requests() == [(demo[0] / "index.html").as_uri()]
    states = browser.evaluate("[...document.querySelectorAll('.curves, .player')].map(f => f.dataset.state)")
    assert len(states) >= 4 and set(states) == {"ready"}


@needs_browser
def test_buttons_and_dragging_zoom_all_panels_together(browser):
    whole = browser.evaluate("rockref.curves[0].range()")
    browser.click(f"{CURVES}.querySelector('button[aria-label=\"show first swing\"]')")
    start, end = browser.evaluate("rockref.curves[0].range()")
    assert start == 0.0 and end < 0.6 < whole[1]
    browser.drag(f"{CURVES}.querySelector('.u-over')", 0.5, 0.75)
    ranges = browser.evaluate("rockref.curves[0].plots.map(p => [p.scales.x.min, p.scales.x.max])")
    assert all(r == pytest.approx(ranges[0]) for r in ranges)
    # Half to three quarters of the first swing, to a few pixels.
    assert ranges[0] == pytest.approx([0.5 * end, 0.75 * end], abs=0.01)
    browser.click(f"{CURVES}.querySelector('button[aria-label=\"show whole run\"]')")
    assert browser.evaluate("rockref.curves[0].range()") == pytest.approx(whole)


@needs_browser
def test_player_steps_plays_and_stops(browser):
    browser.click(f"{PLAYER}.querySelector('button[aria-label=\"to main impact 1\"]')")
    at = int(browser.evaluate(f"{PLAYER}.dataset.frame"))
    # 30 ms before the first main impact of mystery-04's first run, 0.5085 s; frames are 2 ms.
    assert at == pytest.approx((0.5085 - 0.03) / 0.002, abs=2)
    browser.click(f"{PLAYER}.querySelector('button[aria-label=\"one frame on\"]')")
    assert int(browser.evaluate(f"{PLAYER}.dataset.frame")) == at + 1
    browser.click(f"{PLAYER}.querySelector('button[aria-label=\"play\"]')")
    moved = f"Number({PLAYER}.dataset.frame) > {at + 5}"
    browser.evaluate(f"new Promise(r => {{ const look = () => {moved} ? r() : setTimeout(look, 20); look(); }})")
    browser.click(f"{PLAYER}.querySelector('button[aria-label=\"pause\"]')")
    assert browser.evaluate("rockref.players[0].state.playing") is False


@needs_browser
def test_player_turns_the_block_as_the_model_does(browser):
    from rockref.model.rotation import exponential

    turns = (-0.117, 0.02, 0.3)
    shown = browser.evaluate(f"rockref.players[0].rotation({', '.join(map(str, turns))})")
    expected = np.eye(3)
    for axis, angle in enumerate(turns):
        expected = expected @ exponential(angle * np.eye(3)[axis])
    assert np.array(shown) == pytest.approx(expected, abs=1e-12)


@needs_browser
def test_feet_light_up_where_the_model_touches(browser):
    browser.evaluate("rockref.players[0].seek(0)")
    bits = browser.evaluate("rockref.players[0].bodies.map(b => b.bits[0])")
    # The wire lets go of a block that leans on corners 1 and 2, measured and in each model.
    assert len(bits) >= 2 and set(bits) == {0b11}


@needs_browser
def test_page_fits_a_telephone(browser):
    browser.resize(390, 844)
    try:
        assert browser.evaluate("document.documentElement.scrollWidth") <= 390
        assert browser.evaluate("rockref.curves[0].plots[0].width") <= 390
    finally:
        browser.resize(1100, 900)


@needs_browser
def test_picture_is_not_blank(browser):
    browser.evaluate(f"{PLAYER}.scrollIntoView({{behavior: 'instant'}})")
    browser.settle()
    inked = browser.evaluate(
        f"(() => {{ const c = {PLAYER}.querySelector('canvas'); const d = c.getContext('2d')"
        ".getImageData(0, 0, c.width, c.height).data; let n = 0;"
        " for (let i = 3; i < d.length; i += 4) if (d[i]) n++; return n / (d.length / 4); })()"
    )
    # The block and the plan of its base cover more than a twentieth of the frame.
    assert inked > 0.05
    assert browser.screenshot().startswith(b"\x89PNG")
