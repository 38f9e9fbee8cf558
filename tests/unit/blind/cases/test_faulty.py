"""Faults of a logger: what each does to a record, and to which runs."""

import numpy as np
import pytest

from rockref.blind.cases import faulty

T = np.arange(4000) / 1000
RATES = np.column_stack([0.6 * np.sin(3 * T), 0.1 * np.cos(50 * T), 0.1 * np.sin(40 * T)])


def spoilt(id, seed=0):
    return faulty.FAULTS[id](T, RATES, np.random.default_rng(seed))


@pytest.mark.parametrize("seed", range(5))
def test_one_axis_is_held_and_the_others_go_on(seed):
    out, truth = spoilt("held_axis", seed)
    axis = "xyz".index(truth["axis"])
    inside = (truth["from"] <= T) & (truth["to"] >= T)
    assert np.ptp(out[inside, axis]) == 0 and 0.24 < truth["to"] - truth["from"] < 0.51
    out[inside, axis] = RATES[inside, axis]
    np.testing.assert_array_equal(out, RATES)


def test_what_is_too_large_comes_out_with_the_other_sign():
    out, truth = spoilt("wrapped")
    limit = truth["limit"]
    large = np.abs(RATES) > limit
    np.testing.assert_allclose(out[~large], RATES[~large], atol=1e-15)
    np.testing.assert_allclose(out[large], (RATES - np.sign(RATES) * 2 * limit)[large], atol=1e-15)
    assert large.any() and np.abs(out).max() <= limit


def test_an_answer_is_written_again_until_the_next():
    out, truth = spoilt("sample_and_hold")
    n = truth["times"]
    assert 4 <= n <= 10
    np.testing.assert_array_equal(out[::n], RATES[::n])
    np.testing.assert_array_equal(out[n - 1 :: n], out[::n][: len(out[n - 1 :: n])])


def test_a_burst_is_a_few_samples_beyond_what_the_block_does():
    out, truth = spoilt("burst")
    changed = np.flatnonzero(np.any(out != RATES, axis=1))
    assert len(changed) == truth["samples"] == np.ptp(changed) + 1
    assert np.abs(truth["rate"]) >= 2 * np.abs(RATES).max()


@pytest.mark.parametrize("id", faulty.FAULTS)
def test_a_fault_of_the_device_is_in_every_run_and_any_other_in_one_that_is_fitted(id):
    tables = [(T, RATES)] * 3
    found, truth = faulty.spoil(id, tables, ["holdout", "fit", "fit"], np.random.default_rng(4))
    touched = {str(i + 1) for i, (_, rates) in enumerate(found) if not np.array_equal(rates, RATES)}
    assert touched == set(truth["runs"]) and truth["id"] == id
    assert touched == {"1", "2", "3"} if id in faulty.OF_THE_DEVICE else touched in ({"2"}, {"3"})
