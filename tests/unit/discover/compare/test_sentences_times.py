"""Sentences about instants, from made-up comparisons."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.compare import sentences_shape, sentences_times
from rockref.discover.compare.models import impact_time_per_tilt
from rockref.discover.compare.stretches import AXES

#: By how much an impact moves with the tilt at 0.117 rad, s/rad.
SLOPE = impact_time_per_tilt(0.117, 0.1, 0.688)


def impact(measured, error, aligned=0.0):
    return SimpleNamespace(measured=measured, error=error, aligned_error=aligned)


def comparison(impacts, uncertainty=0.0014, turned=(), repeats=None, **more):
    """A model beside runs with these pairs of impacts; `turned` are the places of the runs of a turned block."""
    measured = [
        SimpleNamespace(
            run=SimpleNamespace(release_tilt=0.117, block_turned=math.pi if k in turned else 0.0), repeats=repeats
        )
        for k in range(len(impacts))
    ]
    results = [SimpleNamespace(impacts=i, **more) for i in impacts]
    experiment = SimpleNamespace(tilt_uncertainty=uncertainty, width=0.1, height=0.688)
    return SimpleNamespace(names=("m",), measured=measured, results=[results], experiment=experiment)


def text_of(found):
    (one,) = found
    return one.text


@pytest.mark.parametrize(
    "uncertainty, error, words",
    [
        (None, 4e-3, "is off by +1.0 to +4.0 ms (plus: the model is late)."),
        (0.0014, 4e-3, "of the release tilt explains up to"),
        (0.0014, 4e-2, "more than the"),
    ],
)
def test_the_first_impact_is_held_against_what_the_tilt_explains(uncertainty, error, words):
    c = comparison([[impact(0.51, 1e-3)], [impact(0.51, error)]], uncertainty)
    text = text_of(sentences_times.first_impact(c, 0))
    assert words in text
    assert (f"{1e3 * 0.0014 * SLOPE:.0f} ms" in text) is (uncertainty is not None)


@pytest.mark.parametrize("impacts", [[], [[]], [[impact(0.51, math.nan)]]])
def test_without_a_first_impact_nothing_is_said_of_it(impacts):
    assert sentences_times.first_impact(comparison(impacts), 0) == []


def test_a_run_of_one_impact_says_nothing_of_the_swing_between_two():
    alone = [impact(0.51, 0.0)]
    assert sentences_times.to_second_impact(comparison([alone]), 0) == []
    both = [impact(0.50, 0.0), impact(1.30, 0.0, 8e-3)]
    text = text_of(sentences_times.to_second_impact(comparison([alone, both]), 0))
    assert "the model takes 8.0 ms longer (1.0 %)." in text


@pytest.mark.parametrize(
    "errors, words",
    [
        (
            (8e-3, -6e-3),
            "8.0 ms longer, but with the block turned by 180 degrees 6.0 ms less; repeated runs",
        ),
        ((8e-3, 6e-3), "takes 7.0 ms longer (0.9 %); repeated"),
        ((2e-3, 1e-3), "takes as long as the block, to 2.0 ms; repeated runs scatter by 1.4 ms."),
    ],
)
def test_a_swing_that_depends_on_the_side_is_told_from_one_that_does_not(errors, words):
    both = [[impact(0.50, 0.0), impact(1.30, 0.0, e)] for e in errors]
    repeats = SimpleNamespace(impacts=np.array([[0.5, 1.300], [0.5, 1.302]]))
    c = comparison(both, turned=(1,), repeats=repeats)
    assert words in text_of(sentences_times.to_second_impact(c, 0))


def error(rms, in_noise):
    return SimpleNamespace(rms=rms, in_noise=in_noise)


@pytest.mark.parametrize(
    "noisy, words",
    [
        ((1.0, 1.1, None), "agrees with all three rates to the noise"),
        ((3.0, 1.0, 2.0), "3.0 about the main axis, 2.0 about the longitudinal axis."),
        ((None, None, None), None),
    ],
)
def test_before_the_first_impact_errors_are_told_in_widths_of_the_noise(noisy, words):
    known = dict(zip(AXES, noisy, strict=True))
    c = comparison([[]], error=lambda stretch, axis: error(1.0, known[axis]))
    found = sentences_times.before_impact(c, 0)
    assert (found == []) if words is None else (words in text_of(found))


def losses(**parts):
    return SimpleNamespace(**{"cycle": math.nan, "impact": math.nan, "free": math.nan} | parts)


def test_without_a_loss_at_an_impact_nothing_is_said_of_the_energy():
    c = comparison([[]], losses_model=losses(), losses_measured=losses(impact=0.05))
    assert sentences_shape.energy(c, 0) == []
    c = comparison([[]] * 2, losses_model=losses(impact=0.1), losses_measured=losses(impact=0.05))
    assert "100 % more" in text_of(sentences_shape.energy(c, 0))


@pytest.mark.parametrize(
    "axes, words",
    [
        ((), None),
        (("transverse",), "the transverse envelope is 20 % too wide."),
        (("transverse", "longitudinal"), "20 % too wide; the longitudinal envelope is 20 % too wide."),
    ],
)
def test_envelopes_are_told_of_the_axes_that_have_one(axes, words):
    seen = [SimpleNamespace(axis=axis, width=1.2 if axis in axes else None, period=None) for axis in AXES[1:]]
    found = sentences_shape.envelope(comparison([[]], envelopes=seen), 0)
    assert (found == []) if words is None else text_of(found).endswith(words)


def test_models_are_set_side_by_side_where_all_of_them_have_a_number():
    errors = {"before": (0.1, 0.3), "between": (0.20, 0.21), "after": (0.2, math.nan)}
    c = SimpleNamespace(
        names=("a", "b"), results=[[], []], noise=lambda: 0.01, rms=lambda model, stretch: errors[stretch][model]
    )
    first, second = (f.text for f in sentences_shape.side_by_side(c))
    assert " a is closest (deg/s" in first and " a and b are about as close (deg/s" in second
