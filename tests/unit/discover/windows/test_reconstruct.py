"""From a record to rates and attitude, the filter undone, and to what follows from them."""

from functools import reduce

import numpy as np
import pytest

from rockref.discover.windows.reconstruct import (
    attitudes,
    moved_by,
    plate_motion,
    yaw_since_touch,
)
from rockref.model.rotation import exponential

DT = 1e-3


def test_constant_rate_turns_exactly():
    w = np.array([0.3, -0.1, 0.2])
    found = attitudes(np.eye(3), np.tile(w, (500, 1)), DT)
    # The short series drops |w dt|^5/120 of each step: 1e-18.
    np.testing.assert_allclose(found[-1], exponential(w * 499 * DT), atol=1e-13)


def test_changing_rates_are_integrated_to_second_order():
    def rates(t):
        return np.stack([0.6 * np.sin(9 * t), 0.3 * np.cos(14 * t), 0.2 * np.sin(11 * t + 1)], axis=-1)

    fine = np.arange(0, 0.5, DT / 16)
    exact = reduce(lambda L, w: L @ exponential(w * DT / 16), rates(fine + DT / 32), np.eye(3))
    error = []
    for k in (4, 2):
        t = np.arange(0, 0.5 + 1e-9, k * DT)
        error.append(np.abs(attitudes(np.eye(3), rates(t), k * DT)[-1] - exact).max())
    # The mean of the end rates is the trapezoid: half the step, a quarter of the error.
    assert error[1] < 3e-6 and error[1] == pytest.approx(error[0] / 4, rel=0.1)


def test_rotations_stay_rotations():
    W = np.random.default_rng(0).normal(size=(3000, 3))
    last = attitudes(np.eye(3), W, DT)[-1]
    np.testing.assert_allclose(last @ last.T, np.eye(3), atol=1e-9)


def test_corrections_make_other_starts_of_these():
    """Turned about the body's X and Y, and other rates; a turn about Z is no correction's."""
    rng = np.random.default_rng(4)
    Lambda = np.stack([exponential(v) for v in rng.normal(size=(6, 3))])
    W, by = rng.normal(size=(6, 3)), 1e-4 * rng.normal(size=(6, 5))
    other = np.stack([L @ exponential(np.array([a, c, 2e-4])) for L, (a, c, *_) in zip(Lambda, by, strict=True)])
    # Turns of 2e-4 leave their squares, 4e-8.
    np.testing.assert_allclose(moved_by((Lambda, W), (other, W + by[:, 2:])), by, atol=5e-8)


def test_yaw_is_counted_since_the_point_touched_and_slips():
    corners = np.array([[0.1, 0.1, -0.5], [0.1, -0.1, -0.5]])
    lean = exponential(np.array([-0.05, 0.0, 0.0])), exponential(np.array([0.05, 0.0, 0.0]))
    Lambda = np.array([lean[0]] * 40 + [lean[1]] * 60)
    W = np.array([L.T @ np.array([0.0, 0.0, 0.2]) for L in Lambda])
    starts = np.array([30, 40, 70, 99])
    # 0.2 rad/s about the vertical; the other corner touches from sample 40 on.
    np.testing.assert_allclose(
        yaw_since_touch(Lambda, W, corners, starts, DT, 1.0), [6e-3, 0, 6e-3, 11.8e-3], rtol=1e-9
    )
    np.testing.assert_allclose(yaw_since_touch(Lambda, -W, corners, starts, DT, 5e-3), [-5e-3, 0, -5e-3, -5e-3])


def test_plate_rings_with_the_block_on_it():
    """A change of the centre's vertical velocity starts free vibration at the frequency of plate and block together."""
    mass, plate, stiffness = 50.0, 100.0, 1.5e7
    corners = np.array([[0.0, 0.1, -0.5]])
    W = np.zeros((400, 3))
    W[10:, 0] = 0.1  # v_z = -(W x P)_z = -0.01 m/s from then on
    upright, stiff = np.tile(np.eye(3), (400, 1, 1)), (plate, stiffness, 0.0)
    motion = plate_motion(upright, W, corners, corners[:, 1], DT, mass, 9.81, stiff, (0.0, 0.0, 0.0))
    assert np.all(motion[:10] == 0)
    omega = np.sqrt(stiffness / (mass + plate))
    jump = mass * 0.01 / (mass + plate)
    t = DT * np.arange(390)
    # Semi-implicit steps of 1/16 ms: the phase is off by less than (omega h)^2/24 of itself, the start by one sample.
    np.testing.assert_allclose(motion[10:, 0], jump / omega * np.sin(omega * (t + DT)), atol=0.2 * jump / omega)
    assert motion[10:, 0].max() == pytest.approx(jump / omega, rel=0.02)


@pytest.mark.parametrize("dt", [DT, 2 * DT])
def test_a_plate_that_hardly_yields_does_not_run_away(dt):
    """Bouncing at 2 kHz and pitching at ten times that, with a block that comes down on its edge."""
    corners = np.array([[0.0, 0.1, -0.5]])
    W = np.zeros((200, 3))
    W[10:, 0] = 0.5
    J, k = 8.0, (2 * np.pi * 2e4) ** 2 * 8.0
    stiff = (100.0, (2 * np.pi * 2e3) ** 2 * 100.0, 0.0)
    upright = np.tile(np.eye(3), (200, 1, 1))
    motion = plate_motion(upright, W, corners, corners[:, 1], dt, 50.0, 9.81, stiff, (J, k, 0.0))
    # Free vibration after a jump of the velocity by 0.05 m/s sinks by no more than its quotient by the frequency.
    assert np.abs(motion[:, 0]).max() < 0.05 / (2 * np.pi * 1e3)


def test_plate_pitches_where_the_block_stands():
    """The weight goes over to another corner: both motions begin at rest, and swing about where they are balanced."""
    mass, (M, k), (J, k_p), y = 50.0, (100.0, 1.5e7), (3.0, 8e5), np.array([-0.1, 0.06])
    corners = np.array([[0.0, y[0], -0.5], [0.0, y[1], -0.5]])
    lean = exponential(np.array([0.05, 0.0, 0.0])), exponential(np.array([-0.05, 0.0, 0.0]))
    Lambda = np.array([lean[0]] * 10 + [lean[1]] * 390)
    motion = plate_motion(Lambda, np.zeros((400, 3)), corners, y, DT, mass, 9.81, (M, k, 0.0), (J, k_p, 0.0))
    assert np.all(motion[:10] == 0)
    masses = np.array([[M + mass, mass * y[1]], [mass * y[1], J + mass * y[1] ** 2]])
    squares, shapes = np.linalg.eig(np.linalg.solve(masses, np.diag([k, k_p])))
    balanced = np.array([0.0, mass * 9.81 * (y[0] - y[1]) / k_p])
    t = DT * (np.arange(390) + 1)
    swing = balanced[:, None] - shapes @ (
        np.linalg.solve(shapes, balanced)[:, None] * np.cos(np.sqrt(squares)[:, None] * t)
    )
    # Semi-implicit steps of 1/16 ms follow 85 Hz to some thousandths of a period over 0.2 s and more.
    np.testing.assert_allclose(motion[10:, [0, 2]].T, swing, atol=0.1 * np.abs(balanced).max())
    rates = np.gradient(motion[10:, 2], DT)
    np.testing.assert_allclose(motion[11:-1, 3], rates[1:-1], atol=0.2 * np.abs(rates).max())
