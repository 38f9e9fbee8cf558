"""The head of the page of `rockref compare`: by how much each model is off, and one run drawn with all of them."""

from __future__ import annotations

import math

import numpy as np

from rockref.discover.compare.models import Comparison
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import AXES
from rockref.model.channel import DEGREES
from rockref.report.charts import style
from rockref.report.charts.drawing import Line
from rockref.report.html.trial import Trial, trial
from rockref.report.terminal.comparison_text import error_lines, share_missed
from rockref.report.views.card import Card, Fact


def card_of_comparison(c: Comparison) -> Card:
    """Return the card of a comparison."""
    shown = trial(c, ())
    picture, keys = drawn(c, shown)
    found = [f.text for f in findings(c) if f.kind in ("overturned", "leaves_band") and f.model == c.names[-1]]
    return Card(
        kicker="comparison",
        name=name_of(c),
        sentence=" ".join(error_lines(c)),
        about=" ".join(found[:1]),
        facts=[fact(c, k) for k in range(len(c.names))],
        next_step="rockref diagnose FOLDER --report report: which effect the model lacks.",
        picture=picture,
        keys=keys,
        caption=caption(shown),
        next_label="Next",
    )


def shares(c: Comparison, model: int) -> list[tuple[str, float]]:
    """Return the error of a model over the measured rates, of held-out runs first, with the words for its runs."""
    found = [(words, share_missed(c, model, use)) for use, words in (("holdout", "held-out"), ("fit", "fit"))]
    return [(words, share) for words, share in found if math.isfinite(share)]


def name_of(c: Comparison) -> str:
    """Return by how much the model is off, of several which is closest."""
    sized = [(found[0][1], name) for k, name in enumerate(c.names) if (found := shares(c, k))]
    if not sized:
        return "no model stands"
    share, name = min(sized)
    off = f"off by {100 * share:.2g} %"
    return off if len(c.names) == 1 else f"{name} is closest, {off}"


def fact(c: Comparison, model: int) -> Fact:
    """Return the error of one model."""
    found = [(words, f"{100 * share:.2g} %") for words, share in shares(c, model)]
    if not found:
        return Fact(c.names[model], "–", ["the block falls over"])
    (words, value), *rest = found
    return Fact(c.names[model], value, [f"on the {words} runs", *(f"{v} on the {w} runs" for w, v in rest)])


def drawn(c: Comparison, shown: Trial) -> tuple[str, str]:
    """Return (SVG, legend) of a run where the difference shows, measured and by every model."""
    k = next(i for i, m in enumerate(c.measured) if m.run.id == shown.run)
    t = c.measured[k].run.t
    assert t is not None
    inside = (shown.t >= shown.view[0]) & (shown.t <= shown.view[1])
    x, rows = shown.t[inside], np.searchsorted(t, shown.t[inside])
    lines = [Line("measured", x, shown.measured[inside, shown.axis])]
    for i, name in enumerate(c.names):
        rates = c.results[i][k].modelled[rows, shown.axis] * DEGREES
        lines.append(Line(name, x, rates, style.colour(i), style.dash(i)))
    return shown.drawn(lines, f"Run {shown.run}: measured and modelled")


def caption(shown: Trial) -> str:
    """Return what is drawn."""
    use = "held out" if shown.held_out else "a fit run: none is held out"
    return (
        f"Run {shown.run} ({use}), where the difference begins to show: rate about the {AXES[shown.axis]} axis. "
        "Released as measured, the models run on alone. Red lines: main impacts."
    )
