"""The error falling: dots for each state of a model, by axis, over noise floor and run-to-run spread."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.report.charts import style
from rockref.report.charts.dots import dots, level
from rockref.report.html.page import Page
from rockref.report.tables.table import Table

#: Errors of a state by axis [deg/s], with its name.
States = Sequence[tuple[str, Mapping[str, float]]]


def falling_figure(title: str, states: States, noise: float, spread: np.ndarray | None) -> tuple[str, str]:
    """Return (SVG, legend): errors of states by axis [deg/s], beside the two yardsticks."""
    levels = [level("noise floor", [noise] * len(AXES))]
    if spread is not None:
        levels.append(level("two repeated runs", spread, style.HOUSNER_DASH))
    numbers = [(name, [errors[axis] for axis in AXES]) for name, errors in states]
    return dots(title, AXES, numbers, levels, log=True, height=200.0)


def add_falling(page: Page, title: str, states: States, noise: float, spread: np.ndarray | None) -> None:
    """Add the figure to a page, with its numbers."""
    svg, keys = falling_figure(title, states, noise, spread)
    rows = [[axis, *(f"{errors[axis]:.4f}" for _, errors in states)] for axis in (*AXES, "total")]
    table = Table(f"{title}, deg/s", ("axis", *(name for name, _ in states)), rows)
    sentence = (
        "Dots: root mean square of the innovations of a model that listens to the record, by axis. Dashes: what noise "
        "alone makes, and by how much two repeated runs differ over the same time."
    )
    page.add_figure(svg, sentence, table, title, keys)


def by_use(title: str, places: Sequence[str], errors: Mapping[str, Sequence[float]], noise: float, x_label: str):
    """Return (SVG, legend): errors [deg/s] of fit and held-out runs over the states of a model; NaN for none."""
    states = [(words, errors[use]) for use, words in (("fit", "fit runs"), ("holdout", "held-out runs"))]
    return dots(title, places, states, [level("noise floor", [noise] * len(places))], x_label=x_label)


def history_figure(history: Sequence[dict], noise: float) -> tuple[str, str]:
    """Return (SVG, legend): the error of a model as effects were added, on fit and held-out runs."""
    errors = {use: [entry.get(f"{use}_deg_s", np.nan) for entry in history] for use in ("fit", "holdout")}
    names = [" + ".join(entry["effects"]) or "baseline" for entry in history]
    return by_use("The error as effects were added", names, errors, noise, "effects in the model")
