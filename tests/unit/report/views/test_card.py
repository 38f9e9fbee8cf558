"""The card of a page: what was found, drawn on a run that no fit has read, with the effect at several sizes."""

import numpy as np
import pytest

from rockref.discover.diagnosis_record import plain
from rockref.report.html.encoding import unpacked
from rockref.report.html.trial import OPTIMUM, SHARES, opening, scaled
from rockref.report.terminal.diagnosis_text import MEANINGS
from rockref.report.views.addition_page import compared as before_and_after
from rockref.report.views.card import WITHOUT, card_of_addition, card_of_diagnosis, fitted_baseline
from rockref.report.views.diagnosis_page import compared
from tests.unit.discover import fakes


@pytest.fixture(scope="module")
def named():
    d = fakes.diagnosis("named")
    c = compared(d)
    return d, c, card_of_diagnosis(plain(d.to_dict()), c)


def test_name_size_and_error_stand_at_the_head(named):
    d, _, card = named
    assert card.name == "quadratic_drag" and card.kicker.startswith("named") and card.next_step.startswith("Turn")
    size, error = card.facts
    assert (size.label, size.value, size.notes[0]) == ("Size", "0.41 N m s²", "90 %: 0.38 to 0.44")
    assert error.value == "0.350 → 0.080 deg/s" and error.notes == ["noise alone: 0.050", "90 % of the excess gone"]


def test_the_run_that_is_drawn_was_held_out(named):
    d, c, card = named
    drawn = card.trial
    (run,) = [r for r in d.experiment.holdout_runs() if r.id == drawn.run]
    assert drawn.held_out and "no fit has read it" in drawn.sentence
    assert drawn.view[0] < drawn.view[1] <= drawn.t[-1] and set(drawn.impacts) <= set(
        c.measured[c.of("holdout")[0]].features.impacts.times
    )
    assert drawn.measured[0] == pytest.approx(np.degrees(run.crv[0]))


def test_the_slider_goes_through_the_model_that_was_found(named):
    _, c, card = named
    (dial,) = card.trial.dials
    k = c.of("holdout")[0]
    assert SHARES[OPTIMUM] == 1.0 and len(dial.rates) == len(SHARES) == 9
    found = np.degrees(c.results[1][k].modelled)[:: round((card.trial.t[1] - card.trial.t[0]) * 1000)]
    np.testing.assert_array_equal(dial.rates[OPTIMUM], found[: len(dial.rates[OPTIMUM])])
    assert dial.sizes[0] == "none" and dial.sizes[OPTIMUM].endswith("N m s²")
    assert np.abs(np.diff(dial.rates, axis=0)).max(axis=(1, 2)).min() > 0


def test_at_no_size_the_effect_is_gone_and_at_twice_it_is_twice_as_large(named):
    d, _, _ = named
    without, words = scaled(d.model, "quadratic_drag", 0.0)
    assert without.effects == () and words == "none"
    twice, _ = scaled(d.model, "quadratic_drag", 2.0)
    assert twice.effects[0].c == pytest.approx(2 * d.model.effects[0].c)


def test_what_the_script_draws_is_what_was_computed(named):
    drawn = named[2].trial
    data = drawn.data()
    column = data["dials"][0]["rates"][OPTIMUM][drawn.axis]
    assert np.abs(unpacked(column) - drawn.after[:, drawn.axis]).max() <= column["unit"]
    assert data["axis"] == drawn.axis and len(data["dials"][0]["errors"]) == 9


@pytest.mark.parametrize("verdict", MEANINGS)
def test_every_verdict_has_a_card_and_says_what_to_measure(named, verdict):
    d = fakes.diagnosis(verdict, named[0].experiment)
    card = card_of_diagnosis(plain(d.to_dict()), named[1])
    assert card.next_step and verdict in WITHOUT and card.picture.startswith("<svg")
    assert bool(card.trial.dials) is (verdict in ("named", "class"))


def test_an_addition_is_drawn_beside_the_model_before():
    a = fakes.addition()
    card = card_of_addition(a, before_and_after(a))
    assert card.name == "quadratic_drag" and card.kicker == "added to the baseline"
    assert card.trial.before != pytest.approx(card.trial.after, abs=1e-3)


def test_the_baseline_is_the_one_that_fits_best(monkeypatch):
    d = fakes.diagnosis("named")
    assert fitted_baseline(d).parameters.K_N == pytest.approx(6.0e7)

    class Kept:
        carried = ()

        def of(self, effects):
            return fakes.fitted().evidence

    d.evidence = Kept()
    # z of 0.3 in the prior of a fit.
    assert fitted_baseline(d).parameters.K_N != pytest.approx(6.0e7)


def test_the_view_opens_where_a_difference_stays():
    t = np.arange(0, 2, 1e-3)
    difference = np.where(t > 0.9, 1.0, 0.0)
    difference[100] = 50.0  # a spike is no difference that stays
    start, end = opening(t, difference, 0.05, np.array([0.5, 1.2]))
    assert 0.8 < start < 0.9 < end
    assert opening(t, np.zeros(2000), 0.05, np.array([]))[0] < 1.0
