"""The planar block against closed forms and numbers that were computed apart from the product."""

import numpy as np
import pytest

from rockref.shake.planar import rock

G = 9.81


def falls(factors, wave, alpha, e, step=2e-3, p=1.0):
    """Which levels of a pulse, in units of g alpha, overturn, and after how many impacts. wave(t) of size 1."""
    t = np.arange(0, 12.0, step)
    r = rock(alpha, p, e, t, G * alpha * np.asarray(factors) * wave(t)[:, None])
    return np.abs(r.theta[-1]) > alpha, r.impacts  # beyond its slenderness angle without a pulse it only falls


def one_sine(t, omega=5.0):
    return np.where(omega * t < 2 * np.pi, np.sin(omega * t), 0.0)


@pytest.mark.parametrize(
    "alpha, first, stands, direct",
    [
        # 0.002: the linear equation but for terms of alpha^2
        (0.002, 3.0186, 6.318, 7.16813),
        (0.25, 3.032, 6.743, 7.493),
    ],
)
def test_a_one_sine_pulse_overturns_after_one_impact_in_a_band_and_without_impact_above(alpha, first, stands, direct):
    """omega = 5 p, e = 0.9; computed apart from the product to the digits printed. A thousandth on either side."""
    edges = np.array([first, stands, direct])
    below, b = falls(edges * 0.999, one_sine, alpha, 0.9)
    above, a = falls(edges * 1.001, one_sine, alpha, 0.9)
    assert below.tolist() == [False, True, False] and above.tolist() == [True, False, True]
    assert a[0] == 1 and b[1] == 1 and a[2] == 0


@pytest.mark.parametrize("A, pt", [(1.2, 1.7918), (2.0, 0.6931), (4.0, 0.2877)])
def test_a_rectangular_pulse_overturns_after_its_least_duration(A, pt):
    """cosh(p t) = 1 + 1 / [2 A (A - 1)] of the slender block; the pulse ends on a sample, halfway down its flank."""
    assert np.isclose(np.cosh(pt), 1 + 1 / (2 * A * (A - 1)), rtol=2e-4)
    for share, fallen in ((0.995, False), (1.005, True)):
        step = share * pt / 400
        pulse = np.ones(401)
        pulse[-1] = 0.5  # with the flank that follows, of the area of a pulse that ends 400 steps after its start
        fell, _ = falls([A], lambda t, pulse=pulse: np.pad(pulse, (0, len(t) - 401)), 1e-3, 0.9, step)
        assert fell.tolist() == [fallen]


def test_free_rocking_loses_its_amplitude_as_housner_says():
    """phi_n = 1 - sqrt(1 - e^2n [1 - (1 - phi_0)^2]); numbers of phi_0 = 0.6, alpha = 0.2, computed apart."""
    alpha, e = 0.002, 1 - 1.5 * np.sin(0.2) ** 2
    t = np.arange(0, 12.0, 2e-3)
    r = rock(alpha, 1.0, e, t, np.zeros_like(t), theta=0.6 * alpha)
    tilt = np.abs(r.theta[:, 0]) / alpha
    tops = tilt[1:-1][(tilt[1:-1] > tilt[:-2]) & (tilt[1:-1] >= tilt[2:])]
    np.testing.assert_allclose(tops[:5], [0.4935, 0.4152, 0.3538, 0.3040, 0.2626], atol=6e-5)
    # the quarter period from phi_0
    first = t[np.flatnonzero(r.theta[:, 0] < 0)[0]]
    assert abs(np.cosh(first) - 1 / 0.4) < 3e-3 * np.sinh(first)


def test_a_block_lifts_beyond_g_tan_alpha_and_not_before():
    t = np.arange(0, 1.0, 1e-3)
    r = rock(0.3, 3.0, 0.9, t, G * np.tan(0.3) * np.array([0.999, 1.001, -1.001]) * np.ones_like(t)[:, None])
    assert r.theta[-1, 0] == 0 and r.theta[-1, 1] < 0 and r.theta[-1, 2] == -r.theta[-1, 1]
