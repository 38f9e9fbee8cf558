"""Curves that can be zoomed, with a static picture and a table for those who cannot or need not."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.report.charts.drawing import Panel, chart, key_of
from rockref.report.html.encoding import packed
from rockref.report.tables.table import Table


@dataclass(frozen=True, eq=False)
class Curves:
    """The data of one set of curves: ``title``, ``sentence``, ``picture`` (SVG), ``keys`` (legend), ``table`` of its
    numbers or None, ``data`` for the script."""

    title: str
    sentence: str
    picture: str
    keys: str
    table: Table | None
    data: dict[str, Any]


def curves(
    t: np.ndarray,
    panels: Sequence[Panel],
    *,
    title: str,
    sentence: str,
    x_label: str = "time (s)",
    marks: Sequence[float] = (),
    views: Sequence[tuple[str, float, float]] = (),
    opening: tuple[float, float] | None = None,
    table: Table | None = None,
    whole: Sequence[Panel] = (),
) -> Curves:
    """Return curves over t (N,) s; every line of the panels has N values, or fewer at even steps of its own.

    `marks` are main impacts, s; `views` are named stretches that a button leads to;
    `opening` is the one that is shown first, by default all; `whole` are the panels of the picture, where not these.
    """
    lines = [line for panel in panels for line in panel.lines]
    data = {
        "title": title,
        "xLabel": x_label,
        "x": _abscissa(t),
        "marks": [round(float(mark), 6) for mark in marks],
        "views": [{"name": name, "from": a, "to": b} for name, a, b in views],
        "panels": [_panel(t, panel) for panel in panels],
    }
    if opening is not None:
        data["open"] = [round(float(end), 5) for end in opening]
    picture = chart(whole or panels, title=title, x_label=x_label, x_limits=(float(t[0]), float(t[-1])), marks=marks)
    return Curves(title, sentence, picture, key_of(lines), table, data)


def _abscissa(t: np.ndarray) -> dict[str, Any]:
    step = float(t[-1] - t[0]) / (len(t) - 1)
    even = float(np.abs(t - t[0] - step * np.arange(len(t))).max()) < 0.05 * step
    return {"start": float(t[0]), "step": step, "n": len(t)} if even else {"values": np.round(t, 6).tolist()}


def _panel(t: np.ndarray, panel: Panel) -> dict[str, Any]:
    if panel.strips:
        strips = [{"name": name, "on": np.round(intervals, 5).tolist()} for name, intervals in panel.strips]
        return {"label": panel.label, "height": panel.height, "strips": strips, "colour": panel.colour}
    lines = []
    for line in panel.lines:
        y = packed(line.y)
        if len(line.y) != len(t):
            y |= {"start": float(line.x[0]), "step": float(line.x[1] - line.x[0])}
        lines.append({"name": line.name, "colour": line.colour, "dash": list(line.dash), "y": y})
    return {"label": panel.label, "height": panel.height, "lines": lines}
