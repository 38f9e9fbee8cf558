"""Line charts, strips and dots as plain SVG text: small, printable, readable without scripts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from html import escape

import numpy as np

from rockref.report.charts.style import COLOURS, GREY, IMPACT, INK

WIDTH, LEFT, RIGHT, TOP, BOTTOM = 860.0, 62.0, 12.0, 8.0, 34.0
# decided: half the width of a line; what is left out is not seen.
TOLERANCE = 0.6


#: Outlines about the origin, as different as they can be at six pixels.
MARKERS = (
    "M-3 0a3 3 0 1 0 6 0a3 3 0 1 0-6 0Z",
    "M-2.8-2.8h5.6v5.6h-5.6Z",
    "M0-4L4 0L0 4L-4 0Z",
    "M0-3.6L3.6 3H-3.6Z",
    "M-1-3.5h2v2.5h2.5v2h-2.5v2.5h-2v-2.5h-2.5v-2h2.5Z",
)


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
    levels: Sequence[tuple[str, float]] = field(default=())


def chart(
    panels: Sequence[Panel],
    *,
    title: str,
    x_label: str,
    x_limits: tuple[float, float] | None = None,
    marks: Sequence[float] = (),
    ticks: Sequence[tuple[float, str]] | None = None,
) -> str:
    """Return an SVG with panels above one another and one common abscissa.

    `marks` are abscissae of vertical lines (main impacts); `ticks` (place, text) replace the numbers of the abscissa.
    """
    x0, x1 = x_limits or _extent([line.x for panel in panels for line in panel.lines])
    height = TOP + sum(panel.height + 10.0 for panel in panels) + BOTTOM
    inner = WIDTH - LEFT - RIGHT
    across = _Scale(x0, x1, LEFT, LEFT + inner)
    parts = [
        f'<svg class="chart" viewBox="0 0 {WIDTH:g} {height:g}" role="img" aria-label="{escape(title)}">',
        f"<title>{escape(title)}</title>",
    ]
    top = TOP
    places = list(ticks) if ticks is not None else [(v, _number(v)) for v in nice_ticks(x0, x1, 9)]
    for panel in panels:
        parts.append(_panel(panel, across, top, inner, marks, [v for v, _ in places]))
        top += panel.height + 10.0
    baseline = top - 10.0
    for value, text in places:
        parts.append(_text(across(value), baseline + 15.0, text, "middle"))
    parts.append(_text(LEFT + 0.5 * inner, baseline + 30.0, x_label, "middle"))
    parts.append("</svg>")
    return "".join(parts)


@dataclass(frozen=True)
class _Scale:
    low: float
    high: float
    start: float
    end: float
    log: bool = False

    def __call__(self, value):
        a, b = (math.log10(self.low), math.log10(self.high)) if self.log else (self.low, self.high)
        v = np.log10(np.maximum(value, 1e-300)) if self.log else value
        return self.start + (v - a) / ((b - a) or 1.0) * (self.end - self.start)


def _panel(panel: Panel, across: _Scale, top: float, inner: float, marks: Sequence[float], grid: list[float]) -> str:
    bottom = top + panel.height
    parts = [f'<rect x="{LEFT:g}" y="{top:g}" width="{inner:g}" height="{panel.height:g}" class="frame"/>']
    parts += [f'<path class="grid" d="M{across(v):.1f} {top:g}V{bottom:g}"/>' for v in grid]
    place = f"translate(13 {0.5 * (top + bottom):.0f}) rotate(-90)"
    parts.append(f'<text class="label" transform="{place}">{escape(panel.label)}</text>')
    if panel.strips:
        parts.append(_strips(panel, across, top))
    else:
        low, high = panel.limits or _limits(panel)
        up = _Scale(low, high, bottom, top, panel.log)
        for v in _log_ticks(low, high) if panel.log else nice_ticks(low, high, 5):
            parts.append(f'<path class="grid" d="M{LEFT:g} {up(v):.1f}h{inner:g}"/>')
            parts.append(_text(LEFT - 5.0, up(v) + 3.5, _number(v), "end"))
        if panel.band is not None:
            parts.append(_band(panel.band, across, up, inner))
        for name, value in panel.levels:
            parts.append(f'<path d="M{LEFT:g} {up(value):.1f}h{inner:g}" stroke="{GREY}" stroke-dasharray="2 3"/>')
            parts.append(_text(LEFT + inner - 4.0, up(value) - 3.0, name, "end"))
        parts += [_line(line, across, up, inner) for line in panel.lines]
    for mark in marks:
        if across.low <= mark <= across.high:
            parts.append(f'<path d="M{across(mark):.1f} {top:g}V{bottom:g}" stroke="{IMPACT}" stroke-width="0.7"/>')
    return "".join(parts)


def _strips(panel: Panel, across: _Scale, top: float) -> str:
    step = panel.height / len(panel.strips)
    parts = []
    for k, (name, intervals) in enumerate(panel.strips):
        y = top + (k + 0.5) * step
        parts.append(_text(LEFT - 5.0, y + 3.5, name, "end"))
        inside = [(max(a, across.low), min(b, across.high)) for a, b in intervals if b > across.low and a < across.high]
        # Contacts closer than half a pixel are drawn as one.
        moves = "".join(
            f"M{across(a):.1f} {y:.1f}H{max(across(b), across(a) + 0.4):.1f}" for a, b in _merged(inside, across)
        )
        parts.append(f'<path d="{moves}" stroke="{panel.colour}" stroke-width="{0.55 * step:.1f}"/>')
    return "".join(parts)


def _merged(intervals: list[tuple[float, float]], across: _Scale) -> list[tuple[float, float]]:
    least = 0.5 * (across.high - across.low) / (across.end - across.start)
    out: list[tuple[float, float]] = []
    for a, b in intervals:
        if out and a - out[-1][1] < least:
            out[-1] = (out[-1][0], b)
        else:
            out.append((a, b))
    return out


def _band(band: tuple, across: _Scale, up: _Scale, inner: float) -> str:
    x, low, high, colour = band
    pick = np.unique(np.linspace(0, len(x) - 1, min(len(x), int(inner / 2))).astype(int))
    forth = [f"{across(x[i]):.1f} {_clipped(up, low[i]):.1f}" for i in pick]
    back = [f"{across(x[i]):.1f} {_clipped(up, high[i]):.1f}" for i in pick[::-1]]
    return f'<path d="M{"L".join(forth + back)}Z" style="fill:{colour};opacity:.6"/>'


def _clipped(up: _Scale, value: float) -> float:
    return min(max(float(up(value)), min(up.start, up.end)), max(up.start, up.end))


def _line(line: Line, across: _Scale, up: _Scale, inner: float) -> str:
    x, y = np.asarray(line.x, float), np.asarray(line.y, float)
    inside = (x >= across.low) & (x <= across.high)
    x, y = x[inside], y[inside]
    px, py = across(x), np.clip(up(y), up.end - 1.0, up.start + 1.0)
    if line.dots:
        px, py = px[np.isfinite(py)], py[np.isfinite(py)]
        return "".join(marker(a, b, line.colour) for a, b in zip(px, py, strict=True))
    dash = f' stroke-dasharray="{" ".join(map(str, line.dash))}"' if line.dash else ""
    gaps = np.flatnonzero(~np.isfinite(py))
    bounds = zip([0, *(gaps + 1)], [*gaps, len(py)], strict=True)
    path = "".join(_path(*thinned(px[a:b], py[a:b])) for a, b in bounds if b > a) or "M0 0"
    return f'<path d="{path}" stroke="{line.colour}" stroke-width="{line.width:g}"{dash}/>'


def marker(x: float, y: float, colour: str) -> str:
    """Return a dot at x, y in pixels: circle, square, diamond, triangle or cross for the first to the fifth model."""
    shape = MARKERS[COLOURS.index(colour)] if colour in COLOURS else MARKERS[0]
    return f'<path transform="translate({x:.1f} {y:.1f})" d="{shape}" style="fill:{colour}" stroke="none"/>'


def thinned(px: np.ndarray, py: np.ndarray, tolerance: float = TOLERANCE) -> tuple[np.ndarray, np.ndarray]:
    """Return the points of a curve in pixels (N,) whose polygon keeps within `tolerance` pixels of all of them.

    Ramer (1972), Douglas and Peucker (1973), by vertical distance: abscissae run forward.
    """
    keep = np.zeros(len(px), dtype=bool)
    keep[[0, -1]] = True
    open_pieces = [(0, len(px) - 1)]
    while open_pieces:
        a, b = open_pieces.pop()
        if b - a < 2:
            continue
        slope = (py[b] - py[a]) / ((px[b] - px[a]) or 1.0)
        off = np.abs(py[a + 1 : b] - py[a] - slope * (px[a + 1 : b] - px[a]))
        far = int(np.argmax(off))
        if off[far] > tolerance:
            middle = a + 1 + far
            keep[middle] = True
            open_pieces += [(a, middle), (middle, b)]
    return px[keep], py[keep]


def _path(px: np.ndarray, py: np.ndarray) -> str:
    """Return path data with relative moves in tenths of a pixel: half the size of absolute ones."""
    x, y = np.rint(10.0 * px).astype(int), np.rint(10.0 * py).astype(int)
    moves = [f"{_tenth(dx)} {_tenth(dy)}" for dx, dy in zip(np.diff(x), np.diff(y), strict=True)]
    return f"M{_tenth(x[0])} {_tenth(y[0])}" + (f"l{' '.join(moves)}" if moves else "")


def _tenth(value: int) -> str:
    whole = f"{value / 10:.1f}"
    return whole[:-2] if whole.endswith(".0") else whole


def _text(x: float, y: float, text: str, anchor: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(text)}</text>'


def _extent(arrays: Sequence[np.ndarray]) -> tuple[float, float]:
    return float(min(np.min(a) for a in arrays)), float(max(np.max(a) for a in arrays))


def _limits(panel: Panel) -> tuple[float, float]:
    values = np.concatenate([np.asarray(line.y, float)[np.isfinite(line.y)] for line in panel.lines] or [np.zeros(1)])
    values = np.concatenate([values, [v for _, v in panel.levels]])
    if panel.band is not None:
        values = np.concatenate([values, panel.band[1], panel.band[2]])
    if panel.log:
        values = values[values > 0.0]
        return float(10 ** math.floor(math.log10(values.min()))), float(
            10 ** math.ceil(math.log10(values.max() * 1.05))
        )
    low, high = float(values.min()), float(values.max())
    margin = 0.06 * (high - low) or 1.0
    return low - margin, high + margin


def nice_ticks(low: float, high: float, count: int) -> list[float]:
    """Return round numbers between low and high, about `count` of them."""
    raw = (high - low) / max(count, 1)
    if not raw > 0.0:
        return [low]
    power = 10.0 ** math.floor(math.log10(raw))
    step = next(f * power for f in (1.0, 2.0, 5.0, 10.0) if f * power >= raw * 0.999)
    first = math.ceil(low / step - 1e-9)
    return [k * step for k in range(first, math.floor(high / step + 1e-9) + 1)]


def _log_ticks(low: float, high: float) -> list[float]:
    powers = range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)
    return [10.0**k for k in powers]


def _number(value: float) -> str:
    return f"{value:.6g}".replace("-", "\u2212")


def key_of(lines: Iterable[Line]) -> str:
    """Return the legend of lines, each name once."""
    return key(list({line.name: (line.name, line.colour, line.dash) for line in lines}.values()))


def key(entries: Sequence[tuple[str, str, tuple[int, ...]]]) -> str:
    """Return a legend as HTML: (name, colour, dash) with a piece of each line, or its dot where a model has no dash."""
    items = []
    for name, colour, dash in entries:
        dashes = f' stroke-dasharray="{" ".join(map(str, dash))}"' if dash else ""
        path = f'<path d="M1 4h28" stroke="{colour}" stroke-width="2"{dashes}/>'
        if colour in COLOURS and not dash:
            path = marker(15.0, 4.0, colour)
        sample = f'<svg viewBox="0 0 30 8" aria-hidden="true">{path}</svg>'
        items.append(f'<span class="key">{sample}{escape(name)}</span>')
    return f'<p class="keys">{"".join(items)}</p>'
