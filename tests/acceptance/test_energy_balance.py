"""The energy account of the block of Table 3.1, step by step, through its first main impact."""

import numpy as np
import pytest

import rockref
from rockref.model.energy_balance import balance

MODEL = rockref.Model.table_3_1()
STEPS = (2e-5, 1e-5, 5e-6)


@pytest.fixture(scope="module")
def accounts():
    """The first 0.56 s at three steps: the release, the swing, and the clatter about the first main impact."""
    found = {}
    for step in STEPS:
        response = rockref.simulate(MODEL, duration=0.56, step=step, output_rate=1 / step, engine="numba")
        found[step] = response, balance(response)
    return found


def test_the_account_closes_and_its_residual_is_of_order_two(accounts):
    worst = np.array([np.max(np.abs(accounts[step][1].residual)) for step in STEPS])
    # measured: 3.0e-6 J at 1e-5 s, of 0.32 J that the block turns over and 0.089 J that it loses
    assert worst[1] < 3.2e-6
    assert np.log2(worst[:-1] / worst[1:]) == pytest.approx([2, 2], abs=0.02)


def test_the_residual_does_not_grow_with_time(accounts):
    """It follows the accelerations of the moment: in the calm after the impact it is a thousandth of its peak."""
    _, b = accounts[1e-5]
    assert np.abs(b.residual[-1]) < 1e-3 * np.max(np.abs(b.residual))


def test_every_step_closes(accounts):
    """Change of mechanical energy against work, step by step: m h^2 a da / 4 and its like for the turning."""
    response, b = accounts[1e-5]
    slips = np.abs(np.diff(b.residual))
    # an impact changes accelerations by 30 m/s2 at once: 54 kg 1e-10 s2 / 8 (30 m/s2)^2 = 6e-7 J, some points together
    assert np.max(slips) < 3e-6
    assert np.median(slips) < 1e-12


def test_normal_forces_never_give_energy(accounts):
    """In no single step of any of the three runs; C h^3 (jump of a)^2 / 64, the only dip there could be, is 1e-13 J."""
    for step in STEPS:
        _, b = accounts[step]
        # rounding of energies of 200 J
        assert np.min(np.diff(b.dissipated_normal)) > -1e-13


def test_friction_gives_nothing_to_its_anchors(accounts):
    """-F_T . ds >= 0 for every point in every step in which the anchor stays alive."""
    for step in STEPS:
        response, _ = accounts[step]
        alive = response.anchored[1:] & response.anchored[:-1]
        work = -np.sum(response.F[1:, :, :2] * np.diff(response.s, axis=0), axis=-1)[alive]
        # anchors at 0.05 m are rounded at 7e-18 m, forces are up to 4 kN
        assert np.min(work) > -1e-13
        # measured: 1.7e-4 J; the rest of what friction takes goes into the dampers
        assert np.sum(work) > 1e-4


def test_friction_takes_energy_over_all_though_not_in_every_step(accounts):
    """The damper of the law is beside the spring and sees the whole sliding velocity: some steps give energy back."""
    for step in STEPS:
        _, b = accounts[step]
        steps = np.diff(b.dissipated_friction)
        given = -np.sum(steps[steps < 0])
        # measured: 2.9e-5 to 3.4e-5 J given back of 2.5e-3 J taken
        assert 0 < given < 0.02 * b.dissipated_friction[-1]
        assert b.dissipated_friction[-1] == pytest.approx(2.5e-3, rel=0.03)


def test_what_the_first_main_impact_costs(accounts):
    """0.0885 J of normal damping and friction, the same at every step to half a percent."""
    lost = np.array([accounts[step][1].dissipated[-1] for step in STEPS])
    assert lost == pytest.approx(np.full(3, 0.0886), rel=5e-3)
    response, b = accounts[1e-5]
    # nearly all of it in the 20 ms about the impact at 0.51 s
    before, after = np.searchsorted(response.t, [0.49, 0.53])
    assert b.dissipated[after] - b.dissipated[before] > 0.9 * b.dissipated[-1]


def test_response_energy_agrees_with_the_account(accounts):
    response, b = accounts[1e-5]
    e = response.energy()
    assert e["kinetic"] + e["potential"] == pytest.approx(b.mechanical, rel=1e-14)
    # what is missing of the total is what was dissipated, and the residual
    assert e["dissipated"] == pytest.approx(b.dissipated - b.residual, abs=1e-12)
