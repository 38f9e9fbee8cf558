"""The ledger: against the closed form, and against what the shipped experiments are known to hold.

Then the ledger, number by number, at impacts that are given.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from rockref.measure.experiment import load_experiment
from rockref.measure.signals.ledger import energy_ledger, rocking_block
from tests.refusal import refusal
from tests.unit.measure.struck import struck

BLOCK = rocking_block(54.0, 0.1, 0.688)
ALPHA, P = BLOCK.alpha, BLOCK.rocking_rate


def test_block_about_its_edge():
    block = rocking_block(54.0, 0.1, 0.688)
    assert block.mass == 54.0 and block.radius == pytest.approx(0.5 * math.hypot(0.1, 0.688), rel=1e-15)
    assert math.tan(block.alpha) == pytest.approx(0.1 / 0.688, rel=1e-15)
    assert block.edge_inertia == pytest.approx(4.0 / 3.0 * 54.0 * block.radius**2, rel=1e-15)
    assert block.spin_inertia == pytest.approx(54.0 * 0.01 / 6.0, rel=1e-15)
    assert rocking_block(0.5, 0.1, 0.688).edge_inertia == pytest.approx(block.edge_inertia / 108.0, rel=1e-15)
    assert BLOCK.rocking_rate**2 == pytest.approx(0.75 * 9.81 / BLOCK.radius, rel=1e-14)
    assert BLOCK.potential(0.0) == 0.0
    assert BLOCK.potential(-0.05) == BLOCK.potential(0.05) > 0.0
    # At the tipping angle the centre stands over the edge.
    assert BLOCK.potential(BLOCK.alpha) == pytest.approx(54.0 * 9.81 * (BLOCK.radius - 0.344), rel=1e-12)


@pytest.mark.parametrize(
    "sizes", [(0.0, 0.1, 0.7), (54.0, 0.0, 0.7), (54.0, 0.1, 0.0), (54.0, -0.1, 0.7), (54.0, 0.1, math.nan)]
)
def test_block_without_size_is_refused(sizes):
    said = ", ".join(f"{size:g} {unit}" for size, unit in zip(sizes, ("kg", "m", "m"), strict=True))
    asked = "arguments mass, width, height"
    assert refusal(rocking_block, *sizes) == ("E-RANGE", asked, said, "Give positive numbers.")


def test_loss_in_the_arcs_is_told_from_loss_at_impacts(rocking):
    """Four per cent are taken off the rate at every apex: the arcs lose 7.8 % of the energy, the impacts no more."""
    motion = rocking()
    t = np.arange(0.0, 3.0, 0.0005)
    apexes = 0.5 * (motion.times[1:] + motion.times[:-1])
    plain = energy_ledger(t, motion.crv(t), BLOCK)
    taxed = energy_ledger(t, motion.crv(t) * 0.96 ** np.searchsorted(apexes, t)[:, None], BLOCK)
    assert np.allclose(taxed.times, plain.times, rtol=0.0, atol=1e-9)
    assert np.allclose(taxed.restitution, plain.restitution, rtol=1e-9, equal_nan=True)
    lost = taxed.free_loss / taxed.energy_after[:-1]
    kept = plain.free_loss / plain.energy_after[:-1]
    assert np.allclose(1.0 - lost, (1.0 - kept) * 0.96**2, rtol=1e-9)


def test_cut_after_the_last_impact_is_said_with_nan(rocking):
    motion = rocking()
    t = np.arange(0.0, motion.times[1] + 0.025, 0.001)
    ledger = energy_ledger(t, motion.crv(t), BLOCK)
    assert len(ledger.times) == 2
    assert np.isfinite(ledger.restitution[0]) and np.isnan(ledger.restitution[1])
    assert np.isfinite(ledger.free_loss[0])


def ledgers(shipped, number):
    experiment = load_experiment(shipped / f"mystery-{number:02d}", uses=("fit",))
    return {run.id: energy_ledger(run.t, run.crv, BLOCK) for run in experiment.fit_runs()}


def test_control_loses_what_a_slender_block_loses(shipped):
    """Housner's block loses 1 - (1 - 1.5 sin^2 alpha)^2 = 6.1 % of the energy; clatter hands some of it on."""
    for ledger in ledgers(shipped, 8).values():
        known = np.isfinite(ledger.restitution)
        assert 0.96 < ledger.restitution[known].mean() < 0.985
        # The arc from the release is free of clatter, and closes to 0.3 % of its energy.
        assert abs(ledger.release_loss) < 0.003 * ledger.energy_before[0]
        assert np.all(np.diff(ledger.energy_before) < 0.0)


def test_signatures_of_the_shipped_experiments(shipped):
    """What is known of four of them shows in the ledger, before any model is asked."""
    control = ledgers(shipped, 8)["01"]
    # Gyroscope 4 % low: the kinetic energy at the first impact seems 8 % too small for the angle, which is 4 % low too.
    assert ledgers(shipped, 10)["01"].release_loss > 0.1 > 10 * abs(control.release_loss)
    # Mass off centre: the block falls with more energy to one side and with less to the other.
    eccentric = ledgers(shipped, 3)
    assert eccentric["01"].release_loss < -0.03 and eccentric["06"].release_loss > 0.03
    # A loose mass takes a tenth of the rate at the impact and gives some of it back in the arc.
    loose = ledgers(shipped, 11)["01"]
    assert loose.restitution[0] < 0.92 and loose.free_loss[0] < -0.05 < control.free_loss[0]
    # Rolling resistance takes from every arc, also from the release.
    assert ledgers(shipped, 5)["01"].release_loss > 0.01


def along_x(wx):
    return np.stack([wx, np.zeros_like(wx), np.zeros_like(wx)], axis=-1)


@pytest.mark.parametrize("sign", [1, -1])
def test_linear_arcs_lead_to_their_own_rates(rocking, sign):
    """Housner's arcs are those that are fitted: rates, energies and losses are exact, whatever the time of day."""
    motion = rocking(sign=sign)
    t = 5.0 + np.arange(6000) / 2000.0
    ledger = energy_ledger(t, motion.crv(t - 5.0), BLOCK, struck(*(5.0 + motion.times[:4]), sign=sign))
    before, after, J = motion.before[:4], motion.after[:4], BLOCK.edge_inertia
    assert np.array_equal(ledger.times, 5.0 + motion.times[:4]) and ledger.signs[0] == sign
    assert ledger.rate_before == pytest.approx(before, rel=1e-9)
    assert ledger.rate_after == pytest.approx(after, rel=1e-9)
    assert ledger.energy_before == pytest.approx(J * before**2 / 2, rel=1e-9)
    assert ledger.energy_after == pytest.approx(J * after**2 / 2, rel=1e-9)
    assert ledger.impact_loss == pytest.approx(J * (before**2 - after**2) / 2, rel=1e-7)
    assert ledger.restitution == pytest.approx(after / before, rel=1e-9)
    assert ledger.free_loss == pytest.approx(J * (after[:-1] ** 2 - before[1:] ** 2) / 2, abs=1e-8)
    # The trapezoidal rule over a drop of 0.02 rad/s inside a sample of 0.5 ms: 1e-5 rad.
    assert ledger.apex_angles == pytest.approx(motion.apexes[1:4], abs=1e-5)
    assert ledger.release_angle == pytest.approx(0.117, abs=1e-5)
    assert ledger.apex_energy == pytest.approx(BLOCK.potential(ledger.apex_angles), rel=1e-12)
    assert ledger.release_loss == pytest.approx(
        BLOCK.potential(ledger.release_angle) - J * before[0] ** 2 / 2, abs=1e-8
    )


def test_arcs_are_bounded_by_their_impacts():
    t = 2.0 + np.arange(3000) / 1000.0
    ledger = energy_ledger(t, along_x(np.ones(3000)), BLOCK, struck(2.5, 3.25, 4.5))
    assert ledger.arc_starts.tolist() == [2.5, 3.25] and ledger.arc_ends.tolist() == [3.25, 4.5]


def test_integrals_of_a_line_and_of_a_constant():
    """w = t - 2: path (b^2 - a^2)/2, square (b^3 - a^3)/3, cube (b^4 - a^4)/4, from 0.5 to 0.75 s."""
    t = 2.0 + np.arange(3000) / 1000.0
    w = t - 2.0
    crv = np.stack([-w, 0.1 + 0.2 * w, np.full(3000, 0.3)], axis=-1)
    ledger = energy_ledger(t, crv, BLOCK, struck(2.5, 2.75))
    a, b = 0.5, 0.75
    assert ledger.path == pytest.approx([(b**2 - a**2) / 2], rel=1e-12)
    # The trapezoidal rule: f'' h^2/12 of the length, 1e-6 relative here.
    assert ledger.square == pytest.approx([(b**3 - a**3) / 3], rel=2e-6)
    assert ledger.cube == pytest.approx([(b**4 - a**4) / 4], rel=2e-6)
    # Mean square of the rate about Y from 0.2 to 0.25 rad/s: (b^3 - a^3)/(3 (b - a)).
    mean = (0.25**3 - 0.2**3) / 3 / 0.05
    expected = 0.5 * (BLOCK.edge_inertia * mean + BLOCK.spin_inertia * 0.09)
    assert ledger.out_of_plane == pytest.approx([expected], rel=2e-6)


def windowed(inside, arc, outside=-5.0, step=0.001):
    """Rates that follow arc(t) where inside(t), and are something else everywhere else."""
    t = np.arange(3000) * step
    return t, along_x(np.where(inside(t), arc(t), outside))


@pytest.mark.parametrize(
    ("rate", "first", "last", "exact"),
    [
        ("rate_before", -0.1050, -0.0051, True),
        ("rate_before", -0.1040, -0.0051, False),
        ("rate_before", -0.1050, -0.0065, False),
        ("rate_after", 0.0250, 0.1241, True),
        ("rate_after", 0.0260, 0.1241, False),
        ("rate_after", 0.0250, 0.1235, False),
    ],
)
def test_arcs_are_looked_at_from_105_to_5_ms_before_an_impact_and_from_25_to_125_ms_after_it(rate, first, last, exact):
    """Between the samples: 99.6 ms of an arc, and another rate everywhere else, of one sign with it."""
    time, slope = 1.5, -0.3 * np.sign(first)
    arc = lambda t: 0.6 * np.cosh(P * (t - time)) + slope * np.sinh(P * (t - time))  # noqa: E731
    t, crv = windowed(lambda t: (t > time + first - 1e-9) & (t < time + last), arc, outside=5.0)
    ledger = energy_ledger(t, crv, BLOCK, struck(0.7, time, sign=-1))
    assert (abs(getattr(ledger, rate)[1] - 0.6) < 1e-9) == exact


def test_an_arc_is_looked_at_on_one_side_of_its_apex():
    """Apexes 45 ms before and 65 ms after an impact, and another motion from 50 ms beyond them on."""
    time, rise, fall = 1.5, 1.455, 1.565
    up = lambda t: np.sinh(P * (t - rise)) / np.sinh(P * (time - rise))  # noqa: E731
    down = lambda t: 0.9 * np.sinh(P * (fall - t)) / np.sinh(P * (fall - time))  # noqa: E731
    t = np.arange(3000) * 0.001
    w = np.where(t < time, up(t), down(t))
    w[(t < rise - 0.05) | (t > fall + 0.05)] = -2.0
    ledger = energy_ledger(t, along_x(w), BLOCK, struck(0.7, time, sign=-1))
    assert ledger.rate_before[1] == pytest.approx(1.0, rel=1e-9)
    assert ledger.rate_after[1] == pytest.approx(0.9, rel=1e-9)


@pytest.mark.parametrize(("first", "exact"), [(0.1055, True), (0.1045, False)])
def test_an_apex_further_away_leaves_the_100_ms_before_the_clatter(first, exact):
    """An apex 200 ms before the impact; for 9 ms up to `first` before it the rate is another."""
    time, rise = 1.5, 1.3
    t = np.arange(3000) * 0.001
    w = np.sinh(P * (t - rise)) / np.sinh(P * (time - rise))
    w[(t > time - first - 0.009) & (t < time - first)] += 0.1
    ledger = energy_ledger(t, along_x(w), BLOCK, struck(0.7, time, sign=-1))
    assert (abs(ledger.rate_before[1] - 1.0) < 1e-9) == exact


@pytest.mark.parametrize(("samples", "known"), [(10, True), (9, False)])
def test_fewer_than_ten_samples_say_nothing(samples, known):
    """A record that ends so many samples after the clatter of the impact."""
    time = 1.0
    t = np.arange(1026 + samples) / 1000.0
    w = np.where(t < time, 0.5 * np.cosh(P * (t - time)), 0.4 * np.cosh(P * (t - time)))
    # The last sample ends the stretch, and is not in it.
    ledger = energy_ledger(t, along_x(w), BLOCK, struck(time))
    assert np.isfinite(ledger.rate_after[0]) == known
    if known:
        assert ledger.rate_after[0] == pytest.approx(0.4, rel=1e-9)


def test_without_an_impact_nothing_is_known():
    t = np.arange(400) / 1000.0
    ledger = energy_ledger(t, along_x(np.ones(400)), BLOCK, struck())
    assert ledger.rate_before.shape == ledger.free_loss.shape == (0,)
    assert math.isnan(ledger.release_angle) and math.isnan(ledger.release_loss)


def test_every_impact_has_its_own_sign():
    impacts = struck(0.7, 1.5)
    with pytest.raises(ValueError):
        energy_ledger(
            np.arange(3000) / 1000.0, along_x(np.ones(3000)), BLOCK, replace(impacts, signs=impacts.signs[:1])
        )
