"""Spikes of a covariance: found in a sample of it, none in white noise, and taken back to one."""

import numpy as np
import pytest

from rockref.discover.fit.spikes import Spikes, spikes, whitened

#: Records, samples of one axis in a piece.
K, n = 64, 60
RING = np.exp(-np.arange(n) / 12.0)


def sample(rng: np.random.Generator, variance: float) -> np.ndarray:
    """White noise (K, n, 3), and a ring about the third axis with this variance."""
    direction = np.zeros((n, 3))
    direction[:, 2] = RING / np.linalg.norm(RING)
    noise = rng.standard_normal((K, n, 3))
    return noise + np.sqrt(variance - 1.0) * rng.standard_normal((K, 1, 1)) * direction


def test_white_noise_has_none():
    rng = np.random.default_rng(1)
    found = [len(spikes(rng.standard_normal((K, 3 * n)))[1]) for _ in range(40)]
    assert sum(found) == 0


def test_a_ring_is_found_with_its_direction_and_variance():
    directions, variances = spikes(sample(np.random.default_rng(2), 80.0).reshape(K, -1))
    assert len(variances) == 1
    # 64 records tell a variance to 2 sqrt(2/64) = 0.35 with 95 %.
    assert variances[0] == pytest.approx(80.0, rel=0.35)
    along = directions[0].reshape(n, 3)
    assert abs(along[:, 2] @ RING) / np.linalg.norm(RING) > 0.97
    assert np.abs(along[:, :2]).max() < 0.1


def test_what_rings_is_white_afterwards():
    rng = np.random.default_rng(3)
    found = Spikes(1, 20, 20 + n, *spikes(sample(rng, 80.0).reshape(K, -1)))
    r = rng.standard_normal((K, 2, 100, 3))
    r[:, 1, 20 : 20 + n] = sample(rng, 80.0)
    before, after = r.copy(), whitened(r.copy(), [found])
    ring = np.zeros((n, 3))
    ring[:, 2] = RING / np.linalg.norm(RING)
    along = (after[:, 1, 20 : 20 + n] * ring).sum(axis=(1, 2))
    # A variance by 64 values, in a direction that 64 others told: one, to a half.
    assert np.var(along) == pytest.approx(1.0, abs=0.8)
    assert np.var((before[:, 1, 20 : 20 + n] * ring).sum(axis=(1, 2))) > 40.0
    # Nothing else is touched.
    outside = np.ones(r.shape, bool)
    outside[:, 1, 20 : 20 + n] = False
    assert np.array_equal(after[outside], before[outside])


def test_a_part_of_the_runs_is_whitened_as_far_as_it_goes():
    directions, variances = spikes(sample(np.random.default_rng(4), 80.0).reshape(K, -1))
    r = np.random.default_rng(5).standard_normal((2, 40, 3))
    inside, beyond = Spikes(0, 20, 20 + n, directions, variances), Spikes(1, 60, 60 + n, directions, variances)
    after = whitened(r.copy(), [inside, beyond])
    assert after.shape == r.shape and np.array_equal(after[1], r[1])
    assert np.array_equal(after[0, :20], r[0, :20]) and not np.array_equal(after[0, 20:], r[0, 20:])
