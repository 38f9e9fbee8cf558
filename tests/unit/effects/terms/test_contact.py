"""What each effect on the normal contact adds, by hand: numbers of a few points, no motion."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.contact.hertzian_contact import HertzianContact
from rockref.effects.contact.hunt_crossley_contact import HuntCrossleyContact
from rockref.effects.contact.hysteretic_contact import HystereticContact
from rockref.effects.contact.orientation_dependent_damping import OrientationDependentDamping
from rockref.effects.contact.uneven_foot_damping import UnevenFootDamping
from rockref.effects.contact.uneven_foot_stiffness import UnevenFootStiffness
from rockref.model.problem import State
from tests.unit.effects.bodies import body, contact, points_at

#: Rounding of a few products and powers.
ROUNDED = 1e-14


def at_rest():
    """A body of two points at rest."""
    return State.at_rest(np.array([0.1, 0.2, 0.5]), np.eye(3), 2)


def two_points(K_N, **kwargs):
    """Two points of different stiffness."""
    points = points_at([(0.1, 0, 0), (0, 0.2, 0)], **kwargs)
    return replace(points, K_N=np.array(K_N, float))


def test_the_pull_is_whole_on_the_plate_and_fades_over_its_range():
    pull = Adhesion(8.0, 2e-5).pull(np.array([-3e-5, -2e-5, -1e-5, 0.0, 5e-6]))
    # Rounding of 1 - 1e-5/2e-5.
    assert pull == pytest.approx([0.0, 0.0, 4.0, 8.0, 8.0], rel=ROUNDED, abs=1e-15)


def test_the_pull_of_each_point_acts_downward_where_the_point_is():
    """8 N at (1, 0, 0) and 4 N at (0, 2, 0): moments (0, 8, 0) and (-8, 0, 0)."""
    force, moment = Adhesion(8.0, 2e-5).point_wrench(None, contact([0.0, -1e-5], r=[(1, 0, 0), (0, 2, 0)]), {})
    assert force == pytest.approx([0, 0, -12], rel=ROUNDED)
    assert moment == pytest.approx([-8, 8, 0], rel=ROUNDED)


def test_a_block_that_is_held_down_stands_deeper_by_the_pull_over_the_stiffness():
    """Of two pivots, 8 N on 1e6 N/m and on 2e6 N/m, the middle."""
    before = at_rest()
    state = Adhesion(8.0, 2e-5).release(None, two_points([1e6, 2e6]), before)
    assert state.x == pytest.approx([0.1, 0.2, 0.5 - 6e-6], rel=ROUNDED)
    assert np.array_equal(before.x, [0.1, 0.2, 0.5]) and state.W is before.W


def test_without_a_force_the_range_holds_nothing():
    absent, before = Adhesion(0.0, 1e-4), at_rest()
    assert absent.point_wrench(None, contact([0.0]), {}) is None and absent.release(None, None, before) is before


def test_a_hertzian_spring_is_the_linear_one_at_its_reference():
    """K x0 (xi/x0)^p: four times the reference is eight times the force for p = 3/2; above the plate there is none."""
    K_N, damper = np.array([1e6, 2e6, 1e6]), 3.0
    xi = np.array([2e-5, 8e-5, -1e-5])
    points = replace(points_at([(0, 0, 0)] * 3), K_N=K_N)
    F = HertzianContact(1.5, 2e-5).normal_force(K_N * xi + damper, contact(xi).k, points, {})
    # Rounding beside the linear spring that is taken away, of up to 160 N.
    assert F == pytest.approx([20 + damper, 320 + damper, damper], rel=1e-13)


def test_a_hertzian_block_is_released_where_its_springs_carry_it():
    """The depth d has K x0 (d/x0)^p = m g/2 at each of two pivots; the law's is m g/2 K."""
    mass, g, p, x0, K_N = 4.0, 10.0, 1.5, 2e-5, 2.5e5
    block = body(points_at([(0, 0, 0)]), mass=mass, g=g).block
    before = at_rest()
    state = HertzianContact(p, x0).release(block, two_points([K_N, K_N]), before)
    depth = mass * g / 2 / K_N - (state.x[2] - before.x[2])
    # The height of half a metre is kept to 1e-16 m, of a depth of 5e-5 m.
    assert K_N * x0 * (depth / x0) ** p == pytest.approx(mass * g / 2, rel=1e-10)
    assert np.array_equal(state.x[:2], before.x[:2]) and state.v is before.v


def test_a_hertzian_block_on_unequal_springs_stands_at_their_mean():
    block = body(points_at([(0, 0, 0)]), mass=4.0, g=10.0).block
    effect = HertzianContact(2.0, 2e-5)
    heights = [effect.release(block, two_points(K_N), at_rest()).x[2] for K_N in ((1e6, 1e6), (4e6, 4e6), (1e6, 4e6))]
    # Heights of half a metre, kept to 1e-16 m.
    assert heights[2] == pytest.approx((heights[0] + heights[1]) / 2, abs=2e-16)
    # At the load that the reference names the spring is the law's: 20 N at 1e6 N/m is 2e-5 m.
    assert heights[0] == pytest.approx(0.5, abs=2e-16) and heights[1] < 0.5


def test_an_exponent_of_one_leaves_force_and_release():
    absent, before, F = HertzianContact(1.0, 5e-5), at_rest(), np.array([1.0])
    assert absent.release(None, None, before) is before and absent.normal_force(F, None, None, {}) is F


def test_hunt_and_crossleys_damper_grows_with_depth():
    """K xi (1 + a xi_rate) + C xi_rate, going in and coming out."""
    K_N, C, a = np.array([1e6, 2e6]), 50.0, 3.0
    xi, rate = np.array([1e-5, 2e-5]), np.array([0.2, -0.1])
    points = replace(points_at([(0, 0, 0)] * 2, C_N=C), K_N=K_N)
    F = HuntCrossleyContact(a).normal_force(K_N * xi + C * rate, contact(xi, xi_rate=rate).k, points, {})
    assert F == pytest.approx([10 * 1.6 + 10, 40 * 0.7 - 5], rel=ROUNDED)


#: Lines from the centre of mass to a corner: of a tip, of an edge, of a face, of a flat block, of none; and P_2 >= 0.
DIRECTIONS = {
    "tip": ((0.0, 0.0, -0.7), 1.0),
    "edge": ((0.3, 0.4, -np.sqrt(0.5)), 0.5),
    "face": ((0.5, -0.5, -0.5), 0.0),
    "flat": ((0.5, 0.5, -0.1), 0.0),
    "halfway": ((0.6, 0.0, -0.8), 0.46),
    "none": ((0.0, 0.0, 0.0), 0.0),
}


@pytest.mark.parametrize("radius", [None, 0.05])
@pytest.mark.parametrize("name", DIRECTIONS)
def test_a_damper_that_knows_how_its_corner_is_turned(name, radius):
    """C xi_rate (1 + a P_2), going in and coming out; of a round corner the centre says how it is turned."""
    (x, y, z), tip = DIRECTIONS[name]
    C, a, F, rate = 50.0, 3.0, np.array([7.0, 7.0]), np.array([0.2, -0.1])
    points = points_at([(0, 0, 0)] * 2, C_N=C, radius=radius)
    k = contact([1e-5, 1e-5], r=[(x, y, z - (radius or 0.0))] * 2, xi_rate=rate).k
    found = OrientationDependentDamping(a).normal_force(F, k, points, {})
    # A cosine whose square is 1/3 or 2/3 to rounding, times 30 N.
    assert found == pytest.approx(7.0 + a * tip * C * rate, abs=1e-13)


def test_without_an_orientation_the_damper_is_the_law_s():
    F = np.array([1.0])
    assert OrientationDependentDamping(0.0).normal_force(F, None, None, {}) is F


def dented(xi, largest, rate=0.0, kappa=0.5, share=0.0):
    """Force and memory of points of 1e6 N/m and 100 N s/m that have been as deep as `largest`."""
    xi, rate = np.array(xi), np.broadcast_to(rate, np.shape(xi))
    points = points_at([(0, 0, 0)] * len(xi), K_N=1e6, C_N=100.0)
    m = {"xi_largest": np.array(largest)}
    F = HystereticContact(kappa, share).normal_force(1e6 * xi + 100.0 * rate, contact(xi, xi_rate=rate).k, points, m)
    return F, m["xi_largest"]


def test_a_contact_loads_along_its_spring_and_unloads_more_steeply():
    """kappa = 1/2: after 3e-5 m the dent is 1e-5 m, and at 2e-5 m the spring of 1.5e6 N/m has 15 N."""
    F, largest = dented([4e-5, 3e-5, 2e-5, 1e-5, 5e-6], [3e-5] * 5)
    # Below the dent nothing is left.
    assert F == pytest.approx([40, 30, 15, 0, 0], rel=ROUNDED, abs=1e-13)
    assert np.array_equal(largest, [4e-5, 3e-5, 3e-5, 3e-5, 3e-5])


@pytest.mark.parametrize("share", [0.5, 1.0])
def test_a_curved_unloading_ends_where_the_line_does(share):
    """Half of the way back: s = 1/2 of the line's force, s^(3/2) of the curve's; whole at the turning point."""
    F, _ = dented([4e-5, 3e-5, 2e-5, 1e-5, 5e-6], [3e-5] * 5, share=share)
    half = 15 * (1 - share + share * np.sqrt(0.5))
    assert F == pytest.approx([40, 30, half, 0, 0], rel=1e-13, abs=1e-13)
    touching, largest = dented([0.0], [0.0], share=share)
    assert touching[0] == 0 and largest[0] == 0


def test_the_damper_of_a_dented_contact_stays():
    still, _ = dented([4e-5, 2e-5, 5e-6], [3e-5] * 3)
    moving, _ = dented([4e-5, 2e-5, 5e-6], [3e-5] * 3, rate=np.array([0.2, -0.1, -0.03]))
    assert moving - still == pytest.approx([20, -10, -3], rel=1e-13)


def test_the_dent_is_forgotten_above_the_plate_and_not_on_it():
    _, largest = dented([0.0, -1e-9, -1e-3], [3e-5] * 3)
    assert np.array_equal(largest, [3e-5, 0.0, 0.0])


def test_a_fresh_contact_has_no_dent():
    problem = body(points_at([(0, 0, 0)] * 3), [HystereticContact(0.5)])
    (name, largest), *rest = HystereticContact(0.5).start(problem).items()
    assert (name, rest) == ("xi_largest", []) and np.array_equal(largest, np.zeros(3))
    F = np.array([1.0])
    assert HystereticContact(0.0).normal_force(F, None, None, {}) is F


NAMES = ("1ext", "2ext", "3int", "4int", "2int")
FACTORS = np.array([0.5, 2.0, 3.0, 4.0, 2.0])


def five_points():
    """One or two points a foot."""
    return points_at([(0, 0, 0)] * 5, K_N=1e6, K_T=2e6, C_N=30.0, C_T=40.0, mu=0.25, names=NAMES)


def test_stiffness_of_a_foot_is_the_normal_springs_alone():
    points = five_points()
    block, changed = UnevenFootStiffness(0.5, 2.0, 3.0, 4.0).points("block", points)
    assert block == "block" and np.array_equal(changed.K_N, 1e6 * FACTORS)
    assert all(getattr(changed, key) is getattr(points, key) for key in ("P", "C_N", "C_T", "mu_0", "mu"))
    assert np.array_equal(changed.K_T, points.K_T)


def test_the_tangential_stiffness_of_a_foot_goes_along_by_its_share():
    """Share 1: as far; share 1/2: by the root; and in the points' precision."""
    points = replace(five_points(), K_T=np.full(5, 2e6, np.longdouble), K_N=np.full(5, 1e6, np.longdouble))
    _, whole = UnevenFootStiffness(0.5, 2.0, 3.0, 4.0, tangential_share=1.0).points("block", points)
    assert np.array_equal(whole.K_T, 2e6 * FACTORS) and np.array_equal(whole.K_N, 1e6 * FACTORS)
    _, half = UnevenFootStiffness(0.5, 2.0, 3.0, 4.0, tangential_share=0.5).points("block", points)
    assert np.array_equal(half.K_T, 2e6 * np.sqrt(FACTORS.astype(np.longdouble))) and half.K_T.dtype == np.longdouble
    assert np.array_equal(half.K_N, whole.K_N)


def test_damping_of_a_foot_is_that_of_both_dampers():
    points = five_points()
    block, changed = UnevenFootDamping(0.5, 2.0, 3.0, 4.0).points("block", points)
    assert block == "block" and np.array_equal(changed.C_N, 30.0 * FACTORS)
    assert np.array_equal(changed.C_T, 40.0 * FACTORS)
    assert all(getattr(changed, key) is getattr(points, key) for key in ("P", "K_N", "K_T", "mu_0", "mu"))


def test_the_tangential_damper_of_a_foot_stays_behind_by_its_share():
    """Share 1: all the way; share 1/2: by the root."""
    points = five_points()
    _, alone = UnevenFootDamping(0.5, 2.0, 3.0, 4.0, normal_share=1.0).points("block", points)
    assert np.array_equal(alone.C_T, points.C_T) and np.array_equal(alone.C_N, 30.0 * FACTORS)
    _, half = UnevenFootDamping(0.5, 2.0, 3.0, 4.0, normal_share=0.5).points("block", points)
    assert np.array_equal(half.C_T, 40.0 * np.sqrt(FACTORS)) and np.array_equal(half.C_N, alone.C_N)


@pytest.mark.parametrize("kind", [UnevenFootStiffness, UnevenFootDamping])
def test_an_effect_on_feet_names_itself_where_a_point_has_none(kind):
    with pytest.raises(ValueError, match=f"^effect {kind.id}: contact point 'left' belongs to no foot"):
        kind(foot1=2.0).points(None, points_at([(0, 0, 0)], names=("left",)))
