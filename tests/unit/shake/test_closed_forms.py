"""Rule B1 against closed forms, the planar model, a tilted plate, and a scheme that moves the plate instead."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

pytest.importorskip("numba")

from rockref.effects.base import Effect
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.engines.compiled.engine import simulate, simulate_many
from rockref.model.base_motion import BaseMotion
from rockref.model.simulate import simulate as law
from rockref.shake.plane_block import plane_block, rock
from tests.unit.shake.blocks import G, along_y, block, shaken, tilt


def test_the_block_lifts_at_g_b_over_h():
    """A ramp of one second, slow beside the springs: the feet behind are unloaded at a = g b / h."""
    b, h = 0.1, 0.4
    r = simulate(shaken(block(b, h), along_y([0, 1], [0, 1.2 * G * b / h], 0.25), 1.0, output_rate=5000.0))
    lifted = r.t[np.argmin(r.F[:, :2, 2].max(axis=1) > 0)]  # the plate runs to +y, the feet at +y go up
    # the force lags by the block's turn on its springs: 0.0015 of the level
    assert 1.0 <= lifted * 1.2 < 1.003


@pytest.mark.parametrize("K, distance", [(1e7, 2e-3), (1e8, 5e-4)])
def test_a_sliding_block_goes_as_far_as_newmark_says(K, distance):
    """D = V^2 / (2 mu g) (1 - mu g / a) = 0.77905 m for a = 6 m/s2 over 0.5 s, mu = 0.3.

    Springs of the feet shift the start and the end of the slide: by 0.13 and 0.04 % at these stiffnesses.
    """
    r = simulate(shaken(block(0.25, 0.05, K=K, mu=0.3), along_y([0, 0.5], [6.0, 6.0], 0.5), 1.8))
    assert abs(-(r.x[-1, 1] - r.x[0, 1]) / 0.77905 - 1) < distance
    assert abs(r.v[-1, 1]) < 1e-9 and r.anchored.all() and abs(r.x[-1, 0]) < 1e-12


def test_a_plate_that_falls_leaves_the_block_weightless():
    r = simulate(shaken(block(0.1, 0.4), BaseMotion(0.0, 1.0, np.full((2, 3), [0.0, 0.0, -G])), 0.2))
    assert r.F[0].any() and not r.F[2:].any()  # the springs relax within two milliseconds
    # no force but that of rounding g: the block drifts evenly with what the springs gave it
    assert np.ptp(r.v[3:], axis=0).max() < 1e-12 and 0 < r.v[-1, 2] < 0.01


def test_a_constant_acceleration_is_a_tilted_plate():
    """The weight has components a g and b g along the plate, and less across by the square: the same as shaking."""
    a, b = 0.11, -0.07
    acting = -G * np.array([a, b, (a * a + b * b) / 2])
    base = shaken(block(0.1, 0.5, mu=0.4), BaseMotion(-1.0, 10.0, np.array([acting, acting])), 0.2)
    tilted = base.replace(base=None, effects=(PlateTilt(x=a, y=b),))
    here, there = simulate(base), simulate(tilted)
    assert np.ptp(here.x[:, 1]) > 1e-6
    # forces of 500 N are rounded in another order; the springs make 1e-15 of it in 20 000 steps
    np.testing.assert_allclose(here.x, there.x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(here.W, there.W, rtol=0, atol=1e-9)


@pytest.mark.parametrize("K, distance", [(1e7, 0.012), (1e8, 1e-3)])
def test_a_one_sine_pulse_overturns_the_block_at_the_level_of_the_planar_model(K, distance):
    """alpha = 0.25, omega = 5 p, without an impact from 7.493 alpha g; springs of 1e7 N/m give 1.1 % less, 1e8 0.03 %.

    Levels closer than the distance on either side must decide alike. Thresholds with impacts depend on the restitution,
    which the planar model has as a number and the law as a damper: see the next test.
    """
    b, h = np.sin(0.25), np.cos(0.25)
    omega = 5 * np.sqrt(3 * G / 4)
    t = np.linspace(0, 2 * np.pi / omega, 401)
    levels = 7.493 * np.array([1 - distance, 1 + distance / 10])
    records = [along_y(t, level * 0.25 * G * np.sin(omega * t), t[1] / 2) for level in levels]
    runs = simulate_many([shaken(block(b, h, K=K), base, 3.5, output_rate=100.0) for base in records])
    assert [bool(abs(tilt(r)[-1]) > 0.3) for r in runs] == [False, True]
    # on even feet the block stays in its plane
    assert all(np.max(np.abs(r.W[:, 1:])) < 1e-6 and np.max(np.abs(r.x[:, 0])) < 1e-9 for r in runs)


def test_all_three_thresholds_of_a_one_sine_pulse_are_those_of_the_planar_model():
    """It falls after one impact from 2.945 alpha g, stands from 6.827, falls without one from 7.493 (alpha = 0.25).

    The planar block keeps its angular momentum at an impact, e = 1 - 1.5 sin(alpha)^2; so do feet of 1e9 N/m that
    hardly spring back. Levels 0.2 % below and above decide alike in both; closer than 0.1 % they need not.
    """
    b, h = np.sin(0.25), np.cos(0.25)
    omega, levels = 5 * np.sqrt(3 * G / 4), np.outer([2.945, 6.827, 7.493], [0.998, 1.002]).ravel()
    t = np.linspace(0, 2 * np.pi / omega, 401)
    records = [along_y(t, level * 0.25 * G * np.sin(omega * t), t[1] / 2) for level in levels]
    planar = plane_block(h, (b, b), np.sqrt((b * b + h * h) / 3))
    in_a_plane = [rock(base.rotated(-90), planar).fell for base in records]
    body = block(b, h, K=1e9, beta=0.7)
    in_space = simulate_many([shaken(body, base, 4.0, output_rate=100.0) for base in records])
    assert in_a_plane == [False, True, True, False, False, True]
    assert [bool(abs(tilt(r)[-1]) > 0.3) for r in in_space] == in_a_plane


@dataclass(frozen=True)
class MovedPlate(Effect):
    """The plate moves, in the axes of the room, by the double integral of a record: no force on the block."""

    id = "moved_plate"
    base: BaseMotion

    def is_absent(self):
        return False

    def plate_motion(self, t, m):
        base, place, velocity = self.base, np.zeros(3), np.zeros(3)
        last = min(int((t - base.t_0) // base.dt), len(base.a) - 2)
        for k in range(last + 1):
            s = base.dt if k < last else t - base.t_0 - k * base.dt
            slope = (base.a[k + 1] - base.a[k]) / base.dt
            place = place + velocity * s + base.a[k] * s * s / 2 + slope * s**3 / 6
            velocity = velocity + base.a[k] * s + slope * s * s / 2
        return place, velocity


def test_a_plate_that_is_moved_under_the_block_shakes_it_as_the_force_does():
    """The witness shares the contact with B1, and no force: the plate goes its way, the block has its weight alone.

    Both schemes are of second order, so their difference falls to a quarter with half the step; a force that were read
    one step early or late would leave a difference of first order, a hundred times larger.
    """
    base = BaseMotion(0.0, 0.003, np.random.default_rng(5).normal(size=(12, 3)) * [9, 8, 6])
    found = []
    for step in (2e-5, 1e-5):
        body, points = block(0.05, 0.2, K=1e7, mu=0.35)
        problem = shaken((body, replace(points, P=points.P + [0.01, -0.02, 0.0])), base, 0.03, step)
        shaking = law(problem)
        moved = law(problem.replace(base=None, effects=(MovedPlate(base),)))
        place = np.array([MovedPlate(base).plate_motion(float(t), None)[0] for t in moved.t])
        found.append((np.max(np.abs(moved.x - place - shaking.x)), np.max(np.abs(moved.W - shaking.W))))
        assert shaking.sliding.any() and not shaking.anchored.all() and np.max(np.abs(shaking.W)) > 0.2
    (x, W), (x_half, W_half) = found
    assert x_half < 1e-8 and W_half < 1e-5
    assert 3.5 < x / x_half < 4.5 and 3.5 < W / W_half < 4.5


def test_a_later_start_with_a_later_record_is_the_same_run():
    """Times that are sums of powers of two: not a bit changes."""
    base = BaseMotion(0.125, 2.0**-8, np.random.default_rng(6).normal(size=(15, 3)) * 5)
    here = shaken(block(0.05, 0.2, mu=0.35), base, 0.25, step=2.0**-17, output_rate=2.0**9)
    there = here.replace(base=replace(base, t_0=16.125), start=replace(here.start, t=16.0))
    a, b = simulate(here), simulate(there)
    assert a.x.tobytes() == b.x.tobytes() and a.W.tobytes() == b.W.tobytes() and (b.t - a.t == 16).all()
    assert np.ptp(a.x, axis=0).min() > 1e-6
