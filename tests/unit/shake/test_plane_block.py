"""The block in a plane under pulses against closed forms and thresholds of another program."""

import math

import numpy as np
import pytest

from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.model.housner import velocity_ratio
from rockref.shake.plane_block import PlaneBlock, plane_block, rk4, rock, rock_all, rock_many
from rockref.shake.pulses import one_sine

G = 9.81


def symmetric(alpha, p, e):
    return PlaneBlock((alpha, alpha), (p, p), (e, e))


def falls(ratio, alpha, linear):
    """Whether a block with p = 2 /s falls under one sine of 5 p and `ratio` times the uplift of small angles."""
    period = 2 * math.pi / 10.0
    return rock(one_sine(ratio * alpha * G, period, period / 2000), symmetric(alpha, 2.0, 0.9), linear=linear).fell


@pytest.mark.parametrize(
    "alpha, linear, after_impact, stands, without",
    [(0.1, True, 3.0186, 6.318, 7.168), (0.25, False, 3.032, 6.743, 7.493)],
)
def test_one_sine_has_three_thresholds(alpha, linear, after_impact, stands, without):
    # Four figures are stated, found with steps of another method.
    near = 1.5e-3
    assert not falls(after_impact * (1 - near), alpha, linear) and falls(after_impact * (1 + near), alpha, linear)
    assert falls(stands * (1 - near), alpha, linear) and not falls(stands * (1 + near), alpha, linear)
    assert not falls(without * (1 - near), alpha, linear) and falls(without * (1 + near), alpha, linear)


@pytest.mark.parametrize("A, duration", [(1.2, 1.7918), (2.0, 0.6931), (4.0, 0.2877)])
def test_rectangular_pulse_overturns_from_its_closed_form_on(A, duration):
    # cosh(p t) = 1 + 1/[2 A (A - 1)], p = 1; the pulse's edge takes one step of the record.
    assert math.cosh(duration) == pytest.approx(1 + 1 / (2 * A * (A - 1)), rel=1e-4)
    dt, alpha, block = 1e-4, 0.05, symmetric(0.05, 1.0, 0.9)
    for factor, fell in ((0.999, False), (1.001, True)):
        a = np.zeros((round(factor * duration / dt) + 2, 3))
        a[1:-1, 0] = -A * alpha * G
        assert rock(BaseMotion(0.0, dt, a), block, linear=True).fell is fell


def test_uplift_begins_at_g_b_over_h_and_the_weaker_edge_is_the_nearer_one():
    block = plane_block(0.3, (0.06, 0.09), 0.2)
    for sign, reach in ((-1.0, 0.06), (1.0, 0.09)):
        for share, moves in ((0.999, False), (1.001, True)):
            a = np.zeros((41, 3))
            a[1:-1, 0] = sign * share * G * reach / 0.3
            assert (rock(BaseMotion(0.0, 0.01, a), block).largest_tilt > 0.0) is moves


def test_impact_ratio_of_equal_edges_is_housners():
    block = plane_block(0.4, (0.1, 0.1), math.hypot(0.4, 0.1) / math.sqrt(3))
    R = math.hypot(0.4, 0.1)
    assert block.e[0] == pytest.approx(velocity_ratio(1.0, R**2 / 3, R, math.atan(0.25)), rel=1e-14)
    assert plane_block(0.3, (0.06, 0.09), 0.2, restitution=0.5).e[1] == 0.5 * plane_block(0.3, (0.06, 0.09), 0.2).e[1]


def test_mirrored_motion_and_block_give_the_same_outcome():
    rng = np.random.default_rng(15)
    a = np.zeros((300, 3))
    a[:, 0] = 4.0 * rng.standard_normal(300)
    block, mirror = (plane_block(0.3, reach, 0.2) for reach in ((0.06, 0.09), (0.09, 0.06)))
    one, other = rock(BaseMotion(0.0, 0.02, a), block), rock(BaseMotion(0.0, 0.02, -a), mirror)
    assert one == other and one.impacts > 5


def test_the_step_keeps_the_energy_of_a_quiet_floor():
    theta, rate, alpha, p2 = 0.08, 0.0, 0.2, 4.0
    for _ in range(400):
        theta, rate = rk4(theta, rate, 1e-3, 1.0, 0.0, 0.0, alpha, p2, False)
    # Fourth order: (1e-3)^4 times a number of the order of one.
    assert 0.5 * rate**2 + p2 * math.cos(alpha - theta) == pytest.approx(p2 * math.cos(alpha - 0.08), abs=1e-12)


def test_compiled_loop_is_the_text():
    block = np.array([[0.1, 0.2, 3.0, 3.5, 0.9, 0.8]])
    base = one_sine(4.0, 0.5, 0.01)
    quiet = np.zeros(math.ceil(20 / (3.0 * 0.01)))
    a = np.concatenate([base.a[:, 0], quiet]) / G
    text = rock_all(a, 0.01, 20, block, False)
    # The compiler may join a product and a sum.
    assert rock_many(base, block) == pytest.approx(text, rel=1e-9)


def test_lengths_must_be_positive():
    with pytest.raises(InputError, match="E-RANGE"):
        plane_block(0.3, (0.0, 0.1), 0.2)
