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
from rockref.report.charts.figures import contact_lines, dressed, mark_impacts, new_figure, titled

#: The stretches of Fig. 3.4 [s]: the whole record; about the first main impact; the first two; the ninth to eleventh.
WHOLE, ABOUT_FIRST, FIRST_TWO, LATE = (0.0, 14.0), (0.46, 0.62), (0.45, 1.40), (4.8, 5.9)


def response_figure(response: Response, plane: HousnerResponse) -> Any:
    """Return rates over the whole run, contact indices below; Housner's model on the main axis (as Fig. 3.4a)."""
    figure = new_figure(10.0, 7.6)
    axes = figure.subplots(4, 1, sharex=True, height_ratios=[1.3, 1.0, 1.0, 1.0])
    _rates(axes[:3], response, plane, WHOLE)
    _contacts(axes[3], response, WHOLE)
    axes[3].set_xlabel("time (s)")
    axes[0].legend(loc="upper right", frameon=False, fontsize=8)
    return titled(figure, "The release of Table 3.1 (as Fig. 3.4a)")


def zooms_figure(response: Response, plane: HousnerResponse) -> Any:
    """Return zooms: about the first main impact, between the first two, ninth to eleventh (as Fig. 3.4b to 3.4j)."""
    figure = new_figure(12.0, 7.4)
    stretches = (ABOUT_FIRST, FIRST_TWO, LATE)
    axes = figure.subplots(4, 3, sharex="col", height_ratios=[1, 1, 1, 0.9])
    for column, stretch in enumerate(stretches):
        _rates(axes[:3, column], response, plane, stretch, labelled=column == 0)
        _contacts(axes[3][column], response, stretch, labelled=column == 0)
        axes[3][column].set_xlabel("time (s)")
    return titled(figure, "Zooms (as Fig. 3.4b to 3.4j); red: main impacts")


def _rates(axes: Any, response: Response, plane: HousnerResponse, stretch: tuple[float, float], labelled=True) -> None:
    inside = (response.t >= stretch[0]) & (response.t <= stretch[1])
    for axis, ax in enumerate(axes):
        ax.plot(response.t[inside], response.crv[inside, axis], color=style.INK, lw=0.8, label="eight points")
        if axis == 0:
            also = (plane.t >= stretch[0]) & (plane.t <= stretch[1])
            ax.plot(
                plane.t[also], DEGREES * plane.rate[also], color=style.GREY, lw=0.8, ls=(0, (5, 4)), label="Housner"
            )
        mark_impacts(ax, response.main_impacts(), *stretch)
        dressed(ax, f"{style.AXIS_NAMES[axis]}\n(deg/s)" if labelled else None)


def _contacts(ax: Any, response: Response, stretch: tuple[float, float], labelled: bool = True) -> None:
    contact_lines(ax, response.contacts(), style.COLOURS[0], stretch, labelled)
    ax.set_xlim(stretch)
    mark_impacts(ax, response.main_impacts(), *stretch)


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
