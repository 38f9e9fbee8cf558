"""Charts of outcomes: what is drawn is what was given."""

import numpy as np
import pytest

from rockref.report.charts.figures import rendered
from rockref.report.charts.shake_figures import (
    distribution_figure,
    fragility_figure,
    overturning_map,
    reliability_figure,
)
from rockref.shake.statistics.fragility import fit_fragility

X = np.geomspace(0.1, 1.0, 40)
FELL = (np.arange(40) * 7 % 40 < np.arange(40)).astype(float)


def labelled(figure):
    return {line.get_label(): line for line in figure.axes[0].lines}


def test_fragility_curve_and_every_outcome_are_drawn():
    fitted = fit_fragility(X, FELL)
    figure = fragility_figure(X, FELL, fitted, "PGA (g)")
    curve = labelled(figure)["fitted, with Jeffreys' prior"]
    assert curve.get_ydata() == pytest.approx(fitted.probability(curve.get_xdata()))
    outcomes = figure.axes[0].lines[-1].get_ydata()
    assert (np.asarray(outcomes) > 0.5).tolist() == (FELL == 1).tolist()


def test_few_levels_have_a_mark_each_and_many_sizes_groups_of_as_many():
    def marks(x):
        figure = fragility_figure(x, FELL, fit_fragility(x, FELL), "PGA (g)")
        return sorted(float(line.get_xdata()[0]) for line in figure.axes[0].lines if line.get_marker() == "o")

    # Two levels that groups of as many tests would mix.
    assert marks(np.where(np.arange(40) < 17, 0.2, 0.3)) == pytest.approx([0.2, 0.3])
    assert len(marks(X)) == 8


def test_map_tells_falls_from_stands_and_draws_one_half():
    figure = overturning_map(X, X[::-1], FELL, lambda a, b: np.clip(a, 0.0, 1.0))
    marks = labelled(figure)
    assert len(marks[f"fell ({int(FELL.sum())})"].get_xdata()) == FELL.sum()
    assert len(marks[f"stood ({int((1 - FELL).sum())})"].get_xdata()) == (1 - FELL).sum()
    assert any("0.5" in text.get_text() for text in figure.axes[0].texts)


def test_distribution_functions_end_at_one():
    figure = distribution_figure({"measured": [1.0, 2.0], "model": [3.0, 1.0, 2.0]}, "tilt (deg)")
    assert all(line.get_ydata()[-1] == 1.0 for line in figure.axes[0].lines)
    assert len(figure.axes[0].collections) == 2


def test_reliability_is_drawn_with_its_intervals_and_files_repeat_to_the_byte():
    figure = reliability_figure({"a": (np.linspace(0, 1, 40), FELL)})
    assert len(figure.axes[0].containers) == 1
    assert rendered(figure, "png") == rendered(reliability_figure({"a": (np.linspace(0, 1, 40), FELL)}), "png")
