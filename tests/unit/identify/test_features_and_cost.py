"""The cost: zero at itself, terms that answer to what they are named after, the fast spectrum against the plain one."""

import numpy as np
import pytest

from rockref.identify.candidates import Releases, evaluate, feature_costs, records
from rockref.identify.cost import MISSING, WEIGHTS, Terms, cost_terms, total
from rockref.identify.features import Features, features, spectrum
from rockref.identify.genes import chromosome, space_12
from rockref.measure.signals.spectra import amplitude_spectrum


def test_a_record_costs_nothing_against_itself(twin):
    assert cost_terms(twin.features, twin.features) == Terms(0, 0, 0, 0, 0, 0)


def test_the_true_model_costs_nothing(twin, table_3_1):
    space = space_12(table_3_1)
    cost, terms = evaluate(space, [twin], chromosome(space, table_3_1.parameters)[None])[0]
    # The chromosome's logarithms round the parameters in the last digit; what is left is rounding.
    assert cost < 1e-6 and len(terms) == 1


@pytest.mark.parametrize("rate", [1000.0, 2000.0])
def test_fast_spectrum_is_the_plain_one(twin, rate):
    t = np.arange(0, twin.t[-1], 1 / rate)
    crv = np.stack([np.interp(t, twin.t, c) for c in twin.crv.T], axis=-1)
    start, end = twin.features.impacts[:2]
    plain = amplitude_spectrum(t, crv, start, end).amplitudes[1:]
    # Sums of 1600 terms in another order.
    np.testing.assert_allclose(spectrum(t, crv, start, end), plain, rtol=0, atol=1e-12 * plain.max())


def test_an_odd_rate_takes_the_plain_way(twin):
    t = np.linspace(0, twin.t[-1], 1234)
    crv = np.stack([np.interp(t, twin.t, c) for c in twin.crv.T], axis=-1)
    start, end = twin.features.impacts[:2]
    np.testing.assert_array_equal(spectrum(t, crv, start, end), amplitude_spectrum(t, crv, start, end).amplitudes[1:])


def test_each_term_answers_to_its_own_change(twin):
    t, crv = twin.t, twin.crv
    louder = crv.copy()
    louder[:, 1] *= 1.5
    terms = cost_terms(features(t, louder), twin.features)
    assert terms.envelope_transverse == pytest.approx(0.5, abs=0.02)
    assert terms.spectrum_transverse == pytest.approx(0.5, abs=0.02)
    assert terms.envelope_longitudinal == 0.0 == terms.first_impact
    later = cost_terms(features(t + 0.004, crv), twin.features)
    assert later.first_impact == pytest.approx(0.4, rel=1e-6), "4 ms of the 10 ms that count as one"
    assert later.duration == pytest.approx(0.0, abs=1e-9)


def test_weights_are_in_one_place():
    terms = Terms(1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert total(terms) == sum(w * x for w, x in zip(WEIGHTS, terms, strict=True))
    assert total(terms, weights=Terms(0, 1, 0, 0, 0, 0)) == 2.0


def test_a_model_that_falls_short_costs_more_than_any_that_does_not(twin):
    assert cost_terms(Features(np.array([0.5])), twin.features) is None
    assert total(None, 0) > total(None, 1) >= MISSING


def test_the_cost_is_the_chromosome_s_own(twin, table_3_1):
    """Whatever else is in the batch, in whatever pieces: that is what makes workers exchangeable."""
    space = space_12(table_3_1)
    us = np.random.default_rng(0).random((3, 12))
    together = feature_costs(space, [twin], us)
    assert together == [feature_costs(space, [twin], u[None])[0] for u in us]


def test_a_block_that_cannot_be_released_is_only_a_bad_one(twin, table_3_1):
    bodies = [table_3_1.body(), table_3_1.body(), None]
    [(t, crv)] = records([Releases(twin, [table_3_1] * 3, [0.117, 0.2, 0.117], [{}] * 3, bodies, twin.duration)])
    assert np.isfinite(crv[0]).all() and np.isnan(crv[1:]).all()
    space = space_12(table_3_1, 0.117)
    assert np.isfinite(feature_costs(space, [twin], np.full((1, 12), 0.5)))
