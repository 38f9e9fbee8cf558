"""Figures in the manner of the source's 3.5 to 3.7: responses that should be alike over one another, with zooms; and
the growth of small differences."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.model.channel import DEGREES
from rockref.report.charts import style
from rockref.report.charts.drawing import draw
from rockref.report.charts.figures import one_panel, titled
from rockref.report.charts.run_panels import rate_panels
from rockref.studies.predictability import Growth
from rockref.studies.sensitivity import Family
from rockref.studies.sensitivity_study import Study

#: The zoom of the source's figures [s]: about the first two main impacts.
ZOOM = (0.45, 1.40)
#: Curves that are drawn of a family at most; decided: more than three over one another cannot be told apart (the
#: source draws three).
CURVES = 3


def sensitivity_figures(study: Study) -> dict[str, Any]:
    """Return the four figures by name of file, without its ending."""
    titles = {
        "time_step": ("figure_3_5_time_step", "The same release with several time steps (as Fig. 3.5)"),
        "last_digits": ("figure_3_6_last_digits", "±0.5 of the last digit, release angle kept (as Fig. 3.6)"),
        "release_angle": ("figure_3_7_release_angle", "Release angle ±0.08° (as Fig. 3.7)"),
    }
    found = {titles[k][0]: family_figure(f, titles[k][1]) for k, f in study.families().items()}
    return found | {"growth_of_differences": growth_figure(study.growth)}


def family_figure(f: Family, title: str) -> Any:
    """Return three rates over the whole run on the left, between the first two main impacts on the right."""
    look = [style.INK, *(style.colour(k) for k in range(CURVES))]
    rates = [(f.labels[k], DEGREES * f.crv[k].T, colour, ()) for k, colour in zip(_drawn(f), look, strict=False)]
    return draw(rate_panels(f.t, rates), [(0.0, float(f.t[-1])), ZOOM], marks=f.impacts[0], title=title)


def _drawn(f: Family) -> list[int]:
    """Choose what is drawn: the reference and two more, of many the last two."""
    return list(range(len(f.labels))) if len(f.labels) <= CURVES + 1 else [0, len(f.labels) - 2, len(f.labels) - 1]


def growth_figure(g: Growth) -> Any:
    """Return every small difference in the middle of each arc, over its first size; the straight line of the mean
    factor."""
    figure, ax = one_panel(7.0, 4.2, "main impacts passed", "difference over the first")
    arcs = np.arange(g.factors.shape[1])
    for row in g.factors:
        ax.semilogy(arcs, row, color=style.BAND, lw=0.8)
    ax.semilogy(arcs, np.median(g.factors, axis=0), color=style.INK, lw=1.6, label="median")
    until = arcs[g.per_impact**arcs < 3 * g.factors.max()]
    label = f"{g.per_impact:.3g} × per main impact (×/÷ {g.spread:.2g})"
    ax.semilogy(until, g.per_impact**until, color=style.COLOURS[0], lw=1.2, ls="--", label=label)
    ax.xaxis.get_major_locator().set_params(integer=True)
    ax.legend(frameon=False, fontsize=9)
    return titled(figure, f"{len(g.factors)} releases that differ by 1e-9 rad")
