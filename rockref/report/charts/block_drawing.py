"""A drawing of the block: axes, corners 1 to 4, outer and inner points, the tilt of the release, the block turned.

The poses and points are those of the law (`Model.problem`), of a block with exaggerated proportions; the drawing is one
SVG text without scripts, which follows the colours of the page that it stands in.
"""

from __future__ import annotations

import math

import numpy as np

from rockref.api import Model
from rockref.model.problem import Problem
from rockref.report.charts.style import COLOURS, GREY

# decided: proportions that show feet and tilt at four hundred pixels; the source's is higher.
SIDE, HEIGHT, INWARD, TILT = 0.100, 0.230, 0.022, 0.22
# decided: pixels a metre, and where X, which comes towards the reader, goes in the drawing for each metre.
SCALE, TOWARDS = 900.0, np.array([-0.40, -0.26])
BLUE, RED = COLOURS[1], COLOURS[0]
_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
PANEL, HIGH = 300.0, 400.0
_STROKE = 'fill="none" stroke-width='
#: What stands in the place of classes, which a page could have, too.
_LOOK = {
    "line": f'stroke="currentColor" {_STROKE}"1.3"',
    "hidden": f'stroke="{GREY}" stroke-dasharray="4 3" {_STROKE}"1"',
    "axis": f'stroke="{BLUE}" {_STROKE}"2"',
    "axis head": f'fill="{BLUE}"',
    "edge": f'stroke="{RED}" stroke-linecap="round" {_STROKE}"4"',
    "swing": f'stroke="{RED}" {_STROKE}"2"',
    "outer": f'fill="{RED}"',
    "inner": f'stroke="{RED}" {_STROKE}"1.8"',
    "plate": f'fill="{GREY}" fill-opacity=".12"',
}


def block_drawing(standalone: bool = False) -> str:
    """Return the drawing as SVG text: the release, the block turned by 180 degrees, the feet from above.

    A `standalone` file follows the reader's dark mode by itself; in a page it takes the page's colour.
    """
    panels = (_posture(False), _posture(True), _feet())
    parts = [f'<g transform="translate({PANEL * k:g} 0)">{panel}</g>' for k, panel in enumerate(panels)]
    width = PANEL * len(panels)
    dark = "<style>svg{color:#1f2328}@media(prefers-color-scheme:dark){svg{color:#e6edf3}}</style>"
    # The class lets a page keep it on a white ground, and as large as it can be read.
    name = ' xmlns="http://www.w3.org/2000/svg"' if standalone else ' class="block"'
    title = (
        "The block tilted on corners 1 and 2, the same block turned by 180 degrees, and its feet from above. "
        "Not to scale."
    )
    return (
        f'<svg{name} viewBox="0 0 {width:g} {HIGH:g}" role="img" style="max-width:{width:g}px;width:100%" '
        f'font-family="system-ui,sans-serif" font-size="14"><title>{title}</title>{dark if standalone else ""}'
        f"{''.join(parts)}</svg>"
    )


def problem(turned: bool) -> Problem:
    """Return the release that is drawn, as the law places it."""
    sides = {"width": SIDE, "depth": SIDE, "height": HEIGHT}
    return Model.table_3_1().replace(**sides, delta_diag=INWARD).problem(theta_0=TILT, turned=turned)


def _flat(points: np.ndarray) -> np.ndarray:
    """Return points (N, 3) m of the laboratory as places (N, 2) in the panel: Y to the right, Z up, X towards."""
    right = points[:, 1] + TOWARDS[0] * points[:, 0]
    up = points[:, 2] + TOWARDS[1] * points[:, 0]
    return np.stack([150.0 + SCALE * right, HIGH - 95.0 - SCALE * up], axis=-1)


def _posture(turned: bool) -> str:
    """Return the block on its edge: body, feet, axes of the block, tilt, first swing."""
    one = problem(turned)
    start, P = one.start, one.points.P
    to_lab = lambda body: start.x + np.asarray(body, dtype=np.float64) @ start.Lambda.T  # noqa: E731
    half = 0.5 * HEIGHT
    corners = np.vstack([np.column_stack([P[:4, :2], np.full(4, z)]) for z in (-half, half)])
    seen = _flat(to_lab(corners))
    plate = _flat(0.1 * np.array([(1.1, -1.1, 0), (1.1, 1.25, 0), (-1.1, 1.25, 0), (-1.1, -1.1, 0)]))
    parts = [_shape(plate, "plate")]
    # The corner at the far, lower end of the body is hidden, and so are its three edges.
    depth = to_lab(corners) @ np.array([1.0, 0.45, 0.3])
    hidden = int(np.argmin(depth))
    for a, b in _EDGES:
        parts.append(_line(seen[a], seen[b], "hidden" if hidden in (a, b) else "line"))
    on = [k for k in range(4) if to_lab(P[k])[2] < 1e-3 * HEIGHT]
    parts.append(_line(seen[on[0]], seen[on[1]], "edge"))
    for k, at in enumerate(_flat(to_lab(P[:4]))):
        away = at - seen[:4].mean(axis=0)
        parts += [_dot(at, "outer"), _text(at + 17.0 * away / np.linalg.norm(away) + (0, 5), str(k + 1))]
    centre = to_lab(np.zeros(3))
    for axis, name in enumerate("XYZ"):
        ends = _flat(np.stack([centre, centre + 0.075 * (1.2 if axis != 1 else 1.0) * start.Lambda[:, axis]]))
        parts.append(_arrow(ends[0], ends[1], "axis", "axis head"))
        parts.append(_text(ends[1] + 12.0 * _unit(ends[1] - ends[0]) + (0, 5), name))
    parts += _tilt(seen, on)
    heading = "block_turned_deg = 180" if turned else "block_turned_deg = 0"
    sign = "negative" if turned else "positive"
    parts.append(_text((150, 20), heading))
    parts.append(_text((150, HIGH - 28), f"leans on corners {on[0] + 1} and {on[1] + 1}", "middle small"))
    parts.append(_text((150, HIGH - 10), f"first swing: wx {sign}", "middle small"))
    return "".join(parts)


def _tilt(seen: np.ndarray, on: list[int]) -> list[str]:
    """Return the tilt angle at the pivot, and the way of the first swing at the top."""
    pivot = max((seen[k] for k in on), key=lambda p: p[1])
    up, radius = pivot - (0, 110.0), 80.0
    first, last = pivot - (0, radius), pivot + radius * np.array([math.sin(TILT), -math.cos(TILT)])
    top = seen[4:].min(axis=0)
    right = seen[4:].max(axis=0)[0]
    swing = f'<path {_LOOK["swing"]} d="M{right - 8:.1f} {top[1] - 14:.1f}q-46 -22 -92 -2"/>'
    end = np.array([right - 100.0, top[1] - 16.0])
    head = _head(end + (8.0, -1.5), end, "outer")
    angle = pivot - (14.0, radius - 12.0)
    begin, bend, stop = (f"{x:.1f} {y:.1f}" for x, y in (first, (radius, radius), last))
    arc = f'<path {_LOOK["line"]} d="M{begin}A{bend} 0 0 1 {stop}"/>'
    return [_line(pivot, up, "hidden"), arc, _text(angle, "θ₀"), swing, head]


def _feet() -> str:
    """Return the feet from above: outer points in the corners, inner ones on the diagonals, the pivot edge."""
    P = problem(False).points.P
    middle, scale = np.array([150.0, 190.0]), 1700.0
    seen = middle + scale * np.stack([P[:, 1], P[:, 0]], axis=-1)
    parts = [_text((150, 20), "the feet from above")]
    parts.append(_shape(seen[:4], "line"))
    parts.append(_line(seen[0], seen[1], "edge"))
    for k in range(4):
        away = _unit(seen[k] - middle)
        parts += [_line(seen[k], seen[4 + k], "hidden"), _dot(seen[k], "outer"), _dot(seen[4 + k], "inner")]
        parts.append(_text(seen[k] + 19.0 * away + (0, 5), str(k + 1)))
    parts.append(_text(seen[5] + (-10, 5), "2int, inner", "end small"))
    parts.append(_text(seen[0] + (-14, 22), "1ext, outer", "end small"))
    parts.append(_text((seen[0] + seen[4]) / 2 + (-13, 8), "δ"))
    y, x = middle + (50.0, 0.0), middle + (0.0, 50.0)
    parts += [_arrow(middle, y, "axis", "axis head"), _arrow(middle, x, "axis", "axis head")]
    parts += [_text(y + (12, 5), "Y"), _text(x + (0, 17), "X")]
    parts.append(_text((150, HIGH - 28), "edge 1–2 holds the block at the release", "middle small"))
    parts.append(_text((150, HIGH - 10), "δ_diag is measured along the diagonal", "middle small"))
    return "".join(parts)


def _unit(v: np.ndarray) -> np.ndarray:
    return v / max(float(np.linalg.norm(v)), 1e-12)


def _shape(places: np.ndarray, look: str) -> str:
    """Return a closed outline through places (N, 2)."""
    return f'<path {_LOOK[look]} d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in places)}Z"/>'


def _line(a: np.ndarray, b: np.ndarray, look: str) -> str:
    return f'<path {_LOOK[look]} d="M{a[0]:.1f} {a[1]:.1f}L{b[0]:.1f} {b[1]:.1f}"/>'


def _dot(at: np.ndarray, look: str) -> str:
    return f'<circle {_LOOK[look]} cx="{at[0]:.1f}" cy="{at[1]:.1f}" r="5"/>'


def _text(at: np.ndarray | tuple[float, float], words: str, look: str = "middle") -> str:
    """Return words about a place, or ending there; small ones where `look` says so."""
    anchor, small = look.split()[0], ' font-size="12"' if "small" in look else ""
    return f'<text x="{at[0]:.1f}" y="{at[1]:.1f}" text-anchor="{anchor}" fill="currentColor"{small}>{words}</text>'


def _head(behind: np.ndarray, end: np.ndarray, look: str) -> str:
    """Return the head of an arrow that ends at `end`."""
    along = _unit(np.asarray(end) - np.asarray(behind))
    across = np.array([-along[1], along[0]])
    tips = np.stack([end + 2 * along, end - 9 * along + 4.5 * across, end - 9 * along - 4.5 * across])
    return _shape(tips, look)


def _arrow(a: np.ndarray, b: np.ndarray, line: str, head: str) -> str:
    return _line(a, b - 6.0 * _unit(b - a), line) + _head(a, b, head)
