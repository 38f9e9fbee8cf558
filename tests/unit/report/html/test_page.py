"""The page: whole, safe with any text, readable without scripts, small."""

import hashlib
from importlib import resources

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.report.charts.drawing import Line, Panel, chart
from rockref.report.html import page as page_module
from rockref.report.html.curves import curves
from rockref.report.html.page import Page
from rockref.report.html.player import Player
from rockref.report.tables.table import Table
from tests.unit.report.page_checks import faults_of

NASTY = '</script><script>alert(1)</script> & "x" <b>\''
T = np.arange(200) / 100.0
TABLE = Table("What <it> is", ("what", "value"), [["a <b>", "1"], [NASTY, "2"]], NASTY)
PANEL = Panel(NASTY, [Line(NASTY, T, np.sin(T)), Line("coarse", T[::10], np.cos(T[::10]))])
PICTURE = chart([PANEL], title=NASTY, x_label="time (s)")


def full_page():
    page = Page(NASTY, NASTY)
    page.add_section(NASTY, [NASTY, "second"])
    page.add_sentences([NASTY, "another"], NASTY)
    page.add_table(TABLE)
    page.add_details(NASTY, TABLE)
    page.add_figure(PICTURE, NASTY, TABLE, NASTY)
    page.add_figure(b"\x89PNG", NASTY, TABLE)
    page.add_section(NASTY)
    page.add_heading(NASTY)
    strips = Panel("contacts", strips=[("1ext", np.array([[0.0, 1.0]]))])
    page.add_curves(curves(T, [PANEL, strips], title=NASTY, sentence=NASTY, marks=[0.5], table=TABLE))
    page.add_player(Player(NASTY, NASTY, {"note": NASTY}))
    page.add_provenance({"file": NASTY, "model": {"effects": {}}})
    return page


@pytest.fixture(scope="module")
def text():
    return full_page().html()


def test_page_keeps_the_rules(text):
    assert faults_of(text) == []


@pytest.mark.parametrize(
    "broken, fault",
    [
        ("<p><b></p>", "closes"),
        ('<i id="a"></i><i id="a"></i>', "twice"),
        ('<a href="#nowhere">x</a>', "leads nowhere"),
        ('<img alt="x" src="http://example.org/x.png">', "source"),
        ("<style>p { background: url(x.png) }</style>", "style asks"),
        ("<script>fetch('https://example.org/')</script>", "address"),
        ("<figure><figcaption> </figcaption></figure>", "without a sentence"),
        ("<table><tbody></tbody></table>", "without a caption"),
    ],
)
def test_the_checks_see_faults(broken, fault):
    assert any(fault in found for found in faults_of(broken))


def test_text_is_never_taken_for_markup(text):
    assert "<script>alert" not in text
    assert "alert(1)" in text


def test_sections_with_one_title_have_anchors_of_their_own():
    page = Page("t")
    anchors = [page.add_section("The same").anchor for _ in range(3)]
    assert len(set(anchors)) == 3


def test_what_comes_before_a_section_is_kept():
    page = Page("t")
    page.add_text("first words")
    assert "first words" in page.html() and len(page.sections) == 1


def test_scripts_come_only_where_they_are_needed():
    plain = Page("t")
    plain.add_figure(PICTURE, "a sentence")
    assert "<script" not in plain.html() and "uPlot" not in plain.html()
    still = Page("t")
    still.add_player(Player("p", "s", {}))
    assert "uPlot" not in still.html() and "<script" in still.html()


def test_licence_travels_with_the_code(text):
    assert "The MIT License" in text and "Leon Sorokin" in text


def test_curves_have_a_picture_without_scripts(text):
    assert text.index('class="static"') < text.index("</figure>", text.index('class="static"'))
    assert '<svg class="chart"' in text.partition('class="static"')[2][:200]


def test_page_is_written_whole(tmp_path, text):
    path = full_page().write(tmp_path / "index.html")
    assert path.read_text(encoding="utf-8") == text
    assert [p.name for p in tmp_path.iterdir()] == ["index.html"]


def test_page_that_is_too_large_is_not_written(tmp_path, monkeypatch):
    monkeypatch.setattr(page_module, "MAX_BYTES", 1000)
    with pytest.raises(InputError, match="E-PAGE-SIZE]"):
        full_page().write(tmp_path / "index.html")
    assert list(tmp_path.iterdir()) == []


def test_folder_that_is_not_there_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="E-WRITE]"):
        Page("t").write(tmp_path / "missing" / "index.html")


def test_vendored_files_are_the_published_ones():
    folder = resources.files("rockref.report.html") / "vendor"
    lines = (folder / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    listed = dict(reversed(line.split(maxsplit=1)) for line in lines)
    assert set(listed) == {"uPlot.iife.min.js", "uPlot.min.css", "uPlot.LICENSE"}
    for name, digest in listed.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == digest


def test_numbers_that_are_none_cannot_enter_the_data():
    page = Page("t")
    page.add_player(Player("p", "s", {"x": float("nan")}))
    with pytest.raises(ValueError):
        page.html()
