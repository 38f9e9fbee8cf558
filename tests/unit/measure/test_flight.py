"""Start states from free flight."""

import numpy as np
import pytest

from rockref.measure.flight import Poses, ballistic_starts, flight_frames, raw_starts
from rockref.model.rotation import exponential, logarithm

G = np.array([0.0, 0.0, -9.81])


def flight(W, J, frames=20, rate=148.0):
    """A free body by small steps of Euler's equations: poses of two tosses."""
    t = np.arange(frames) / rate
    x0, v0 = np.array([0.1, 0.2, 0.5]), np.array([-1.0, 0.3, 0.2])
    x = x0 + v0 * t[:, None] + G * (t * t / 2)[:, None]
    Lambda, rates, turns = np.eye(3), np.array(W, float), []
    n = 40
    for _ in range(frames):
        turns.append(Lambda)
        for _ in range(n):
            h = 1 / rate / n
            A = np.linalg.solve(J, np.cross(J @ rates, rates))
            Lambda = Lambda @ exponential(h * rates + h * h / 2 * A)
            rates = rates + h * A
    Lambda = np.array(turns)
    two = np.array([frames, frames])
    return Poses(t, np.stack([x, x]), np.stack([Lambda, Lambda]), two, np.stack([v0] * 2), np.zeros((2, 3))), x0, v0


@pytest.mark.parametrize("J", [np.eye(3) * 8e-4, np.diag([1.2e-3, 1.1e-3, 1.0e-3])])
def test_a_torque_free_parabola_gives_its_start_back(J):
    poses, x0, v0 = flight((3.0, -2.0, 4.0), J)
    s = ballistic_starts(poses, poses.frames, G, J)
    assert np.max(np.abs(s.x - x0)) < 1e-12
    assert np.max(np.abs(s.v - v0)) < 1e-11
    # The fourth order, A'' t^4/24 with A = 1.7 rad/s2, some 2e-5 rad at the end of the flight; with equal moments none.
    limit = 1e-9 if J[0, 0] == J[2, 2] else 4e-5
    assert np.max(np.abs(logarithm(s.Lambda))) < limit
    assert np.max(np.abs(s.W - [3.0, -2.0, 4.0])) < 25 * limit


def test_the_stated_covariance_is_that_of_repeated_noise():
    poses, x0, v0 = flight((3.0, -2.0, 4.0), np.eye(3) * 8e-4)
    rng = np.random.default_rng(1)
    B, noise = 400, 1e-4
    many = poses._replace(
        x=poses.x[:1] + noise * rng.normal(size=(B, 20, 3)),
        Lambda=poses.Lambda[:1] @ exponential(10 * noise * rng.normal(size=(B, 20, 3))),
        frames=np.full(B, 20),
    )
    s = ballistic_starts(many, many.frames, G, np.eye(3) * 8e-4)
    stated = np.sqrt(np.mean(s.covariance[:, range(12), range(12)], axis=0))
    seen = np.concatenate([s.x - x0, logarithm(s.Lambda), s.v - v0, s.W - [3.0, -2.0, 4.0]], axis=1).std(axis=0)
    # 400 draws give a standard deviation to 3.5 %; four times that.
    assert np.max(np.abs(seen / stated - 1)) < 0.15


def test_flight_ends_where_a_corner_comes_near():
    poses, _, _ = flight((0.0, 0.0, 0.0), np.eye(3), frames=40)
    P = np.array([[0, 0, -0.05], [0, 0, 0.05]])
    used = flight_frames(poses, P, 0.3)
    low = poses.x[0, :, 2] - 0.05
    assert used[0] == np.argmax(low < 0.3)
    assert low[used[0] - 1] >= 0.3 > low[used[0]]


def test_the_raw_start_is_the_first_frame():
    poses, x0, v0 = flight((3.0, -2.0, 4.0), np.eye(3))
    s = raw_starts(poses, poses.v, poses.W)
    assert np.array_equal(s.x[0], x0) and np.array_equal(s.v[0], v0)


def test_a_contact_between_two_frames_ends_the_flight():
    # 10 mm a frame down, a contact after frame 4, up again: no frame is below 9 mm.
    z = 1e-3 * np.array([50.0, 40, 30, 20, 10, 9, 12, 14])
    x = np.zeros((1, 8, 3))
    x[0, :, 2] = z
    still = np.broadcast_to(np.eye(3), (1, 8, 3, 3))
    poses = Poses(np.arange(8) / 148, x, still, np.array([8]), np.zeros((1, 3)), np.zeros((1, 3)))
    assert flight_frames(poses, np.zeros((1, 3)), 2e-3)[0] == 5
