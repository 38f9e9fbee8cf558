"""What the report makes of a comparison: tables, curves, player, figures, page."""

import json
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from rich.console import Console

from rockref import Model
from rockref.discover.compare.models import compare
from rockref.effects.catalogue import parse
from rockref.report.charts import run_panels, style
from rockref.report.charts.figures import rendered
from rockref.report.html import blocks
from rockref.report.html.encoding import unpacked
from rockref.report.html.page import Page
from rockref.report.html.player import FRAME_RATE, player
from rockref.report.tables import comparison_tables
from rockref.report.tables.table import number
from rockref.report.terminal.comparison_text import print_comparison
from rockref.report.views.comparison_card import card_of_comparison
from rockref.report.views.comparison_page import add_runs, comparison_page
from tests.unit.discover.synthetic import DEGREE, experiment
from tests.unit.report.page_checks import faults_of

TABLE = Model.table_3_1()
SCALED = TABLE.replace(effects=(parse("gyro_scale:x=1.02,y=1.02,z=1.02"),))


@pytest.fixture(scope="module")
def c():
    runs = [{}, {"use": "holdout"}, {"turned": True}]
    return compare(experiment(SCALED, runs, noisy=True), [TABLE, SCALED], ["plain", "<scaled>"])


@pytest.fixture(scope="module")
def text(c):
    return comparison_page(c).html()


def test_page_keeps_the_rules_and_the_limit(text):
    assert faults_of(text) == []
    assert len(text.encode()) < 2_000_000


def test_page_names_models_runs_and_digests(c, text):
    assert "&lt;scaled&gt;" in text and "<scaled>" not in text
    assert "01 (fit)" in text and "02 (holdout)" in text
    assert c.experiment.digest in text


def test_whose_contacts_stand_where_is_said_in_words(text):
    """Beside the rows there is no room for a long name."""
    assert "every contact point of the model (from above: plain, then &lt;scaled&gt;) while it touches" in text


def test_same_comparison_gives_the_same_page(c, text):
    assert comparison_page(c).html() == text


def test_curves_hold_the_record(c):
    drawn = blocks.run_curves(c, 0)
    lines = drawn.data["panels"][0]["lines"]
    assert [line["name"] for line in lines] == ["measured", "plain", "<scaled>", "Housner"]
    column = lines[0]["y"]
    run = c.measured[0].run
    assert np.abs(unpacked(column) - run.crv[:, 0] / DEGREE).max() <= 0.5 * column["unit"] * 1.001
    assert drawn.data["x"] == {"start": 0.0, "step": pytest.approx(0.001), "n": len(run.t)}
    assert drawn.data["marks"] == pytest.approx(c.measured[0].features.impacts.times.tolist(), abs=1e-6)


def test_contact_lines_are_those_of_the_response(c):
    r = c.results[0][2]
    strips = dict(run_panels.contact_strips(r))
    assert set(strips) == set(r.aligned.response.problem.points.names)
    # The turned block rests on corners 3 and 4 from the release until some 40 ms before the first main impact.
    first = c.measured[2].features.impacts.times[0]
    for name in ("3ext", "4ext"):
        assert strips[name][0, 0] == pytest.approx(r.shift)
        assert first - 0.06 < strips[name][0, 1] < first + 0.01


def test_housner_swings_with_the_block(c):
    for k, sign in ((0, 1.0), (2, -1.0)):
        line = run_panels.planar(c, k, 0.4)
        measured = np.interp(0.4, c.measured[k].run.t, c.measured[k].run.crv[:, 0]) / DEGREE
        assert sign * line.y[-1] > 0.0
        # Up to the first impact the planar block is the block; the gyroscope shows two per cent more.
        assert line.y[-1] == pytest.approx(measured / 1.02, rel=0.02)


def test_curves_are_thinned_before_a_run_is_left_out(c):
    whole, thin = Page("t"), Page("t")
    assert add_runs(whole, c) == [] and add_runs(thin, c, room=150_000) == []
    seen = [[b["curves"] for kind, b in page.sections[0].blocks if kind == "curves"] for page in (whole, thin)]
    assert [len(found) for found in seen] == [3, 3]
    a, b = (found[0].data["panels"][0]["lines"][0]["y"] for found in seen)
    assert b["n"] < a["n"] / 2 and "Thinned to one sample in" in seen[1][0].sentence
    # Every extreme is still drawn.
    assert max(unpacked(b)) == pytest.approx(max(unpacked(a)), abs=a["unit"])
    # What cannot be thinned any further is left out, repeats first, and named.
    assert add_runs(Page("t"), c, room=0) == ["01", "03", "02"]


@pytest.mark.parametrize("every", [1, 3])
def test_of_thinned_values_each_bucket_keeps_both_ends_in_their_order(every):
    y = np.array([0, 5, 1, -7, 2, 3, 9, 8, 7, 6, 5, 4, 100.0])
    wanted = y if every == 1 else [5, -7, 9, 4]
    assert run_panels.thinned(y, every).tolist() == list(wanted)
    assert len(run_panels.thinned_times(np.arange(13.0), every)) == len(wanted)


def test_a_run_opens_where_the_model_leaves_the_band(c):
    start, end = blocks.run_curves(c, 0).data["open"]
    gone = c.results[0][0].leaves_band
    assert start <= gone.time <= end and end - start >= blocks.OPENED and start > 0


def test_player_shows_measured_and_modelled(c):
    m, r = c.measured[0], c.results[0][0]
    data = player(m, [("plain", r)], until=1.0).data
    assert data["frames"] == FRAME_RATE and [b["name"] for b in data["bodies"]] == ["measured", "plain"]
    assert [b["estimated"] for b in data["bodies"]] == [True, False]
    tilts = [unpacked(b["angles"][0]) for b in data["bodies"]]
    assert tilts[0][0] == pytest.approx(-(0.117 + r.tilt_offset), abs=1e-5)
    # A gyroscope that shows two per cent too much turns the integrated block by two per cent too far; its low-pass is
    # 0.75 ms late, which at 36 deg/s is 0.4 % of the 6.7 degrees.
    moved = [tilt[250] - tilt[0] for tilt in tilts]
    assert moved[0] / moved[1] == pytest.approx(1.02 * 0.996, abs=0.002)
    touching = unpacked(data["bodies"][1]["touching"]).astype(int)
    assert touching[0] == 0b11
    assert touching.max() < 1 << len(data["points"])


def test_turned_block_is_drawn_turned(c):
    data = player(c.measured[2], [("plain", c.results[0][2])]).data
    for body in data["bodies"]:
        assert abs(body["turned"]) == pytest.approx(np.pi)
        # What is left of the turn is small, so that it can be exaggerated.
        assert np.abs(unpacked(body["angles"][2])).max() < 0.1


def test_error_table_has_both_uses_in_three_units(c):
    table = comparison_tables.errors_table(c, 0)
    assert list(table.columns)[2:] == [
        f"{use} {unit}" for use in ("fit", "holdout") for unit in ("(deg/s)", "/ noise", "/ spread")
    ]
    assert len(table.rows) == 9
    row = table.rows[0]
    assert float(row[2]) == pytest.approx(c.rms(0, "before", "main", "fit") / DEGREE, abs=6e-4)


@pytest.mark.parametrize("value, shown", [(1.234, "1.23"), (None, "\u2013"), (float("nan"), "\u2013"), (-0.5, "-0.50")])
def test_numbers_in_tables(value, shown):
    assert number(value) == shown


def test_terminal_shows_tables_and_sentences(c):
    console = Console(width=200, record=True, file=open("/dev/null", "w"))
    print_comparison(console, c, full=True)
    printed = console.export_text()
    assert "Error of plain" in printed and "Error of <scaled>" in printed
    assert "All three measured rates are 2.0 % larger" in printed
    assert "Side by side" in printed


@pytest.fixture(scope="module")
def written(c, tmp_path_factory):
    folder = tmp_path_factory.mktemp("figures")
    return run_panels.write_figures(c, folder)


def test_figures_are_png_and_svg(written):
    assert sorted(p.suffix for p in written) == [".png", ".png", ".svg", ".svg"]
    for path in written:
        data = path.read_bytes()
        assert data.startswith(b"\x89PNG") if path.suffix == ".png" else ET.fromstring(data).tag.endswith("svg")


def test_same_figure_gives_the_same_bytes(c, written):
    svg = next(p for p in written if p.name.endswith("whole.svg"))
    assert rendered(run_panels.whole_run(c, 0), "svg") == svg.read_bytes()


def test_figure_names_its_curves(written):
    svg = next(p for p in written if p.name.endswith("whole.svg")).read_text(encoding="utf-8")
    for name in ("measured", "plain", "Housner", "1ext", "4int", "transverse"):
        assert name in svg


def test_provenance_is_plain(c):
    facts = blocks.provenance(c)
    assert json.loads(json.dumps(facts)) == facts
    assert {"engine", "rockref", "numpy"} <= set(facts)


def test_zooms_have_a_labelled_row_of_contacts_for_every_model(c):
    figure = run_panels.zooms(c, 0)
    columns = 3 if len(c.measured[0].features.impacts.times) > 4 else 2
    rows = [figure.axes[i : i + columns] for i in range(0, len(figure.axes), columns)]
    assert len(rows) == 3 + len(c.names)
    for i, name in enumerate(c.names):
        first = rows[3 + i][0]
        assert first.get_ylabel() == name and len(first.get_yticklabels()) == 8
        strips = [line.get_color() for axes in rows[3 + i] for line in axes.lines if line.get_color() != style.IMPACT]
        assert len(strips) == 8 * columns and set(strips) == {style.colour(i)}


def test_the_head_says_which_model_is_closest_and_draws_the_held_out_run(c):
    card = card_of_comparison(c)
    assert card.name.startswith("<scaled> is closest, off by") and card.facts[0].label == "plain"
    assert "held-out" in card.facts[1].notes[0] and card.caption.startswith("Run 02 (held out)")
    # Measured and each model is a line of the picture; the frame and its grid are not drawn with them.
    assert card.keys.count("<svg") == 3 and card.picture.count("<svg") == 1
