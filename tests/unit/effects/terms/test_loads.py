"""What each load adds, and how a block is released with a push, by hand: numbers of one instant, no motion."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rockref.effects.loads.attachment import arm, half_height, velocity_at
from rockref.effects.loads.base_vibration import BaseVibration
from rockref.effects.loads.cable_restraint import CableRestraint
from rockref.effects.loads.gravity_deviation import GravityDeviation
from rockref.effects.loads.lingering_wire_pull import LingeringWirePull
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.effects.loads.quadratic_drag import QuadraticDrag
from rockref.effects.release.release_velocity import ReleaseVelocity
from rockref.model.problem import State
from tests.unit.effects.bodies import TURNED, body, contact, points_at

#: Rounding of a few products.
ROUNDED = 1e-14
X, V, W = np.array([0.3, -0.2, 0.5]), np.array([0.4, -0.1, 0.2]), np.array([0.5, 0.7, -0.3])
#: The base is 0.4 m below the centre of mass.
FEET = points_at([(0.1, 0.1, -0.4), (-0.1, 0.1, -0.35)])


def load(effect, problem, m=None, t=0.0):
    """Force and moment at X, TURNED, V, W."""
    return effect.body_wrench(problem, contact([-1.0], t=t), X, TURNED, V, W, m or {})


def test_the_half_height_is_that_of_each_run():
    P = np.stack([FEET.P, 2 * FEET.P])
    assert half_height(FEET) == 0.4 and np.array_equal(half_height(replace(FEET, P=P)), [0.4, 0.8])


def test_an_arm_is_the_third_axis_of_the_body_times_the_height():
    assert arm(TURNED, 0.4) == pytest.approx(TURNED @ (0, 0, 0.4), rel=ROUNDED)
    both = arm(np.stack([TURNED, np.eye(3)]), np.array([0.4, 0.8]))
    assert both == pytest.approx(np.array([TURNED @ (0, 0, 0.4), (0, 0, 0.8)]), rel=ROUNDED)


def test_a_point_of_the_body_moves_with_the_centre_and_turns_about_it():
    r = np.array([0.1, -0.2, 0.3])
    assert velocity_at(r, TURNED, V, W) == pytest.approx(V + np.cross(TURNED @ W, r), rel=ROUNDED)


def test_gravity_is_scaled_and_nothing_else():
    block = body(FEET, mass=2.0, g=9.81).block
    changed, points = GravityDeviation(0.9).points(block, FEET)
    assert points is FEET and changed.g == pytest.approx(0.9 * 9.81, rel=ROUNDED)
    assert changed.mass is block.mass and changed.inertia is block.inertia


def test_a_plate_that_falls_toward_x_and_y_pulls_there_and_carries_less():
    """m g (x, y, (x^2 + y^2)/2), for slopes of 0.03 and -0.04 under 20 N."""
    problem = body(FEET, mass=2.0, g=10.0)
    force, moment = load(PlateTilt(0.03, -0.04), problem)
    assert force == pytest.approx([0.6, -0.8, 0.025], rel=ROUNDED) and np.array_equal(moment, np.zeros(3))
    assert load(PlateTilt(), problem) is None


def test_drag_is_against_the_motion_and_grows_with_its_square():
    """v of length 0.458 and W, turned into the plate's axes, of length 0.911."""
    force, moment = load(QuadraticDrag(3.0, 5.0), body(FEET))
    omega = TURNED @ W
    assert force == pytest.approx(-5.0 * math.sqrt(0.21) * V, rel=ROUNDED)
    assert moment == pytest.approx(-3.0 * math.sqrt(0.83) * omega, rel=ROUNDED)
    assert load(QuadraticDrag(), body(FEET)) is None


@pytest.mark.parametrize("height, above", [(None, 0.4), (0.15, 0.15)])
def test_a_cable_pulls_its_end_back_sideways(height, above):
    """-k (p - p(0)) - c p' of the body point at the top, or at the stated height; nothing along the vertical."""
    start = {"x": (0.1, 0.2, 0.45), "Lambda": np.eye(3)}
    effect = CableRestraint(7.0, 2.0, height)
    problem = body(FEET, [effect], **start)
    m = effect.start(problem)
    assert list(m) == ["anchor"] and m["anchor"] == pytest.approx([0.1, 0.2, 0.45 + above], rel=ROUNDED)
    r = TURNED @ (0, 0, above)
    wanted = -7.0 * (X + r - m["anchor"]) - 2.0 * (V + np.cross(TURNED @ W, r))
    force, moment = load(effect, problem, m)
    assert force == pytest.approx([*wanted[:2], 0.0], rel=ROUNDED)
    assert moment == pytest.approx(np.cross(r, force), rel=ROUNDED)
    assert load(CableRestraint(0.0, 0.0, 0.1), problem, m) is None


def test_a_cable_stiffens_with_the_square_of_the_way_about_its_reference():
    """k ((1 - q) + q o^2/o_0^2): k where the way is the reference one, k (1 + q) where its square is twice that."""
    anchor = X + TURNED @ (0, 0, 0.15) - (0.03, -0.04, 0.5)
    for reference, k in ((0.05, 7.0), (0.05 / math.sqrt(2), 7.0 * 1.6), (1e9, 7.0 * 0.4)):
        effect = CableRestraint(7.0, 0.0, 0.15, 0.6, reference)
        force, _ = load(effect, body(FEET), {"anchor": anchor})
        assert force == pytest.approx([-0.03 * k, 0.04 * k, 0.0], rel=ROUNDED)


def test_a_cable_that_does_not_stiffen_is_linear_to_the_last_bit():
    """Whatever the reference; and in a batch each block has a way of its own."""
    r, anchor = arm(TURNED, 0.15), np.array([0.7, 0.3, 0.0])
    wanted = -7.0 * (X + r - anchor) - 2.0 * velocity_at(r, TURNED, V, W)
    for reference in (1e-300, 0.08, 1e300):
        effect = CableRestraint(7.0, 2.0, 0.15, 0.0, reference)
        assert np.array_equal(load(effect, body(FEET), {"anchor": anchor})[0][:2], wanted[:2])
    effect = CableRestraint(7.0, 2.0, 0.15, 0.6, 0.1)
    both = [X, X + (0.2, 0.0, 0.0)]
    states = np.stack(both), np.stack([TURNED] * 2), np.stack([V] * 2), np.stack([W] * 2)
    force, _ = effect.body_wrench(body(FEET), contact([-1.0]), *states, {"anchor": anchor})
    for x, of_batch in zip(both, force, strict=True):
        alone, _ = effect.body_wrench(body(FEET), contact([-1.0]), x, TURNED, V, W, {"anchor": anchor})
        assert np.array_equal(alone, of_batch)


def test_a_wire_pulls_the_top_toward_y_and_lets_go_slowly():
    """3 N after no time, 3/e N after tau, at the top of the body."""
    effect = LingeringWirePull(3.0, 0.2)
    r = TURNED @ (0, 0, 0.4)
    for t, pull in ((0.0, 3.0), (0.2, 3.0 / math.e)):
        force, moment = load(effect, body(FEET), t=t)
        assert force == pytest.approx([0.0, pull, 0.0], rel=ROUNDED)
        assert moment == pytest.approx(np.cross(r, (0, pull, 0)), rel=ROUNDED, abs=1e-16)
    assert load(LingeringWirePull(0.0, 0.2), body(FEET)) is None


def test_a_wire_that_is_paid_out_lets_go_evenly_and_ends():
    """Evenness 1: a straight line to nothing at tau; 1/2: a parabola to nothing at 2 tau; small: the exponential."""
    left = LingeringWirePull(3.0, 0.2, evenness=1.0).left
    assert [left(t) for t in (0.0, 0.05, 0.2, 0.3)] == pytest.approx([1.0, 0.75, 0.0, 0.0], abs=1e-15)
    left = LingeringWirePull(3.0, 0.2, evenness=0.5).left
    assert [left(t) for t in (0.0, 0.2, 0.4, 0.5)] == pytest.approx([1.0, 0.25, 0.0, 0.0], abs=1e-15)
    # (1 - q s)^(1/q) = exp(-s - q s^2/2 - ...), s = 1/2.
    assert LingeringWirePull(3.0, 0.2, evenness=1e-6).left(0.1) == pytest.approx(math.exp(-0.5), rel=1e-6)
    # So little of it is lost in rounding: the exponential itself, not a pull that never ends.
    assert LingeringWirePull(3.0, 0.2, evenness=1e-17).left(0.1) == math.exp(-0.5)
    force, _ = load(LingeringWirePull(3.0, 0.2, evenness=1.0), body(FEET), t=0.05)
    assert force == pytest.approx([0.0, 2.25, 0.0], rel=ROUNDED)


def test_a_plate_that_shakes_pushes_every_mass_alike_along_its_direction():
    """-m A cos(2 pi f t + phase) along (sin d, cos d): d = atan(3/4), a quarter period and a sixth after the crest."""
    effect = BaseVibration(0.5, 2.0, math.atan2(3, 4), math.pi / 3)
    problem = body(FEET, mass=3.0)
    for t, cosine in ((0.0, 0.5), (0.125, -math.sqrt(3) / 2)):
        force, moment = load(effect, problem, t=t)
        assert force == pytest.approx(-3.0 * 0.5 * cosine * np.array([0.6, 0.8, 0.0]), rel=ROUNDED)
        assert np.array_equal(moment, np.zeros(3))
    assert load(BaseVibration(0.0, 2.0, 1.0, 1.0), problem) is None


def test_a_second_harmonic_keeps_twice_the_phase_of_the_first_tone():
    """cos 2 psi = 2 cos^2 psi - 1, sin 2 psi at psi = 2 pi f t + phase; none of it leaves the first tone's bits."""
    first, both = BaseVibration(0.5, 2.0, 0.0, 0.7), BaseVibration(0.5, 2.0, 0.0, 0.7, 0.3, -0.2)
    for t in (0.0, 0.125, 0.3):
        psi = 4 * math.pi * t + 0.7
        assert first.wave(t) == math.cos(psi)
        assert both.wave(t) == pytest.approx(math.cos(psi) + 0.3 * math.cos(2 * psi) - 0.2 * math.sin(2 * psi))
        force, _ = load(both, body(FEET, mass=3.0), t=t)
        assert force == pytest.approx([0.0, -1.5 * both.wave(t), 0.0], rel=ROUNDED)


@pytest.mark.parametrize(
    "effect",
    [
        LingeringWirePull(3.0, 0.2), LingeringWirePull(3.0, 0.2, evenness=0.7), BaseVibration(0.5, 2.0, 0.6, 0.7),
        BaseVibration(0.5, 2.0, 0.6, 0.7, 0.3, -0.2),
    ],
    ids=("falls as what is left", "falls more evenly", "vibration", "second harmonic"),
)  # fmt: skip
def test_a_time_for_each_run_gives_each_its_own_load(effect):
    """As the windows of a fit have."""
    times = np.array([0.0, 0.13, 0.4])
    one = body(FEET, mass=3.0)
    many = replace(one, block=replace(one.block, mass=np.full(3, 3.0)))
    x, Lambda = np.tile(X, (3, 1)), np.tile(TURNED, (3, 1, 1))
    force, moment = effect.body_wrench(many, contact([-1.0], t=times), x, Lambda, None, None, {})
    assert force.shape == moment.shape == (3, 3)
    for i, t in enumerate(times):
        alone, turning = load(effect, one, t=float(t))
        # NumPy's functions for arrays differ from those for one number by a rounding.
        assert force[i] == pytest.approx(alone, rel=ROUNDED) and moment[i] == pytest.approx(turning, rel=ROUNDED)


def pushed(P, x=0.0, y=0.0, z=0.0, dtype=float):
    """The state after a push, of a turned body that was moving already."""
    P = np.array(P, dtype)
    start = State.at_rest(X.astype(dtype), TURNED.astype(dtype), len(P), V.astype(dtype), W.astype(dtype))
    points = replace(points_at(P), P=P)
    return start, ReleaseVelocity(x, y, z).release(None, points, start)


def still_point(P, middle):
    """What the push adds to the velocity of a body point in the middle [m/s]."""
    start, state = pushed(P, 0.3, -0.2, 0.5)
    added = state.W - start.W
    assert added == pytest.approx([0.3, -0.2, 0.5], rel=ROUNDED)
    return state.v - start.v + np.cross(TURNED @ added, TURNED @ middle)


def test_a_push_turns_the_body_about_the_middle_of_its_lowest_points_on_either_side():
    """Of each side the lowest; TURNED, body y and z count for the height: 0.6 y + 0.8 z."""
    left, right = np.array([-0.2, -0.15, -0.5]), np.array([0.1, -0.1, -0.4])
    others = [(0.3, 0.2, -0.4), (-0.1, 0.2, -0.5)]
    assert still_point([others[0], left, others[1], right], (left + right) / 2) == pytest.approx([0] * 3, abs=1e-16)


def test_a_point_on_the_middle_line_is_no_pivot_and_one_side_may_be_empty():
    left, between = np.array([-0.2, 0.1, -0.5]), np.array([0.0, 0.0, -2.0])
    assert still_point([between, left], left) == pytest.approx([0] * 3, abs=1e-16)


def test_a_body_without_pivots_turns_about_its_centre():
    start, state = pushed([(0.0, 0.0, -0.5)], 0.3, dtype=np.float32)
    assert np.array_equal(state.v, start.v) and state.v.dtype == state.W.dtype == np.float32
    assert state.W == pytest.approx(W.astype(np.float32) + np.float32([0.3, 0, 0]), rel=1e-7)


def test_no_push_leaves_the_state():
    start, state = pushed([(0.1, 0.0, -0.5)])
    assert state is start
