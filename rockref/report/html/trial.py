"""One run drawn measured, before and after: curves of a model with its effect at several sizes, none to twice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.models import Comparison
from rockref.discover.compare.stretches import AXES
from rockref.discover.hypotheses.effects import effect_parameters, own_value
from rockref.discover.hypotheses.parameter import Parameter
from rockref.effects import catalogue
from rockref.effects.natural import natural_units
from rockref.effects.scale import to_scale
from rockref.measure.prediction import gyro_of, predict
from rockref.model.channel import DEGREES
from rockref.report.charts import style
from rockref.report.charts.drawing import Line, Panel, chart, key_of
from rockref.report.html.encoding import packed
from rockref.report.tables.spoken import spoken

#: Sizes of the slider, as shares of the size that was found; the optimum is in the middle.
SHARES = tuple(k / 4 for k in range(9))
OPTIMUM = 4
#: Samples of each curve at most; decided: at 1 kHz the first two swings of a block, and 150 kB on a page.
SAMPLES = 1600
#: Length of the opening view, what it shows before the difference [s], and the noise widths from which one is seen
#: (decided).
VIEW, BEFORE, SEEN = 0.4, 0.05, 5.0


@dataclass(frozen=True, eq=False)
class Dial:
    """An effect at several sizes: labels (S,), rates (S, n, 3) and errors (S,) [deg/s]."""

    effect: str
    sizes: tuple[str, ...]
    rates: np.ndarray
    errors: np.ndarray


@dataclass(frozen=True, eq=False)
class Trial:
    """One run: times (n,) [s], rates measured and before (n, 3) [deg/s], its dials, the opening view [s].

    held_out : whether no fit has read the run;  axis : about which the effect changes most of what is seen
    error : of the model before [deg/s]
    """

    run: str
    held_out: bool
    t: np.ndarray
    measured: np.ndarray
    before: np.ndarray
    dials: tuple[Dial, ...]
    impacts: np.ndarray
    axis: int
    view: tuple[float, float]
    error: float

    @property
    def after(self) -> np.ndarray | None:
        """Return the rates with the effect as it was found (n, 3) [deg/s], or None."""
        return self.dials[0].rates[OPTIMUM] if self.dials else None

    @property
    def sentence(self) -> str:
        """Return what is drawn."""
        use = "no fit has read it" if self.held_out else "a fit has read it: no run was held out"
        after = f", and with {self.dials[0].effect}" if self.dials else ""
        return (
            f"Run {self.run} ({use}): rate about the {AXES[self.axis]} axis as measured, by the model before{after}. "
            "Released as measured, the models run on alone. Red lines: main impacts."
        )

    def data(self) -> dict[str, Any]:
        """Return what the script draws."""
        columns = [packed(y) for y in self.measured.T], [packed(y) for y in self.before.T]
        return {
            "x": {"start": float(self.t[0]), "step": float(self.t[1] - self.t[0]), "n": len(self.t)},
            "axes": [f"{axis} axis" for axis in AXES],
            "axis": self.axis,
            "view": list(self.view),
            "marks": [round(float(v), 5) for v in self.impacts],
            "measured": columns[0],
            "before": columns[1],
            "error": round(self.error, 4),
            "colours": [style.INK, style.colour(0), style.colour(1)],
            "dials": [
                {
                    "effect": d.effect, "sizes": list(d.sizes), "optimum": OPTIMUM,
                    "errors": [round(float(e), 4) for e in d.errors],
                    "rates": [[packed(y) for y in rates.T] for rates in d.rates],
                }
                for d in self.dials
            ],
        }  # fmt: skip

    def lines(self) -> list[Line]:
        """Return the curves of the axis that is shown first."""
        found = [Line("measured", self.t, self.measured[:, self.axis])]
        found.append(Line("before", self.t, self.before[:, self.axis], style.colour(0), style.dash(0)))
        if self.after is not None:
            name = f"with {self.dials[0].effect}"
            found.append(Line(name, self.t, self.after[:, self.axis], style.colour(1), style.dash(1)))
        return found

    def picture(self) -> tuple[str, str]:
        """Return (SVG, legend) of the opening view, for paper and where no script runs."""
        inside = (self.t >= self.view[0]) & (self.t <= self.view[1])
        lines = [Line(ln.name, ln.x[inside], ln.y[inside], ln.colour, ln.dash) for ln in self.lines()]
        return self.drawn(lines, f"Run {self.run}: measured, before and after")

    def drawn(self, lines: list[Line], title: str) -> tuple[str, str]:
        """Return (SVG, legend) of lines in the opening view, with the impacts in it."""
        marks = [float(v) for v in self.impacts if self.view[0] <= v <= self.view[1]]
        svg = chart(
            [Panel(f"{AXES[self.axis]} (deg/s)", lines, height=220.0)],
            title=title, x_label="time (s)", x_limits=self.view, marks=marks,
        )  # fmt: skip
        return svg, key_of(lines)


def trial(c: Comparison, effects: Sequence[str]) -> Trial:
    """Return the first held-out run of a comparison of one model (before), or two (before, after).

    effects : those of the second model that have a dial.
    """
    held = c.of("holdout")
    k = held[0] if held else 0
    m, before = c.measured[k], c.results[0][k]
    run, impacts = m.run, m.features.impacts.times
    assert run.t is not None and run.crv is not None
    end = float(impacts[2]) + 0.1 if len(impacts) > 2 else float(run.t[-1])
    rows = slice(0, int(np.searchsorted(run.t, end)), None)
    rows = slice(0, rows.stop, max(1, -(-rows.stop // SAMPLES)))
    t = run.t[rows]
    compared = (t < impacts[1]) if len(impacts) > 1 else np.ones(len(t), bool)
    measured, drawn = run.crv[rows] * DEGREES, before.modelled[rows] * DEGREES
    dials = tuple(dial(c, k, id, rows, measured, compared) for id in effects) if len(c.names) > 1 else ()
    other = dials[0].rates[OPTIMUM] if dials else measured
    difference = np.abs(drawn - other)
    # The axis on which the eye sees most: a difference counts beside what the axis shows, noise left out.
    shows = np.maximum(np.mean(measured[compared] ** 2, axis=0), (10 * m.noise * DEGREES) ** 2)
    axis = int(np.nanargmax(np.nanmean(difference[compared] ** 2, axis=0) / shows))
    view = opening(t, difference[:, axis], float(m.noise[axis]) * DEGREES, impacts)
    shown = impacts[impacts <= t[-1]]
    error = rms(drawn - measured, compared)
    return Trial(run.id, bool(held), t, measured, drawn, dials, shown, axis, view, error)


def dial(c: Comparison, k: int, id: str, rows: slice, measured: np.ndarray, compared: np.ndarray) -> Dial:
    """Return an effect of the second model of a comparison at several sizes, in run k, all else as it was found."""
    run, r, model = c.measured[k].run, c.results[1][k], c.models[1]
    assert run.t is not None and run.release_tilt is not None
    releases = {run.id: {"theta_0": run.release_tilt + r.tilt_offset}}
    # Aligned with the first main impact as the model that was found is, so that in the middle the dial is that model.
    times = np.where(run.t < c.measured[k].first_impact, run.t, run.t - r.shift)[rows]
    gyro = gyro_of(c.experiment)
    found, sizes = [], []
    for share in SHARES:
        one, label = scaled(model, id, share)
        (said,) = predict(one, [run], gyro, engine=c.engine, releases=releases, step=c.step)
        found.append(said.at(times) * DEGREES)
        sizes.append(label)
    rates = np.stack(found)
    return Dial(id, tuple(sizes), rates, np.array([rms(one - measured, compared) for one in rates]))


def rms(difference: np.ndarray, rows: np.ndarray) -> float:
    """Return the root mean square of differences (n, 3) over some rows and all axes."""
    return float(np.sqrt(np.nanmean(difference[rows] ** 2)))


def scaled(model: Model, id: str, share: float) -> tuple[Model, str]:
    """Return a model with an effect at a share of its size, on the scale of its prior, and that size in words."""
    if share == 0.0:
        return model.replace(effects=tuple(e for e in model.effects if e.id != id)), "none"
    kind, effect = catalogue.find(id), next(e for e in model.effects if e.id == id)
    largest: tuple[float, Parameter, float] | None = None
    for p in effect_parameters(id, 1, units=natural_units(model)):
        if p.run is not None or p.typical <= 0.0:
            continue
        z = p.z_of(to_scale(kind, p.name.partition(".")[2], float(getattr(effect, p.name.partition(".")[2]))))
        at = float(np.clip(share * z, p.least, p.most))
        model = p.set(model, p.value(at))
        if largest is None or abs(z) / p.typical > largest[0]:
            largest = abs(z) / p.typical, p, at
    if largest is None:
        return model, f"{100 * share:.0f} % of its size"
    _, p, at = largest
    return model, spoken(p.name, own_value(p, at), None, None, p.unit).size


def opening(t: np.ndarray, difference: np.ndarray, noise: float, impacts: np.ndarray) -> tuple[float, float]:
    """Return the stretch [s] about the first instant from which a difference (n,) exceeds the noise for 20 ms."""
    step = float(t[1] - t[0])
    length = max(1, round(0.02 / step))
    seen = (np.nan_to_num(difference) > SEEN * noise).astype(float)
    above = np.flatnonzero(np.convolve(seen, np.ones(length) / length, mode="valid") > 0.5)
    first = float(impacts[0]) if len(impacts) else float(t[-1]) / 2
    start = max(0.0, (float(t[above[0]]) if len(above) else first) - BEFORE)
    start = min(start, max(0.0, float(t[-1]) - VIEW))
    # A difference that begins before the first impact shows after it.
    return (start, min(float(t[-1]), max(start + VIEW, first + VIEW)))
