"""Housner's 2-D model against its closed forms."""

import numpy as np
import pytest

from rockref.model import housner
from tests.refusal import refused

MASS, B, H, G, J = 54.0, 0.100, 0.688, 9.81, 2.175048
R, ALPHA = float(np.hypot(B, H) / 2), float(np.arctan2(B, H))
P = housner.frequency_parameter(MASS, J, R, G)


def run(theta_0, duration=1.5, rate=2000.0, **changes):
    return housner.housner(MASS, B, H, J, G, theta_0, duration, rate, **changes)


def test_frequency_parameter_of_a_uniform_block():
    """I_O = 4/3 m R^2 for a uniform rectangle (no depth): p = sqrt(3 g / (4 R))."""
    J_plane = MASS * R * R / 3
    assert housner.frequency_parameter(MASS, J_plane, R, G) == pytest.approx(np.sqrt(3 * G / (4 * R)), rel=1e-14)


def test_velocity_ratio_of_a_uniform_block():
    """Housner (1963), eq. 8: 1 - 3/2 sin^2(alpha)."""
    assert housner.velocity_ratio(MASS, MASS * R * R / 3, R, ALPHA) == pytest.approx(
        1 - 1.5 * np.sin(ALPHA) ** 2, rel=1e-14
    )


def exact_quarter_period(theta_0):
    """Time to the first impact of the full equation, by quadrature of the energy integral."""
    from scipy.integrate import quad

    # rate^2 / 2 = p^2 (cos(alpha - theta_0 ... )): substitution theta = theta_0 - s^2 takes out the root at the start.
    def integrand(s):
        theta = theta_0 - s * s
        drop = np.cos(ALPHA - theta_0) - np.cos(ALPHA - theta)
        return 2 * s / np.sqrt(2 * P * P * drop)

    return quad(integrand, 0, np.sqrt(theta_0), epsabs=1e-12, epsrel=1e-12, limit=200)[0]


@pytest.mark.parametrize("theta_0", [0.02, 0.1170])
def test_first_impact_against_the_energy_integral(theta_0):
    # RK4 at 1e-4 s: (p h)^4 = 5e-14; the quadrature asks 1e-12
    assert run(theta_0).impacts[0] == pytest.approx(exact_quarter_period(theta_0), abs=1e-10)


def test_second_impact_is_a_swing_to_the_other_side_later():
    """The impact leaves the square of the ratio of the energy, and with it a tilt from which the block comes back."""
    theta_0 = 0.1170
    ratio = housner.velocity_ratio(MASS, J, R, ALPHA)
    left = ratio**2 * (np.cos(ALPHA - theta_0) - np.cos(ALPHA))
    theta_1 = ALPHA - np.arccos(np.cos(ALPHA) + left)
    r = run(theta_0)
    # RK4 at 1e-4 s, and twice the quadrature
    assert r.impacts[1] - r.impacts[0] == pytest.approx(2 * exact_quarter_period(theta_1), abs=1e-9)
    assert np.max(r.theta) == pytest.approx(theta_1, rel=1e-4)


def test_first_impact_of_a_small_tilt_is_housners_formula():
    """cosh(p t) = alpha / (alpha - theta_0) is linear in the angles: relative error about alpha^2 / 6."""
    for theta_0 in (0.01, 0.05, 0.1170):
        assert housner.first_impact(theta_0, ALPHA, P) == pytest.approx(exact_quarter_period(theta_0), rel=ALPHA**2 / 6)
    # and it is the limit for slender blocks
    slender = 1e-3
    t = housner.first_impact(0.5 * slender, slender, P)
    assert np.cosh(P * t) == pytest.approx(2, rel=1e-14)


def test_angular_velocity_ratio_at_the_impacts():
    r = run(0.1170, rate=1e5)
    ratio = housner.velocity_ratio(MASS, J, R, ALPHA)
    for impact in r.impacts:
        i = np.searchsorted(r.t, impact)
        # between the samples the rate changes by p^2 sin(alpha) h = 3e-5 of itself
        assert r.rate[i] / r.rate[i - 1] == pytest.approx(ratio, rel=1e-4)


def test_between_impacts_the_energy_is_kept():
    r = run(0.1170)
    side = np.sign(r.theta)
    energy = r.rate**2 / 2 + P * P * np.cos(ALPHA - np.abs(r.theta))
    arcs = np.split(energy[side != 0], np.flatnonzero(np.diff(side[side != 0])) + 1)
    assert len(arcs) == 1 + len(r.impacts)
    # RK4 at 1e-4 s
    assert all(np.ptp(arc) < 1e-9 for arc in arcs)


def test_signs_and_rows():
    r = run(0.1170, duration=0.6, rate=1000.0)
    assert len(r.t) == 601
    assert r.theta[0] == -0.1170
    assert r.rate[0] == 0
    assert r.rate[200] > 0
    assert np.all(np.diff(r.impacts) > 0)


def test_few_rows_are_as_good_as_many():
    many, few = run(0.1170, rate=2000.0), run(0.1170, rate=5.0)
    # both step by 1e-4 s at most, but not at the same instants: (p h)^4 = 5e-14 a unit of time
    assert few.theta == pytest.approx(many.theta[::400], abs=1e-11)
    assert few.impacts == pytest.approx(many.impacts, abs=1e-10)


def test_impacts_come_closer_together():
    r = run(0.1170, duration=4.0, rate=100.0)
    assert len(r.impacts) > 5
    assert np.all(np.diff(r.impacts, 2) < 0)


@pytest.mark.parametrize("theta_0", [0.0, -0.1, ALPHA, 1.0, np.nan])
def test_a_tilt_that_overturns_is_refused(theta_0):
    error = refused(run, theta_0)
    assert (error.code, error.where) == ("E-TILT", "theta_0")


@pytest.mark.parametrize(("height", "duration"), [(0.688, 60.0), (0.4, 5.0), (0.1, 5.0), (0.06, 5.0)])
def test_impacts_that_pile_up_end_in_rest(height, duration):
    """Arcs shrink by the ratio of the rates: infinitely many fit into a finite time, after which the block stands."""
    J_G, alpha, radius = MASS / 12 * (B * B + height * height), np.arctan2(B, height), np.hypot(B, height) / 2
    r = housner.housner(MASS, B, height, J_G, G, 0.117, duration, 200.0, 1e-3)
    assert len(r.t) == 200 * duration + 1
    after = r.t > r.impacts[-1]
    assert after.sum() > 100
    assert not np.any(r.theta[after])
    assert not np.any(r.rate[after])
    # The rates shrink by the ratio from the first impact on; the last arc would have lasted less than the limit.
    ratio = housner.velocity_ratio(MASS, J_G, radius, alpha)
    p2 = housner.frequency_parameter(MASS, J_G, radius, G) ** 2
    first = np.sqrt(2 * p2 * (np.cos(alpha - 0.117) - np.cos(alpha)))
    rest = np.log(housner.SHORTEST_ARC / 2 * p2 * np.sin(alpha) / first) / np.log(ratio) if ratio > 0 else 1
    assert len(r.impacts) == np.ceil(rest)


def test_a_squat_block_stops_at_its_first_impact():
    """Below a velocity ratio of zero (3/2 sin^2 alpha > 1) the impact does not lift the block on the other side."""
    J_G = MASS / 12 * (0.1**2 + 0.06**2)
    r = housner.housner(MASS, 0.1, 0.06, J_G, G, 0.117, 1.0, 200.0)
    assert housner.velocity_ratio(MASS, J_G, np.hypot(0.1, 0.06) / 2, np.arctan2(0.1, 0.06)) < 0
    assert len(r.impacts) == 1
