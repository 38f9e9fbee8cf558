"""Effects on shape and mass, each against another way to the same body."""

import numpy as np
import pytest

from rockref import Model
from rockref.effects.shape.dimension_deviation import DimensionDeviation
from rockref.effects.shape.foot_defects import FootDefects
from rockref.effects.shape.inertia_deviation import InertiaDeviation
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.effects.shape.rounded_feet import RoundedFeet
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.engines import run
from rockref.model.contact import point_kinematics
from rockref.model.release import tipping_angle
from tests.unit.effects.bodies import H, last, puck

TABLE = FootDefects(1.0e-5, 4.0e-5, 9.2e-5, 5.8e-5, 6e-3, 0.30 / 0.25, 0.15 / 0.18)


def test_foot_defects_make_the_eight_point_model():
    block, points = Model.four_points().replace(effects=(TABLE,)).body()
    block_8, points_8 = Model.table_3_1().body()
    assert points.names == points_8.names
    assert np.array_equal(points.P, points_8.P)
    for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"):
        # A ratio instead of the number itself: one rounding.
        assert getattr(points, key) == pytest.approx(getattr(points_8, key), rel=4e-16)
    assert np.array_equal(block.inertia, block_8.inertia)


def test_feet_that_stand_elsewhere_on_the_stated_body():
    """Without a share the points move and the tensor stays; half a share is a body of half the deviation."""
    table, sides = Model.table_3_1(), {"width": 1.01, "depth": 0.98, "height": 1.02}
    _, moved = table.replace(effects=(DimensionDeviation(**sides),)).body()
    block, points = table.replace(effects=(DimensionDeviation(**sides, inertia_share=0.0),)).body()
    assert np.array_equal(points.P, moved.P)
    # A few roundings on the way through the second moments.
    assert block.inertia == pytest.approx(table.body()[0].inertia, rel=1e-14)
    half = DimensionDeviation(**{side: 1 + (s - 1) / 2 for side, s in sides.items()})
    between, _ = table.replace(effects=(DimensionDeviation(**sides, inertia_share=0.5),)).body()
    assert between.inertia == pytest.approx(table.replace(effects=(half,)).body()[0].inertia, rel=1e-14)


def test_products_of_inertia_are_those_of_the_axes_that_a_part_turns():
    """Half a kilogram at two opposite corners: its tensor by the parallel axes, against the effect's numbers."""
    r = np.array([0.05, 0.05, 0.344])
    J = np.diag(np.diag(Model.table_3_1().body()[0].inertia))
    wanted = J + 2 * 0.25 * (r @ r * np.eye(3) - np.outer(r, r))
    scale = np.diag(wanted) / np.diag(J)
    size = np.sqrt(np.diag(wanted))
    p = wanted / np.outer(size, size)
    effect = InertiaDeviation(*scale, xy=p[0, 1], xz=p[0, 2], yz=p[1, 2])
    block, _ = Model.table_3_1().replace(effects=(effect,)).body()
    assert block.inertia == pytest.approx(wanted, rel=1e-12)  # rounding of roots and products
    assert np.array_equal(block.inertia, block.inertia.T)


def arc_time(R, tilt_of_edge, tilt, inertia, weight):
    """Time from rest at `tilt` to upright of a rigid block that turns about its edge, by quadrature of its energy.

    w^2 = 2 m g R [cos(alpha - tilt) - cos(alpha - theta)]/I; with theta = tilt cos(s) the integrand is smooth.
    """
    s = (np.arange(4000) + 0.5) * (np.pi / 2) / 4000
    theta = tilt * np.cos(s)
    w = np.sqrt(2 * weight * R / inertia * (np.cos(tilt_of_edge - tilt) - np.cos(tilt_of_edge - theta)))
    return np.sum(tilt * np.sin(s) / w) * (np.pi / 2) / 4000


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("effect", [MassEccentricity(y=2e-3, z=-3e-3), InertiaDeviation(xx=1.05)])
def test_first_arc_takes_as_long_as_the_rigid_body_says(effect, turned):
    """An eccentricity toward the pivots shortens their lever and lengthens the arc; turned, it shortens the arc."""
    stiff = Model.four_points()
    stiff = stiff.replace(K_N=6e8, K_T=5e8, effects=(effect,))
    tilt = 0.08
    response = run(stiff.problem(duration=0.6, step=5e-6, turned=turned, theta_0=tilt), engine="auto")
    block, points = stiff.body()
    lever = np.abs(points.P[2 if turned else 0, 1])
    height = -points.P[0, 2]
    R2 = lever**2 + height**2
    expected = arc_time(np.sqrt(R2), np.arctan2(lever, height), tilt, block.inertia[0, 0] + 54 * R2, 54 * 9.81)
    # The springs under the edge give by 0.4 micrometres of 50 mm, and the release begins with their swing.
    assert response.main_impacts()[0] == pytest.approx(expected, rel=2e-4)


def test_eccentricity_moves_the_tipping_angles_apart():
    block, points = Model.four_points().replace(effects=(MassEccentricity(y=1e-3),)).body()
    assert tipping_angle(block, points, 1) == pytest.approx(np.arctan(0.049 / 0.344), rel=1e-14)
    assert tipping_angle(block, points, -1) == pytest.approx(np.arctan(0.051 / 0.344), rel=1e-14)


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_tilted_normals_push_sideways(share):
    """Frictionless, all normals tilted alike: a = g (x, y), whose ever the tilts are: the block is not turned."""
    effect = UnevenContactNormals(*(0.02, -0.01) * 4, turning_share=share)
    state = last(puck([effect], K_N=1e6), 300)
    assert state.v[:2] == pytest.approx(np.array([0.02, -0.01]) * 9.81 * 300 * H, rel=1e-9)


def test_normals_belong_to_their_foot():
    one = UnevenContactNormals(x3=0.02)
    problem = puck([one], K_N=1e6, J=(1e3, 1e3, 1.0))
    state = last(problem, 100)
    # A quarter of the weight at foot 3 (-0.1, -0.1), pushed along x: a moment 0.1 * F about z.
    assert state.W[2] == pytest.approx(0.1 * 0.02 * 9.81 / 4 * 100 * H, rel=1e-6)


def rolled_arc_time(lever, height, radius, tilt, J, mass):
    """Time from rest at `tilt` to upright of a rigid block that rolls on a round edge, by quadrature of its energy.

    The centre of mass stands z = radius + (height - radius) cos(theta) + lever sin(theta) above the plate and
    dz/dtheta to the side of the contact, about which it turns: w^2 = 2 m g [z(tilt) - z]/(J + m (z'^2 + z^2)).
    """
    s = (np.arange(4000) + 0.5) * (np.pi / 2) / 4000

    def z(theta):
        return radius + (height - radius) * np.cos(theta) + lever * np.sin(theta)

    theta = tilt * np.cos(s)
    aside = lever * np.cos(theta) - (height - radius) * np.sin(theta)
    w = np.sqrt(2 * mass * 9.81 * (z(tilt) - z(theta)) / (J + mass * (aside**2 + z(theta) ** 2)))
    return np.sum(tilt * np.sin(s) / w) * (np.pi / 2) / 4000


@pytest.mark.parametrize("radius", [0.0, 2e-3, 1e-2])
def test_a_round_foot_rolls_as_the_rigid_body_says_and_keeps_the_energy(radius):
    """The first arc takes as long as the quadrature says, and nothing is lost on the way: the foot does not rub."""
    tilt = 0.08
    stiff = Model.four_points().replace(K_N=6e8, K_T=5e8, effects=(RoundedFeet(radius),))
    response = run(stiff.problem(duration=0.4, step=5e-6, theta_0=tilt), engine="auto")
    block, points = stiff.body()
    J, mass = block.inertia, 54.0
    lever, height = points.P[0, 1], -points.P[0, 2]
    expected = rolled_arc_time(lever, height, radius, tilt, J[0, 0], mass)
    first = response.main_impacts()[0]
    # The springs under the edge give by 0.4 micrometres of 50 mm, 1e-5; a radius of 2 mm makes 2.6e-3 of the time.
    assert first == pytest.approx(expected, rel=5e-5)
    before = response.t < first - 0.01
    energy = mass * np.sum(response.v**2, axis=1) / 2 + np.sum(response.W**2 * np.diag(J), axis=1) / 2
    energy += mass * 9.81 * response.x[:, 2]
    fallen = mass * 9.81 * (response.x[0, 2] - response.x[before][-1, 2])
    # What the springs hold at release and lose in their swing: m g 0.2 micrometres of 1.4 J, with the step's error.
    assert np.ptp(energy[before]) < 1e-4 * fallen


@pytest.mark.parametrize("radius", [2e-3, 1e-2])
def test_a_round_foot_rolls_outward_and_shortens_the_arc(radius):
    """The lever of the weight at release grows by rho sin(tilt), and the block comes back the sooner."""
    sharp, tilt = Model.table_3_1(), Model.table_3_1().parameters.theta_0
    round_ = sharp.replace(effects=(RoundedFeet(radius),))
    levers, impacts = [], []
    for model in (sharp, round_):
        problem = model.problem(duration=0.52)
        start, points = problem.start, problem.points
        k = point_kinematics(start.x, start.Lambda, start.v, start.W, points.P, points.radius)
        levers.append(k.r[np.argmax(k.xi), 1])
        impacts.append(run(problem, engine="auto").main_impacts()[0])
    # At release the points stand where the sharp ones do, but for rounding.
    assert levers[1] - levers[0] == pytest.approx(radius * np.sin(tilt), rel=1e-6)
    assert "lever grows" in RoundedFeet.sentence and "arcs are shorter" in RoundedFeet.sentence
    # Two millimetres bring the impact 3.9 ms earlier, ten 18.5 ms.
    assert impacts[0] - impacts[1] == pytest.approx({2e-3: 3.9e-3, 1e-2: 18.5e-3}[radius], rel=0.02)
