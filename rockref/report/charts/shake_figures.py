"""Charts of outcomes on the shake table: fragility, overturning map, distribution functions, reliability."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rockref.report.charts import style
from rockref.report.charts.figures import new_figure, one_panel, plain_ticks, titled
from rockref.shake.statistics.bands import distribution_function, wilson_interval
from rockref.shake.statistics.fragility import Fragility, monotone_curve
from rockref.shake.statistics.scores import reliability

# decided: so many marks at most; each rests on as many tests, or on all tests of a level where there are few levels.
_GROUPS = 8
# decided: outcomes lie on two lines; marks are shifted by up to this share of the axis, so that they can be counted.
_JITTER = 0.03
# decided: where the largest value is so many times the smallest, a straight axis hides one of them.
WIDE = 30.0


def fragility_figure(x: Any, fell: Any, fitted: Fragility, unit: str) -> Any:
    """Draw a fragility with its interval, the monotone curve, shares of groups of tests, and every outcome.

    x : (n,) sizes of the motions, `unit` is what the axis says;  fell : (n,) outcomes
    """
    sizes, y = np.asarray(x, float), np.asarray(fell, float)
    figure, ax = one_panel(7.0, 4.4, unit, "probability of falling")
    at = np.geomspace(sizes.min(), sizes.max(), 300)
    low, high = fitted.interval(at)
    ax.fill_between(at, low, high, color=style.BAND, lw=0, label="95% interval of the fit")
    ax.plot(at, fitted.probability(at), color=style.COLOURS[1], lw=1.6, label="fitted, with Jeffreys' prior")
    levels, curve = monotone_curve(sizes, y)
    ax.step(levels, curve, where="post", color=style.COLOURS[0], lw=1.0, label="monotone, without a form")
    for group in _groups(sizes):
        k, n = int(y[group].sum()), len(group)
        ends = wilson_interval(k, n)
        middle = float(np.exp(np.log(sizes[group]).mean()))
        ax.plot([middle, middle], ends, color=style.INK, lw=0.8)
        ax.plot(middle, k / n, "o", ms=4, color=style.INK)
    shift = _JITTER * (np.arange(len(y)) * 0.618 % 1.0)
    ax.plot(sizes, np.where(y == 1.0, 1.0 + shift, -shift), "|", ms=4, mew=0.5, color=style.GREY)
    ax.set_xscale("log")
    plain_ticks(ax.xaxis)
    ax.set_ylim(-0.06, 1.06)
    ax.legend(loc="upper left", bbox_to_anchor=(0.0, 0.94), frameon=False, fontsize=8)
    title = f"median {fitted.theta:.3g}, scatter {fitted.beta:.2g}; {len(y)} tests, {int(y.sum())} fell"
    return titled(figure, title, 9)


def _groups(sizes: np.ndarray) -> list[np.ndarray]:
    """Return the places of tests, group by group: a group a level, or groups of as many tests in order of size."""
    levels, level = np.unique(sizes, return_inverse=True)
    if len(levels) <= _GROUPS:
        return [np.flatnonzero(level == k) for k in range(len(levels))]
    return np.array_split(np.argsort(sizes), _GROUPS)


def overturning_map(
    x: Any, y: Any, fell: Any, probability: Any = None, axes: tuple[str, str] = ("PGA (g)", "PGV / PGA (s)")
) -> Any:
    """Draw outcomes (n,) over two sizes of their motions, both (n,); lines are those of equal predicted probability.

    probability : function of both sizes (m,) that returns (m,), or None;  axes : what the axes say
    """
    across_all, up_all, outcome = (np.asarray(v, float) for v in (x, y, fell))
    figure = new_figure(7.0, 4.8)
    ax = figure.subplots(1, 1)
    ax.set_xscale("log")
    ax.set_yscale("log")
    if probability is not None:
        # A tenth beyond the tests on all sides, so that no mark is cut.
        across, up = (np.geomspace(v.min() / 1.1, v.max() * 1.1, 120) for v in (across_all, up_all))
        X, Y = np.meshgrid(across, up)
        P = np.asarray(probability(X.ravel(), Y.ravel())).reshape(X.shape)
        ax.contourf(X, Y, P, levels=np.linspace(0.0, 1.0, 11), cmap="Greys", alpha=0.35)
        lines = ax.contour(X, Y, P, levels=[0.1, 0.5, 0.9], colors=style.INK, linewidths=[0.7, 1.4, 0.7])
        ax.clabel(lines, fmt="%.1f", fontsize=8)
    for value, mark, colour, name in ((0.0, "o", style.COLOURS[1], "stood"), (1.0, "x", style.COLOURS[0], "fell")):
        inside = outcome == value
        look: dict[str, Any] = {"ms": 4, "mfc": "none", "color": colour, "lw": 0, "label": f"{name} ({inside.sum()})"}
        ax.plot(across_all[inside], up_all[inside], mark, **look)
    plain_ticks(ax.xaxis)
    plain_ticks(ax.yaxis)
    ax.set_xlabel(axes[0])
    ax.set_ylabel(axes[1])
    ax.legend(loc="upper right", frameon=True, framealpha=0.9, edgecolor="none", fontsize=8)
    said = "" if probability is None else "; lines: predicted probability of falling"
    return titled(figure, f"{len(outcome)} tests{said}", 9)


def distribution_figure(samples: Mapping[str, Any], quantity: str) -> Any:
    """Draw distribution functions with their bands, a colour and a dash a sample; the first is the measured one."""
    figure, ax = one_panel(7.0, 4.8, quantity, "share of runs at or below")
    # Room for the names above the curves, which reach into every corner.
    figure.subplots_adjust(top=0.82)
    for k, (name, values) in enumerate(samples.items()):
        x, share, low, high = distribution_function(values)
        colour = style.INK if k == 0 else style.colour(k - 1)
        dashes = {} if k == 0 else {"dashes": tuple(0.8 * d for d in style.dash(k - 1))}
        ax.fill_between(x, low, high, step="post", color=colour, alpha=0.13, lw=0)
        ax.step(x, share, where="post", color=colour, lw=1.3, label=f"{name} ({len(x)})", **dashes)
    ax.set_ylim(0.0, 1.0)
    ax.margins(x=0.0)
    known = np.concatenate([np.asarray(values, float) for values in samples.values()])
    known = known[np.isfinite(known)]
    if len(known) and known.min() > 0.0 and known.max() > WIDE * known.min():
        ax.set_xscale("log")
        plain_ticks(ax.xaxis)
    ax.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), frameon=False, fontsize=8, ncols=3)
    return titled(figure, "Distribution functions; bands hold a whole function with 95% (DKW)", 9)


def reliability_figure(predictions: Mapping[str, tuple[Any, Any]]) -> Any:
    """Draw the share that fell over the predicted probability, with Wilson intervals; values: probability and fell."""
    figure, ax = one_panel(5.6, 4.8, "predicted probability of falling", "share that fell")
    ax.plot([0.0, 1.0], [0.0, 1.0], color=style.GREY, lw=0.8, dashes=style.HOUSNER_DASH)
    for k, (name, (probability, fell)) in enumerate(predictions.items()):
        found = reliability(probability, fell)
        at = np.array([b.predicted for b in found]) + 0.006 * k
        ends = np.array([[b.observed - b.low, b.high - b.observed] for b in found]).T
        look: dict[str, Any] = {"fmt": "os^Dv"[k % 5], "ms": 4, "lw": 0.8, "color": style.colour(k), "label": name}
        ax.errorbar(at, [b.observed for b in found], np.maximum(ends, 0.0), **look)
    ax.set_xlim(-0.03, 1.03)
    ax.set_ylim(-0.03, 1.03)
    ax.legend(loc="upper left", frameon=False, fontsize=8)
    return titled(figure, "Reliability: on the line is as predicted", 9)
