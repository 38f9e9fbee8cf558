"""Which first impacts are used, on heights that are given frame by frame, and what of their frames."""

import numpy as np
import pytest

from rockref.measure.tosses.flight import MOST, Poses
from rockref.measure.tosses.impact_balance import _segment, first_impacts
from rockref.model.errors import InputError

DT = 1.0 / 148.0
G = np.array([0.0, 0.0, -9.81])
POINT = np.zeros((1, 3))
NEAR = 1.5


def tosses(*rows, frames=None):
    """Points at these heights, frame by frame."""
    B, F = len(rows), max(map(len, rows))
    x = np.zeros((B, F, 3))
    for k, row in enumerate(rows):
        x[k, : len(row), 2], x[k, len(row) :, 2] = row, row[-1]
    frames = np.array([len(row) for row in rows] if frames is None else frames)
    still = np.zeros((B, 3))
    return Poses(np.arange(F) * DT, x, np.tile(np.eye(3), (B, F, 1, 1)), frames, still, still)


def used(*rows, frames=None):
    """Numbers of the tosses whose impact is used."""
    try:
        return first_impacts(tosses(*rows, frames=frames), POINT, np.eye(3), G, NEAR).which.tolist()
    except InputError:
        return []


HIGH = 9.0
GOOD = [HIGH] * 5 + [0.0] + [HIGH] * 5


def test_five_frames_of_flight_on_either_side_are_the_fewest():
    assert used(GOOD) == [0]
    assert used(GOOD[1:]) == [] and used(GOOD[:-1]) == []
    # What is behind the measured frames does not count.
    assert used(GOOD + [HIGH], frames=[10]) == []


def test_unused_tosses_do_not_end_the_search():
    flying, resting = [HIGH] * 12, [HIGH] * 5 + [0.0] * 7
    assert used(flying, resting, GOOD, GOOD[1:], GOOD) == [2, 4]


def test_flights_of_unlike_lengths_up_to_the_last_frame_are_used_side_by_side():
    assert used([HIGH] * 12 + [0.0] + [HIGH] * 5, [HIGH] * 5 + [0.0] + [HIGH] * 12) == [0, 1]


def test_a_flight_that_is_longer_than_what_is_used_of_it_has_no_impact_there():
    """The frame after the last one that is used is high."""
    assert used([HIGH] * (MOST + 9)) == []
    assert used([HIGH] * (MOST + 2) + [0.0] + [HIGH] * 9) == []
    assert used([HIGH] * MOST + [0.0] + [HIGH] * 9) == [0]


@pytest.mark.parametrize(("contact", "found"), [(6, [0]), (7, [])])
def test_a_contact_of_more_than_six_frames_is_none(contact, found):
    assert used([HIGH] * 5 + [0.0] * contact + [HIGH] * 5) == found


@pytest.mark.parametrize(("between", "found"), [(5, [0]), (4, [])])
def test_a_second_contact_ends_the_flight_after_the_first(between, found):
    assert used([HIGH] * 5 + [0.0] + [HIGH] * between + [0.0] + [HIGH] * 9) == found


@pytest.mark.parametrize(("last", "found"), [(5.2, []), (5.3, [0])])
def test_a_second_contact_between_two_frames_ends_it_as_well(last, found):
    """Four frames, the last of which is so much lower that the next would be below 1.5, or not."""
    assert used([HIGH] * 5 + [0.0] + [HIGH] * 3 + [last] + [HIGH] * 5) == found


def test_a_second_contact_may_follow_from_the_second_frame_on():
    assert used([HIGH] * 5 + [0.0] + [HIGH, 5.2] + [HIGH] * 9) == []


def test_a_first_contact_between_two_frames_is_one():
    """Down by two a frame to 3; up again from 2, which from 3 seems to go on down, but is the first frame after it."""
    assert used([11.0, 9.0, 7.0, 5.0, 3.0, 2.0, 4.0, 6.0, 8.0, 10.0]) == [0]


def bounced(shift):
    """Down at -1 m/s and up at 1 m/s at frame 8.5, aside at 0.5 m/s before and at -1.5 m/s after, from `shift` on."""
    t = np.arange(18) * DT
    s = t - 8.5 * DT
    z = 0.5 * G[2] * s**2 + np.abs(s)
    x = np.where(s < 0.0, 0.5 * s, shift - 1.5 * s)
    still = np.zeros((1, 3))
    path = np.stack([x, 0.0 * t, z], axis=-1)
    return Poses(t, path[None], np.tile(np.eye(3), (1, 18, 1, 1)), np.array([18]), still, still)


@pytest.mark.parametrize(("shift", "frame"), [(0.0, 8.5), (0.012, 8.5 + 0.003 / DT), (0.05, 10.0), (-0.05, 7.0)])
def test_the_impact_is_not_before_the_last_frame_of_flight_nor_after_the_first_one(shift, frame):
    """The paths are nearest to one another after a quarter of the shift over 1 m/s; frames 8 and 9 are near."""
    found = first_impacts(bounced(shift), POINT, np.eye(3), G, 4e-3)
    # At frame 8.5 it falls at 1 m/s.
    assert found.v_before[0] == pytest.approx([0.5, 0.0, -1.0 + G[2] * (frame - 8.5) * DT], abs=1e-9)
    assert found.v_after[0] == pytest.approx([-1.5, 0.0, 1.0 + G[2] * (frame - 8.5) * DT], abs=1e-9)


def test_frames_beside_a_contact_are_not_used():
    """Frames 8 and 9 are near; the last one may be the first of the next contact. All others move a velocity."""
    plain = first_impacts(bounced(0.0), POINT, np.eye(3), G, 4e-3)
    moved = {"v_before": [], "v_after": []}
    for frame in range(18):
        poses = bounced(0.0)
        poses.x[0, frame, 1] += 1e-3
        found = first_impacts(poses, POINT, np.eye(3), G, 4e-3)
        for name, frames in moved.items():
            if abs(getattr(found, name)[0, 1] - getattr(plain, name)[0, 1]) > 1e-6:
                frames.append(frame)
    # The slope of a line does not depend on the middle of an odd number of frames.
    assert moved == {"v_before": list(range(8)), "v_after": [10, 11, 12, 14, 15, 16]}


def test_a_stretch_has_its_own_times_frames_and_stated_velocities():
    poses = tosses([1.0, 2.0, 3.0, 4.0], [5.0, 6.0, 7.0, 8.0])
    poses = poses._replace(v=np.arange(6.0).reshape(2, 3), W=np.arange(6.0, 12.0).reshape(2, 3))
    found = _segment(poses, np.array([1, 1, 0]), np.array([0, 2, 1]), np.array([3, 2, 1]))
    # Behind the frames of a stretch its last one is repeated.
    assert found.x[..., 2].tolist() == [[5.0, 6.0, 7.0], [7.0, 8.0, 8.0], [2.0, 2.0, 2.0]]
    assert found.t.tolist() == poses.t[:3].tolist() and found.frames.tolist() == [3, 2, 1]
    assert found.v.tolist() == poses.v[[1, 1, 0]].tolist() and found.W.tolist() == poses.W[[1, 1, 0]].tolist()
