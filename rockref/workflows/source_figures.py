"""The figures of `rockref reproduce`: the response as Fig. 3.4, twins, the way from 54 genes to 12, the models that
failed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.model.channel import DEGREES
from rockref.model.housner import HousnerResponse
from rockref.model.response import Response
from rockref.report.charts import style
from rockref.report.charts.drawing import draw
from rockref.report.charts.figures import dressed, new_figure, titled
from rockref.report.charts.run_panels import housner_line, response_panels

#: The stretches of Fig. 3.4 [s]: the whole record; about the first main impact; the first two; the ninth to eleventh.
WHOLE, ABOUT_FIRST, FIRST_TWO, LATE = (0.0, 14.0), (0.46, 0.62), (0.45, 1.40), (4.8, 5.9)


def response_figures(response: Response, plane: HousnerResponse) -> dict[str, Any]:
    """Return by name of file the rates and contacts of a run with Housner's block, whole and zooms (as Fig. 3.4)."""
    panels = response_panels(response, "eight points", style.INK, housner_line(plane))
    marks = response.main_impacts()
    zooms = "Zooms (as Fig. 3.4b to 3.4j); red: main impacts"
    return {
        "figure_3_4_whole": draw(panels, [WHOLE], marks=marks, title="The release of Table 3.1 (as Fig. 3.4a)"),
        "figure_3_4_zooms": draw(panels, [ABOUT_FIRST, FIRST_TWO, LATE], marks=marks, title=zooms),
    }


def twins_figure(rows: Sequence[dict[str, Any]]) -> Any:
    """Return what came back, by parameter: error in units of the last digit, two standard errors as bars, a place a
    seed."""
    figure = new_figure(10.0, 4.2)
    ax = figure.subplots(1, 1)
    names = list(rows[0]["parameters"])
    for k, row in enumerate(rows):
        x = np.arange(len(names)) + 0.8 * (k - (len(rows) - 1) / 2) / max(1, len(rows))
        off = np.array([row["parameters"][n]["off"] for n in names])
        error = np.array([2 * row["parameters"][n]["error"] for n in names])
        colour = style.COLOURS[1] if row["at_floor"] else style.IMPACT
        ax.errorbar(x, off, error, fmt="o", ms=3, lw=0.7, color=colour)
    ax.axhspan(-1, 1, color=style.BAND, alpha=0.6, lw=0)
    ax.set_yscale("symlog", linthresh=1.0)
    ax.set_xticks(np.arange(len(names)), names, rotation=25, ha="right", fontsize=8)
    ax.set_ylabel("error in last digits")
    ax.grid(axis="y", color=style.GRID, lw=0.6)
    figure.subplots_adjust(bottom=0.2)
    title = "Twin experiments, found minus true; blue: at the noise floor, red: above it; grey: one last digit"
    return titled(figure, title, 9)


def reduction_figure(result: dict[str, Any]) -> Any:
    """Return the best chromosomes over the generations, a panel for each group of the source's reduction."""
    figure = new_figure(11.0, 5.6)
    axes = figure.subplots(2, 3, sharex=True, sharey=True).ravel()
    way, names = np.array(result["ways"]), result["genes"]
    for ax, group in zip(axes, result["groups"], strict=True):
        for k, name in enumerate(group["genes"]):
            ax.plot(way[:, names.index(name)], lw=0.9, color=style.colour(k), alpha=0.8)
        ax.set_title(group["group"], fontsize=8)
        ax.set_ylim(-0.02, 1.02)
        ax.tick_params(labelsize=8)
        ax.grid(color=style.GRID, lw=0.6)
    for ax in axes[3:]:
        ax.set_xlabel("generation", fontsize=8)
    for ax in axes[::3]:
        ax.set_ylabel("in parts of the range", fontsize=8)
    figure.subplots_adjust(hspace=0.25, top=0.88)
    return titled(figure, "Genes of the best chromosome, 54-gene search")


def scenarios_figure(t: np.ndarray, wanted: np.ndarray, found: Sequence[tuple[str, np.ndarray, np.ndarray]]) -> Any:
    """Return transverse and longitudinal rate of some models, (name, t, crv), beside the reference, in deg/s."""
    figure = new_figure(11.0, 1.5 + 1.45 * len(found))
    axes = figure.subplots(len(found), 2, sharex=True, squeeze=False)
    for row, (name, at, crv) in enumerate(found):
        for column, axis in enumerate((1, 2)):
            ax = axes[row][column]
            ax.plot(t, DEGREES * wanted[:, axis], color=style.INK, lw=0.9, label="reference")
            ax.plot(at, DEGREES * crv[:, axis], color=style.COLOURS[0], lw=0.9, label="model")
            ax.set_xlim(*FIRST_TWO)
            dressed(ax, size=7)
            limit = 1.6 * DEGREES * np.abs(wanted[:, axis]).max()
            ax.set_ylim(-limit, limit)
        axes[row][0].set_title(name, fontsize=8, loc="left", pad=2)
    axes[0][1].legend(frameon=False, fontsize=8, loc="upper right", ncols=2)
    for column, name in enumerate(style.AXIS_NAMES[1:]):
        axes[-1][column].set_xlabel(f"time (s); {name} in deg/s", fontsize=8)
    figure.subplots_adjust(hspace=0.35, top=1.0 - 0.65 / figure.get_figheight())
    return titled(figure, "The models that failed, each at its best")
