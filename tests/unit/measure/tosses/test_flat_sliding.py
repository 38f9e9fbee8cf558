"""Friction of a flat face, from slides of known deceleration."""

import warnings

import numpy as np
import pytest

from rockref.measure.tosses.flat_sliding import flat_pieces, rest_height, sliding_friction
from rockref.measure.tosses.flight import Poses

RATE, HALF = 148.0, 0.05
# A box on four corners, the upper four given first.
P = np.array([[x, y, z] for z in (HALF, -HALF) for x in (-HALF, HALF) for y in (-HALF, HALF)])


def slides(v, a, frames=11, lifted=0):
    """Boxes that slide flat at v (B, 2) m/s in the middle frame with accelerations a (B, 2) m/s2; the first `lifted`
    frames are 3 mm higher."""
    v, a = np.atleast_2d(np.asarray(v, float)), np.atleast_2d(np.asarray(a, float))
    B = len(v)
    s = (np.arange(frames) - frames // 2) / RATE
    x = np.full((B, frames, 3), HALF)
    x[..., :2] = v[:, None] * s[:, None] + a[:, None] * (s * s / 2)[:, None]
    x[:, :lifted, 2] += 3e-3
    Lambda = np.tile(np.eye(3), (B, frames, 1, 1))
    return Poses(np.arange(frames) / RATE, x, Lambda, np.full(B, frames), np.zeros((B, 3)), np.zeros((B, 3)))


def tipped(poses, corner):
    """The poses tipped about Y: two corners on the plate, two of the same face above it by `corner` [m]."""
    tip = np.arcsin(corner / (2 * HALF))
    c, s = np.cos(tip), np.sin(tip)
    poses.Lambda[:] = np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])
    poses.x[..., 2] = HALF * (c + s)
    return poses


def test_speed_and_deceleration_of_a_piece_are_those_of_its_middle():
    """Eleven frames: two settle, nine make a piece, whose middle is one frame after that of the eleven."""
    v, a = np.array([0.3, -0.4]), np.array([-1.0, 3.0])
    found = flat_pieces(slides(v, a), P)
    w = v + a / RATE
    speed = np.hypot(*w)
    assert found == pytest.approx(np.array([[0.0, speed, -(a @ w) / speed]]), rel=1e-9)


@pytest.mark.parametrize(("frames", "starts"), [(38, [12, 21]), (39, [12, 21, 30]), (47, [12, 21, 30])])
def test_pieces_follow_one_another_from_two_frames_after_the_face_came_down(frames, starts):
    """The tenth frame is the last one with a corner above two millimetres; speeds tell where the pieces lie."""
    found = flat_pieces(slides([1.0, 0.0], [-2.0, 0.0], frames, lifted=10), P)
    middle = (np.array(starts) + 4 - frames // 2) / RATE
    assert found[:, 1] == pytest.approx(1.0 - 2.0 * middle, rel=1e-9)
    assert found[:, 2] == pytest.approx(2.0, rel=1e-9)


def test_a_face_that_lifts_again_begins_anew():
    poses = slides([1.0, 0.0], [-2.0, 0.0], 40, lifted=3)
    poses.x[0, 25, 2] += 3e-3
    found = flat_pieces(poses, P)
    assert found[:, 1] == pytest.approx([1.0 - 2.0 * (28 + 4 - 20) / RATE], rel=1e-9)


@pytest.mark.parametrize(("corner", "pieces"), [(0.0019, 1), (0.0021, 0)])
def test_flat_is_a_fourth_corner_below_two_millimetres(corner, pieces):
    poses = tipped(slides([1.0, 0.0], [0.0, 0.0]), corner)
    assert len(flat_pieces(poses, P)) == pieces
    # A body of three points has no fourth corner: its highest counts, which is one of the two above.
    assert len(flat_pieces(poses, P[[4, 6, 7]])) == pieces


def test_slow_slides_are_left_out_and_the_toss_is_named():
    found = flat_pieces(slides([[0.059, 0.0], [0.061, 0.0], [0.0, -0.2]], np.zeros((3, 2))), P)
    assert found[:, :2] == pytest.approx(np.array([[1.0, 0.061], [2.0, 0.2]]), rel=1e-9)
    assert flat_pieces(slides([0.01, 0.0], [0.0, 0.0]), P).shape == (0, 3)


def test_only_measured_frames_count():
    """Frames behind the measured ones repeat the last."""
    poses = slides([[0.5, 0.0]] * 2, np.zeros((2, 2)), 30)._replace(frames=np.array([10, 11]))
    assert flat_pieces(poses, P)[:, 0].tolist() == [1.0]


def test_friction_is_the_median_of_a_class_of_speed():
    g, mu = 9.7, np.array([0.10, 0.15, 0.20, 0.26, 0.50])
    speeds = [0.15] * 5 + [0.25] * 4 + [0.6] * 6
    all_mu = [*mu, *mu[:4], *mu, 0.4]
    # The middle of the piece is one frame after the one in which the speed is as stated.
    v = [[s + g * m / RATE, 0.0] for s, m in zip(speeds, all_mu, strict=True)]
    found = sliding_friction(slides(v, [[-g * m, 0.0] for m in all_mu]), P, g)
    assert list(found.values) == ["0.1 to 0.2 m/s", "0.5 to 0.7 m/s"]
    # Deviations from 0.2: 0.1, 0.05, 0, 0.06, 0.3; their median 0.06. Six: median 0.23, deviations' median 0.105.
    for (value, se, unit), middle, spread, n in zip(
        found.values.values(), (0.20, 0.23), (0.06, 0.105), (5, 6), strict=True
    ):
        assert value == pytest.approx(middle, rel=1e-9) and unit == "1"
        assert se == pytest.approx(1.2533 * 1.4826 * spread / np.sqrt(n), rel=1e-9)
    assert found.tosses == 15
    assert found.scatter == pytest.approx(np.std(all_mu), rel=1e-9)


def test_without_a_slide_there_is_no_friction():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = sliding_friction(slides([0.01, 0.0], [0.0, 0.0]), P, 9.81)
    assert found.values == {} and found.tosses == 0 and np.isnan(found.scatter)


def test_rest_height_is_that_of_the_lowest_four_corners_in_the_last_frame():
    """Of three boxes, at 1, 2 and 1.2 mm in their last frames, the third of which has nine; the fourth is on edge."""
    poses = slides(np.zeros((4, 2)), np.zeros((4, 2)))
    poses.frames[2] = 9
    for box, frame, height in ((0, 10, 1e-3), (1, 10, 2e-3), (2, 8, 1.2e-3)):
        poses.x[box, frame, 2] += height
    c = np.sqrt(0.5)
    poses.Lambda[3] = np.array([[c, 0.0, c], [0.0, 1.0, 0.0], [-c, 0.0, c]])
    assert rest_height(poses, P) == pytest.approx(1.2e-3, abs=1e-12)
    assert rest_height(poses, P + [0.0, 0.0, 1e-3]) == pytest.approx(2.2e-3, abs=1e-12)
    poses.Lambda[:] = poses.Lambda[3]
    assert rest_height(poses, P) == 0.0


@pytest.mark.parametrize(("corner", "height"), [(0.0019, 0.00095), (0.0021, 0.0)])
def test_a_face_that_is_tipped_by_two_millimetres_does_not_rest(corner, height):
    poses = tipped(slides([0.0, 0.0], [0.0, 0.0]), corner)
    assert rest_height(poses, P) == pytest.approx(height, abs=1e-12)
