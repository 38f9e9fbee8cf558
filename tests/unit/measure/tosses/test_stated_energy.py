"""The energy of stated velocities, and what is counted as a rise, on heights that are known frame by frame."""

import numpy as np
import pytest

from rockref.measure.records.toss import Toss
from rockref.measure.tosses.stated_energy import rises, stated_energy
from rockref.model.rotation import exponential


def test_the_energy_is_that_of_the_centre_of_mass_and_of_the_turn():
    """Against the same body seen from the plate: the velocity of its centre is v + w x r."""
    rng = np.random.default_rng(3)
    x, v, W = rng.normal(size=(3, 5, 3))
    Lambda = exponential(rng.uniform(-1.0, 1.0, (5, 3)))
    centre, J, g = np.array([0.3, -0.2, 0.5]), np.array([0.4, 0.7, 0.2]), 9.7
    found = stated_energy(Toss("0", "0", "fit", np.arange(5.0), x, Lambda, v, W), centre, J, g)
    for k in range(5):
        r, w = Lambda[k] @ centre, Lambda[k] @ W[k]
        spin = Lambda[k] @ np.diag(J) @ Lambda[k].T
        kinetic = 0.5 * np.sum((v[k] + np.cross(w, r)) ** 2) + 0.5 * w @ spin @ w
        assert found[k] == pytest.approx(kinetic + g * (x[k] + r)[2], rel=1e-12)


def at_heights(heights):
    """A body that stands still in every frame, at these heights: with g = 1 they are its energy."""
    still = np.zeros((len(heights), 3))
    x = np.stack([*still.T[:2], heights], axis=-1)
    return Toss("0", "0", "fit", np.arange(len(heights)) / 148.0, x, np.tile(np.eye(3), (len(x), 1, 1)), still, still)


def counted(*heights, first=None):
    tosses = [at_heights(np.array(h, float)) for h in heights]
    first = np.full(len(tosses), 6) if first is None else np.array(first)
    return rises(tosses, first, np.zeros(3), np.zeros(3), 1.0)


# Fourteen frames that lose 100 altogether; the first contact is frame 6.
LEVEL = [150, 150, 150, 150, 150, 150, 150, 50, 50, 50, 50, 50, 50, 50]


def raised(frame, by):
    heights = list(LEVEL)
    heights[frame] += by
    return heights


@pytest.mark.parametrize("frame", [1, 2, 3, 6, 10, 11, 12])
def test_a_rise_counts_from_four_frames_before_to_four_after(frame):
    found, counts = counted(raised(frame, 3.0)), frame in (3, 6, 10)
    assert (found["tosses"], found["from_frame_to_frame"]) == (1, int(counts))
    assert found["largest"] == pytest.approx(0.03 if counts else 0.0)


def test_two_hundredths_are_no_rise_and_more_is():
    found = counted(raised(6, 2.0), raised(6, 2.01), LEVEL)
    assert (found["tosses"], found["from_frame_to_frame"]) == (3, 1)
    assert found["largest"] == pytest.approx(0.0201)


@pytest.mark.parametrize(("frame", "seen"), [(4, 0.05), (5, 0.0)])
def test_in_flight_are_the_frames_that_no_contact_reaches(frame, seen):
    """The running median of the velocities reaches one frame ahead: frame 5 already has the contact in it."""
    assert counted(raised(frame, 5.0))["largest_in_flight"] == pytest.approx(seen)


def test_an_early_contact_leaves_two_frames_of_flight():
    """A toss that is begun in contact: its first frames are taken as far as there are any."""
    found = counted([100, 104, 109, 100, 90, 0, 0, 0], first=[1])
    assert (found["largest_in_flight"], found["largest"]) == (pytest.approx(0.04), pytest.approx(0.05))
    # From frame 0, which is nearer than three before, to frame 4.
    assert found["least_loss_around"] == pytest.approx(0.1)
    # The first two frames count, too.
    assert counted([100, 106, 109, 100, 90, 0, 0, 0], first=[1])["largest"] == pytest.approx(0.06)


def test_around_compares_three_frames_before_with_three_after():
    heights = [100, 99, 98, 50, 90, 90, 90, 90, 90, 60, 10, 10, 10, 0]
    found = counted(heights, [100, 100, 100, 80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0])
    # From 50 to 60 of 100, and from 80 to 0.
    assert (found["around"], found["least_loss_around"]) == (1, pytest.approx(-0.1))
    assert counted([100, 99, 98, 50, 90, 90, 90, 90, 90, 50, 10, 10, 10, 0])["around"] == 0


def test_only_tosses_with_rates_and_three_frames_after_the_contact_are_looked_at():
    whole, short = at_heights(np.array(LEVEL, float)), at_heights(np.array(LEVEL[:9], float))
    no_v = Toss("0", "0", "fit", whole.t, whole.x, whole.Lambda, None, whole.W)
    no_W = Toss("0", "0", "fit", whole.t, whole.x, whole.Lambda, whole.v, None)
    ask = (np.zeros(3), np.zeros(3), 1.0)
    assert rises([no_v, no_W, short, whole], np.array([6, 6, 6, 6]), *ask)["tosses"] == 1
    assert rises([no_v, no_W, short], np.array([6, 6, 6]), *ask) == {}
    # Frame 6 + 3 is the last of ten.
    assert rises([at_heights(np.array(LEVEL[:10], float))], np.array([6]), *ask)["tosses"] == 1


def test_every_toss_has_its_own_contact():
    whole = at_heights(np.array(LEVEL, float))
    with pytest.raises(ValueError):
        rises([whole, whole], np.array([6]), np.zeros(3), np.zeros(3), 1.0)
