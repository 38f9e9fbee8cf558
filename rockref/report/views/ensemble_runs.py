"""Chosen runs of an ensemble on its page: they are run again, drawn with the motion of the plate, and replayed."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from rockref.engines import run
from rockref.model.response import Response
from rockref.report.charts import style
from rockref.report.charts.drawing import Line, Panel
from rockref.report.html.curves import curves
from rockref.report.html.page import Page
from rockref.report.html.player import replay
from rockref.shake.ensemble import Ensemble

#: Interval of the rows that are drawn and replayed [s]; decided: a fifth of what the eye tells apart, and a run of
#: thirty seconds has a quarter of a megabyte.
INTERVAL = 0.005


def chosen_runs(rows: list[dict[str, Any]]) -> list[tuple[str, int]]:
    """Return runs worth a look, each with the reason: the first fall, the narrowest escape, the usual run."""
    fell = [k for k, row in enumerate(rows) if row["fell"]]
    stood = sorted((k for k, row in enumerate(rows) if not row["fell"]), key=lambda k: (rows[k]["tilt_rad"], k))
    found = []
    if fell:
        found.append(("fell under the smallest PGA", min(fell, key=lambda k: (rows[k]["pga_m_s2"], k))))
    if stood:
        found.append(("stood with the largest tilt", stood[-1]))
    if len(stood) > 2:
        found.append(("has the median tilt of those that stood", stood[len(stood) // 2]))
    return found


def again(ensemble: Ensemble, k: int, end: float) -> Response:
    """Return run k of an ensemble up to its end [s], with rows every `INTERVAL` or one step, whichever is longer."""
    problem = ensemble.problem(k, ensemble.model.body(), {})
    every = max(1, round(INTERVAL / problem.step))
    return run(problem.replace(duration=end, output_rate=1.0 / (every * problem.step)))


def add_runs(page: Page, ensemble: Ensemble, rows: list[dict[str, Any]]) -> None:
    """Add the section of chosen runs: motion of the plate, tilt, contacts, and a replay of each."""
    said = "Each is run again from its number, bit for bit. The replay shows the block as seen from the moving plate."
    page.add_section("Chosen runs", said)
    for reason, k in chosen_runs(rows):
        row = rows[k]
        response = again(ensemble, row["run"], row["end_s"])
        title = f"Run {row['run']}: {row['record']}, factor {row['factor']:g}"
        words = (
            f"This run {reason}: PGA {row['pga_m_s2']:.3g} m/s2, largest tilt {math.degrees(row['tilt_rad']):.3g} deg."
        )
        page.add_curves(curves(response.t, _panels(response), title=title, sentence=words, opening=_opening(response)))
        page.add_player(replay(response, title, _opening(response)))


def _panels(response: Response) -> list[Panel]:
    t, base = response.t, response.problem.base
    assert base is not None
    times = base.t_0 + base.dt * np.arange(len(base.a))
    plate = [np.interp(t, times, np.asarray(a, float), left=0.0, right=0.0) for a in base.a.T[:2]]
    lines = [Line(f"plate, {'xy'[k]}", t, a, style.colour(k), style.dash(k)) for k, a in enumerate(plate)]
    L = response.Lambda
    lean = np.degrees(np.arctan2(np.hypot(L[:, 0, 2], L[:, 1, 2]), L[:, 2, 2]))
    return [
        Panel("plate (m/s2)", lines),
        Panel("tilt (deg)", [Line("block", t, lean)]),
        Panel("contacts", strips=response.contacts()),
    ]


def _opening(response: Response) -> tuple[float, float]:
    """Return the stretch [s] from just before the first foot lifts to the end."""
    carried = response.anchored[0]
    lifted = np.flatnonzero((carried & ~response.anchored).any(axis=1))
    end = float(response.t[-1])
    start = float(response.t[lifted[0]]) if len(lifted) else 0.0
    # decided: half a second before the first uplift shows what caused it.
    return max(0.0, min(start - 0.5, end - 1.0)), end
