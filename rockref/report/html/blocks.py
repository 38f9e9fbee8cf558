"""What every page about an experiment is made of: what was measured, where a model fails, runs, energy, motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.discover.compare.features import Features
from rockref.discover.compare.models import Comparison
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import AXES, STRETCH_WORDS, STRETCHES, stretch_masks
from rockref.engines import machine
from rockref.measure.signals.impacts import Impacts
from rockref.model.channel import DEGREES
from rockref.report.charts import style
from rockref.report.charts.dots import dots, level
from rockref.report.charts.drawing import Line, Panel, chart, key, key_of
from rockref.report.charts.run_panels import run_panels
from rockref.report.html.curves import Curves, curves
from rockref.report.html.page import Page
from rockref.report.html.player import player
from rockref.report.tables import comparison_tables
from rockref.report.tables.table import Table, number


def add_measured(page: Page, c: Comparison) -> None:
    """Add what was measured, before any model."""
    e = c.experiment
    runs = f"{len(c.of('fit'))} fitted, {len(c.of('holdout'))} held out"
    page.add_text(
        f"{e.name}: a block of {e.mass:g} kg, {1e3 * e.width:g} mm wide and {1e3 * e.height:g} mm high, released "
        f"{len(c.measured)} times ({runs}). The gyroscope's noise floor, from the quiet stretches, is "
        f"{DEGREES * c.noise():.3f} deg/s."
    )
    page.add_table(comparison_tables.runs_table(c))
    if e.notices:
        page.add_sentences([str(notice) for notice in e.notices], "Remarks about the files")


def add_failures(page: Page, c: Comparison) -> None:
    """Add where each model fails: sentences, the error by axis and stretch, run by run."""
    found = findings(c)
    together = [f.text for f in found if f.model is None]
    if together:
        page.add_sentences(together, "Side by side")
    for name in c.names:
        page.add_sentences([f.text for f in found if f.model == name], name)
    add_error_figure(page, c)
    for k in range(len(c.names)):
        page.add_table(comparison_tables.errors_table(c, k))
    for k in range(len(c.names)):
        page.add_table(comparison_tables.departures_table(c, k))


def add_error_figure(page: Page, c: Comparison) -> None:
    """Add the error by stretch and axis of every model, with noise floor and run-to-run spread as lines."""
    places = [(s, a) for s in STRETCHES for a in AXES]
    svg, keys = dots(
        "Error by stretch and axis",
        [f"{a[:5]}." if len(a) > 5 else a for _, a in places],
        [(name, [DEGREES * c.rms(k, s, a) for s, a in places]) for k, name in enumerate(c.names)],
        [
            level("noise floor", [DEGREES * c.noise(AXES.index(a)) for _, a in places]),
            level("two repeated runs", [_repeats_differ(c, s, a) for s, a in places], style.HOUSNER_DASH),
        ],
        x_label=f"left to right: {' | '.join(STRETCH_WORDS[s] for s in STRETCHES)}",
        log=True,
        height=210.0,
        marks=(2.5, 5.5),
    )
    sentence = (
        "Dots: RMS of model minus measured over all runs, by axis, in the three stretches of a run, on a "
        "logarithmic scale. Dashes: what noise alone makes, and by how much two repeated runs differ."
    )
    page.add_figure(svg, sentence, title="Error by stretch and axis", keys=keys)


def _repeats_differ(c: Comparison, stretch: str, axis: str) -> float:
    """Return the RMS over runs of the difference between two repeated runs, deg/s; NaN where unknown."""
    errors = [r.error(stretch, axis) for r in c.results[0]]
    squares = [2.0 * (e.rms / e.in_spread) ** 2 for e in errors if e is not None and e.in_spread is not None]
    return DEGREES * math.sqrt(float(np.mean(squares))) if squares else float("nan")


def run_curves(c: Comparison, k: int, every: int = 1) -> Curves:
    """Return the curves of one run: measured, every model, Housner about the main axis, contact points as lines.

    every : of so many samples one is drawn, such that every extreme is.
    """
    t, panels = run_panels(c, k, every)
    m = c.measured[k]
    assert m.run.t is not None
    last = float(m.run.t[-1])
    of_each = f" (from above: {', then '.join(c.names)})" if len(c.names) > 1 else ""
    return curves(
        t,
        panels,
        title=f"Run {comparison_tables.run_name(c, k)}",
        sentence=(
            f"Body rates about the three axes in run {comparison_tables.run_name(c, k)}; models are aligned with its "
            f"first main impact. Below, a line for every contact point of the model{of_each} while it touches. "
            "Red: main impacts of the run." + (THINNED.format(every, 2 * every) if every > 1 else "")
        ),
        marks=[float(v) for v in m.features.impacts.times],
        views=named_views(m.features.impacts, last),
        opening=opening_view(c, k, last),
        table=extremes_table(c, k),
        whole=run_panels(c, k)[1],
    )


#: What is said of thinned curves.
THINNED = " Thinned to one sample in {}: of every {} the smallest and the largest are drawn."
#: Opening view of a run: what it shows before a model leaves the band, and its length [s]; decided: an impact and the
#: clatter after it.
EARLIER, OPENED = 0.1, 0.6


def opening_view(c: Comparison, k: int, end: float) -> tuple[float, float] | None:
    """Return the stretch [s] in which the first model leaves the band of a run; None where it never does."""
    gone = c.results[0][k].leaves_band
    if gone is None:
        return None
    first = c.measured[k].first_impact
    start = max(0.0, min(gone.time, end - OPENED) - EARLIER)
    # What begins before the first main impact shows after it.
    return (start, min(end, max(start + OPENED, first + OPENED if math.isfinite(first) else 0.0)))


def named_views(impacts: Impacts, end: float) -> list[tuple[str, float, float]]:
    """Return the stretches to which a button leads."""
    times = [float(v) for v in impacts.times]
    views = []
    if times:
        views.append(("first swing", 0.0, times[0] + 0.05))
        views.append(("at the first main impact", max(times[0] - 0.04, 0.0), min(times[0] + 0.06, end)))
    if len(times) > 1:
        views.append(("between the first two", times[0] - 0.02, times[1] + 0.02))
    if len(times) > 4:
        views.append(("last arcs", times[-3] - 0.02, times[-1] + 0.02))
    return views


def extremes_table(c: Comparison, k: int) -> Table:
    """Return the numbers of a set of curves: smallest, largest and RMS by stretch."""
    m = c.measured[k]
    assert m.run.t is not None and m.run.crv is not None
    series = [("measured", m.run.crv), *((n, c.results[i][k].modelled) for i, n in enumerate(c.names))]
    rows = []
    for stretch, mask in stretch_masks(m.run.t, m.features.impacts).items():
        for axis, label in enumerate(AXES):
            for name, values in series:
                x = DEGREES * values[mask, axis]
                x = x[np.isfinite(x)]
                if len(x):
                    rms = float(np.sqrt(np.mean(x**2)))
                    numbers = [number(float(v), 2) for v in (x.min(), x.max(), rms)]
                    rows.append([STRETCH_WORDS[stretch], label, name, *numbers])
    return Table("Rates in deg/s", ("stretch", "axis", "of", "smallest", "largest", "RMS"), rows)


def add_energy(page: Page, c: Comparison) -> None:
    """Add the ledger: loss of every main impact and every free arc, measured and modelled."""
    count = max((len(m.features.impacts) for m in c.measured), default=0)
    if count < 2:
        return
    panels = []
    for label, name, length in (
        ("loss at impact (mJ)", "impact_loss", count),
        ("loss in the arc after (mJ)", "free_loss", count - 1),
    ):
        x = np.arange(1.0, length + 1.0)
        mean, scatter = _by_number([getattr(m.features.ledger, name) for m in c.measured], length)
        lines = [Line("measured", x, mean, style.INK)]
        for k, model in enumerate(c.names):
            values, _ = _by_number([getattr(r.features.ledger, name) for r in c.results[k]], length)
            lines.append(Line(model, x, values, style.colour(k), style.dash(k)))
        low, high = mean - scatter, mean + scatter
        known = np.isfinite(low)
        panels.append(Panel(label, lines, band=(x[known], low[known], high[known], style.BAND), height=130.0))
    svg = chart(
        panels,
        title="Energy lost, impact by impact",
        x_label="number of the main impact",
        x_limits=(0.7, count + 0.3),
        ticks=[(float(k), str(k)) for k in range(1, count + 1)],
    )
    keys = key_of(panels[0].lines)
    sentence = (
        "Energy of the rocking lost at each main impact and in each free arc, means over the runs; the band is the "
        "standard deviation between the measured runs. The split between impact and arc scatters with the clatter, "
        "their sum does not."
    )
    page.add_figure(svg, sentence, comparison_tables.energy_table(c), "Energy lost, impact by impact", keys)


def _by_number(values: Sequence[np.ndarray], length: int) -> tuple[np.ndarray, np.ndarray]:
    """Return mean and standard deviation (length,) mJ over runs of what each lists by number; NaN where unknown."""
    stack = np.full((len(values), length), np.nan)
    for row, listed in zip(stack, values, strict=True):
        n = min(len(listed), length)
        row[:n] = 1e3 * listed[:n]
    known = np.ma.masked_invalid(stack)
    return known.mean(axis=0).filled(np.nan), known.std(axis=0, ddof=1).filled(np.nan)


def add_shapes(page: Page, c: Comparison, k: int) -> None:
    """Add envelopes and spectra of one run between its first two main impacts."""
    measured = c.measured[k].features
    if measured.envelope is None or measured.spectrum is None:
        return
    seen: list[tuple[str, Features, str, tuple[int, ...]]] = [("measured", measured, style.INK, ())]
    for i, name in enumerate(c.names):
        seen.append((name, c.results[i][k].features, style.colour(i), style.dash(i)))
    envelopes, spectra = [], []
    for row, axis in enumerate(AXES[1:]):
        lines = []
        for name, f, colour, dash in seen:
            if f.envelope is not None:
                share = np.linspace(0.0, 1.0, len(f.envelope.t))
                lines += [
                    Line(name, share, DEGREES * y[row], colour, dash) for y in (f.envelope.upper, f.envelope.lower)
                ]
        envelopes.append(Panel(f"{axis} (deg/s)", lines, height=120.0))
        lines = [
            Line(name, f.spectrum.frequencies, DEGREES * f.spectrum.amplitudes[row + 1], colour, dash)
            for name, f, colour, dash in seen
            if f.spectrum is not None
        ]
        spectra.append(Panel(f"{axis} (deg/s)", lines, height=110.0))
    keys = key([(name, colour, dash) for name, _, colour, dash in seen])
    where = f"run {comparison_tables.run_name(c, k)}, between the first two main impacts"
    svg = chart(envelopes, title=f"Envelopes: {where}", x_label="share of the arc", x_limits=(0.0, 1.0))
    page.add_figure(svg, f"Upper and lower envelopes of the out-of-plane rates, {where}.", None, "Envelopes", keys)
    svg = chart(spectra, title=f"Spectra: {where}", x_label="frequency (Hz)", x_limits=(2.5, 100.0))
    page.add_figure(svg, f"Amplitude spectra of the out-of-plane rates, {where}.", _peaks(c, k), "Spectra", keys)


def _peaks(c: Comparison, k: int) -> Table:
    rows = []
    for i, name in enumerate(c.names):
        for s in c.results[i][k].spectra:
            peaks = [number(v, 2) for peak in (s.peak_measured, s.peak_model) for v in (peak[0], DEGREES * peak[1])]
            rows.append([name, s.axis, *peaks, number(s.distance, 2)])
    columns = ("model", "axis", "measured peak (Hz)", "(deg/s)", "model peak (Hz)", "(deg/s)", "distance")
    return Table(
        "Largest lines of the spectra", columns, rows, "Distance: size of the difference over the measured size."
    )


def add_motion(page: Page, c: Comparison) -> None:
    """Add the player of the first run: measured and every model side by side."""
    # decided: after the third main impact the motion of model and block has little to do with one another.
    times = c.measured[0].features.impacts.times
    until = float(times[2]) + 0.1 if len(times) > 2 else None
    page.add_player(player(c.measured[0], [(name, c.results[i][0]) for i, name in enumerate(c.names)], until))


def provenance(c: Comparison) -> dict[str, Any]:
    """Return where the numbers come from: inputs with their digests, models, engine, versions."""
    facts: dict[str, Any] = {f"experiment {c.experiment.name}": f"sha256 {c.experiment.digest}"}
    facts |= {f"file {name}": f"sha256 {digest}" for name, digest in c.experiment.digests.items()}
    for name, model in zip(c.names, c.models, strict=True):
        effects = {effect.id: effect.values() for effect in model.active_effects()}
        facts[f"model {name}"] = {"points": model.points, "effects": effects, "origin": model.origin}
    facts["engine"] = f"{c.engine}, step {c.step:g} s"
    described = machine.describe()
    facts |= {k: described[k] for k in ("rockref", "python", "numpy", "scipy", "numba", "platform") if described.get(k)}
    return facts
