"""Figures in the manner of the source's Figure 3.4, as PNG and SVG files.

The three body rates of a whole run with the contact indices below, and zooms between main impacts.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.discover.compare.models import Comparison
from rockref.discover.compare.stretches import AXES
from rockref.model.channel import DEGREES
from rockref.model.storage import write_bytes
from rockref.report.charts import style
from rockref.report.charts.run_lines import contact_strips, housner_line
from rockref.report.tables import comparison_tables

# decided: the source zooms a little beyond the main impacts on either side.
BEYOND = 0.03


def write_figures(c: Comparison, folder: Path) -> list[Path]:
    """Write the figures of the first run as PNG and SVG and return their paths. Raises InputError E-WRITE."""
    written = []
    run = c.measured[0].run.id
    for name, figure in (("whole", whole_run(c, 0)), ("zooms", zooms(c, 0))):
        if figure is None:
            continue
        for kind in ("png", "svg"):
            path = folder / f"{c.experiment.name}_run{run}_{name}.{kind}"
            write_bytes(path, rendered(figure, kind))
            written.append(path)
    return written


def rendered(figure: Any, kind: str, dpi: float = 150) -> bytes:
    """Return a figure as the bytes of a PNG or SVG file; the same figure gives the same bytes."""
    import matplotlib

    buffer = io.BytesIO()
    # Ids from a fixed salt and no date: two runs of the program write the same file.
    with matplotlib.rc_context({"svg.hashsalt": "rockref", "svg.fonttype": "none"}):
        metadata = {"Date": None} if kind == "svg" else {"Software": None}
        figure.savefig(buffer, format=kind, dpi=dpi, metadata=metadata)
    return buffer.getvalue()


def new_figure(width: float, height: float) -> Any:
    """Return an empty figure, inches; no window system is asked for."""
    from matplotlib.figure import Figure

    figure: Any = Figure(figsize=(width, height))
    # A notebook shows a figure of pyplot by itself, and this one by its picture.
    figure._repr_png_ = lambda: rendered(figure, "png", dpi=80)
    # Fixed margins in inches: a layout that is searched for takes three times as long and moves with every drawing.
    left, right, top, bottom = 0.85 / width, 1.0 - 0.15 / width, 1.0 - 0.4 / height, 0.5 / height
    figure.subplots_adjust(left=left, right=right, top=top, bottom=bottom, hspace=0.12, wspace=0.16)
    return figure


def dressed(ax: Any, name: str | None = None, margin: float = 0.0, size: float = 8) -> None:
    """Give axes small numbers, a grid, room beside the curves as a share of their width, and what the ordinate is."""
    if name is not None:
        ax.set_ylabel(name, fontsize=8)
    ax.tick_params(labelsize=size)
    ax.margins(x=margin)
    ax.grid(color=style.GRID, lw=0.6)


def titled(figure: Any, words: str, size: float = 10) -> Any:
    """Return a figure with its title."""
    figure.suptitle(words, fontsize=size, x=0.02, ha="left")
    return figure


def whole_run(c: Comparison, k: int) -> Any:
    """Return the figure of a whole run: three rates, and the contact indices of each model as lines."""
    t = _times(c, k)
    figure = new_figure(9.0, 7.2 + 1.1 * len(c.names))
    ratios = [1.6, 1.0, 1.0, *([0.8] * len(c.names))]
    axes = figure.subplots(3 + len(c.names), 1, sharex=True, height_ratios=ratios)
    for axis in range(3):
        _rates(axes[axis], c, k, axis, float(t[0]), float(t[-1]))
    for i, name in enumerate(c.names):
        contact_plot(axes[3 + i], c, k, i, (float(t[0]), float(t[-1])))
        axes[3 + i].set_ylabel(f"contacts\n{name}", fontsize=8)
    axes[-1].set_xlabel("time (s)")
    axes[-1].set_xlim(float(t[0]), float(t[-1]))
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=5, frameon=False, fontsize=9)
    return titled(figure, f"{c.experiment.name}, run {comparison_tables.run_name(c, k)}")


def zooms(c: Comparison, k: int) -> Any | None:
    """Return the zooms: about the first main impact, between the first two, and the last arcs; None without impacts."""
    times = [float(v) for v in c.measured[k].features.impacts.times]
    if len(times) < 2:
        return None
    stretches = [(times[0] - 0.06, times[0] + 0.08), (times[0] - BEYOND, times[1] + BEYOND)]
    if len(times) > 4:
        stretches.append((times[-3] - BEYOND, times[-1] + BEYOND))
    models = range(len(c.names))
    figure = new_figure(4.0 * len(stretches), 6.3 + 1.2 * len(models))
    ratios = [1, 1, 1, *(0.7 for _ in models)]
    axes = figure.subplots(3 + len(models), len(stretches), squeeze=False, height_ratios=ratios, sharex="col")
    for column, (start, end) in enumerate(stretches):
        for axis in range(3):
            _rates(axes[axis][column], c, k, axis, start, end, labelled=column == 0)
        for i in models:
            contact_plot(axes[3 + i][column], c, k, i, (start, end), labelled=column == 0)
        axes[-1][column].set_xlim(start, end)
        axes[-1][column].set_xlabel("time (s)")
    for i, name in enumerate(c.names):
        axes[3 + i][0].set_ylabel(f"contacts\n{name}", fontsize=8)
    handles, labels = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=5, frameon=False, fontsize=9)
    return titled(figure, f"{c.experiment.name}, run {comparison_tables.run_name(c, k)}")


def _times(c: Comparison, k: int) -> np.ndarray:
    t = c.measured[k].run.t
    assert t is not None
    return t


def _rates(ax: Any, c: Comparison, k: int, axis: int, start: float, end: float, labelled: bool = True) -> None:
    run = c.measured[k].run
    assert run.t is not None and run.crv is not None
    inside = (run.t >= start) & (run.t <= end)
    t = run.t[inside]
    ax.plot(t, DEGREES * run.crv[inside, axis], color=style.INK, lw=0.9, label="measured")
    for i, name in enumerate(c.names):
        y = DEGREES * c.results[i][k].modelled[inside, axis]
        ax.plot(t, y, color=style.colour(i), lw=0.9, dashes=_dashes(style.dash(i)), label=name)
    if axis == 0:
        line = housner_line(c, k, float(run.t[-1]))
        keep = (line.x >= start - 0.01) & (line.x <= end + 0.01)
        ax.plot(
            line.x[keep], line.y[keep], color=style.GREY, lw=0.8, dashes=_dashes(style.HOUSNER_DASH), label="Housner"
        )
    mark_impacts(ax, c.measured[k].features.impacts.times, start, end)
    dressed(ax, f"{AXES[axis]}\n(deg/s)" if labelled else None)


def contact_plot(
    ax: Any, c: Comparison, k: int, model: int, stretch: tuple[float, float], labelled: bool = True
) -> None:
    """Draw the contact indices of one model in the run's time, and its main impacts."""
    contact_lines(ax, contact_strips(c.results[model][k]), style.colour(model), stretch, labelled)
    mark_impacts(ax, c.measured[k].features.impacts.times, *stretch)


def contact_lines(
    ax: Any, strips: Sequence[tuple[str, np.ndarray]], colour: str, stretch: tuple[float, float], labelled: bool = True
) -> None:
    """Draw a line for each contact point, (name, intervals (k, 2) s), while it touches within a stretch [s]."""
    for row, (_, intervals) in enumerate(strips):
        spans = [(a, b - a) for a, b in intervals if b > stretch[0] and a < stretch[1]]
        ax.broken_barh(spans, (len(strips) - row - 0.75, 0.5), color=colour, lw=0)
    ax.set_ylim(0, len(strips))
    ticks = [len(strips) - row - 0.5 for row in range(len(strips))]
    ax.set_yticks(ticks, [name for name, _ in strips] if labelled else [])
    ax.tick_params(labelsize=7)


def mark_impacts(ax: Any, times: np.ndarray, start: float, end: float) -> None:
    """Draw a red line at every main impact between start and end, s."""
    for time in times:
        if start <= time <= end:
            ax.axvline(float(time), color=style.IMPACT, lw=0.5)


def _dashes(dash: tuple[int, ...]) -> tuple[float, ...]:
    return tuple(0.8 * d for d in dash)
