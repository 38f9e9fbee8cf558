"""Matplotlib figures of the house, and their files: empty, dressed, titled, written."""

from __future__ import annotations

import io
from typing import Any

import numpy as np

from rockref.report.charts import style


def rendered(figure: Any, kind: str, dpi: float = 150, salt: str = "rockref") -> bytes:
    """Return a figure as the bytes of a PNG or SVG file; the same figure gives the same bytes."""
    import matplotlib

    buffer = io.BytesIO()
    # Ids from a fixed salt and no date: two runs of the program write the same file. Curves keep to half their width.
    look: Any = {"svg.hashsalt": salt, "svg.fonttype": "none", "path.simplify_threshold": 0.6}
    with matplotlib.rc_context(look):
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


def one_panel(width: float, height: float, x: str, y: str) -> tuple[Any, Any]:
    """Return a figure, inches, and its only axes with a grid and what they are."""
    figure = new_figure(width, height)
    ax = figure.subplots(1, 1)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.grid(color=style.GRID, lw=0.6)
    return figure, ax


def dressed(ax: Any, name: str | None = None, margin: float = 0.0, size: float = 8) -> None:
    """Give axes a pale frame and grid, small numbers, room beside the curves as a share, and what the ordinate is."""
    if name is not None:
        ax.set_ylabel(name, fontsize=size)
    ax.tick_params(labelsize=size, left=False, bottom=False, which="both")
    ax.margins(x=margin)
    ax.grid(color=style.GRID, lw=0.6)
    for side in ax.spines.values():
        side.set_color(style.FRAME)


def titled(figure: Any, words: str, size: float = 10) -> Any:
    """Return a figure with its title."""
    figure.suptitle(words, fontsize=size, x=0.02, ha="left")
    return figure


def mark_impacts(ax: Any, times: Any, start: float, end: float) -> None:
    """Draw a red line at every main impact between start and end, s."""
    for time in np.asarray(times, float):
        if start <= time <= end:
            ax.axvline(float(time), color=style.IMPACT, lw=0.6)


#: Decades that an axis can show with all its numbers; decided: beyond, numbers of 1e-3 and less run into each other.
MANY_DECADES = 4.0


def plain_ticks(axis: Any, at: tuple[float, ...] = (1.0, 2.0, 5.0)) -> None:
    """Label a logarithmic axis with plain numbers, `at` of each decade; of many decades with powers of ten alone."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    low, high = axis.get_data_interval()
    many = low > 0.0 and np.log10(high / low) > MANY_DECADES
    axis.set_major_locator(LogLocator(subs=(1.0,) if many else at, numticks=15))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())
