"""Energies of the block and of the springs, and the account of a run."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model import energy, energy_balance
from rockref.model.problem import stack
from tests import physics
from tests.refusal import refused


def every_step(problem):
    return rockref.simulate(problem.replace(output_rate=1 / problem.step), engine="numpy")


def test_kinetic_energy_of_a_turning_block():
    E = energy.kinetic_energy(np.array([1.0, 2, 2]), np.array([1.0, 0, 2]), np.array(54.0), np.diag([2.0, 3, 5]))
    assert E == 54 * 9 / 2 + (2 + 20) / 2
    coupled = np.array([[2.0, 0.5, 0], [0.5, 3, 0], [0, 0, 5]])
    assert energy.kinetic_energy(np.zeros(3), np.array([1.0, 1, 0]), np.array(1.0), coupled) == (2 + 3 + 1) / 2


def test_potential_energy_is_the_height_times_the_weight():
    assert energy.potential_energy(np.array([9.0, 9, 0.5]), np.array(54.0), np.array(10.0)) == 270


def test_springs_of_points_in_the_air_store_nothing():
    xi, touching = np.array([1e-6, 2e-6]), np.array([True, False])
    s = np.array([[1e-3, -2e-3], [0, 0]])
    u = s + [[3e-6, 4e-6], [1, 1]]
    normal, tangential = energy.spring_energy(xi, touching, u, s, np.full(2, 6e7), np.full(2, 5e7))
    # the stretch of 5e-6 m is the difference of places at 1e-3 m: two digits and a half less
    assert (normal, tangential) == pytest.approx((3e-5, 5e7 * 25e-12 / 2), rel=1e-12, abs=0)


def test_sums_of_energies():
    e = energy.Energy(1.0, 20.0, 300.0, 4000.0)
    assert (e.mechanical, e.total) == (21, 4321)


def test_balance_of_a_bounce():
    """Without gravity the block loses what the restitution tells, all of it by the normal damper."""
    b = energy_balance.balance(every_step(physics.mass_on_a_foot(v=(0, 0, -0.1), g=0.0, duration=0.005)))
    lost = b.mechanical[0] - b.mechanical[-1]
    # the residual, m h^2/8 a_0^2 = 9.3e-7 J with a_0 = C v / m = 37 m/s2
    assert b.dissipated[-1] == pytest.approx(lost, abs=1e-6)
    assert b.dissipated_friction[-1] == 0
    assert b.stored_normal[0] == b.stored_normal[-1] == 0
    # of 0.27 J the spring holds 0.164 J when the mass turns back
    assert np.max(b.stored_normal) > 0.15


def test_residual_of_a_body_that_does_not_turn_is_known():
    """m h^2/8 (a.a - a_0.a_0), to rounding: the account, the step and the forces are consistent to the last digit."""
    response = every_step(physics.mass_on_a_foot(z=-1e-6, v=(0.3, 0.1, -0.1), duration=0.004))
    F = response.F[:, 0]
    a = F / physics.MASS - [0, 0, 9.81]
    expected = physics.MASS * 1e-10 / 8 * (np.sum(a * a, axis=-1) - a[0] @ a[0])
    # energies of 3 J rounded at 4e-16, in 400 steps
    assert np.max(np.abs(energy_balance.balance(response).residual - expected)) < 1e-13


def test_a_row_for_every_step_is_needed():
    error = refused(
        energy_balance.balance, rockref.simulate(physics.mass_on_a_foot().replace(output_rate=1000.0), engine="numpy")
    )
    assert (error.code, error.where) == ("E-RATE", "output_rate")


def test_the_account_does_not_mind_when_the_run_began():
    problem = physics.mass_on_a_foot(z=-1e-6, v=(0.3, 0, -0.1), duration=1e-3)
    early = energy_balance.balance(every_step(problem))
    late = energy_balance.balance(every_step(problem.replace(start=replace(problem.start, t=7.0))))
    assert late.t[0] == 7
    assert late.t == pytest.approx(7 + early.t, rel=1e-15)
    assert np.array_equal(late.residual, early.residual)


def test_one_block_only():
    error = refused(
        energy_balance.balance, rockref.simulate(stack([physics.mass_on_a_foot(duration=1e-4)] * 2), engine="numpy")
    )
    assert error.code == "E-BATCH"


def test_from_start():
    for dtype in (np.float32, np.float64, np.longdouble):
        sums = energy_balance.from_start(np.array([1, 2, 3], dtype))
        assert np.array_equal(sums, [0, 1, 3, 6])
        assert sums.dtype == dtype
