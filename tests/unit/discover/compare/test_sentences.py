"""Words stand for thresholds."""

import pytest

from rockref.discover.compare.finding import factor_words, listed
from rockref.discover.compare.sentences_shape import (
    AGREE_SHARE,
    LEDGER_SHARE,
    _change,
    _energy_words,
    _envelope_words,
    _less,
)


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
        (0.9, 0.9, "is 10 % too narrow and its teeth are 10 % too close"),
        (1.01, 1.13, "agrees in width, but its teeth are 13 % too far apart"),
        (4.0, None, "is 4 times as wide as measured"),
        (1.01, 5.3, "agrees in width, but its teeth are 5.3 times as far apart as measured"),
        (0.001, None, "is missing"),
    ],
)
def test_envelopes_in_words(width, period, words):
    assert _envelope_words(width, period) == words


def energy_words(**parts):
    """The sentence for losses (model, measured), alike in two runs."""
    return _energy_words({part: _change([pair] * 2, LEDGER_SHARE[part]) for part, pair in parts.items()})


@pytest.mark.parametrize(
    "parts, text",
    [
        (
            {"cycle": (0.069, 0.089), "impact": (0.050, 0.049), "free": (0.020, 0.039)},
            "The model loses 22 % less energy per cycle (6.9 instead of 8.9 %), 49 % less in free arcs (2.0 instead of "
            "3.9 %); the loss per main impact (to 14 %) agrees.",
        ),
        (
            {"cycle": (0.059, 0.068), "impact": (0.066, 0.050), "free": (-0.007, 0.020)},
            "The model loses 13 % less energy per cycle (5.9 instead of 6.8 %), 32 % more per main impact (6.6 instead "
            "of 5.0 %), less in free arcs (below 0.7 instead of 2.0 %).",
        ),
        (
            {"cycle": (0.060, 0.060), "impact": (0.060, 0.061), "free": (0.001, -0.004)},
            "The model loses as much energy as the block, per cycle (to 2 %), per main impact (to 11 %); in free arcs "
            "it cannot be told.",
        ),
        (
            {"impact": (0.004, 0.006), "free": (0.001, 0.001)},
            "Whether the model loses as much energy as the block cannot be told, per main impact or in free arcs.",
        ),
        (
            {"cycle": (0.076, 0.086), "impact": (0.075, 0.085), "free": (0.002, -0.006)},
            "The model loses 12 % less energy per cycle (7.6 instead of 8.6 %), 12 % less per main impact (7.5 instead "
            "of 8.5 %); in free arcs it cannot be told.",
        ),
    ],
    ids=["less in the arcs", "a gain is none", "no free loss", "nothing told", "both below the ledger"],
)
def test_energy_in_words(parts, text):
    """A negative loss is never told as one; a difference below the ledger's own uncertainty is none."""
    assert energy_words(**parts) == text
