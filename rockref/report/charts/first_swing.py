"""The first swing of each imported run, as a picture and in a terminal: is this what the block did?"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.measure.importing.campaign import Campaign, ImportedRun
from rockref.measure.signals.signal import growth_rate, rocking_time
from rockref.report.charts import style
from rockref.report.charts.figures import new_figure, rendered

# decided: a quarter of a second of standing, and as much of what follows the first impact.
BEFORE, AFTER = 0.25, 0.4
# decided: more panels than this are a poster; the others are counted in words.
MOST = 12
# The dots of a braille letter, column by column: Unicode standard, chapter 21.1.
_DOTS = ((0x01, 0x02, 0x04, 0x40), (0x08, 0x10, 0x20, 0x80))


def expected_arc(run: ImportedRun, width: float, height: float) -> tuple[np.ndarray, np.ndarray]:
    """Return times (N,) s and the rate (N,) rad/s of a loss-free block from this tilt, up to upright (Housner 1963).

    width and height in m; linear in the angle.
    """
    p, alpha = growth_rate(width, height), math.atan2(width, height)
    end = rocking_time(run.tilt, width, height) if run.tilt < alpha else run.impact
    t = np.linspace(0.0, end, 200)
    return t, (-1 if run.turned else 1) * (alpha - run.tilt) * p * np.sinh(p * t)


def first_swing_png(campaign: Campaign) -> bytes:
    """Return a picture of the first swings: the three rates, and the swing of a loss-free block beside them."""
    runs = campaign.runs[:MOST]
    rows = math.ceil(len(runs) / 2)
    figure: Any = new_figure(9.6, 0.9 + 2.1 * rows)
    figure.subplots_adjust(hspace=0.42, top=1.0 - 0.75 / (0.9 + 2.1 * rows))
    for k, run in enumerate(runs):
        axes = figure.add_subplot(rows, 2, k + 1)
        seen = (run.t > -BEFORE) & (run.t < run.impact + AFTER)
        for axis, colour in ((2, style.COLOURS[2]), (1, style.COLOURS[1]), (0, style.INK)):
            axes.plot(run.t[seen], np.degrees(run.crv[seen, axis]), color=colour, lw=0.9, label="XYZ"[axis])
        t, rate = expected_arc(run, campaign.choices.width, campaign.choices.height)
        axes.plot(t, np.degrees(rate), "--", color=style.COLOURS[0], lw=1.6, label="loss-free block")
        axes.axvline(0.0, color=style.GREY, lw=0.8)
        side = ", turned" if run.turned else ""
        axes.set_title(f"run {run.id}: {math.degrees(run.tilt):.2f}°{side}, {run.use}", fontsize=9, loc="left")
        axes.tick_params(labelsize=8)
        if k == 0:
            axes.legend(fontsize=7, frameon=False, ncol=2)
        if k >= len(runs) - 2:
            axes.set_xlabel("time from the release (s)", fontsize=8)
        if k % 2 == 0:
            axes.set_ylabel("deg/s", fontsize=8)
    more = f" ({len(campaign.runs) - MOST} more runs)" if len(campaign.runs) > MOST else ""
    figure.suptitle(f"Is this your first swing?{more}", fontsize=11, x=0.01, ha="left")
    return rendered(figure, "png", dpi=110)


def swing_in_text(run: ImportedRun, columns: int = 64, rows: int = 6) -> list[str]:
    """Return the rate about X from before the release to after the first impact, drawn in braille letters."""
    seen = (run.t > -BEFORE) & (run.t < run.impact + AFTER)
    t, x = run.t[seen], run.crv[seen, 0]
    low, high = min(float(x.min()), 0.0), max(float(x.max()), 0.0)
    across = np.minimum(((t - t[0]) / (t[-1] - t[0]) * 2 * columns).astype(int), 2 * columns - 1)
    down = ((high - x) / (high - low or 1.0) * (4 * rows - 1)).astype(int)
    cells = np.zeros((rows, columns), dtype=int)
    for i, j in zip(across, down, strict=True):
        cells[j // 4, i // 2] |= _DOTS[i % 2][j % 4]
    lines = ["".join(chr(0x2800 + cell) for cell in row) for row in cells]
    lines[0] += f" {round(math.degrees(high)):+d} deg/s"
    lines[-1] += f" {round(math.degrees(low)):+d} deg/s"
    release = int(np.searchsorted(t, 0.0) / len(t) * columns)
    impact = int(np.searchsorted(t, run.impact) / len(t) * columns)
    below, width = [], columns + len(" +000 deg/s")
    for place, words in ((release, "release"), (impact, f"first impact, {run.impact:.3f} s")):
        fits = place + 2 + len(words) <= width
        below.append(" " * place + f"^ {words}" if fits else f"{words} ^".rjust(place + 1))
    first, second = below
    apart = len(first) < len(second) - len(second.lstrip())
    return [*lines, first + second[len(first) :]] if apart else [*lines, *below]
