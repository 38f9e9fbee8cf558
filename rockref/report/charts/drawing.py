"""Panels of curves, dots and strips above one another: as a figure, and as SVG that a page shows without scripts."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

import numpy as np

from rockref.report.charts.figures import dressed, mark_impacts, new_figure, plain_ticks, rendered, titled
from rockref.report.charts.shorten import shortened
from rockref.report.charts.style import COLOURS, GREY, INK

#: Pixels of a chart on a page: its width, what is above and below its panels, and between them.
WIDTH, TOP, BOTTOM, BETWEEN = 860.0, 8.0, 34.0, 10.0
#: Shortest piece of a strip as a share of the width; decided: what the eye still sees.
SHORTEST = 5e-4
#: Size of letters and numbers [pixels].
LETTERS = 11.0
#: Outlines about the origin that a legend shows, and matplotlib's letters for them: as different as they can be at six
#: pixels.
MARKERS = {
    "o": "M-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0Z",
    "s": "M-2.8-2.8h5.6v5.6h-5.6Z",
    "D": "M0-4L4 0L0 4L-4 0Z",
    "^": "M0-3.6L3.6 3H-3.6Z",
    "P": "M-1-3.5h2v2.5h2.5v2h-2.5v2.5h-2v-2.5h-2.5v-2h2.5Z",
}


@dataclass(frozen=True, eq=False)
class Line:
    """A curve: ``name``, ``x`` and ``y`` (N,), ``colour``, ``dash`` and ``width`` in pixels. NaN leaves a gap."""

    name: str
    x: np.ndarray
    y: np.ndarray
    colour: str = INK
    dash: tuple[int, ...] = ()
    width: float = 1.2
    dots: bool = False

    def within(self, stretch: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
        """Return abscissae and ordinates of the points in a stretch."""
        x, y = np.asarray(self.x, float), np.asarray(self.y, float)
        inside = (x >= stretch[0]) & (x <= stretch[1])
        return x[inside], y[inside]


@dataclass(frozen=True, eq=False)
class Panel:
    """One frame of a chart: ``label`` of its ordinate, ``lines``; ``strips`` (name, intervals (k, 2)) instead of lines
    draws one row for each; ``band`` (x, low, high, colour) behind; ``log`` ordinate; ``limits`` of it or None."""

    label: str
    lines: Sequence[Line] = ()
    strips: Sequence[tuple[str, np.ndarray]] = ()
    band: tuple[np.ndarray, np.ndarray, np.ndarray, str] | None = None
    height: float = 130.0
    log: bool = False
    limits: tuple[float, float] | None = None
    colour: str = GREY


def draw(
    panels: Sequence[Panel],
    stretches: Sequence[tuple[float, float]],
    *,
    x_label: str = "time (s)",
    marks: Sequence[float] | np.ndarray = (),
    ticks: Sequence[tuple[float, str]] = (),
    title: str = "",
) -> Any:
    """Return a figure of panels above one another, a column for each stretch of the abscissa.

    `marks` are abscissae of vertical lines (main impacts); `ticks` (place, text) replace the numbers of the abscissa. A
    figure with a title has a legend beside it.
    """
    top = TOP if not title else 30.0
    heights = [panel.height for panel in panels]
    height = top + sum(heights) + BETWEEN * (len(panels) - 1) + BOTTOM
    figure = new_figure(WIDTH / 72, height / 72)
    space = BETWEEN * len(panels) / sum(heights)
    figure.subplots_adjust(top=1.0 - top / height, bottom=BOTTOM / height, hspace=space)
    axes = figure.subplots(len(panels), len(stretches), squeeze=False, sharex="col", height_ratios=heights)
    for place, (column, stretch) in enumerate(zip(axes.T, stretches, strict=True)):
        for ax, panel in zip(column, panels, strict=True):
            _panel(ax, panel, stretch, place == 0)
            mark_impacts(ax, marks, *stretch)
        column[-1].set_xlim(stretch)
        column[-1].set_xlabel(x_label, fontsize=LETTERS)
        if ticks:
            column[-1].set_xticks(*zip(*ticks, strict=True))
    if title:
        handles, labels = axes[0][0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="upper right", ncols=5, frameon=False, fontsize=LETTERS)
    return titled(figure, title, LETTERS + 1.0) if title else figure


def _panel(ax: Any, panel: Panel, stretch: tuple[float, float], labelled: bool) -> None:
    if panel.strips:
        _strips(ax, panel, stretch, labelled)
    if panel.band is not None:
        x, low, high, colour = panel.band
        ax.fill_between(x, low, high, color=colour, alpha=0.6, lw=0)
    for line in panel.lines:
        x, y = line.within(stretch)
        look: dict[str, Any] = {"lw": line.width, "color": line.colour, "label": line.name}
        if line.dash:
            look["dashes"] = [pixels / line.width for pixels in line.dash]
        if line.dots:
            look |= {"ls": "none", "marker": _letter(line.colour), "ms": 6, "mew": 0}
        ax.plot(x, y, **look)
    if panel.log:
        ax.set_yscale("log")
        plain_ticks(ax.yaxis, (1.0,))
    if limits := panel.limits or (_decades(panel) if panel.log else None):
        ax.set_ylim(limits)
    dressed(ax, panel.label if labelled else None, size=LETTERS)
    if panel.strips:
        ax.grid(visible=False, axis="y")


def _strips(ax: Any, panel: Panel, stretch: tuple[float, float], labelled: bool) -> None:
    """Draw a row for each contact point while it touches within a stretch."""
    rows, shortest = len(panel.strips), SHORTEST * (stretch[1] - stretch[0])
    for row, (_, intervals) in enumerate(panel.strips, 1):
        spans = [(max(a, stretch[0]), min(b, stretch[1])) for a, b in intervals if b > stretch[0] and a < stretch[1]]
        x = [end for a, b in spans for end in (a, max(b, a + shortest), np.nan)]
        thick = 0.56 * panel.height / rows
        ax.plot(x, np.full(len(x), rows - row + 0.5), color=panel.colour, lw=thick, solid_capstyle="butt")
    ax.set_ylim(0, rows)
    ax.set_yticks(rows - 0.5 - np.arange(rows), [name if labelled else "" for name, _ in panel.strips])


def _decades(panel: Panel) -> tuple[float, float]:
    """Return the powers of ten around the positive values of a panel."""
    values = np.concatenate([np.asarray(line.y, float) for line in panel.lines])
    values = values[np.isfinite(values) & (values > 0.0)]
    ends = math.floor(math.log10(values.min())), math.ceil(math.log10(values.max() * 1.05))
    return 10.0 ** ends[0], 10.0 ** ends[1]


def _letter(colour: str) -> str:
    """Return the marker of a model by its colour: circle, square, diamond, triangle or cross."""
    return list(MARKERS)[COLOURS.index(colour) if colour in COLOURS else 0]


def chart(
    panels: Sequence[Panel],
    *,
    title: str,
    x_label: str,
    x_limits: tuple[float, float] | None = None,
    marks: Sequence[float] = (),
    ticks: Sequence[tuple[float, str]] = (),
) -> str:
    """Return panels as SVG for a page, which says its title to those who do not see (see :func:`draw`)."""
    ends = [float(end) for panel in panels for line in panel.lines for end in (np.min(line.x), np.max(line.x))]
    figure = draw(panels, [x_limits or (min(ends), max(ends))], x_label=x_label, marks=marks, ticks=ticks)
    return inside_page(figure, title, "chart")


def inside_page(figure: Any, title: str, kind: str) -> str:
    """Return a figure as SVG of a class `kind`, which says its title to those who do not see."""
    for ground in (figure, *figure.axes):
        ground.patch.set_visible(False)
    for artist in figure.findobj():
        # What lies in the stretch needs no clipping; each clip would have an id.
        artist.set_clip_on(False)
    text = rendered(figure, "svg", salt=title).decode()
    width, height = 72.0 * figure.get_size_inches()
    return (
        f'<svg class="{kind}" viewBox="0 0 {width:g} {height:g}" role="img" aria-label="{escape(title)}">'
        f"<title>{escape(title)}</title>{shortened(text)}</svg>"
    )


def key_of(lines: Iterable[Line]) -> str:
    """Return the legend of lines, each name once."""
    once = list({line.name: line for line in lines}.values())
    return key([(line.name, line.colour, line.dash) for line in once], {line.name for line in once if line.dots})


def key(entries: Sequence[tuple[str, str, tuple[int, ...]]], dots: Collection[str] = ()) -> str:
    """Return a legend as HTML: (name, colour, dash) with a piece of each line, or the dot of those named in `dots`."""
    items = []
    for name, colour, dash in entries:
        dashes = f' stroke-dasharray="{" ".join(map(str, dash))}"' if dash else ""
        path = f'<path d="M1 4h28" stroke="{colour}" stroke-width="2"{dashes}/>'
        if name in dots:
            path = f'<path transform="translate(15 4)" d="{MARKERS[_letter(colour)]}" style="fill:{colour}"/>'
        sample = f'<svg viewBox="0 0 30 8" aria-hidden="true">{path}</svg>'
        items.append(f'<span class="key">{sample}{escape(name)}</span>')
    return f'<p class="keys">{"".join(items)}</p>'
