"""What the law says when it refuses: place, finding, cure and code, word for word.

The words may change from version to version, but on purpose, and here as well: a finding without its value, or a cure
without its limit, leaves the reader alone.
"""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model import energy_balance, geometry, housner, parameters, problem, release, rotation, simulate, storage
from tests import physics
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()
FOOT = physics.mass_on_a_foot()


def run(problem):
    return simulate.simulate(problem)


def two():
    return run(problem.stack([physics.mass_on_a_foot(duration=2e-5)] * 2))


def body(**changes):
    return replace(FOOT, block=replace(FOOT.block, **changes))


def start(**changes):
    return replace(FOOT, start=replace(FOOT.start, **changes))


def feet(**properties):
    return replace(FOOT, points=physics.points([0, 0, 0], **properties))


class Motor(physics.Pull):
    """A moment of 3e9 N m about X, from rate to rate."""

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        return np.zeros_like(x), np.array([3e9, 0.0, 0.0])


def bar(end=0.0):
    """A body on three feet in a row, the last of which may be nowhere."""
    points = physics.points([[0, 0, 0], [0.1, 0, 0], [end, 0.2, 0]])
    return replace(FOOT, points=points, start=problem.State.at_rest(np.zeros(3), np.eye(3), 3))


def spun_up(origin):
    """A body of 1 kg m2 that turns by 2.4 rad a step of 1e-5 s, and by 0.3 rad more after each."""
    free = physics.flying((1, 1, 1), (2.4e5, 0, 0), 1e-5, 1e-3)
    return replace(free, start=replace(free.start, t=origin, origin=origin), effects=(Motor(),))


def cuboid(**changes):
    sizes = dict(mass=54.0, width=0.1, depth=0.1, height=0.688, delta_long=(0, 0, 0, 0), delta_diag=0.006)
    geometry.check_cuboid(**{**sizes, **changes})


def plausible(**changes):
    sizes = dict(width=0.1, depth=0.1, height=0.688, delta_long=(0, 0, 0, 0), foot_radius=0.0)
    geometry.check_plausible(**{**sizes, **changes})


def released(theta_0, points=None):
    points = MODEL.body()[1] if points is None else points
    release.release_posture(physics.block(), points, theta_0)


NO_NUMBER = "Give one real number. [E-TYPE]"
ONE_BLOCK = "was asked of a batch. Index the response first: response[i]. [E-BATCH]"
ONE_BY_ONE = "differs between the problems of a batch. Run them one by one. [E-STACK]"
MATRIX = "Give a symmetric, positive definite 3 x 3 matrix in kg m2. [E-RANGE]"
REAL = "Use float32, float64 or longdouble. [E-TYPE]"
FINITE = "Give a positive, finite number. [E-RANGE]"
BODY = "Give a finite number, not negative; a mass is positive. [E-RANGE]"
FEET = "Stiffness must be positive; damping, friction and radius must not be negative. [E-RANGE]"
TILT = "Give a release tilt in radians between 0 and the tipping angle. [E-TILT]"
PIVOT = "A release needs a pivot point on either side; give a start state instead. [E-RELEASE]"

REFUSALS = [
    # numbers
    (lambda: geometry.check_number("mu", "x"), f"mu: is 'x'. {NO_NUMBER}"),
    (lambda: geometry.check_number("mu", 300 * "x"), f"mu: is '{116 * 'x'}. {NO_NUMBER}"),
    (lambda: geometry.check_number("mu", -0.5), "mu: is -0.5. Give a finite number, not below 0. [E-RANGE]"),
    (
        lambda: geometry.check_number("K_N", 0.0, more_than_least=True),
        "K_N: is 0.0. Give a finite number, above 0. [E-RANGE]",
    ),
    (lambda: geometry.check_number("g", 2e30), "g: is 2e+30. No block has such a number: check its unit. [E-RANGE]"),
    # the block
    (lambda: geometry.check_inertia(np.zeros((1, 1))), f"inertia: is [[0.0]]. {MATRIX}"),
    (
        lambda: geometry.check_inertia(np.full((5, 3, 3), 0.25)),
        # the first two hundred characters of what was given
        f"inertia: is {str(np.full((5, 3, 3), 0.25).tolist())[:197]}. {MATRIX}",
    ),
    (lambda: cuboid(mass=0), "mass: is 0. Give a finite number, above 0. [E-RANGE]"),
    (lambda: cuboid(delta_diag=-1.0), "delta_diag: is -1.0. Give a finite number, not below 0. [E-RANGE]"),
    (lambda: cuboid(delta_long=(0, 0)), "delta_long: has 2 values. Give four heights in metres. [E-SHAPE]"),
    (lambda: cuboid(delta_long=(0, "a", 0, 0)), f"delta_long[1]: is 'a'. {NO_NUMBER}"),
    (
        lambda: cuboid(delta_long=(0, 0, 0, -0.688)),
        "delta_long[3]: is -0.688 m, larger than the block. Give heights in metres. [E-RANGE]",
    ),
    (
        lambda: cuboid(width=0.6, depth=0.8, delta_diag=0.5),
        "delta_diag: is 0.5 m; half the diagonal of the base is 0.5 m. "
        "Give a distance from the corner in metres, between 0 and half the diagonal. [E-RANGE]",
    ),
    (
        lambda: plausible(height=688.0),
        "height: is 688.0 m, and no block rocks that is so large or small. "
        "Give metres, between 0.001 and 100. [E-RANGE]",
    ),
    (
        lambda: plausible(width=9e-4),
        "width: is 0.0009 m, and no block rocks that is so large or small. "
        "Give metres, between 0.001 and 100. [E-RANGE]",
    ),
    (
        lambda: plausible(depth=100.1),
        "depth: is 100.1 m, and no block rocks that is so large or small. "
        "Give metres, between 0.001 and 100. [E-RANGE]",
    ),
    (
        lambda: plausible(depth=0.2, delta_long=(0, 0, -0.06, 0)),
        "delta_long[2]: is -0.06 m, more than half the width of the base, 0.05 m. "
        "Give metres: a foot is a small part of the block. [E-RANGE]",
    ),
    (
        lambda: plausible(width=0.2, foot_radius=0.06),
        "foot_radius: is 0.06 m, more than half the width of the base, 0.05 m. "
        "Give metres: a foot is a small part of the block. [E-RANGE]",
    ),
    # parameters
    (
        lambda: parameters.check_friction("mu_int", [0.3, 30.0]),
        "mu_int: is 30.0, and no dry contact has more than 10. "
        "Give a friction coefficient, not per cent or degrees. [E-RANGE]",
    ),
    (
        lambda: parameters.Parameters().replace(k_n=1.0),
        "k_n: is no parameter. Known: K_N, K_T, beta_int, beta_ext, mu_int, mu_ext, delta_long, delta_diag, theta_0. "
        "[E-KEY]",
    ),
    (
        lambda: parameters.from_chromosome_12(np.ones((2, 13))),
        "chromosome: has shape (2, 13). Give 12 genes. [E-SHAPE]",
    ),
    (lambda: parameters.split_54([1.0]), "chromosome: has shape (1,). Give 54 genes. [E-SHAPE]"),
    # batches
    (lambda: problem.stack([FOOT, FOOT.replace(step=2e-5)]), f"step: {ONE_BY_ONE}"),
    (lambda: problem.stack([FOOT, FOOT.replace(effects=(physics.Pull(),))]), f"effects: {ONE_BY_ONE}"),
    (
        lambda: problem.stack([FOOT, feet(radius=1e-3)]),
        "radius: is given for some of the problems only. Give it for all of them. [E-STACK]",
    ),
    (lambda: run(FOOT)[0], "response: is of one block. Only a batch can be indexed. [E-BATCH]"),
    (lambda: two().main_impacts(), f"main_impacts: {ONE_BLOCK}"),
    (lambda: two().contacts(), f"contacts: {ONE_BLOCK}"),
    (lambda: two().to_frame(), f"to_frame: {ONE_BLOCK}"),
    (lambda: two().columns(), f"columns: {ONE_BLOCK}"),
    (lambda: energy_balance.balance(two()), f"balance: {ONE_BLOCK}"),
    (
        lambda: energy_balance.balance(run(FOOT.replace(output_rate=2000.0))),
        "output_rate: 2000 Hz skips steps. Record 100000 rows a second. [E-RATE]",
    ),
    # release
    (
        lambda: housner.housner(54.0, 0.1, 0.688, 2.175, 9.81, 0.2, 1.0, 100.0),
        "theta_0: is 0.2 rad. Give a tilt between 0 and 0.1443 rad. [E-TILT]",
    ),
    (
        # between the tipping angle and that of a block twice as wide
        lambda: release.check_tilt(physics.block(), MODEL.body()[1], 0.2),
        f"theta_0: is 0.2 rad; the block tips over at 0.1443 rad. {TILT}",
    ),
    (lambda: released(0.25), f"theta_0: is 0.25 rad; the block tips over at 0.1443 rad. {TILT}"),
    (
        lambda: released(0.1, physics.points([[0.05, 0.05, -0.344]])),
        f"contact points: there is no point with x < 0. {PIVOT}",
    ),
    (
        # a point on the axis is on neither side
        lambda: released(0.1, physics.points([[0.05, 0.05, -0.344], [0, 0.05, -0.344]])),
        f"contact points: there is no point with x < 0. {PIVOT}",
    ),
    (
        lambda: released(0.1, physics.points([[0, 0.05, -0.344], [-0.05, 0.05, -0.344]])),
        f"contact points: there is no point with x > 0. {PIVOT}",
    ),
    (
        lambda: released(0.1, physics.points([[-0.05, 0.05, -0.344]])),
        f"contact points: there is no point with x > 0. {PIVOT}",
    ),
    (
        # a stool that leans on its front foot, between its two others
        lambda: released(0.1, physics.points([[0.05, -0.05, -0.344], [0, 0.05, -0.344], [-0.05, -0.05, -0.344]])),
        "contact points: point 1 would start 9.99 mm inside the plate. "
        "A release leans on one point with x > 0 and one with x < 0; give a start state instead. [E-RELEASE]",
    ),
    # the step
    (
        lambda: rotation.exp_minus_identity(np.array([0.0, 3.0, 4.0])),
        "Theta: a step turns the block by 5 rad. Use a smaller step or a smaller angular velocity. [E-ANGLE]",
    ),
    (
        # 2.55 rad in the first step, 0.3 rad more in each: beyond 3.2 rad in the fourth
        lambda: run(spun_up(origin=0.5)),
        "step 4 (t = 0.50004 s): a step turns the block by 3.45 rad. "
        "Use a smaller step or a smaller angular velocity. [E-ANGLE]",
    ),
    (
        lambda: simulate.check_names(replace(physics.points([[0, 0, 0]] * 4), names=("a", "b", "c", "b"))),
        "names: 'b' is there twice. Give every point a name of its own. [E-KEY]",
    ),
    # what cannot be simulated
    (lambda: run(FOOT.replace(step=-1.0)), f"step: is -1.0. {FINITE}"),
    (lambda: run(FOOT.replace(duration="1")), f"duration: is '1'. {NO_NUMBER}"),
    (lambda: run(FOOT.replace(duration=300 * "x")), f"duration: is '{116 * 'x'}. {NO_NUMBER}"),
    (lambda: run(FOOT.replace(step=True)), f"step: is True. {NO_NUMBER}"),
    (
        lambda: simulate.check(FOOT.replace(duration=2e5)),
        "duration: 200000 s in steps of 1e-05 s are 2e+10 steps, more than 1e+10. "
        "Ask for a shorter run, or check the unit of duration and step: both are in seconds. [E-SIZE]",
    ),
    (
        # 18 numbers of the body and five of the foot, with two flags, are 186 bytes a row
        lambda: simulate.check(FOOT.replace(duration=5e4, output_rate=1e3)),
        "output_rate: 5e+07 rows would take 9.3 GB, more than 4. "
        "Ask for fewer rows a second, or a shorter run. [E-SIZE]",
    ),
    (
        lambda: simulate.check(problem.stack([FOOT.replace(duration=1e4, output_rate=1e3)] * 3)),
        "output_rate: 1e+07 rows a block would take 5.6 GB, more than 4. "
        "Ask for fewer rows a second, or a shorter run. [E-SIZE]",
    ),
    (lambda: simulate.simulate(FOOT, dtype=np.int32), f"dtype: is int32. {REAL}"),
    (lambda: simulate.simulate(FOOT, dtype=np.float16), f"dtype: is float16. {REAL}"),
    (lambda: simulate.simulate(FOOT, dtype="number"), f"dtype: is number. {REAL}"),
    (lambda: run(start(x=np.array([0, 0, 1]))), f"dtype: is int64. {REAL}"),
    (lambda: run(FOOT.replace(output_rate=np.inf)), f"output_rate: is inf. {FINITE}"),
    (
        lambda: run(FOOT.replace(duration=5e-6)),
        "duration: 5e-06 s is shorter than one step. Ask for a longer run. [E-DURATION]",
    ),
    (
        lambda: run(FOOT.replace(output_rate=2e5)),
        "output_rate: 200000 Hz asks for more than one row a step of 1e-05 s. "
        "Use at most 100000 Hz or a smaller step. [E-RATE]",
    ),
    (
        # an undamped spring of 6e7 N/m under 66 kg: (w h)^2 / 4 = 1 at h = 2.098 ms
        lambda: run(physics.mass_on_a_foot(mass=66.0, K_N=6e7, K_T=6e7, C_N=0, C_T=0, step=3e-3)),
        "step: 0.003 s is too large for the stiffest contact, 0 with K_N = 6e+07 N/m and C_N = 0 N s/m. "
        "Use a step of at most 0.002 s. [E-STEP]",
    ),
    (
        # h = 1 / d, d = C_T (1/60 + 0.1^2 / 0.09), of the second foot, damped more than stiff, under the lighter block
        lambda: run(
            problem.stack(
                [
                    replace(
                        physics.mass_on_a_foot(mass=m, step=3e-3),
                        points=physics.points([0, 0, 0, 0.1, 0, 0], C_T=np.array([1e4, 3e6])),
                        start=problem.State.at_rest(np.zeros(3), np.eye(3), 2),
                    )
                    for m in (66.0, 60.0)
                ]
            )
        ),
        "step: 0.003 s is too large for the stiffest contact, 1 with K_T = 5e+07 N/m and C_T = 3e+06 N s/m. "
        "Use a step of at most 2.6e-06 s. [E-STEP]",
    ),
    (lambda: run(body(mass=np.array(0.0))), f"mass: is 0.0. {BODY}"),
    (lambda: run(body(g=np.array(-1.0))), f"g: is -1.0. {BODY}"),
    (
        lambda: run(start(v=np.array([0, np.nan, 0]))),
        "start.v: is not finite everywhere. Give finite numbers. [E-START]",
    ),
    (
        lambda: run(start(Lambda=2 * np.eye(3))),
        "start.Lambda: is no rotation. Give a matrix with orthonormal columns, or use from_quaternion. [E-START]",
    ),
    (lambda: run(feet(C_T=-1.0)), f"C_T of point 0: is -1.0. {FEET}"),
    (
        lambda: run(replace(FOOT, points=physics.points([0, np.nan, 0]))),
        "P of point 0: is not finite. Give a place in metres. [E-RANGE]",
    ),
    (
        lambda: run(problem.stack([bar(), bar(np.nan)])),
        "P of point 2: is not finite. Give a place in metres. [E-RANGE]",
    ),
    (lambda: run(feet(K_N=0.0)), f"K_N of point 0: is 0.0. {FEET}"),
    (lambda: run(feet(K_T=0.0)), f"K_T of point 0: is 0.0. {FEET}"),
    (
        lambda: run(feet(mu_0=0.2, mu=0.3)),
        "mu_0: is below mu. Static friction is at least as large as dynamic friction. [E-RANGE]",
    ),
    # files
    (
        lambda: storage.write_text("/nowhere/a.txt", ""),
        "/nowhere/a.txt: cannot be written (No such file or directory). Check the folder and its space. [E-WRITE]",
    ),
]


@pytest.mark.parametrize("call, text", REFUSALS, ids=[text[:40] for _, text in REFUSALS])
def test_a_refusal_says_what_was_found_and_what_to_do(call, text):
    error = refused(call)
    assert str(error) == text


def test_the_limits_themselves_are_allowed():
    plausible(width=1e-3, depth=1e-3, height=100.0)
    plausible(delta_long=(0.05, 0, 0, 0), foot_radius=0.05)
    parameters.check_friction("mu_int", 10.0)
