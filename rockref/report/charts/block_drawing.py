"""A drawing of the block: axes, corners 1 to 4, outer and inner points, the tilt of the release, the block turned.

The poses and points are those of the law (`Model.problem`), of a block with exaggerated proportions; the drawing is one
SVG text without scripts, which follows the colours of the page that it stands in.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.model.problem import Problem
from rockref.report.charts.drawing import inside_page
from rockref.report.charts.figures import new_figure
from rockref.report.charts.style import COLOURS, GREY

# decided: proportions that show feet and tilt at four hundred pixels; the source's is higher.
SIDE, HEIGHT, INWARD, TILT = 0.100, 0.230, 0.022, 0.22
# decided: pixels a metre, and where X, which comes towards the reader, goes in the drawing for each metre.
SCALE, TOWARDS = 900.0, np.array([-0.40, -0.26])
BLUE, RED = COLOURS[1], COLOURS[0]
_EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
PANEL, HIGH = 300.0, 400.0
TITLE = (
    "The block tilted on corners 1 and 2, the same block turned by 180 degrees, and its feet from above. Not to scale."
)
_ARROW: dict[str, Any] = {"arrowstyle": "-|>", "lw": 2.0, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 15}
_HIDDEN: dict[str, Any] = {"color": GREY, "lw": 1.0, "dashes": (4.0, 3.0)}


def block_drawing(standalone: bool = False) -> str:
    """Return the drawing as SVG text: the release, the block turned by 180 degrees, the feet from above.

    A `standalone` file follows the reader's dark mode by itself; in a page it takes the page's colour.
    """
    figure = new_figure(3 * PANEL / 72, HIGH / 72)
    figure.subplots_adjust(left=0, right=1, top=1, bottom=0, wspace=0)
    axes = figure.subplots(1, 3)
    for ax in axes:
        ax.set(xlim=(0, PANEL), ylim=(HIGH, 0))
        ax.axis("off")
    _posture(axes[0], False)
    _posture(axes[1], True)
    _feet(axes[2])
    # Black is the colour of the page.
    svg = inside_page(figure, TITLE, "block").replace("#000000", "currentColor")
    look = f' style="max-width:{3 * PANEL:g}px;width:100%;fill:currentColor" font-family="system-ui,sans-serif"'
    dark = "<style>svg{color:#1f2328}@media(prefers-color-scheme:dark){svg{color:#e6edf3}}</style>"
    head = ' xmlns="http://www.w3.org/2000/svg"' if standalone else ' class="block"'
    svg = svg.replace(' class="block"', head + look, 1)
    return svg.replace("</title>", f"</title>{dark}", 1) if standalone else svg


def problem(turned: bool) -> Problem:
    """Return the release that is drawn, as the law places it."""
    sides = {"width": SIDE, "depth": SIDE, "height": HEIGHT}
    return Model.table_3_1().replace(**sides, delta_diag=INWARD).problem(theta_0=TILT, turned=turned)


def _flat(points: np.ndarray) -> np.ndarray:
    """Return points (N, 3) m of the laboratory as places (N, 2) in the panel: Y to the right, Z up, X towards."""
    right = points[:, 1] + TOWARDS[0] * points[:, 0]
    up = points[:, 2] + TOWARDS[1] * points[:, 0]
    return np.stack([150.0 + SCALE * right, HIGH - 95.0 - SCALE * up], axis=-1)


def _posture(ax: Any, turned: bool) -> None:
    """Draw the block on its edge: body, feet, axes of the block, tilt, first swing."""
    one = problem(turned)
    start, P = one.start, one.points.P
    to_lab = lambda body: start.x + np.asarray(body, dtype=np.float64) @ start.Lambda.T  # noqa: E731
    corners = to_lab(np.vstack([np.column_stack([P[:4, :2], np.full(4, z)]) for z in (-0.5 * HEIGHT, 0.5 * HEIGHT)]))
    seen, feet, centre = _flat(corners), to_lab(P[:4]), to_lab(np.zeros(3))
    plate = _flat(0.1 * np.array([(1.1, -1.1, 0), (1.1, 1.25, 0), (-1.1, 1.25, 0), (-1.1, -1.1, 0)]))
    ax.fill(*plate.T, color=GREY, alpha=0.12, lw=0)
    # The corner at the far, lower end of the body is hidden, and so are its three edges.
    hidden = int(np.argmin(corners @ np.array([1.0, 0.45, 0.3])))
    for edge in _EDGES:
        ax.plot(*seen[list(edge)].T, **(_HIDDEN if hidden in edge else {"color": "black", "lw": 1.3}))
    on = [k for k in range(4) if feet[k, 2] < 1e-3 * HEIGHT]
    ax.plot(*seen[on].T, color=RED, lw=4.0, solid_capstyle="round")
    for k, at in enumerate(_flat(feet)):
        _foot(ax, at, str(k + 1), seen[:4].mean(axis=0), 17.0)
    for axis, name in enumerate("XYZ"):
        reach = 0.075 * (1.2 if axis != 1 else 1.0) * start.Lambda[:, axis]
        begin, end = _flat(np.stack([centre, centre + reach]))
        _arrow(ax, begin, end, name)
    _tilt(ax, seen, on)
    sign = "negative" if turned else "positive"
    ax.text(150, 16, f"block_turned_deg = {180 if turned else 0}", ha="center", va="center", fontsize=14)
    _words(ax, f"leans on corners {on[0] + 1} and {on[1] + 1}", f"first swing: wx {sign}")


def _tilt(ax: Any, seen: np.ndarray, on: list[int]) -> None:
    """Draw the tilt angle at the pivot, and the way of the first swing at the top."""
    pivot, radius = max((seen[k] for k in on), key=lambda p: p[1]), 80.0
    ax.plot(*np.stack([pivot, pivot - (0, 110.0)]).T, **_HIDDEN)
    turn = np.linspace(0.0, TILT, 9)
    ax.plot(pivot[0] + radius * np.sin(turn), pivot[1] - radius * np.cos(turn), color="black", lw=1.3)
    ax.text(*(pivot - (14.0, radius - 7.0)), "θ₀", ha="center", va="center", fontsize=14)
    right, top = seen[4:].max(axis=0)[0], seen[4:].min(axis=0)[1]
    bent = _ARROW | {"color": RED, "connectionstyle": "arc3,rad=0.25"}
    ax.annotate("", (right - 102.0, top - 16.0), (right - 8.0, top - 14.0), arrowprops=bent)


def _feet(ax: Any) -> None:
    """Draw the feet from above: outer points in the corners, inner ones on the diagonals, the pivot edge."""
    P = problem(False).points.P
    middle = np.array([150.0, 190.0])
    seen = middle + 1700.0 * np.stack([P[:, 1], P[:, 0]], axis=-1)
    ax.fill(*seen[:4].T, fc="none", ec="black", lw=1.3)
    ax.plot(*seen[:2].T, color=RED, lw=4.0, solid_capstyle="round")
    for k in range(4):
        ax.plot(*seen[[k, 4 + k]].T, **_HIDDEN)
        ax.plot(*seen[4 + k], "o", ms=10, mfc="none", mec=RED, mew=1.8)
        _foot(ax, seen[k], str(k + 1), middle, 19.0)
    for place, words in ((seen[5] + (-10, 0), "2int, inner"), (seen[0] + (-14, 17), "1ext, outer")):
        ax.text(*place, words, ha="right", va="center", fontsize=12)
    ax.text(*((seen[0] + seen[4]) / 2 + (-13, 3)), "δ", ha="center", va="center", fontsize=14)
    _arrow(ax, middle, middle + (50.0, 0.0), "Y")
    _arrow(ax, middle, middle + (0.0, 50.0), "X")
    ax.text(150, 16, "the feet from above", ha="center", va="center", fontsize=14)
    _words(ax, "edge 1–2 holds the block at the release", "δ_diag is measured along the diagonal")


def _words(ax: Any, *lines: str) -> None:
    """Write two small lines below a panel."""
    for k, line in enumerate(lines):
        ax.text(150, HIGH - 32 + 18 * k, line, ha="center", va="center", fontsize=12)


def _foot(ax: Any, at: np.ndarray, name: str, middle: np.ndarray, away: float) -> None:
    """Draw an outer point with its name, so many pixels away from the middle."""
    ax.plot(*at, "o", ms=10, color=RED, mew=0)
    ax.text(*(at + away * (at - middle) / math.hypot(*(at - middle))), name, ha="center", va="center", fontsize=14)


def _arrow(ax: Any, a: np.ndarray, b: np.ndarray, name: str) -> None:
    """Draw an axis with its name beyond its end."""
    ax.annotate("", b, a, arrowprops=_ARROW | {"color": BLUE})
    ax.text(*(b + 12.0 * (b - a) / math.hypot(*(b - a))), name, ha="center", va="center", fontsize=14)
