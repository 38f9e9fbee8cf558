"""Free flight: the order of the step, what it keeps, and the tops that can be solved in closed form."""

import numpy as np
import pytest
from scipy.special import ellipj

import rockref
from rockref.model.rotation import apply, exponential, logarithm, product, transposed
from rockref.model.simulate import simulate
from tests import physics

ASYMMETRIC = (2.0, 1.5, 0.4)


def flown(inertia, W, step, duration, **kwargs):
    response = simulate(physics.flying(inertia, W, step, duration, 1 / duration, **kwargs))
    return response.W[-1], response.Lambda[-1], response


def momentum(J, Lambda, W):
    return apply(Lambda, np.asarray(J) * W)


# --- closed forms


def jacobi(J, W_0, t):
    """Torque-free rates of a body with J1 > J2 > J3 that starts with W2 = 0.

    Source: L. D. Landau, E. M. Lifshitz, Mechanics (1976), section 37, eqs. 37.8 to 37.10, with 1 and 3 exchanged where
    the momentum is nearer the axis of the largest inertia (then 2 E J2 < L^2 in their order of axes).
    """
    J1, J2, J3 = J
    E2 = J1 * W_0[0] ** 2 + J3 * W_0[2] ** 2
    L2 = (J1 * W_0[0]) ** 2 + (J3 * W_0[2]) ** 2
    if L2 > E2 * J2:
        J1, J3, first, last = J3, J1, 2, 0  # now J1 < J2 < J3 as in the book, momentum nearer to axis 3
    else:
        first, last = 0, 2
    # in the book's order J1 < J2 < J3 with L^2 > 2 E J2; with the order turned round all differences change sign
    rate = np.sqrt((J3 - J2) * (L2 - E2 * J1) / (J1 * J2 * J3))
    m = (J2 - J1) * (E2 * J3 - L2) / ((J3 - J2) * (L2 - E2 * J1))
    sn, cn, dn, _ = ellipj(rate * t, m)
    W = np.empty(3)
    W[first] = np.sqrt((E2 * J3 - L2) / (J1 * (J3 - J1))) * cn
    W[1] = np.sqrt((E2 * J3 - L2) / (J2 * (J3 - J2))) * sn
    W[last] = np.sqrt((L2 - E2 * J1) / (J3 * (J3 - J1))) * dn
    # d W2 / dt = (J_last - J_first) / J2 W_first W_last at the start, in the order 1, 2, 3 of the axes
    sign = np.sign((J[2] - J[0]) / J[1] * W_0[0] * W_0[2])
    return W * [1, sign, 1]


@pytest.mark.parametrize("W_0", [(1.0, 0, 4.0), (4.0, 0, 1.0), (2.0, 0, 2.5)], ids=str)
def test_closed_form_solves_eulers_equations(W_0):
    """The formula itself, so that the next test means something: derivative by central difference."""
    J, h = np.array(ASYMMETRIC), 1e-4
    assert jacobi(J, W_0, 0.0) == pytest.approx(W_0, abs=1e-12)
    for t in (0.0, 0.3, 1.1, 2.7):
        W = jacobi(J, W_0, t)
        rate = (jacobi(J, W_0, t + h) - jacobi(J, W_0, t - h)) / (2 * h)
        # error h^2/6 of the third derivative, some 5^3
        assert rate == pytest.approx(-np.cross(W, J * W) / J, abs=1e-5)


@pytest.mark.parametrize("W_0", [(1.0, 0, 4.0), (4.0, 0, 1.0), (2.0, 0, 2.5)], ids=str)
def test_three_different_inertias_against_jacobi(W_0):
    """Both sides of the separatrix; the error falls by four when the step is halved."""
    errors = []
    for step in (2e-3, 1e-3, 5e-4):
        W, _, _ = flown(ASYMMETRIC, W_0, step, 2.0)
        errors.append(np.max(np.abs(W - jacobi(ASYMMETRIC, W_0, 2.0))))
    # (|W| h)^2 |W| t, some 3e-5, at the finest step
    assert errors[-1] < 4e-5
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx([2, 2], abs=0.02)


@pytest.mark.parametrize("J, W_0", [((2.0, 2.0, 0.4), (1.0, 0.5, 3.0)), ((2.175048, 2.175048, 0.09), (0.4, 0.1, -2.0))])
def test_symmetric_top(J, W_0):
    """Rates turn in the body about its axis at (J1 - J3)/J1 W3; the body precesses about the momentum at L / J1."""
    t, W_0 = 2.0, np.array(W_0)
    spin = (J[0] - J[2]) / J[0] * W_0[2]
    expected_W = apply(exponential(np.array([0, 0, -spin * t / 2])), W_0)
    expected_W = apply(exponential(np.array([0, 0, -spin * t / 2])), expected_W)
    L = momentum(J, np.eye(3), W_0)
    angle = L / J[0] * t
    # exp(L t / J1) about the fixed momentum, then the spin about the body's axis; in parts below half a turn
    expected = np.eye(3)
    for _ in range(16):
        expected = product(exponential(angle / 16), expected)
    for _ in range(16):
        expected = product(expected, exponential(np.array([0, 0, spin * t / 16])))
    errors = []
    for step in (2e-3, 1e-3):
        W, Lambda, _ = flown(J, W_0, step, t)
        errors.append(
            max(np.max(np.abs(W - expected_W)), np.max(np.abs(logarithm(product(transposed(expected), Lambda)))))
        )
    assert errors[1] < 2e-6
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2, abs=0.02)


def test_ballistic_flight_is_exact():
    """Constant acceleration: no error but rounding, at most half of 1.8e-15 (the last digit of 10) in 1000 steps."""
    _, _, response = flown(ASYMMETRIC, (0, 0, 0), 1e-3, 1.0, x=(0, 0, 10.0), v=(1.0, -2.0, 3.0))
    assert response.x[-1] == pytest.approx([1, -2, 10 + 3 - 9.81 / 2], abs=1e-12)
    assert response.v[-1] == pytest.approx([1, -2, 3 - 9.81], abs=1e-12)


# --- what is kept


@pytest.mark.parametrize("engine", ["numba", pytest.param("numpy", marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    "J, W_0",
    [
        (ASYMMETRIC, (1.0, -3.0, 4.0)),
        ((2.175048, 2.175048, 0.09), (0.6, 0.2, 0.3)),
        ([[2.1, 0.1, 0.05], [0.1, 2.2, 0.03], [0.05, 0.03, 0.09]], (0.6, 0.2, -3.0)),
    ],
    ids=["asymmetric", "the block", "not principal"],
)
def test_spatial_angular_momentum_over_a_hundred_thousand_steps(J, W_0, engine):
    response = rockref.simulate(physics.flying(J, W_0, 1e-5, 1.0, 1000.0), engine=engine)
    J = np.diag(J) if np.ndim(J) == 1 else np.array(J)
    L = apply(response.Lambda, apply(J, response.W))
    # roundings of 1e-16 a step add up like a random walk: sqrt(1e5) of them are 3e-14; a bias would give 1e-11
    assert np.max(np.linalg.norm(L - L[0], axis=-1)) / np.linalg.norm(L[0]) < 1e-13


def test_energy_of_free_flight_stays_in_a_band_of_order_two():
    """No drift: over 40 turns the energy error stays what it was over the first; it falls by four with the step."""
    bands = []
    for step in (1e-3, 5e-4):
        response = rockref.simulate(
            physics.flying(ASYMMETRIC, (2.0, 0.1, 2.5), step, 60.0, 200.0, g=0.0), engine="numba"
        )
        energy = 0.5 * np.sum(np.array(ASYMMETRIC) * response.W**2, axis=-1)
        error = np.abs(energy / energy[0] - 1)
        assert np.max(error[-2000:]) < 1.1 * np.max(error[:2000])
        bands.append(np.max(error))
    assert np.log2(bands[0] / bands[1]) == pytest.approx(2, abs=0.02)
