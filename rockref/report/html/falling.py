"""The error falling: dots for each state of a model, by axis, over noise floor and run-to-run spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.report.charts import style
from rockref.report.charts.drawing import Line, Panel, chart, key_of
from rockref.report.html.page import Page
from rockref.report.tables.table import Table


def levels(name: str, values: Sequence[float], dash: tuple[int, ...]) -> Line:
    """Return short level lines at the places 0, 1, ...; a place without a number has none."""
    known = [(k, v) for k, v in enumerate(values) if np.isfinite(v)]
    x = np.array([c for k, _ in known for c in (k - 0.38, k + 0.38, k + 0.38)])
    y = np.array([c for _, v in known for c in (v, v, np.nan)])
    return Line(name, x, y, style.GREY, dash, 1.6)


def falling_figure(
    title: str, states: Sequence[tuple[str, Mapping[str, float]]], noise: float, spread: np.ndarray | None
) -> tuple[str, str]:
    """Return (SVG, legend): errors of states by axis [deg/s], beside the two yardsticks."""
    lines = [levels("noise floor", [noise] * len(AXES), (2, 2))]
    if spread is not None:
        lines.append(levels("two repeated runs", [*spread], style.HOUSNER_DASH))
    for k, (name, errors) in enumerate(states):
        places = np.arange(len(AXES)) + 0.16 * (k - 0.5 * (len(states) - 1))
        lines.append(Line(name, places, np.array([errors[axis] for axis in AXES]), style.colour(k), dots=True))
    svg = chart(
        [Panel("error (deg/s)", lines, log=True, height=200.0)],
        title=title,
        x_label="axis",
        x_limits=(-0.6, len(AXES) - 0.4),
        ticks=[(float(k), axis) for k, axis in enumerate(AXES)],
    )
    return svg, key_of(lines)


def add_falling(
    page: Page, title: str, states: Sequence[tuple[str, Mapping[str, float]]], noise: float, spread: np.ndarray | None
) -> None:
    """Add the figure to a page, with its numbers."""
    svg, keys = falling_figure(title, states, noise, spread)
    rows = [[axis, *(f"{errors[axis]:.4f}" for _, errors in states)] for axis in (*AXES, "total")]
    table = Table(f"{title}, deg/s", ("axis", *(name for name, _ in states)), rows)
    sentence = (
        "Dots: root mean square of the innovations of a model that listens to the record, by axis. Dashes: what noise "
        "alone makes, and by how much two repeated runs differ over the same time."
    )
    page.add_figure(svg, sentence, table, title, keys)


def history_figure(history: Sequence[dict], noise: float) -> tuple[str, str]:
    """Return (SVG, legend): the error of a model as effects were added, on fit and held-out runs."""
    lines = []
    for k, (use, words) in enumerate((("fit", "fit runs"), ("holdout", "held-out runs"))):
        y = np.array([entry.get(f"{use}_deg_s", np.nan) for entry in history], float)
        lines.append(Line(words, np.arange(len(y), dtype=float), y, style.colour(k), dots=True))
    lines.insert(0, levels("noise floor", [noise] * len(history), (2, 2)))
    names = [" + ".join(entry["effects"]) or "baseline" for entry in history]
    svg = chart(
        [Panel("error (deg/s)", lines, height=170.0, limits=(0.0, 1.1 * _largest(lines)))],
        title="The error as effects were added",
        x_label="effects in the model",
        x_limits=(-0.6, len(history) - 0.4),
        ticks=[(float(k), name) for k, name in enumerate(names)],
    )
    return svg, key_of(lines)


def _largest(lines: Sequence[Line]) -> float:
    return max((float(np.nanmax(line.y)) for line in lines if np.isfinite(line.y).any()), default=1.0)
