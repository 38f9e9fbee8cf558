"""The error falling: dots for each state of a model, by stretch and axis, over noise floor and run-to-run spread."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.discover.add import cell_names
from rockref.discover.fit.errors import STRETCH_WORDS, STRETCHES
from rockref.report import style
from rockref.report.drawing import Line, Panel, chart, key
from rockref.report.page import Page, Table


def levels(name: str, values: Sequence[float], dash: tuple[int, ...]) -> Line:
    """Short level lines at the places 0, 1, ...; a place without a number has none."""
    known = [(k, v) for k, v in enumerate(values) if np.isfinite(v)]
    x = np.array([c for k, _ in known for c in (k - 0.38, k + 0.38, k + 0.38)])
    y = np.array([c for _, v in known for c in (v, v, np.nan)])
    return Line(name, x, y, style.GREY, dash, 1.6)


def falling_figure(
    title: str, states: Sequence[tuple[str, np.ndarray]], noise: float, spread: np.ndarray | None
) -> tuple[str, str]:
    """Return (SVG, legend): errors of states, (name, nine numbers in deg/s each), beside the two yardsticks."""
    names = cell_names()
    lines = [levels("noise floor", [noise] * len(names), (2, 2))]
    if spread is not None:
        lines.append(levels("two repeated runs", [*spread] * len(STRETCHES), style.HOUSNER_DASH))
    for k, (name, values) in enumerate(states):
        places = np.arange(len(names)) + 0.16 * (k - 0.5 * (len(states) - 1))
        lines.append(Line(name, places, np.asarray(values, float), style.colour(k), dots=True))
    svg = chart(
        [Panel("error (deg/s)", lines, log=True, height=200.0)],
        title=title,
        x_label=" | ".join(STRETCH_WORDS[s] for s in STRETCHES),
        x_limits=(-0.6, len(names) - 0.4),
        marks=(2.5, 5.5),
        ticks=[(float(k), f"{axis[:5]}." if len(axis) > 5 else axis) for k, (_, axis) in enumerate(names)],
    )
    return svg, key([(line.name, line.colour, line.dash) for line in lines])


def add_falling(
    page: Page, title: str, states: Sequence[tuple[str, np.ndarray]], noise: float, spread: np.ndarray | None
) -> None:
    """Add the figure to a page, with its numbers."""
    svg, keys = falling_figure(title, states, noise, spread)
    rows = [
        [STRETCH_WORDS[s], axis, *(f"{v[k]:.4f}" if np.isfinite(v[k]) else "–" for _, v in states)]
        for k, (s, axis) in enumerate(cell_names())
    ]
    table = Table(f"{title}, deg/s", ("stretch", "axis", *(name for name, _ in states)), rows)
    sentence = (
        "Dots: quadratic mean of measured minus modelled over windows of 50 to 90 ms, by axis. Dashes: what noise "
        "alone makes, and by how much two repeated runs differ over the same time."
    )
    page.add_figure(svg, sentence, table, title, keys)


def history_figure(history: Sequence[dict], noise: float) -> tuple[str, str]:
    """Return (SVG, legend): the error of a model as it grew, on fit and held-out runs."""
    lines = []
    for k, (use, words) in enumerate((("fit", "fit runs"), ("holdout", "held-out runs"))):
        y = np.array([entry.get(f"{use}_deg_s", np.nan) for entry in history], float)
        lines.append(Line(words, np.arange(len(y), dtype=float), y, style.colour(k), dots=True))
    lines.insert(0, levels("noise floor", [noise] * len(history), (2, 2)))
    names = [" + ".join(entry["effects"]) or "baseline" for entry in history]
    svg = chart(
        [Panel("error (deg/s)", lines, height=170.0, limits=(0.0, 1.1 * _largest(lines)))],
        title="The error as the model grew",
        x_label="effects in the model",
        x_limits=(-0.6, len(history) - 0.4),
        ticks=[(float(k), name) for k, name in enumerate(names)],
    )
    return svg, key([(line.name, line.colour, line.dash) for line in lines])


def _largest(lines: Sequence[Line]) -> float:
    return max((float(np.nanmax(line.y)) for line in lines if np.isfinite(line.y).any()), default=1.0)
