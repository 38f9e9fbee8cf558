"""Numbers as dots over named places, a colour a state, beside levels that they are held against."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rockref.report.charts import style
from rockref.report.charts.drawing import Line, Panel, chart, key_of

#: Half the length of a level, and how far the dots of two states lie apart; decided: five states keep to their place.
HALF, APART = 0.37, 0.14
#: Dashes of the noise floor.
FLOOR_DASH = (2, 2)

Numbers = Sequence[float] | np.ndarray


def level(name: str, values: Numbers, dash: tuple[int, ...] = FLOOR_DASH) -> Line:
    """Return short level lines at the places 0, 1, ...; a place without a number has none."""
    y = np.repeat(np.asarray(values, float), 3)
    y[2::3] = np.nan
    return Line(name, np.add.outer(np.arange(len(y) // 3), (-HALF, HALF, HALF)).ravel(), y, style.GREY, dash, 1.6)


def dots(
    title: str,
    places: Sequence[str],
    states: Sequence[tuple[str, Numbers]],
    levels: Sequence[Line] = (),
    *,
    label: str = "error (deg/s)",
    x_label: str = "axis",
    log: bool = False,
    limits: tuple[float, float] | None = None,
    height: float = 170.0,
    marks: Sequence[float] = (),
) -> tuple[str, str]:
    """Return (SVG, legend) of states, each with a number for every place; from zero up, if not `log` or of `limits`."""
    x, lines = np.arange(float(len(places))), list(levels)
    for k, (name, values) in enumerate(states):
        shift = APART * (k - 0.5 * (len(states) - 1))
        lines.append(Line(name, x + shift, np.asarray(values, float), style.colour(k), dots=True))
    if not log and limits is None:
        limits = (
            0.0,
            1.15 * max((float(np.nanmax(y)) for y in (ln.y for ln in lines) if np.isfinite(y).any()), default=1.0),
        )
    svg = chart(
        [Panel(label, lines, log=log, limits=limits, height=height)],
        title=title,
        x_label=x_label,
        x_limits=(-0.6, len(places) - 0.4),
        marks=marks,
        ticks=list(zip(x.tolist(), places, strict=True)),
    )
    return svg, key_of(lines)
