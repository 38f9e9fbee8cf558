"""Words stand for thresholds."""

import pytest

from rockref.discover.finding import factor_words, listed
from rockref.discover.sentences_shape import AGREE_SHARE, _change, _envelope_words, _less


@pytest.mark.parametrize(
    "words, text",
    [([], ""), (["a"], "a"), (["a", "b"], "a and b"), (["a", "b", "c"], "a, b and c")],
)
def test_lists_in_words(words, text):
    assert (listed(words) if words else "") == text


@pytest.mark.parametrize("factor, words", [(1.02, "2.0 % larger"), (0.958, "4.2 % smaller")])
def test_factors_in_words(factor, words):
    assert factor_words(factor) == words


def test_losses_agree_within_two_per_cent_however_sharp_the_runs():
    assert _change([(1.019, 1.0)] * 4).agrees
    assert not _change([(1.021, 1.0)] * 4).agrees
    assert _change([(1.0, 1.0)]).resolution == AGREE_SHARE


def test_losses_agree_within_two_standard_errors():
    # Mean difference 0.1; standard deviation 0.1, standard error of three runs 0.0577.
    change = _change([(1.0, 1.0), (1.1, 1.0), (1.2, 1.0)])
    assert change.error == pytest.approx(0.1 / 3**0.5)
    assert change.agrees and change.resolution == pytest.approx(2 * 0.1 / 3**0.5)


@pytest.mark.parametrize(
    "model, measured, words",
    [(0.96, 1.0, "4 % less"), (1.25, 1.0, "25 % more"), (3.0, 1.0, "more"), (0.1, -0.2, "more"), (-0.3, -0.2, "less")],
)
def test_amounts_in_words(model, measured, words):
    assert _less(_change([(model, measured)])) == words


@pytest.mark.parametrize(
    "width, period, words",
    [
        (1.0, 1.0, "agrees in width"),
        (1.12, None, "is 12 % too wide"),
        (0.9, 0.9, "is 10 % too narrow and its teeth come 10 % too fast"),
        (1.01, 1.13, "agrees in width, but its teeth come 13 % too slowly"),
        (4.0, None, "is 4 times as wide as measured"),
        (0.001, None, "is missing"),
    ],
)
def test_envelopes_in_words(width, period, words):
    assert _envelope_words(width, period) == words
