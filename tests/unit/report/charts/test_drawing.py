"""Charts as SVG: well-formed, within their stretch, gaps kept, every model told from the others."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rockref.report.charts.dots import dots, level
from rockref.report.charts.drawing import Line, Panel, chart, draw, key, key_of
from rockref.report.charts.style import COLOURS

X = np.linspace(0.0, 5.0, 1001)
INK = "#123456"


def texts(svg):
    return {t.text for t in ET.fromstring(svg).iter("text")}


def paths(svg, colour=INK):
    """The d of every path drawn in a colour, in order."""
    return [p.get("d") for p in ET.fromstring(svg).iter("path") if f"stroke:{colour}" in (p.get("style") or "")]


def points(d):
    """The places that a path goes through, in pixels."""
    at, places = np.zeros(2), []
    for kind, numbers in re.findall(r"([Mlhv])([^Mlhv]*)", d):
        n = [float(word) for word in re.findall(r"-?(?:\d+\.?\d*|\.\d+)", numbers)]
        at = np.array(n) if kind == "M" else at + {"h": [n[0], 0.0], "v": [0.0, n[0]], "l": n}[kind]
        places.append(at)
    return np.array(places)


def of(y, **more):
    return chart([Panel("y", [Line("y", X, y, INK)])], title="t", x_label="x", **more)


def test_chart_is_well_formed_and_says_what_it_is():
    svg = chart([Panel("rate <deg/s>", [Line("a & b", X, np.sin(X))])], title='a "quoted" <title>', x_label="time (s)")
    root = ET.fromstring(svg)
    assert root.get("role") == "img" and root.get("aria-label") == root.findtext("title") == 'a "quoted" <title>'
    assert {"rate <deg/s>", "time (s)"} <= texts(svg)
    assert " id=" not in svg


def test_curve_is_where_its_numbers_are():
    """A parabola through a frame whose corners are those of the limits, to the width of a line."""
    panel = Panel("y", [Line("y", X, X**2, INK)], limits=(0.0, 25.0), height=100.0)
    (d,) = paths(chart([panel], title="t", x_label="x"))
    at = points(d)
    x, y = np.interp(at[:, 0], at[[0, -1], 0], (0.0, 5.0)), np.interp(at[:, 1], at[[-1, 0], 1], (25.0, 0.0))
    assert at[0, 1] - at[-1, 1] == pytest.approx(100.0, abs=0.3) and len(at) < 60
    assert np.abs(y - x**2).max() < 25.0 * 1.2 / 100.0


def test_gap_parts_the_curve():
    y = np.sin(X)
    y[400:500] = np.nan
    (d,) = paths(of(y))
    assert d.count("M") == 2 and "nan" not in d


def test_only_what_lies_in_view_is_drawn_and_sets_the_ordinate():
    (d,) = paths(of(X, x_limits=(1.0, 2.0)))
    # The margins of 62 and 12 of 860 pixels, to a pixel.
    assert np.sort(points(d)[[0, -1], 0]) == pytest.approx([61.2, 849.2], abs=1.0)
    assert {"1.2", "1.8"} <= texts(of(X, x_limits=(1.0, 2.0))) and "4.0" not in texts(of(X, x_limits=(1.0, 2.0)))


def test_strips_show_every_point_and_its_intervals():
    strips = [("1ext", np.array([[0.0, 1.0], [2.0, 3.0]])), ("2ext", np.empty((0, 2)))]
    svg = chart([Panel("contacts", strips=strips, colour=INK)], title="t", x_label="x", x_limits=(0.5, 4.0))
    (d,) = paths(svg)
    assert d.count("M") == 2 and {"1ext", "2ext"} <= texts(svg)
    # Of seven half seconds one, then two after two.
    assert points(d)[:, 0] == pytest.approx(61.2 + 788.0 / 7 * np.array([0, 1, 3, 5]), abs=1.0)


def test_a_short_contact_is_still_seen():
    svg = chart([Panel("c", strips=[("1ext", np.array([[1.0, 1.00001]]))], colour=INK)], title="t", x_label="x",
                x_limits=(0.0, 4.0))  # fmt: skip
    assert np.ptp(points(paths(svg)[0])[:, 0]) > 0.3


def test_logarithmic_ordinate_has_powers_of_ten():
    svg = chart([Panel("y", [Line("y", X, 10.0 ** (X - 2.0), dots=True)], log=True)], title="t", x_label="x")
    assert {"0.01", "0.1", "1", "10", "100"} <= texts(svg)


def test_marks_outside_are_left_out():
    assert len(paths(of(X, marks=[1.0, 9.0]), "#b42318")) == 1


def test_models_have_dots_of_their_own_and_the_legend_shows_them():
    lines = [Line(str(k), X[:3], X[:3] + k, colour, dots=True) for k, colour in enumerate(COLOURS)]
    (ax,) = draw([Panel("y", lines)], [(-1.0, 1.0)]).axes
    assert len({line.get_marker() for line in ax.lines}) == len(COLOURS)
    shapes = {re.search(r' d="([^"]+)"', key([("1", colour, ())], {"1"})).group(1) for colour in COLOURS}
    assert len(shapes) == len(COLOURS)


def test_a_whole_line_of_a_models_colour_is_a_line_in_the_legend():
    lines = [Line("model", X, X, COLOURS[0]), Line("size", X, X, COLOURS[0], dots=True)]
    curve, dot = re.findall(r"<span.*?</span>", key_of(lines))
    assert "M1 4h28" in curve and "translate" not in curve and "translate" in dot


def test_legend_escapes_names():
    assert re.search(r"<svg[^>]*>.*</svg>a&lt;b", key([("a<b", "#000", (1, 2))]))


def test_every_stretch_has_its_column_and_a_title_its_legend():
    figure = draw(
        [Panel("y", [Line("sine", X, np.sin(X))]), Panel("z", [Line("line", X, X)])], [(0, 1), (2, 5)], title="t"
    )
    assert [ax.get_xlim() for ax in figure.axes] == [(0, 1), (2, 5)] * 2
    assert [ax.get_ylabel() for ax in figure.axes] == ["y", "", "z", ""]
    assert [text.get_text() for text in figure.legends[0].get_texts()] == ["sine"]


def test_dots_stand_over_their_places_beside_levels_that_leave_out_what_is_unknown():
    line = level("floor", [1.0, np.nan, 2.0])
    assert np.isfinite(line.y).sum() == 4 and line.x[np.isfinite(line.y)] == pytest.approx([-0.37, 0.37, 1.63, 2.37])
    svg, keys = dots("t", ["a", "b", "c"], [("before", [3.0, 4.0, np.nan]), ("after", [1.0, 1.0, 1.0])], [line])
    assert {"a", "b", "c"} <= texts(svg) and all(name in keys for name in ("floor", "before", "after"))
    # From zero up, with room above the largest.
    assert "0" in texts(svg) and len(re.findall("<use ", svg)) == 5
