"""Start states from free flight.

Then free flight, number by number: tosses side by side, the frames before a contact, starts and their covariance.
"""

import numpy as np
import pytest

from rockref.measure.records.toss import Toss
from rockref.measure.tosses.flight import (
    LEAST,
    MOST,
    NOISE_TURN,
    NOISE_X,
    Poses,
    Starts,
    ballistic_starts,
    displaced,
    first_true,
    flight_frames,
    lowest,
    raw_starts,
    side_by_side,
)
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


RATE = 148.0
PULL = np.array([0.3, -0.1, -9.7])


def toss(frames, stated=True, seed=0):
    rng = np.random.default_rng(seed)
    x, v, W, turn = rng.uniform(-1.0, 1.0, (4, frames, 3))
    return Toss("0", "0", "fit", np.arange(frames) / RATE, x, exponential(turn), *((v, W) if stated else (None, None)))


def test_tosses_lie_side_by_side_with_their_last_frame_repeated():
    tosses = [toss(6), toss(9, seed=1)]
    found = side_by_side(tosses, RATE)
    assert np.allclose(found.t, np.arange(9) / RATE, rtol=1e-15)
    assert found.frames.tolist() == [6, 9]
    for k, one in enumerate(tosses):
        n = one.frames
        for got, given in ((found.x[k], one.x), (found.Lambda[k], one.Lambda)):
            assert np.array_equal(got[:n], given)
            assert all(np.array_equal(rest, given[-1]) for rest in got[n:])
        assert np.array_equal(found.v[k], one.v[0]) and np.array_equal(found.W[k], one.W[0])
    assert found.measured.tolist() == [6 * [True] + 3 * [False], 9 * [True]]


@pytest.mark.parametrize("missing", ["v", "W", "both"])
def test_without_stated_velocities_they_are_differences(missing):
    one = toss(6, stated=missing != "both")
    if missing != "both":
        one = Toss(one.id, one.group, one.use, one.t, one.x, one.Lambda, **{"v": one.v, "W": one.W, missing: None})
    found = side_by_side([one], RATE)
    assert found.v[0] == pytest.approx((one.x[1] - one.x[0]) * RATE, rel=1e-12)
    assert one.Lambda[0] @ exponential(found.W[0] / RATE) == pytest.approx(one.Lambda[1], abs=1e-12)


def test_lowest_is_the_height_of_the_lowest_point():
    P = np.array([[0.1, 0.0, 0.0], [0.0, 0.2, 0.3], [0.0, 0.0, -0.1]])
    Lambda = exponential(np.random.default_rng(1).uniform(-2.0, 2.0, (4, 5, 3)) / 2.0)
    x = np.random.default_rng(2).normal(size=(4, 5, 3))
    each = x[..., None, :] + np.einsum("bfij,nj->bfni", Lambda, P)
    assert lowest(x, Lambda, P) == pytest.approx(each[..., 2].min(axis=-1), rel=1e-12)


def test_first_true_of_each_row():
    found = np.array([[False, True, True], [False, False, False], [True, False, False]])
    assert first_true(found, np.array([7, 8, 9])).tolist() == [1, 8, 0]


def at_heights(*rows, frames=None):
    """Points that are at these heights, frame by frame."""
    z = np.array(rows, float)
    B, F = z.shape
    x = np.stack([np.zeros_like(z), np.zeros_like(z), z], axis=-1)
    still, frames = np.zeros((B, 3)), np.full(B, F) if frames is None else np.array(frames)
    return Poses(np.arange(F) / RATE, x, np.tile(np.eye(3), (B, F, 1, 1)), frames, still, still)


POINT = np.zeros((1, 3))


def test_a_flight_ends_with_the_frame_before_a_point_is_near_or_would_be_in_the_next():
    # Ten a frame, near at 10: frames 0 to 4 are high enough, and from frame 4 the next would be at 10, which is not
    # below it. A jump is not foreseen. What floats never ends before its last frame, what is measured or MOST.
    down, jump, high = [60, 50, 40, 30, 20, 10, 0, 0], [60, 60, 60, 60, 60, 60, 5, 0], [60] * 8
    assert flight_frames(at_heights(down, jump, high), POINT, 10.0).tolist() == [6, 6, 8]
    assert flight_frames(at_heights(down, jump, high), POINT, 10.1).tolist() == [5, 6, 8]
    assert flight_frames(at_heights(high, high, frames=[5, 8]), POINT, 10.0).tolist() == [5, 8]
    assert flight_frames(at_heights([60] * 60), POINT, 10.0).tolist() == [MOST]
    assert flight_frames(at_heights([0] * 8), POINT, 10.0).tolist() == [LEAST]


def parabolas(B=2, frames=15, J=None, seed=0, noise=0.0):
    """Bodies of equal moments of inertia in flight: poses, x, v, Lambda, W at the first frame."""
    rng = np.random.default_rng(seed)
    x, v, W = rng.uniform(-1.0, 1.0, (3, B, 3)) * np.array([1.0, 2.0, 6.0])[:, None, None]
    Lambda = exponential(rng.uniform(-1.0, 1.0, (B, 3)))
    t = np.arange(frames) / RATE
    path = x[:, None] + v[:, None] * t[:, None] + PULL * (t * t / 2)[:, None] + noise * rng.normal(size=(B, frames, 3))
    turns = Lambda[:, None] @ exponential(W[:, None] * t[:, None] + noise * rng.normal(size=(B, frames, 3)))
    return Poses(t, path, turns, np.full(B, frames), v, W), (x, v, Lambda, W)


def test_each_toss_uses_its_own_frames():
    """What comes behind them is anywhere; gravity may be another for each."""
    poses, (x, v, Lambda, W) = parabolas()
    poses.x[0, 9:] += 1.0
    poses.Lambda[0, 9:] = np.eye(3)
    for gravity in (PULL, np.stack([PULL, PULL])):
        s = ballistic_starts(poses, np.array([9, 15]), gravity, np.eye(3) * 1e-3)
        for got, true in ((s.x, x), (s.v, v), (s.Lambda, Lambda), (s.W, W)):
            assert got == pytest.approx(true, abs=1e-9)
        assert s.used.tolist() == [9, 15]
        assert max(s.residual_x.max(), s.residual_turn.max()) < 1e-10
    poses.x[1] += np.array([0.0, 0.0, 1.0]) * (poses.t**2 / 2)[:, None]
    s = ballistic_starts(poses, np.array([9, 15]), np.stack([PULL, PULL + [0.0, 0.0, 1.0]]), np.eye(3) * 1e-3)
    assert s.v == pytest.approx(v, abs=1e-9)


@pytest.mark.parametrize("n", [3, 10])
def test_covariance_is_that_of_a_straight_line(n):
    """Variances s2/D, s0/D and covariance -s1/D of value and slope, times the noise that is known at least."""
    poses, _ = parabolas(1, n)
    t = np.arange(n) / RATE
    s0, s1, s2 = n, t.sum(), (t**2).sum()
    D = s0 * s2 - s1**2
    C = ballistic_starts(poses, np.array([n]), PULL, np.eye(3) * 1e-3).covariance[0]
    expected = np.zeros((12, 12))
    for first, sigma in ((0, NOISE_X), (3, NOISE_TURN)):
        for i in range(first, first + 3):
            expected[i, i], expected[i + 6, i + 6] = sigma**2 * s2 / D, sigma**2 * s0 / D
            expected[i, i + 6] = expected[i + 6, i] = -(sigma**2) * s1 / D
    assert C == pytest.approx(expected, rel=1e-9)


def test_what_a_flight_leaves_is_its_noise():
    """Of n frames of three numbers each six are taken by the line: sigma^2 = sum of squares / (3 (n - 2))."""
    poses, (x, v, *_) = parabolas(1, 20, noise=1e-3, seed=3)
    s = ballistic_starts(poses, np.array([20]), PULL, np.eye(3) * 1e-3)
    left = poses.x[0] - PULL * (poses.t**2 / 2)[:, None]
    line = np.stack([np.ones(20), poses.t], axis=-1)
    rest = left - line @ np.linalg.lstsq(line, left, rcond=None)[0]
    assert s.residual_x[0] == pytest.approx(np.sqrt(np.sum(rest**2) / 54), rel=1e-9)
    turns = logarithm(
        (s.Lambda[:, None] @ exponential(s.W[:, None] * poses.t[:, None])).swapaxes(-1, -2) @ poses.Lambda
    )
    # The residual is that of the turn in other axes, which does not change its size.
    assert s.residual_turn[0] == pytest.approx(np.sqrt(np.sum(turns**2) / 54), rel=1e-3)
    assert s.covariance[0, 0, 0] / s.residual_x[0] ** 2 == pytest.approx(
        s.covariance[0, 3, 3] / s.residual_turn[0] ** 2
    )


def test_two_frames_leave_nothing_and_have_the_known_noise():
    poses, (x, v, Lambda, W) = parabolas(1, 2)
    s = ballistic_starts(poses, np.array([2]), PULL, np.eye(3) * 1e-3)
    assert s.v == pytest.approx(v, abs=1e-9) and s.W == pytest.approx(W, abs=1e-9)
    assert s.residual_x[0] < 1e-12 and s.covariance[0, 0, 0] == pytest.approx(NOISE_X**2)


@pytest.mark.parametrize(("rate", "turn", "spin"), [(148.0, 3e-6, 2e-4), (1480.0, 3e-10, 2e-7)])
def test_a_body_of_unequal_moments_turns_by_eulers_equations(rate, turn, spin):
    """Against forty small steps a frame, each of second order; about the middle axis the rates change most.

    They change by 1.25 rad/s2 here, and that by some 15 rad/s4: the turn of 47 ms lacks 3e-6 rad in the fourth order,
    and the rate that over the time. In a tenth of the time it is 10^-4 and 10^-3 of it; a third order that is wrong
    would leave a hundredth of the rate's.
    """
    J = np.diag([1.0, 1.5, 2.0]) * 1e-3
    W0, dt, steps = np.array([1.0, 5.0, 0.5]), 1 / rate / 40, 40
    W, Lambda, turns = W0.copy(), np.eye(3), []
    for _ in range(8):
        turns.append(Lambda)
        for _ in range(steps):
            middle = W + dt / 2 * np.linalg.solve(J, np.cross(J @ W, W))
            Lambda = Lambda @ exponential(dt * middle)
            W = W + dt * np.linalg.solve(J, np.cross(J @ middle, middle))
    t = np.arange(8) / rate
    x = np.broadcast_to(PULL * (t * t / 2)[:, None], (1, 8, 3))
    poses = Poses(t, x, np.array(turns)[None], np.array([8]), np.zeros((1, 3)), np.zeros((1, 3)))
    s = ballistic_starts(poses, np.array([8]), PULL, J)
    assert logarithm(s.Lambda)[0] == pytest.approx(np.zeros(3), abs=turn)
    assert s.W[0] == pytest.approx(W0, abs=spin)


def test_a_raw_start_has_the_known_noise_and_stated_velocities():
    poses, (x, v, Lambda, W) = parabolas()
    s = raw_starts(poses, v, W)
    for got, true in ((s.x, x), (s.v, v), (s.Lambda, Lambda), (s.W, W)):
        assert got == pytest.approx(true, abs=1e-12)
    sigma = 3 * [NOISE_X] + 3 * [NOISE_TURN] + 3 * [0.03] + 3 * [0.1]
    assert s.covariance == pytest.approx(np.stack(2 * [np.diag(np.square(sigma))]), rel=1e-12)
    assert (
        s.used.dtype.kind == "i" and s.used.tolist() == [1, 1] and not s.residual_x.any() and not s.residual_turn.any()
    )


def test_displaced_moves_each_part_by_its_own_numbers():
    poses, (x, v, Lambda, W) = parabolas()
    d = np.arange(24.0).reshape(2, 12) / 100.0
    s = displaced(Starts(x, v, Lambda, W, np.zeros((2, 12, 12)), np.ones(2), np.zeros(2), np.zeros(2)), d)
    assert s.x - x == pytest.approx(d[:, :3]) and s.v - v == pytest.approx(d[:, 6:9])
    assert s.W - W == pytest.approx(d[:, 9:])
    assert logarithm(Lambda.swapaxes(-1, -2) @ s.Lambda) == pytest.approx(d[:, 3:6])
