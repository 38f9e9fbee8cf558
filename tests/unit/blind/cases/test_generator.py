"""The simulator against a code that nobody here wrote, against conservation laws, and the folder that it writes."""

import numpy as np
import pytest

from rockref.blind.cases import generator
from rockref.blind.cases.blocks import RUNS
from rockref.blind.simulator import kernel, posture, recorder
from rockref.blind.simulator.release import simulate
from rockref.blind.simulator.slots import P
from rockref.blind.simulator.world import CORNERS, DEGREE, TABLE, Sensor, build, draw_parameters
from rockref.measure.experiment import load_experiment
from rockref.measure.signals.impacts import main_impacts

NOMINAL = dict(TABLE)


def test_round_feet_as_lammps_has_them():
    world = build(NOMINAL)
    world.props[:, P["radius"]] = 5e-4
    rates = simulate(world, 0.117, seconds=0.41)
    # LAMMPS 22Jul2025 (rigid body on granular walls, 1e-6 s), same block, spheres of 0.5 mm, at 0.2 and 0.4 s.
    lammps = {0.2: (0.133580060, 7.20434467e-06, -3.92911758e-05), 0.4: (0.388115383, 3.21554417e-06, -1.16127204e-04)}
    for t, expected in lammps.items():
        # Both schemes are of second order: 5e-6 s against 1e-6 s, 6e-7 seen.
        assert rates[round(t * recorder.FINE)] == pytest.approx(expected, abs=2e-6 * expected[0])


def test_main_impacts_of_point_feet_as_lammps_has_them():
    rates = simulate(build(NOMINAL), 0.117, seconds=1.40)
    times = main_impacts(np.arange(len(rates)) / recorder.FINE, rates).times
    # From LAMMPS with spheres of 1 and 0.5 mm, taken to zero. The cusp is 0.2 ms wide.
    assert times[:2] == pytest.approx([0.5104, 1.3358], abs=4e-4)


def test_release_posture_shares_the_weight():
    for turned in (False, True):
        world = build(draw_parameters(np.random.default_rng(5)))
        x, R, pivots = posture.stand(world, 0.1, turned)
        depth = -(x[2] + world.points @ R[2])
        touching = np.flatnonzero(depth > 0)
        assert sorted(touching) == sorted(pivots)
        half = 0.5 * world.mass * world["gravity"]
        # Bisection to 1e-2/2^80 m; cancellation in heights of 0.35 m leaves 1e-16 m, 1e-8 N.
        assert depth[touching] * world.props[touching, P["K_N"]] == pytest.approx(half, rel=1e-6)
        assert np.all(R @ np.array([0, 0, 1.0]) @ np.array([0, 1.0, 0]) > 0)  # leans to +y, turned or not


def test_quaternion_is_the_matrix():
    R, back = posture.matrix(2.9, 0.4, True), np.empty((3, 3))
    kernel.rotation(posture.quaternion(R), back)
    assert back == pytest.approx(R, abs=1e-15)


def flight(rotor=(0.0, 0.0, 0.0)):
    """Spatial angular momentum at the start and after 0.2 s high above the plate, spinning about all axes."""
    world = build(NOMINAL)
    for axis, h in zip("xyz", rotor, strict=True):
        world[f"rotor_{axis}"] = h
    x, v, q, w = np.array([0, 0, 5.0]), np.zeros(3), np.array([1.0, 0, 0, 0]), np.array([1.0, 2.0, 3.0])
    J, R, rates = world.J, np.eye(3), np.empty((2001, 3))
    before = J @ w + np.array(rotor)
    kernel.run(
        x, v, q, w, J, np.linalg.inv(J), world.mass, world.points, world.props, world.g, np.zeros(4), x.copy(),
        np.zeros(3), 20_000, 1e-5, 10, rates,
    )  # fmt: skip
    kernel.rotation(q, R)
    return before, R @ (J @ w + np.array(rotor)), x, 5.0 - 0.5 * world["gravity"] * 0.2**2


@pytest.mark.parametrize("rotor", [(0.0, 0.0, 0.0), (0.0, 0.7, -0.4)])
def test_angular_momentum_is_kept_in_flight(rotor):
    before, after, x, fallen = flight(rotor)
    # Second order in h w = 4e-5: 1e-9 a radian, some radians.
    assert after == pytest.approx(before, rel=0, abs=1e-7)
    assert x == pytest.approx([0, 0, fallen], abs=1e-9)


def test_a_hung_part_changes_nothing_while_it_is_held():
    # At 3 kHz on all axes the part is as good as glued: the block is the same one, in two pieces.
    from rockref.blind.cases import unlisted

    world = build(NOMINAL)
    unlisted._hang(world, 3.0, 0.2, (3000.0, 3000.0, 3000.0), 0.1)
    plain = simulate(build(NOMINAL), 0.117, seconds=0.3)
    split = simulate(world, 0.117, seconds=0.3)
    # The spring gives by g/(2 pi 3000)^2 = 28 nm, the ringing of the start is a hundredth of a resolution.
    assert split[::100] == pytest.approx(plain[::100], abs=2e-6)


def test_a_folder_is_an_experiment_and_the_same_bytes_again(tmp_path):
    options = {"runs": RUNS[2:4], "seconds": 0.75}
    truth = generator.make_case(tmp_path / "a", ["plate_tilt"], 11, name="same", **options)
    again = generator.make_case(tmp_path / "b", ["plate_tilt"], 11, name="same", **options)
    other = generator.make_case(tmp_path / "c", ["plate_tilt"], 12, name="same", **options)
    assert truth == again and truth != other
    for name in ("experiment.toml", "run03.csv.gz", "run04.csv.gz"):
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    assert (tmp_path / "a" / "run03.csv.gz").read_bytes() != (tmp_path / "c" / "run03.csv.gz").read_bytes()
    experiment = load_experiment(tmp_path / "a")
    assert experiment.baseline == "eight_points" and experiment.gyro.sample_rate == 1000
    assert [(run.use, run.release_tilt) for run in experiment.runs] == [("holdout", 0.117), ("fit", 0.098)]
    assert len(experiment.runs[0].t) == 751
    # Leans away from upright at first: the first swing is positive, and nothing moves before the release.
    assert experiment.runs[0].crv[300:480, 0].min() > 0.05
    assert np.abs(experiment.runs[0].crv[:3]).max() < 0.3 * DEGREE


def test_a_turned_block_swings_the_other_way(tmp_path):
    generator.make_case(tmp_path / "t", None, 4, runs=RUNS[5:], seconds=0.75)
    (run,) = load_experiment(tmp_path / "t").runs
    assert run.block_turned == pytest.approx(np.pi) and run.crv[300:480, 0].max() < -0.05


def test_parameters_scatter_as_they_are_meant_to():
    rng = np.random.default_rng(1)
    draws = [draw_parameters(rng) for _ in range(400)]
    spread = {k: np.std([np.log(d[k] / TABLE[k]) for d in draws]) for k in TABLE}
    # 400 draws know a standard deviation to 3.5 %; four of those.
    assert spread["K_N"] == pytest.approx(0.10, rel=0.14)
    assert spread["delta_diag"] == pytest.approx(0.05, rel=0.14)
    assert spread["theta_0"] == pytest.approx(0.004, rel=0.14)


def test_the_inner_points_stand_on_the_diagonals():
    world = build(NOMINAL)
    way = world.points[:4, :2] - world.points[4:, :2]
    assert np.hypot(*way.T) == pytest.approx(6e-3, rel=1e-12)
    assert np.all(np.sign(way) == CORNERS)
    assert world.points[:4, 2] - world.points[4:, 2] == pytest.approx([1e-5, 4e-5, 9.2e-5, 5.8e-5], rel=1e-9)


def test_a_push_is_the_rate_at_release_and_lets_the_block_leave_with_it():
    world = build(NOMINAL)
    plain = simulate(world, 0.117, seconds=0.01)
    world.kick = np.array([0.02, 0.0, 0.0])
    pushed = simulate(world, 0.117, seconds=0.01)
    assert pushed[0] == pytest.approx([0.02, 0.0, 0.0])
    # The edge stays where it is: after ten milliseconds the block still turns faster by as much. Its lean differs by
    # 0.2 mrad at most, which the weight turns into p^2 times that, 4e-3 rad/s2: a hundredth in that time, at most.
    assert pushed[-1, 0] - plain[-1, 0] == pytest.approx(0.02, rel=0.02)


def test_a_block_that_leaves_for_infinity_is_an_error():
    world = build(NOMINAL)
    world.kick = np.array([1e200, 0.0, 0.0])
    with pytest.raises(FloatingPointError, match="draw a smaller effect"):
        simulate(world, 0.117, seconds=0.01)


def test_each_run_meets_a_shaking_floor_at_a_phase_of_its_own(tmp_path):
    truth = generator.make_case(tmp_path / "s", ["base_vibration"], 3, runs=RUNS[:2], seconds=0.2)
    first, second = (run["phase"] for run in truth["runs"])
    assert first != second and "phase" not in truth["effects"][0]["parameters"]


def test_the_range_of_all_runs_is_a_share_of_the_largest_rate_of_the_first(tmp_path):
    runs = (RUNS[3], RUNS[0])
    both = ["plate_tilt", "gyro_saturation"]
    truth = generator.make_case(tmp_path / "r", both, 5, runs=runs, seconds=0.75, other_form=False)
    top = truth["effects"][1]["parameters"]["range"]
    assert "range" not in truth["effects"][0]["parameters"]
    first, second = (np.abs(run.crv).max() for run in load_experiment(tmp_path / "r").runs)
    # The second is released higher and falls faster; both are cut at one rate, to half a resolution.
    assert first == pytest.approx(top, abs=0.51 * Sensor().resolution) and second == pytest.approx(first, abs=1e-12)


def test_feet_that_the_experimenter_does_not_know_of_are_four_corners_to_him(tmp_path):
    generator.make_case(tmp_path / "f", ["foot_defects"], 6, runs=RUNS[:1], seconds=0.75)
    assert load_experiment(tmp_path / "f").baseline == "four_points"
