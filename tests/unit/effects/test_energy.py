"""What each effect takes is never negative, and what it stores comes back."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rockref.effects.catalogue import EFFECTS
from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.contact.hertzian_contact import HertzianContact
from rockref.effects.contact.hunt_crossley_contact import HuntCrossleyContact
from rockref.effects.contact.hysteretic_contact import HystereticContact
from rockref.effects.contact.orientation_dependent_damping import OrientationDependentDamping
from rockref.effects.friction.load_dependent_friction import LoadDependentFriction
from rockref.effects.friction.rolling_resistance import ARM, RollingResistance
from rockref.effects.friction.spin_friction import SpinFriction
from rockref.effects.friction.stribeck_friction import StribeckFriction
from rockref.effects.loads.base_vibration import BaseVibration
from rockref.effects.loads.cable_restraint import CableRestraint
from rockref.effects.loads.lingering_wire_pull import LingeringWirePull
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.effects.shape.uneven_contact_normals import UnevenContactNormals
from rockref.effects.support.compliant_support import CompliantSupport
from rockref.model.contact import Kinematics, point_kinematics
from rockref.model.integrator import Contact, evaluate_contact
from rockref.model.problem import Problem
from tests.unit.effects.bodies import body, points_at, puck, walk

LEVER = 2e-3
K, C, MU, LOAD = 5e7, 100.0, 0.3, 200.0


def still_contact(turn) -> Contact:
    """One point that carries LOAD, while the body turns by `turn`."""
    zero = np.zeros((1, 3))
    k = Kinematics(zero, zero, zero, np.array([1e-6]), np.zeros(1), np.zeros((1, 2)))
    F = np.array([[0.0, 0.0, LOAD]])
    yes, no = np.array([True]), np.array([False])
    return Contact(0.0, k, yes, no, np.zeros((1, 2)), np.array([LOAD]), F, turn)


def turned_through(effect, rates, h):
    """Moments (N, 3) against an upright body that is turned at these rates (N, 3)."""
    problem = body(points_at([(0, 0, 0)], K_N=K, K_T=K, C_N=C, C_T=C, mu=MU), [effect])
    m = effect.start(problem)
    moments = []
    for W in rates:
        _, moment = effect.body_wrench(problem, still_contact(W * h), np.zeros(3), np.eye(3), np.zeros(3), W, m)
        moments.append(moment)
    return np.array(moments)


@pytest.mark.parametrize(
    "effect, axis, limit, stiffness",
    [
        (SpinFriction(LEVER), 2, LEVER * MU * LOAD, K * LEVER**2),
        (RollingResistance(LEVER), 0, LEVER * LOAD, K * LEVER * ARM),
        (RollingResistance(LEVER), 1, LEVER * LOAD, K * LEVER * ARM),
    ],
)
def test_a_turn_to_and_fro_costs_the_limit_times_its_way(effect, axis, limit, stiffness):
    """Turned through 2 A in each direction, slowly: loss 4 A limit less 4 limit^2/stiffness a cycle, for the spring."""
    h, amplitude, omega = 5e-4, 0.02, 2 * math.pi
    t = np.arange(4001) * h
    rates = np.zeros((len(t), 3))
    rates[:, axis] = amplitude * omega * np.cos(omega * t)
    moments = turned_through(effect, rates, h)
    assert np.abs(moments).max() <= limit * (1 + 1e-12)
    power = np.sum(moments * rates, axis=1)
    cycle = -np.sum(power[2001:]) * h
    held = limit / stiffness
    # The damper C takes part only while the spring turns over: held/amplitude of the cycle.
    assert cycle == pytest.approx(4 * limit * (amplitude - held), rel=1e-2)


@pytest.mark.parametrize("effect", [SpinFriction(LEVER), RollingResistance(LEVER)])
def test_resistance_never_drives(effect):
    """Whatever the way: work done against it, less what its spring holds, never falls."""
    rng = np.random.default_rng(7)
    h = 1e-4
    rates = np.cumsum(rng.normal(size=(1500, 3)), axis=0) * 0.02
    # The spring of the one is known by its angle, that of the other by its moment.
    name, twice_energy = ("yaw", K * LEVER**2) if isinstance(effect, SpinFriction) else ("held", 1 / (K * LEVER * ARM))
    stiffness = K * LEVER**2 if name == "yaw" else K * LEVER * ARM
    problem = body(points_at([(0, 0, 0)], K_N=K, K_T=K, C_N=C, C_T=C, mu=MU), [effect])
    m, taken, stored_before = effect.start(problem), [], 0.0
    for W in rates:
        _, moment = effect.body_wrench(problem, still_contact(W * h), np.zeros(3), np.eye(3), np.zeros(3), W, m)
        stored = twice_energy * np.sum(m[name] ** 2) / 2
        taken.append(-np.dot(moment, W) * h - (stored - stored_before))
        stored_before = stored
    # One step's force acts over the whole step: the error is stiffness (W h)^2/2 a step.
    bound = stiffness * (np.abs(rates).max() * h) ** 2
    assert min(taken) > -bound
    assert sum(taken) > 0


@pytest.mark.parametrize("name", ["viscous_friction", "quadratic_drag", "cable_restraint"])
def test_dampers_take_power_from_every_motion(name):
    """F v + M omega <= 0 at random poses and speeds."""
    effect = EFFECTS["cable_restraint"](0.0, 1.0) if name == "cable_restraint" else EFFECTS[name].typical()
    rng = np.random.default_rng(3)
    for _ in range(50):
        v, W = rng.normal(size=3), rng.normal(size=3)
        problem = puck([effect], v=v, W=W)
        s = problem.start
        c = evaluate_contact(problem.replace(effects=()), s, s.x, s.Lambda, s.v, s.W, np.zeros(3), 0.0, ())
        m = effect.start(problem)
        load = effect.point_wrench(problem, c, m) or effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, m)
        assert np.dot(load[0], s.v) + np.dot(load[1], s.W) < 0


def drop(effects, K_N=1e6, h=5e-6, C_N=0.0, **kwargs):
    """Energy of a ball that falls onto the plate from a fifth of a millimetre [J], and its height; two bounces."""
    problem = body(points_at([(0, 0, -1e-3)], K_N=K_N, C_N=C_N), effects, x=(0, 0, 1.2e-3), h=h, **kwargs)
    return np.array([(s.v @ s.v / 2 + 9.81 * s.x[2], s.x[2]) for s in walk(problem, 3600)])


def in_the_air(rows, above=1e-3 + 2.1e-5):
    return rows[rows[:, 1] > above, 0]


@pytest.mark.parametrize("effect", [HertzianContact(1.5, 2e-5), Adhesion(20.0, 2e-5)])
def test_conservative_contacts_give_everything_back(effect):
    energies = in_the_air(drop([effect]))
    # Steps of 5e-6 s: second order in the contact's frequency, which the pull's kink brings to first at its ends.
    assert np.ptp(energies) < 5e-3 * (energies[0] - 9.81e-3)


@pytest.mark.parametrize(
    "effect, damper",
    [(HystereticContact(0.3), 0.0), (HuntCrossleyContact(2.0), 0.0), (OrientationDependentDamping(2.0), 5.0)],
)
def test_dissipative_contacts_only_take(effect, damper):
    energies = in_the_air(drop([effect], C_N=damper))
    # In the air nothing changes but by rounding; each contact takes.
    assert np.all(np.diff(energies) < 1e-12)
    assert energies[-1] - 9.81e-3 < 0.95 * (energies[0] - 9.81e-3)


@pytest.mark.parametrize("share", [0.0, 0.6])
def test_cable_spring_and_tilted_gravity_conserve(share):
    """Kinetic energy, weight along the turned gravity, and k ((1 - q) d^2/2 + q d^4/(4 d_0^2)) of the cable's end."""
    k, slope, mass, reference = 300.0, (0.02, -0.03), 1.0, 0.01
    problem = body(
        points_at([(0.1, 0.1, -0.5)]), [CableRestraint(k, 0.0, None, share, reference), PlateTilt(*slope)],
        x=(0, 0, 10), v=(0.3, 0.1, 0), W=(0.5, -0.4, 0.2), J=(0.2, 0.3, 0.1), h=1e-4,
    )  # fmt: skip
    g = 9.81 * np.array([*slope, -1 + (slope[0] ** 2 + slope[1] ** 2) / 2])
    total = []
    for s in walk(problem, 2000):
        end = s.x + s.Lambda[:, 2] * 0.5
        stretch = (end - [0, 0, 10.5])[:2]
        turning = np.dot(s.W, [0.2, 0.3, 0.1] * s.W) / 2
        square = stretch @ stretch
        cable = k * ((1 - share) * square / 2 + share * square**2 / (4 * reference**2))
        total.append(mass * s.v @ s.v / 2 + turning - mass * g @ s.x + cable)
    # Second order in the step of 1e-4 s against a swing of 0.1 s, of some joules moved.
    assert np.ptp(total) < 1e-5 * abs(total[0])


def test_a_pitching_support_keeps_its_energy():
    """Block, contact springs, plate and both of its springs, about the loaded balance: constant."""
    mass, plate, frequency, K_N = 2.0, 3.0, 40.0, 1e6
    effect = CompliantSupport(plate, frequency, 0.0, 0.5)
    problem: Problem = puck([effect], mass=mass, K_N=K_N, h=4e-6, J=(0.02, 0.03, 0.04))
    problem = problem.replace(
        start=problem.start.at_rest(problem.start.x, np.eye(3), 4, [0, 0, -5e-3], np.array([0.03, 0, 0]))
    )
    # Level under the weight on the middle, and not on the lowest of four points that are equally low.
    m = effect.start(problem) | {"moment": np.array(0.0)}
    problem = problem.replace(start=replace(problem.start, memory=(m,)))
    (_, k, _), (J, k_p, _) = effect.bouncing(), effect.pitching()
    sink, total = mass * 9.81 / k, []
    for s in walk(problem, 2000):
        q, q_rate, phi, phi_rate = (float(s.memory[0][key]) for key in ("q", "q_rate", "pitch", "pitch_rate"))
        u = s.x + problem.points.P @ s.Lambda.T
        xi = q + phi * u[:, 1] - u[:, 2]
        block = mass * s.v @ s.v / 2 + mass * 9.81 * s.x[2] + np.dot(s.W, [0.02, 0.03, 0.04] * s.W) / 2
        bounce = plate * q_rate**2 / 2 + k * (q - sink) ** 2 / 2
        pitch = J * phi_rate**2 / 2 + k_p * phi**2 / 2
        total.append(block + np.sum(K_N * xi * abs(xi)) / 2 + bounce + pitch)
    moved = mass * 5e-3**2 / 2 + 0.02 * 0.03**2 / 2
    # The plate is one step late: K_N h a step as a negative damper, some per cent over the run.
    assert np.abs(np.array(total) - total[0]).max() < 5e-2 * moved


@pytest.mark.parametrize("ratio", [0.0, 0.1])
def test_the_support_keeps_or_takes(ratio):
    """Block, contact springs, plate and its spring, about the loaded balance: constant, or falling by the damper."""
    mass, plate, frequency, K_N = 2.0, 3.0, 40.0, 1e6
    problem: Problem = puck([CompliantSupport(plate, frequency, ratio)], mass=mass, K_N=K_N, h=4e-6)
    problem = problem.replace(start=problem.start.at_rest(problem.start.x, np.eye(3), 4, [0, 0, -5e-3]))
    k = (2 * math.pi * frequency) ** 2 * plate
    sink = mass * 9.81 / k
    total = []
    for s in walk(problem, 2000):
        q, q_rate = (float(s.memory[0][key]) for key in ("q", "q_rate"))
        xi = q + 1e-6 - s.x[2]
        block = mass * s.v[2] ** 2 / 2 + mass * 9.81 * s.x[2]
        total.append(block + 4 * K_N * xi * abs(xi) / 2 + plate * q_rate**2 / 2 + k * (q - sink) ** 2 / 2)
    moved = mass * 5e-3**2 / 2
    change = (np.array(total) - total[0]) / moved
    if ratio == 0:
        # The plate is one step late: K_N h a step as a negative damper, 2 % over the run.
        assert np.abs(change).max() < 3e-2
    else:
        assert change[-1] < -0.1
        assert np.all(np.diff(change[::100]) < 2e-3)


@pytest.mark.parametrize(
    "effect",
    [
        StribeckFriction(1.5, 0.01), StribeckFriction(0.5, 0.05), StribeckFriction(3.0, 1e-3),
        LoadDependentFriction(0.33, 2.5), LoadDependentFriction(-0.33, 2.5),
    ],
    ids=lambda effect: f"{effect.id}-{list(effect.values().values())[0]}",
)  # fmt: skip
def test_friction_with_a_coefficient_that_varies_never_drives(effect):
    """A puck that slides, stops and bounces a little: motion, springs and weight together never rise."""
    K_N, K_T, mass = 1e6, 1e6, 1.0
    problem = puck([effect], mass=mass, mu=0.4, v=(0.05, 0.02, 1e-3), K_N=K_N, K_T=K_T, C_N=20.0, C_T=20.0)
    total = []
    for s in walk(problem, 3000):
        k = point_kinematics(s.x, s.Lambda, s.v, s.W, problem.points.P)
        held = np.where(s.anchored[:, None], k.u[:, :2] - s.s, 0.0)
        springs = K_N * np.maximum(k.xi, 0) ** 2 + K_T * np.sum(held**2, axis=1)
        total.append(mass * s.v @ s.v / 2 + mass * 9.81 * s.x[2] + np.sum(springs) / 2)
    moved = mass * 0.05**2 / 2
    change = np.diff(total) / moved
    # Of second order in the step: (omega h)^2 = 4 K h^2/m = 4e-4 of what a spring holds, (mu m g)^2/8 K = 2e-6 J.
    assert change.max() < 4e-4 * 2e-6 / moved
    assert total[0] - total[-1] > 0.9 * moved


def test_uneven_normals_are_not_conservative():
    """Pressed to 2 um, slid by 1 mm, lifted and brought back, a foot has taken or given K xi x d, as the text says."""
    tilt, depth, way = 0.02, 2e-6, 1e-3
    points = points_at([(0, 0, 0)], K_N=K)
    effect = UnevenContactNormals(x1=tilt)

    def force(x, z):
        problem = body(points, [effect], x=(x, 0, z))
        s = problem.start
        c = evaluate_contact(problem.replace(effects=()), s, s.x, s.Lambda, s.v, s.W, np.zeros(3), 0.0, ())
        return effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, {})[0]

    # Along z the further force has no part; so only the two slides count, pressed and lifted.
    assert force(0.0, -depth)[2] == 0
    work = way * (force(0.0, -depth)[0] - force(way, depth)[0])
    assert work == pytest.approx(tilt * K * depth * way, rel=1e-12)
    # Python 3.13 takes the margin away from docstrings.
    assert "not conservative" in " ".join(UnevenContactNormals.__doc__.split())


@pytest.mark.parametrize(
    "effect", [LingeringWirePull(3.0, 0.02), BaseVibration(0.5, 30.0, 0.4, 0.7)], ids=lambda e: e.id
)
def test_loads_put_in_the_work_of_what_they_say(effect):
    """The energy of a free body against the integral of the stated force along the way of the point that it acts on."""
    h, mass = 1e-4, 2.0
    problem = body(
        points_at([(0.1, 0.1, -0.5), (-0.1, -0.1, -0.5)]), [effect],
        x=(0, 0, 10), v=(0.3, 0.2, 0), W=(0.5, -0.4, 0.2), J=(0.2, 0.3, 0.1), mass=mass, g=0.0, h=h,
    )  # fmt: skip
    wire = isinstance(effect, LingeringWirePull)
    power, energy = [], []
    for s in walk(problem, 800):
        up = s.Lambda[:, 2] * 0.5 * wire
        velocity = s.v + np.cross(s.Lambda @ s.W, up)
        if wire:
            force = np.array([0.0, 3.0 * math.exp(-s.t / 0.02), 0.0])
        else:
            along = np.array([math.sin(0.4), math.cos(0.4), 0.0])
            force = -mass * 0.5 * math.cos(2 * math.pi * 30.0 * s.t + 0.7) * along
        power.append(force @ velocity)
        energy.append(mass * s.v @ s.v / 2 + np.dot(s.W, [0.2, 0.3, 0.1] * s.W) / 2)
    work = np.concatenate([[0.0], np.cumsum(np.array(power)[1:] + np.array(power)[:-1]) * h / 2])
    # Both are of second order in the step: (h/tau)^2/12 = 2e-6, (omega h)^2/12 = 3e-5.
    assert np.abs(np.array(energy) - energy[0] - work).max() < 1e-4 * np.abs(work).max()
    assert np.abs(work).max() > 5e-4
