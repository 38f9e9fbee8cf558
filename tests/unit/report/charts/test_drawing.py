"""Charts as SVG: well-formed, thinned within the width of a line, gaps kept."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rockref.report.charts.drawing import TOLERANCE, Line, Panel, _path, chart, key, nice_ticks, thinned

X = np.linspace(0.0, 5.0, 1001)


def paths(svg):
    """The d of every drawn curve, in order."""
    return [p.get("d") for p in ET.fromstring(svg).iter("path") if p.get("stroke-width") == "1.2"]


def points(d):
    """The points of a path of one M and one l, in pixels."""
    head, _, tail = d[1:].partition("l")
    steps = [float(v) for v in head.split()] + [float(v) for v in tail.split()]
    return np.cumsum(np.array(steps).reshape(-1, 2), axis=0)


@given(arrays(np.float64, st.integers(2, 300), elements=st.floats(0.0, 200.0)))
def test_thinned_curve_keeps_within_the_tolerance(y):
    x = np.linspace(0.0, 800.0, len(y))
    px, py = thinned(x, y)
    assert px[0] == x[0] and px[-1] == x[-1]
    # Rounding of a slope over 800 pixels.
    assert np.abs(np.interp(x, px, py) - y).max() <= TOLERANCE + 1e-9


def test_a_straight_line_is_two_points():
    px, _ = thinned(X, 3.0 * X + 1.0)
    assert len(px) == 2


@given(arrays(np.float64, st.integers(1, 50), elements=st.floats(0.0, 900.0)))
def test_path_data_lead_to_the_points_to_a_tenth_of_a_pixel(y):
    x = np.arange(len(y), dtype=float)
    # Relative moves of rounded places do not add up their rounding: half a tenth remains.
    assert points(_path(x, y)) == pytest.approx(np.stack((x, y), axis=1), abs=0.051)


def test_chart_is_well_formed_and_says_what_it_is():
    svg = chart([Panel("rate <deg/s>", [Line("a & b", X, np.sin(X))])], title='a "quoted" <title>', x_label="time (s)")
    root = ET.fromstring(svg)
    assert root.get("role") == "img" and root.get("aria-label") == 'a "quoted" <title>'
    assert root.findtext("title") == 'a "quoted" <title>'
    assert "rate <deg/s>" in [t.text for t in root.iter("text")]


def test_gap_parts_the_curve():
    y = np.sin(X)
    y[400:500] = np.nan
    (d,) = paths(chart([Panel("y", [Line("y", X, y)])], title="t", x_label="x"))
    assert d.count("M") == 2 and "nan" not in d


def test_only_what_lies_in_view_is_drawn():
    (d,) = paths(chart([Panel("y", [Line("y", X, X)])], title="t", x_label="x", x_limits=(1.0, 2.0)))
    at = points(d)
    assert at[:, 0].min() == pytest.approx(62.0) and at[:, 0].max() == pytest.approx(848.0)


def test_strips_show_every_point_and_its_intervals():
    strips = [("1ext", np.array([[0.0, 1.0], [2.0, 3.0]])), ("2ext", np.empty((0, 2)))]
    svg = chart([Panel("contacts", strips=strips)], title="t", x_label="x", x_limits=(0.0, 4.0))
    drawn = [p.get("d") for p in ET.fromstring(svg).iter("path") if p.get("stroke-width")]
    assert [d.count("M") for d in drawn] == [2, 0]
    assert {"1ext", "2ext"} <= {t.text for t in ET.fromstring(svg).iter("text")}


def test_contacts_closer_than_half_a_pixel_are_one():
    strips = [("1ext", np.array([[0.0, 1.0], [1.0001, 2.0]]))]
    svg = chart([Panel("c", strips=strips)], title="t", x_label="x", x_limits=(0.0, 4.0))
    assert [p.get("d").count("M") for p in ET.fromstring(svg).iter("path") if p.get("stroke-width")] == [1]


def test_logarithmic_ordinate_has_powers_of_ten():
    svg = chart([Panel("y", [Line("y", X, 10.0 ** (X - 2.0), dots=True)], log=True)], title="t", x_label="x")
    texts = [t.text for t in ET.fromstring(svg).iter("text")]
    assert {"0.01", "0.1", "1", "10", "100"} <= set(texts)


def test_marks_outside_are_left_out():
    svg = chart([Panel("y", [Line("y", X, X)])], title="t", x_label="x", marks=[1.0, 9.0])
    assert svg.count('stroke-width="0.7"') == 1


@pytest.mark.parametrize(
    "low, high, expected",
    [(0.0, 5.0, [0, 1, 2, 3, 4, 5]), (-0.03, 0.09, [-0.02, 0, 0.02, 0.04, 0.06, 0.08]), (3.0, 3.0, [3.0])],
)
def test_ticks_are_round(low, high, expected):
    assert nice_ticks(low, high, 6) == pytest.approx(expected, abs=1e-12)


def test_models_have_dots_of_their_own_and_the_legend_shows_them():
    from rockref.report.charts.style import COLOURS

    lines = [Line(str(k), X[:3], X[:3] + k, colour, dots=True) for k, colour in enumerate(COLOURS)]
    svg = ET.fromstring(chart([Panel("y", lines)], title="t", x_label="x", x_limits=(-1.0, 1.0)))
    shapes = {p.get("style"): p.get("d") for p in svg.iter("path") if p.get("transform")}
    assert len(set(shapes.values())) == len(COLOURS)
    assert shapes[f"fill:{COLOURS[1]}"] in key([("1", COLOURS[1], ())])


def test_legend_escapes_names():
    assert re.search(r"<svg[^>]*>.*</svg>a&lt;b", key([("a<b", "#000", (1, 2))]))


def test_levels_are_drawn_and_named_at_their_height():
    panel = Panel("p", [Line("a", X, X)], levels=[("floor", 2.5)], limits=(0.0, 5.0), height=100.0)
    plain = chart([replace(panel, levels=[])], title="t", x_label="x")
    svg = chart([panel], title="t", x_label="x")
    assert ">floor<" in svg and ">floor<" not in plain
    (level,) = [p.get("d") for p in ET.fromstring(svg).iter("path") if p.get("stroke-dasharray") == "2 3"]
    frame = next(r for r in ET.fromstring(svg).iter("rect") if r.get("class") == "frame")
    # Half of the range is the middle of the frame.
    assert float(level[1:].split()[1].split("h")[0]) == pytest.approx(float(frame.get("y")) + 50.0, abs=0.1)
