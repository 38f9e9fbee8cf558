"""The panels of a run and of a response: rates, Housner's block beside them, contacts as lines; figures of a run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rockref.discover.compare.models import Comparison, RunComparison
from rockref.discover.compare.stretches import AXES
from rockref.model.channel import DEGREES
from rockref.model.housner import HousnerResponse, housner
from rockref.model.response import Response
from rockref.model.storage import write_bytes
from rockref.report.charts import style
from rockref.report.charts.drawing import Line, Panel, draw
from rockref.report.charts.figures import rendered
from rockref.report.tables import comparison_tables

# decided: Housner's curve bends over a swing; 5 ms apart its points are on it to the width of a line.
HOUSNER_RATE, HOUSNER_STEP = 200.0, 1e-3
# decided: the source zooms a little beyond the main impacts on either side.
BEYOND = 0.03
#: Rates of one curve: name, numbers, colour and dash.
Rates = tuple[str, np.ndarray, str, tuple[int, ...]]


def housner_line(plane: HousnerResponse, sign: float = 1.0) -> Line:
    """Return the rate of Housner's block about the main axis, deg/s."""
    return Line("Housner", plane.t, sign * DEGREES * plane.rate, style.GREY, style.HOUSNER_DASH, 1.0)


def planar(c: Comparison, k: int, end: float) -> Line:
    """Return Housner's rate for the release of a run up to its end [s], deg/s."""
    e, r, run = c.experiment, c.results[0][k], c.measured[k].run
    assert run.release_tilt is not None
    inertia = e.mass * (e.width**2 + e.height**2) / 12.0
    tilt = run.release_tilt + r.tilt_offset
    plane = housner(e.mass, e.width, e.height, inertia, 9.81, tilt, end, HOUSNER_RATE, HOUSNER_STEP)
    return housner_line(plane, -1.0 if abs(run.block_turned) > 1.0 else 1.0)


def contact_strips(r: RunComparison) -> list[tuple[str, np.ndarray]]:
    """Return each contact point of the aligned model and its intervals of contact, (k, 2) s in the run's time."""
    strips = []
    for name, intervals in r.aligned.response.contacts():
        on = intervals + r.shift
        # Contacts that end where the next begins are one for the eye; it keeps the page small.
        apart = np.flatnonzero(on[1:, 0] - on[:-1, 1] > 1e-3) + 1
        starts = on[np.concatenate(([0], apart)), 0] if len(on) else np.empty(0)
        ends = on[np.concatenate((apart - 1, [len(on) - 1])), 1] if len(on) else np.empty(0)
        strips.append((name, np.stack((starts, ends), axis=-1)))
    return strips


def rate_panels(t: np.ndarray, rates: Sequence[Rates], plane: Line | None = None) -> list[Panel]:
    """Return a panel an axis of rates, (name, (3, N) deg/s, colour, dash) at t (N,) s, and of Housner's block."""
    panels = []
    for axis, name in enumerate(AXES):
        lines = [Line(said, t, crv[axis], colour, dash) for said, crv, colour, dash in rates]
        lines += [plane] if axis == 0 and plane is not None else []
        panels.append(Panel(f"{name} (deg/s)", lines, height=150.0 if axis == 0 else 120.0))
    return panels


def run_panels(c: Comparison, k: int, every: int = 1) -> tuple[np.ndarray, list[Panel]]:
    """Return times (N,) s and the panels of a run: measured and every model, contact points as lines.

    every : of so many samples one is drawn, such that every extreme is.
    """
    run = c.measured[k].run
    assert run.t is not None and run.crv is not None
    t = thinned_times(run.t, every)
    seen: list[Rates] = [("measured", run.crv, style.INK, ())]
    seen += [(n, c.results[i][k].modelled, style.colour(i), style.dash(i)) for i, n in enumerate(c.names)]
    rates = [(n, np.stack([thinned(x * DEGREES, every) for x in v.T]), col, dash) for n, v, col, dash in seen]
    panels = rate_panels(t, rates, planar(c, k, float(run.t[-1])))
    for i, name in enumerate(c.names):
        # A longer name does not fit beside the rows; the colour tells whose they are.
        label = name if 1 < len(c.names) and len(name) <= 16 else "contacts"
        panels.append(Panel(label, strips=contact_strips(c.results[i][k]), height=110.0, colour=style.colour(i)))
    return t, panels


def thinned(y: np.ndarray, every: int) -> np.ndarray:
    """Return (N // every) of the values (N,): of each 2 every the smallest and the largest, in their order."""
    if every == 1:
        return y
    rows = y[: len(y) // (2 * every) * 2 * every].reshape(-1, 2 * every)
    pair = np.sort(np.stack((rows.argmin(axis=1), rows.argmax(axis=1)), axis=1), axis=1)
    return np.take_along_axis(rows, pair, axis=1).ravel()


def thinned_times(t: np.ndarray, every: int) -> np.ndarray:
    """Return the times of thinned values: even steps of `every` samples."""
    return t if every == 1 else t[: len(t) // (2 * every) * 2 * every : every]


def response_panels(
    response: Response, name: str, colour: str, plane: Line | None = None, every: int = 1
) -> list[Panel]:
    """Return the panels of a computed release, one row in `every`: rates and contacts."""
    rates: list[Rates] = [(name, response.crv[::every].T, colour, ())]
    panels = rate_panels(response.t[::every], rates, plane)
    of_strips = style.GREY if colour == style.INK else colour
    return [*panels, Panel("contacts", strips=response.contacts(), height=110.0, colour=of_strips)]


def whole_run(c: Comparison, k: int) -> Any:
    """Return the figure of a whole run, in the manner of the source's Figure 3.4a."""
    t, panels = run_panels(c, k)
    return _of_run(c, k, panels, [(float(t[0]), float(t[-1]))])


def zooms(c: Comparison, k: int) -> Any | None:
    """Return the zooms: about the first main impact, between the first two, and the last arcs; None without impacts."""
    times = [float(v) for v in c.measured[k].features.impacts.times]
    if len(times) < 2:
        return None
    stretches = [(times[0] - 0.06, times[0] + 0.08), (times[0] - BEYOND, times[1] + BEYOND)]
    if len(times) > 4:
        stretches.append((times[-3] - BEYOND, times[-1] + BEYOND))
    return _of_run(c, k, run_panels(c, k)[1], stretches)


def _of_run(c: Comparison, k: int, panels: list[Panel], stretches: list[tuple[float, float]]) -> Any:
    title = f"{c.experiment.name}, run {comparison_tables.run_name(c, k)}"
    return draw(panels, stretches, marks=c.measured[k].features.impacts.times, title=title)


def write_figures(c: Comparison, folder: Path) -> list[Path]:
    """Write the figures of the first run as PNG and SVG and return their paths. Raises InputError E-WRITE."""
    written = []
    run = c.measured[0].run.id
    for name, figure in (("whole", whole_run(c, 0)), ("zooms", zooms(c, 0))):
        for kind in ("png", "svg") if figure is not None else ():
            written.append(folder / f"{c.experiment.name}_run{run}_{name}.{kind}")
            write_bytes(written[-1], rendered(figure, kind))
    return written
