"""Closed forms against integration, and against numbers of the literature."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from rockref.conformance.physics import theory
from rockref.conformance.physics.trial import BLOCK, FLIPPER, G

BLOCK_2D = theory.Rocking.of(BLOCK, G)


def first_zero(rates, start, component, end):
    """Instants at which a component of the solution is zero."""

    def event(t, y):
        return y[component]

    return solve_ivp(rates, (0, end), start, events=event, rtol=1e-12, atol=1e-13, method="DOP853").t_events[0]


@pytest.mark.parametrize("omega", [(0.25, 5.0, 0.0), (0.0, 5.0, 0.3), (1.0, 4.0, 0.1)])
def test_the_flips_of_a_free_body(omega):
    J = np.array(FLIPPER.inertia)
    zeros = first_zero(lambda t, w: np.cross(J * w, w) / J, omega, 1, 12.0)
    # The integrator is good to 1e-11 of 3 s.
    assert np.diff(zeros)[0] == pytest.approx(theory.flip_interval(FLIPPER.inertia, np.array(omega)), rel=1e-9)


@pytest.mark.parametrize("share", [0.05, 0.5, 0.95])
def test_the_quarter_period(share):
    alpha, p = BLOCK_2D.alpha, BLOCK_2D.p
    zeros = first_zero(lambda t, y: [y[1], -p * p * np.sin(alpha - y[0])], [share * alpha, 0.0], 0, 3.0)
    assert theory.quarter_period(share * alpha, alpha, p) == pytest.approx(zeros[0], rel=1e-9)


def test_the_fall_from_balance():
    alpha, p = BLOCK_2D.alpha, BLOCK_2D.p

    def reached(end):
        return first_zero(lambda t, y: [y[1], p * p * np.sin(y[0] + end)], [0.001 * alpha - end, 0.0], 0, 3.0)[0]

    grown = theory.growth_time(0.02 * alpha, 0.1 * alpha, 0.001 * alpha, p)
    assert grown == pytest.approx(reached(0.1 * alpha) - reached(0.02 * alpha), rel=1e-8)


def test_the_impact_ratio_of_a_rigid_block_is_housners():
    # 1 - 3/2 sin^2(alpha) of a uniform block (Housner 1963, eq. 8: its square is the ratio of energies).
    assert BLOCK_2D.ratio == pytest.approx(1 - 1.5 * np.sin(BLOCK_2D.alpha) ** 2, rel=1e-12)
    alpha = BLOCK_2D.alpha
    after = alpha - np.arccos(np.cos(alpha) + BLOCK_2D.ratio**2 * theory.rocking_energy(0.5 * alpha, alpha))
    assert theory.impact_ratio(0.5 * alpha, after, alpha) == pytest.approx(BLOCK_2D.ratio, rel=1e-12)


def test_the_load_that_lifts_the_edge_of_a_block_on_springs():
    """Moments about the loaded edge, springs at both edges, the block turned until one of them has no force."""
    b, h, m, K = 0.1, 0.5, 60.0, 1e6
    sink = m * G / (4 * K)
    turn = np.arctan(2 * sink / (2 * b))  # one edge unloaded, the other twice as deep
    arm = b * np.cos(turn) - h * np.sin(turn)
    height = h * np.cos(turn) + b * np.sin(turn)
    # The rule is of first order in the sink: its square is 1e-5 of b.
    assert theory.toppling_load(sink, b, h) == pytest.approx(arm / height / (b / h), abs=1e-4)


def test_sliding():
    assert theory.sliding(1.0, 0.3, G) == pytest.approx((1 / (2 * 0.3 * G), 1 / (0.3 * G)))


def test_the_change_of_spin_of_a_symmetric_top():
    """A body of two equal moments: the momentum stands still, the rate turns about it at L / J."""
    J, omega, R = (2.0, 2.0, 1.0), np.array([0.3, 0.0, 2.0]), np.eye(3)
    L = np.array(J) * omega
    rate, axis = np.linalg.norm(L) / J[0], L / np.linalg.norm(L)
    t = 0.7
    along = (omega @ axis) * axis
    turned = along + np.cos(rate * t) * (omega - along) + np.sin(rate * t) * np.cross(axis, omega)
    assert theory.spin_change(J, R, omega, t) == pytest.approx(turned - omega, abs=1e-10)
