"""What each effect on friction adds, by hand: numbers of a few points, no motion."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rockref.effects.friction.load_dependent_friction import LoadDependentFriction
from rockref.effects.friction.rolling_resistance import RollingResistance
from rockref.effects.friction.spin_friction import SpinFriction
from rockref.effects.friction.stribeck_friction import StribeckFriction
from rockref.effects.friction.uneven_foot_friction import UnevenFootFriction
from rockref.effects.friction.viscous_friction import ViscousFriction
from tests.unit.effects.bodies import TURNED, body, contact, points_at

#: Rounding of a few products and powers.
ROUNDED = 1e-14
MU_0, MU = np.array([0.5, 0.6, 0.7]), np.array([0.4, 0.3, 0.2])


def test_stribecks_excess_is_whole_at_rest_and_1_over_e_at_its_velocity():
    """Speeds of 0, 5 and 500 mm/s at 5 mm/s: factors rho, 1 + (rho - 1)/e and 1, on both coefficients."""
    k = contact([0.0] * 3, v_slide=[(0, 0), (3e-3, -4e-3), (0.3, 0.4)]).k
    mu_0, mu = StribeckFriction(1.8, 5e-3).friction_coefficient(MU_0, MU, None, k, None, {})
    factor = [1.8, 1 + 0.8 / math.e, 1.0]
    assert mu_0 == pytest.approx(MU_0 * factor, rel=ROUNDED) and mu == pytest.approx(MU * factor, rel=ROUNDED)


@pytest.mark.parametrize("effect", [StribeckFriction(1.0, 0.1), LoadDependentFriction(0.0, 20.0)])
def test_without_an_excess_or_an_exponent_velocity_and_reference_change_nothing(effect):
    mu_0, mu = effect.friction_coefficient(MU_0, MU, None, None, None, {})
    assert mu_0 is MU_0 and mu is MU


def test_the_coefficient_falls_with_a_power_of_the_load():
    """(F/F0)^(-1/4): one at the reference, a half at sixteen times it, and no more than at a thousandth of it."""
    F_N = 20.0 * np.array([1.0, 16.0, 1e-6])
    mu_0, mu = LoadDependentFriction(0.25, 20.0).friction_coefficient(MU_0, MU, F_N, None, None, {})
    factor = [1.0, 0.5, 1000**0.25]
    assert mu_0 == pytest.approx(MU_0 * factor, rel=ROUNDED) and mu == pytest.approx(MU * factor, rel=ROUNDED)


def test_a_film_drags_the_points_that_touch_where_they_are():
    """-c v at (1, 0, 0.5); the point in the air slides, too, and feels nothing."""
    c = contact([0.0, 1e-6, -1e-9], r=[(1, 0, 0.5), (0, 2, 0), (3, 3, 3)], v_slide=[(2, 3), (-1, 0), (7, 8)])
    force, moment = ViscousFriction(5.0).point_wrench(None, c, {})
    first, second = np.array([-10.0, -15.0, 0.0]), np.array([5.0, 0.0, 0.0])
    assert force == pytest.approx(first + second, rel=ROUNDED)
    assert moment == pytest.approx(np.cross((1, 0, 0.5), first) + np.cross((0, 2, 0), second), rel=ROUNDED)
    assert ViscousFriction(0.0).point_wrench(None, c, {}) is None


def test_friction_of_a_foot_is_that_of_both_coefficients():
    points = points_at([(0, 0, 0)] * 5, mu=0.25, names=("1ext", "2ext", "3int", "4int", "2int"))
    block, changed = UnevenFootFriction(0.5, 2.0, 3.0, 4.0).points("block", points)
    factors = np.array([0.5, 2.0, 3.0, 4.0, 2.0])
    assert block == "block"
    assert np.array_equal(changed.mu_0, 0.25 * factors) and np.array_equal(changed.mu, 0.25 * factors)
    assert all(getattr(changed, key) is getattr(points, key) for key in ("P", "K_N", "K_T", "C_N", "C_T"))
    with pytest.raises(ValueError, match="^effect uneven_foot_friction: contact point 'left' belongs to no foot"):
        UnevenFootFriction(foot1=2.0).points(None, points_at([(0, 0, 0)], names=("left",)))


#: One point that holds, one that gives way, one in the air; the body turns slowly about all three axes.
XI, LOADS = [1e-5, 1e-6, -1e-6], np.array([200.0, 1.0, 0.0])
TURN, W = np.array([1e-5, 2e-5, 5e-5]), np.array([0.2, 0.1, 0.7])


def three_points(**values):
    """The three points, with some of their properties."""
    return replace(points_at([(0, 0, 0)] * 3), **{key: np.array(a, float) for key, a in values.items()})


def resisted(effect, points, memory, turn=TURN, rate=W, v_slide=0.0):
    """Force, moment and memory of one evaluation."""
    problem = body(points, [effect])
    m = {key: np.array(a) for key, a in memory.items()}
    c = contact(XI, F_N=LOADS, turn=turn, v_slide=v_slide)
    return *effect.body_wrench(problem, c, np.zeros(3), TURNED, np.zeros(3), rate, m), m


def test_rolling_is_resisted_by_a_spring_and_a_damper_until_the_pressure_can_shift_no_further():
    lever, arm = 2e-3, 0.05
    points = three_points(K_N=[1e6, 2e6, 1e6], C_N=[50.0, 60.0, 70.0])
    before = np.array([(0.1, -0.2), (0.3, 0.4), (0.5, 0.6)])
    force, moment, m = resisted(RollingResistance(lever), points, {"held": before})
    omega = (TURNED @ W)[:2]
    spring = before - (points.K_N * lever * arm)[:, None] * TURN[:2]
    damper = (points.C_N * lever * arm)[:, None] * omega
    trial = spring - damper
    # The first is inside lever F_N = 0.4 N m; the second is outside 0.002 N m and keeps its direction.
    assert math.hypot(*trial[0]) < lever * LOADS[0] and math.hypot(*trial[1]) > lever * LOADS[1]
    cut = trial[1] / math.hypot(*trial[1]) * lever * LOADS[1]
    assert np.array_equal(force, np.zeros(3))
    assert moment == pytest.approx([*(trial[0] + cut), 0.0], rel=ROUNDED)
    # What is held is the spring's part: the damper's is taken out again. In the air all is forgotten.
    assert m["held"][0] == pytest.approx(spring[0], rel=ROUNDED)
    assert m["held"][1] == pytest.approx(cut + damper[1], rel=ROUNDED)
    assert np.array_equal(m["held"][2], [0.0, 0.0]) and set(m) == {"held"}


def test_spinning_is_resisted_by_a_spring_and_a_damper_until_the_face_rubs():
    radius = 2e-3
    points = three_points(K_T=[1e8, 2e8, 1e8], C_T=[1e4, 2e4, 3e4], mu=[0.3, 0.4, 0.5])
    before = np.array([1e-4, -4e-4, 3e-4])
    force, moment, m = resisted(SpinFriction(radius), points, {"yaw": before})
    K, C, rate = points.K_T * radius**2, points.C_T * radius**2, (TURNED @ W)[2]
    yaw = before + TURN[2]
    trial = -K * yaw - C * rate
    # The first is inside r mu F_N = 0.12 N m; the second is outside 0.0008 N m.
    limit = radius * points.mu * LOADS
    assert abs(trial[0]) < limit[0] and trial[1] > limit[1]
    assert np.array_equal(force, np.zeros(3))
    assert moment == pytest.approx([0.0, 0.0, trial[0] + limit[1]], rel=ROUNDED)
    # The spring of a face that rubs is turned as far as gives, with the damper, the limit.
    assert m["yaw"][0] == pytest.approx(yaw[0], rel=ROUNDED)
    assert -K[1] * m["yaw"][1] - C[1] * rate == pytest.approx(limit[1], rel=1e-12)
    assert m["yaw"][2] == 0.0 and set(m) == {"yaw"}


def test_a_face_rubs_alike_in_both_directions():
    points = three_points(K_T=[1e8] * 3, C_T=[1e4] * 3, mu=[0.3] * 3)
    _, one, m = resisted(SpinFriction(2e-3), points, {"yaw": [0.1] * 3})
    _, other, mirrored = resisted(SpinFriction(2e-3), points, {"yaw": [-0.1] * 3}, -TURN, -W)
    assert np.array_equal(one, -other) and np.array_equal(m["yaw"], -mirrored["yaw"])
    assert one[2] == pytest.approx(-2e-3 * 0.3 * 201.0, rel=ROUNDED)


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_a_foot_that_slides_turns_more_easily(share):
    """Sliding at 3/4 of the rim's speed leaves 4/5 of the largest moment; at rest, and in the air, nothing changes."""
    radius = 2e-3
    points = three_points(K_T=[1e8] * 3, C_T=[1e4] * 3, mu=[0.3] * 3)
    rim = radius * (TURNED @ W)[2]
    slides = rim * 0.75 * np.array([(0.6, -0.8), (0.0, 0.0), (0.0, 1.0)])
    effect = SpinFriction(radius, sliding_share=share)
    _, moment, m = resisted(effect, points, {"yaw": [0.1] * 3}, v_slide=slides)
    limit = radius * 0.3 * LOADS * (1 - share * np.array([0.2, 0.0, 0.0]))
    assert moment[2] == pytest.approx(-limit.sum(), rel=ROUNDED)
    K, C = 1e8 * radius**2, 1e4 * radius**2
    assert K * m["yaw"][:2] + C * (TURNED @ W)[2] == pytest.approx(limit[:2], rel=1e-12)


def test_a_foot_that_neither_slides_nor_turns_holds_as_without_sliding():
    points = three_points(K_T=[1e8] * 3, C_T=[1e4] * 3, mu=[0.3] * 3)
    still = [resisted(SpinFriction(2e-3, sliding_share=s), points, {"yaw": [0.1] * 3}, TURN, 0 * W) for s in (0.0, 1.0)]
    assert np.array_equal(still[0][1], still[1][1]) and still[0][1][2] < 0


def test_what_turns_begins_without_a_turn():
    problem = body(three_points())
    (name, held), *rest = RollingResistance(1e-3).start(problem).items()
    assert (name, rest) == ("held", []) and np.array_equal(held, np.zeros((3, 2)))
    (name, yaw), *rest = SpinFriction(1e-3).start(problem).items()
    assert (name, rest) == ("yaw", []) and np.array_equal(yaw, np.zeros(3))
    for absent in (RollingResistance(0.0), SpinFriction(0.0)):
        assert absent.body_wrench(problem, None, None, None, None, None, {}) is None
