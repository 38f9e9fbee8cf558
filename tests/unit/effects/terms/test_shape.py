"""What each effect on the body and the plate under it changes, by hand: points, inertia and forces, no motion."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.contact.hunt_crossley_contact import HuntCrossleyContact
from rockref.effects.shape.dimension_deviation import DimensionDeviation
from rockref.effects.shape.foot_defects import FootDefects
from rockref.effects.shape.inertia_deviation import InertiaDeviation
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.rounded_corners import RoundedCorners
from rockref.effects.shape.rounded_feet import RoundedFeet
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.effects.support.compliant_support import CompliantSupport, moment_at_rest
from rockref.model.geometry import EXTERNAL, INTERNAL, cuboid_inertia
from rockref.model.problem import Block, stack
from rockref.model.rotation import exponential
from tests.unit.effects.bodies import body, contact, points_at

#: Rounding of a few products and roots.
ROUNDED = 1e-14
#: Corners of a base of 6 m by 8 m, whose half diagonal is 5 m, 2 m below the centre of mass.
CORNERS = [(3.0, 4.0, -2.0), (-3.0, 4.0, -2.0), (-3.0, -4.0, -2.0), (3.0, -4.0, -2.0)]
MAKE = {"K_N": 1e6, "K_T": 2e6, "C_N": 30.0, "C_T": 40.0, "mu": 0.25, "names": EXTERNAL}
#: A tensor of no symmetry axis.
J = np.array([[2.0, 0.1, -0.2], [0.1, 2.2, 0.05], [-0.2, 0.05, 0.4]])


def base(**changes):
    """The four corners, all of the same make."""
    return points_at(CORNERS, **{**MAKE, **changes})


def two_runs(points):
    """The same points for two runs side by side, the second of twice the size, stiffness, and so on."""
    keys = ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")
    return replace(points, **{key: np.stack([getattr(points, key), 2 * getattr(points, key)]) for key in keys})


def test_a_corner_rises_and_its_neighbour_stands_further_in_on_the_diagonal():
    """1 m of 5 m along the diagonal leaves four fifths of (3, 4); the height of the inner point stays."""
    _, points = FootDefects(0.1, 0.2, 0.3, 0.4, 1.0).points(None, base())
    outer = [(x, y, z + rise) for (x, y, z), rise in zip(CORNERS, (0.1, 0.2, 0.3, 0.4), strict=True)]
    inner = [(0.8 * x, 0.8 * y, z) for x, y, z in CORNERS]
    assert points.P == pytest.approx(np.array(outer + inner), rel=ROUNDED)
    assert points.names == EXTERNAL + INTERNAL and points.radius is None


@pytest.mark.parametrize("common", [1.0, 3.0])
def test_of_the_factors_of_distances_only_the_ratios_count(common):
    """Of 1 m of 5 m, and half, twice, twice and half of it."""
    diag = {f"diag{i}": factor * common for i, factor in enumerate((0.5, 2.0, 2.0, 0.5), 1)}
    effect = FootDefects(delta_diag=1.0, **diag)
    _, points = effect.points(None, base())
    inner = [(s * x, s * y, z) for (x, y, z), s in zip(CORNERS, (0.9, 0.6, 0.6, 0.9), strict=True)]
    assert points.P == pytest.approx(np.array(CORNERS + inner), rel=ROUNDED)
    assert FootDefects(**diag).is_absent() and not effect.is_absent()


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_inner_points_all_at_one_distance_stand_there_to_the_last_bit(dtype):
    """1 - d/D of their corners, whatever the numbers are written in."""
    sizes = np.random.default_rng(5).uniform(0.5, 2.0, (30, 4, 3))
    given = replace(base(), P=(CORNERS * sizes).astype(dtype))
    _, points = FootDefects(delta_diag=0.3).points(
        None, replace(given, **{k: np.ones((30, 4)) for k in PROPERTIES[1:]})
    )
    x, y = given.P[..., 0], given.P[..., 1]
    wanted = given.P[..., :2] * (1 - 0.3 / np.sqrt(x * x + y * y))[..., None]
    assert points.P.dtype == dtype and np.array_equal(points.P[:, 4:, :2], wanted)


def test_an_inner_point_has_its_corners_properties_times_the_ratios():
    block, points = FootDefects(mu_int=1.5, beta_int=0.5).points("block", base(radius=0.02))
    assert block == "block"
    for key, outside, inside in (
        ("K_N", 1e6, 1e6), ("K_T", 2e6, 2e6), ("C_N", 30.0, 15.0), ("C_T", 40.0, 20.0),
        ("mu_0", 0.25, 0.375), ("mu", 0.25, 0.375), ("radius", 0.02, 0.02),
    ):  # fmt: skip
        assert np.array_equal(getattr(points, key), [outside] * 4 + [inside] * 4), key


def test_defects_of_two_runs_side_by_side_are_those_of_each():
    effect = FootDefects(0.1, 0.2, 0.3, 0.4, 1.0, 1.5, 0.5)
    _, both = effect.points(None, two_runs(base()))
    for i in range(2):
        alone = replace(two_runs(base()), **{key: getattr(two_runs(base()), key)[i] for key in PROPERTIES})
        _, single = effect.points(None, alone)
        assert all(np.array_equal(getattr(both, key)[i], getattr(single, key)) for key in PROPERTIES)


PROPERTIES = ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")


def refusal(effect, points):
    """The error that an effect on the points raises."""
    with pytest.raises(ValueError) as found:
        effect.points(None, points)
    return found.value


def test_defects_refuse_other_points_and_neighbours_beyond_the_middle():
    error = refusal(FootDefects(0.1), base(names=("1ext", "2ext", "3ext", "5ext")))
    assert (error.code, error.where) == ("E-FEET", "effect foot_defects")
    assert error.what == "finds the contact points 1ext, 2ext, 3ext, 5ext"
    assert error.cure == 'It makes eight points of four: use a model with points = "four_points".'
    error = refusal(FootDefects(delta_diag=5.0), base())
    assert (error.code, error.where) == ("E-RANGE", "effect foot_defects delta_diag")
    assert (error.what, error.cure) == ("is 5.0 m, half the base", "Give a distance from the corner in metres.")
    # One inner point of four, at twice the mean and more, is enough.
    error = refusal(FootDefects(delta_diag=2.0, diag1=0.5, diag2=4.0, diag3=1.0, diag4=0.5), base())
    assert (error.code, error.what) == ("E-RANGE", "is 8.0 m, half the base")


def test_a_cuboid_of_other_sides_has_the_inertia_of_its_sides():
    """By the cuboid formula, alone and in two runs side by side; the points stand at the new sides."""
    sides, factors = np.array([0.6, 0.8, 0.4]), np.array([1.1, 0.9, 1.3])
    inertia = np.stack([cuboid_inertia(3.0, *sides), cuboid_inertia(5.0, *(2 * sides))])
    wanted = [cuboid_inertia(3.0, *(sides * factors)), cuboid_inertia(5.0, *(2 * sides * factors))]
    effect = DimensionDeviation(*factors)
    block, points = effect.points(Block(np.array(3.0), inertia[0], np.array(9.81)), base())
    assert block.inertia == pytest.approx(wanted[0], rel=ROUNDED) and block.mass == 3.0
    assert points.P == pytest.approx(np.array(CORNERS) * factors, rel=ROUNDED)
    both, _ = effect.points(Block(np.array([3.0, 5.0]), inertia, np.full(2, 9.81)), two_runs(base()))
    assert both.inertia == pytest.approx(np.stack(wanted), rel=ROUNDED)


def test_products_of_inertia_scale_with_both_their_sides():
    """The second moments int x_i x_j dm do, of which J_ij is the negative; the share is that of each deviation."""
    block = Block(np.array(3.0), J, np.array(9.81))
    scaled, points = DimensionDeviation(1.2, 0.8, 1.4, 0.5).points(block, base())
    own = np.array([1.1, 0.9, 1.2])
    pairs = [(0, 1), (0, 2), (1, 2)]
    assert [scaled.inertia[i, j] for i, j in pairs] == pytest.approx([J[i, j] * own[i] * own[j] for i, j in pairs])
    assert points.P == pytest.approx(np.array(CORNERS) * (1.2, 0.8, 1.4), rel=ROUNDED)


@pytest.mark.parametrize("name, i, j", [("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)])
def test_each_product_of_inertia_is_added_over_the_mean_of_its_two(name, i, j):
    """p sqrt(J_ii J_jj), in two places of the tensor."""
    changed, points = InertiaDeviation(**{name: 0.3}).points(Block(np.array(3.0), J, np.array(9.81)), FEET)
    wanted = J.copy()
    wanted[i, j] = wanted[j, i] = J[i, j] + 0.3 * np.sqrt(J[i, i] * J[j, j])
    assert changed.inertia == pytest.approx(wanted, rel=ROUNDED) and points is FEET


FEET = points_at(CORNERS)


def test_principal_inertias_are_scaled_and_products_by_their_mean():
    """sqrt(s_i s_j), of 4, 9 and 16: 6, 8 and 12; a further product comes first."""
    block = Block(np.array(3.0), J, np.array(9.81))
    factors = np.array([[4.0, 6.0, 8.0], [6.0, 9.0, 12.0], [8.0, 12.0, 16.0]])
    changed, _ = InertiaDeviation(4.0, 9.0, 16.0).points(block, FEET)
    assert changed.inertia == pytest.approx(J * factors, rel=ROUNDED) and changed.mass is block.mass
    with_product, _ = InertiaDeviation(4.0, 9.0, 16.0, yz=0.3).points(block, FEET)
    alone, _ = InertiaDeviation(yz=0.3).points(block, FEET)
    assert with_product.inertia == pytest.approx(alone.inertia * factors, rel=ROUNDED)


def test_a_centre_that_is_moved_sees_all_points_on_the_other_side():
    block, points = MassEccentricity(0.1, -0.2, 0.3).points("block", base())
    assert block == "block" and points.P == pytest.approx(np.array(CORNERS) - (0.1, -0.2, 0.3), rel=ROUNDED)
    assert points.names == EXTERNAL and points.K_N[0] == 1e6


def test_a_round_foot_has_its_radius_and_stands_where_it_did():
    block, points = RoundedFeet(0.02).points("block", base(radius=0.5))
    assert block == "block" and np.array_equal(points.radius, [0.02] * 4) and np.array_equal(points.P, CORNERS)


@pytest.mark.parametrize("common", [1.0, 3.0])
def test_of_the_factors_of_round_feet_only_the_ratios_count(common):
    """Feet are told by their points' names; the geometric mean stays, and runs side by side have a row each."""
    feet = {"foot1": common, "foot2": 4 * common, "foot3": 2 * common, "foot4": 2 * common}
    effect = RoundedFeet(0.02, **feet)
    block, points = effect.points("block", two_runs(base(names=("3int", "1ext", "2ext", "4int"))))
    assert block == "block" and points.radius.shape == points.K_N.shape == (2, 4)
    assert points.radius == pytest.approx(np.array([[0.02, 0.01, 0.04, 0.02]] * 2), rel=ROUNDED)
    assert not effect.is_absent() and replace(effect, radius=0.0).is_absent()


def test_round_feet_that_differ_name_themselves_where_a_point_has_no_foot():
    odd = base(names=("left", "2ext", "3ext", "4ext"))
    assert np.array_equal(RoundedFeet(0.02).points("block", odd)[1].radius, [0.02] * 4)
    with pytest.raises(ValueError, match="^effect rounded_feet: contact point 'left' belongs to no foot"):
        RoundedFeet(0.02, foot3=2.0).points("block", odd)


def test_a_round_corner_is_a_sphere_that_touches_its_three_faces():
    """The engines put the centre a radius above the point, in body axes: it is a radius inside each face."""
    corners = [(3.0, 4.0, -2.0), (-3.0, 4.0, 2.0), (-3.0, -4.0, -2.0), (3.0, -4.0, 2.0)]
    block, points = RoundedCorners(0.25).points("block", points_at(corners))
    centres = points.P + [0, 0, 0.25]
    assert np.array_equal(np.abs(centres), [[2.75, 3.75, 1.75]] * 4)
    assert np.array_equal(np.sign(centres), np.sign(corners))
    assert block == "block" and np.array_equal(points.radius, [0.25] * 4)


def test_a_point_in_a_middle_plane_stays_in_it():
    """P - rho sign(P): there is no side to move away from."""
    _, points = RoundedCorners(0.25).points(None, points_at([(0.0, 4.0, -2.0), (3.0, 0.0, 2.0)]))
    assert np.array_equal(points.P + [0, 0, 0.25], [(0.0, 3.75, -1.75), (2.75, 0.0, 1.75)])


@pytest.mark.parametrize(
    "kind", [FootDefects, DimensionDeviation, InertiaDeviation, MassEccentricity, RoundedFeet, RoundedCorners]
)
def test_an_absent_shape_is_the_body_itself(kind):
    given = ("block", "points")
    block, points = kind().points(*given)
    assert block is given[0] and points is given[1]


UPRIGHT = np.eye(3)


def push(effect, problem, c, Lambda=UPRIGHT):
    """Force and moment of an effect on a body with this rotation."""
    return effect.body_wrench(problem, c, np.zeros(3), Lambda, np.zeros(3), np.zeros(3), {})


def test_a_tilted_normal_pushes_sideways_where_its_foot_stands():
    """F_N (x_i, y_i, 0) at each point of foot i, with its moment."""
    names = ("1ext", "3ext", "3int", "2ext", "4ext")
    effect = UnevenContactNormals(0.1, -0.2, 0.3, 0.4, -0.5, 0.25, 0.125, -0.375)
    r = np.array([(1, 0, -2), (0, 3, -2), (-1, 2, -2), (4, 5, -2), (-3, 1, -2)], float)
    F_N = np.array([10.0, 20.0, 30.0, 40.0, 50.0])
    problem = body(points_at([(0, 0, 0)] * 5, names=names))
    force, moment = push(effect, problem, contact([0.0] * 5, r=r, F_N=F_N))
    tilts = np.array([(0.1, -0.2, 0), (-0.5, 0.25, 0), (-0.5, 0.25, 0), (0.3, 0.4, 0), (0.125, -0.375, 0)])
    F = F_N[:, None] * tilts
    assert force == pytest.approx(F.sum(axis=0), rel=ROUNDED, abs=1e-14)
    assert moment == pytest.approx(np.cross(r, F).sum(axis=0), rel=ROUNDED)
    assert push(UnevenContactNormals(), problem, contact([0.0])) is None


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
def test_tilts_turn_with_the_block_by_their_share(share):
    """A quarter turn about the vertical takes x to y and y to -x; a lean shortens what it leans along."""
    effect = UnevenContactNormals(x1=0.1, y1=-0.2, turning_share=share)
    problem = body(points_at([(0, 0, 0)], names=("1ext",)))
    here = contact([0.0], r=np.array([[0.0, 0.0, -2.0]]), F_N=np.array([10.0]))
    force, _ = push(effect, problem, here, np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]]))
    assert force == pytest.approx(10 * np.array([0.1 + share * 0.1, -0.2 + share * 0.3, 0]), rel=ROUNDED)
    lean = exponential(np.array([0.0, 0.5, 0.0]))
    force, _ = push(effect, problem, here, lean)
    assert force == pytest.approx(10 * np.array([0.1 - share * 0.1 * (1 - np.cos(0.5)), -0.2, 0]), rel=ROUNDED)


@pytest.mark.parametrize("tilt", ["x2", "y2"])
def test_tilted_normals_name_themselves_where_a_point_has_no_foot(tilt):
    problem = body(points_at([(0, 0, 0)], names=("left",)))
    with pytest.raises(ValueError, match="^effect uneven_contact_normals: contact point 'left' belongs to no foot"):
        push(UnevenContactNormals(**{tilt: 0.1}), problem, contact([0.0]))


PLATE = CompliantSupport(5.0, 2.0, 0.1)


def plate_after(effects, q, q_rate, h=1e-3):
    """Position and speed of the plate after one step: a body of 3 kg, 12 N on one point, 7 N on another."""
    problem = body(points_at([(0, 0, 0)] * 2), effects, mass=3.0, g=10.0)
    m = {"q": np.array(q), "q_rate": np.array(q_rate)}
    PLATE.advance(problem, contact([1e-6, 1e-6], F_N=[12.0, 7.0]), h, m)
    assert set(m) == {"q", "q_rate"}
    return m["q"], m["q_rate"]


@pytest.mark.parametrize("pull", [0.0, 2.0])
def test_the_plate_is_a_damped_mass_on_a_spring_under_what_it_carries(pull):
    """M q'' = m g - sum F - k q - c q', k = (2 pi f)^2 M, c = 2 ratio 2 pi f M; first the speed, then the place."""
    effects = [HuntCrossleyContact(1.0), Adhesion(pull, 1e-5), PLATE]
    q, q_rate, h, omega = 0.01, -0.2, 1e-3, 2 * np.pi * 2.0
    # What is held down by adhesion lifts the plate by as much, at each of the two points.
    load = 30.0 - (19.0 - 2 * pull)
    acceleration = load / 5.0 - omega**2 * q - 2 * 0.1 * omega * q_rate
    place, speed = plate_after(effects, q, q_rate, h)
    assert speed == pytest.approx(q_rate + h * acceleration, rel=ROUNDED)
    assert place == pytest.approx(q + h * (q_rate + h * acceleration), rel=ROUNDED)


def test_the_plate_moves_up_and_down_alone():
    m = {"q": np.array([0.01, 0.02]), "q_rate": np.array([-0.2, 0.3])}
    place, speed = PLATE.plate_motion(0.0, m)
    assert np.array_equal(place, [(0, 0, 0.01), (0, 0, 0.02)]) and np.array_equal(speed, [(0, 0, -0.2), (0, 0, 0.3)])
    start = PLATE.start(body(points_at([(0, 0, 0)])))
    assert start == {"q": 0.0, "q_rate": 0.0} and all(np.shape(a) == () for a in start.values())


PITCHING = CompliantSupport(5.0, 2.0, 0.1, 0.25)


@pytest.mark.parametrize("pull", [0.0, 2.0])
def test_the_plate_pitches_by_the_moment_of_what_it_carries(pull):
    """J phi'' = moment at rest - sum F y - k phi - c phi' with J = M 0.6^2/12 and twice the frequency, for 1/4."""
    effects = [Adhesion(pull, 1e-5), PITCHING]
    problem = body(points_at([(0, 0, 0)] * 2), effects, mass=3.0, g=10.0)
    phi, rate, h, omega, J = 1e-3, -0.02, 1e-3, 2 * np.pi * 4.0, 5.0 * 0.03
    m = {k: np.array(a) for k, a in {"q": 0.0, "q_rate": 0.0, "pitch": phi, "pitch_rate": rate, "moment": 2.5}.items()}
    c = contact([1e-6, 1e-6], r=[[0.0, 0.1, 0.0], [0.0, -0.2, 0.0]], F_N=[12.0, 7.0])
    c.k.u[:, 1] += 0.5  # the centre of mass is half a metre along y
    PITCHING.advance(problem, c, h, m)
    carried = (12.0 - pull) * 0.6 + (7.0 - pull) * 0.3
    after = rate + h * ((2.5 - carried) / J - omega**2 * phi - 2 * 0.1 * omega * rate)
    assert m["pitch_rate"] == pytest.approx(after, rel=ROUNDED)
    assert m["pitch"] == pytest.approx(phi + h * after, rel=ROUNDED)


def test_a_plate_that_pitches_is_level_under_the_weight_at_release():
    problem = body(points_at([(0, 0.3, 0.1), (0, -0.2, -0.1)]), [PITCHING], mass=3.0, g=10.0, x=(0, 0.5, 0))
    start = PITCHING.start(problem)
    # The second point is the lowest, at y = 0.5 m - 0.2 m.
    assert start == {"q": 0.0, "q_rate": 0.0, "pitch": 0.0, "pitch_rate": 0.0, "moment": pytest.approx(30.0 * 0.3)}
    motion = PITCHING.plate_motion(0.0, start | {"pitch": np.array(1e-3), "pitch_rate": np.array(2e-3)})
    assert np.array_equal(motion, [(0, 0, 0), (0, 0, 0), (1e-3, 0, 0), (2e-3, 0, 0)])


def test_the_moment_at_rest_is_that_of_the_weight_on_the_lowest_foot():
    """m g y of the point on which each run of a batch stands; a ball of 50 mm under one foot makes that the lowest."""
    plain, shallow = (Model.table_3_1().problem(duration=0.01, theta_0=angle) for angle in (0.08, 0.02))
    radius = np.zeros(plain.points.n)
    radius[1] = 0.05
    round_foot = replace(plain, points=replace(plain.points, radius=radius))

    def weight_on(problem, k, R=0.0):
        y = (problem.start.Lambda @ (problem.points.P[k] + [0, 0, R]))[1]
        return problem.block.mass * problem.block.g * y

    # Released, the block stands on its outer points 1 and 2.
    assert moment_at_rest(plain) == pytest.approx(weight_on(plain, 0), rel=ROUNDED)
    assert moment_at_rest(round_foot) == pytest.approx(weight_on(plain, 1, 0.05), rel=ROUNDED)
    alone = [moment_at_rest(plain), moment_at_rest(shallow)]
    np.testing.assert_allclose(moment_at_rest(stack([plain, shallow])), alone, rtol=ROUNDED)


@pytest.mark.parametrize("pitch, pitches", [(0.0, False), (0.01, False), (0.0101, True)])
def test_a_trifle_of_pitch_is_none(pitch, pitches):
    effect = CompliantSupport(5.0, 2.0, 0.1, pitch)
    assert (effect.pitching() is not None) == pitches
    assert ("pitch" in effect.start(body(points_at([(0, 0, 0)]), [effect]))) == pitches


def test_a_rigid_plate_does_not_move():
    rigid, m = CompliantSupport(5.0, 0.0, 0.1), {}
    assert rigid.plate_motion(0.0, m) is None and rigid.advance(None, None, 1e-3, m) is None and m == {}
