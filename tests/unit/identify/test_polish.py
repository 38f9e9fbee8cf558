"""Least squares: recovers what made the record, says what it cannot see, and gives each run its own release angle."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.identify import polish as polishing
from rockref.identify import unknowns
from rockref.identify.descent import BEYOND_ALL, FACTORS, NEARLY, Descent
from rockref.identify.genes import chromosome, space_12
from rockref.identify.identifiability import identifiability, profile
from rockref.identify.polish import Effort, polish
from rockref.identify.runs import run_error
from rockref.identify.target import Target, seen_until, target
from rockref.identify.unknowns import Unknowns, residuals, signal_costs
from rockref.model.parameters import TABLE_3_1
from tests.unit.identify.analytic import alone

PRECISION = np.array([given.precision for given in TABLE_3_1.values()])


@pytest.fixture(scope="module")
def space(table_3_1):
    return space_12(table_3_1)


@pytest.fixture(scope="module")
def truth(space, table_3_1):
    return chromosome(space, table_3_1.parameters)


@pytest.fixture(scope="module")
def end(space, truth, noisy_twin):
    """From a start that is off by a tenth of a last digit in every parameter, to the end, without long moves."""
    signs = np.random.default_rng(2).choice([-1.0, 1.0], 12)
    start = space.units(space.values(truth) + 0.1 * PRECISION * signs)
    return polish(space, [noisy_twin], start, effort=Effort(windows=(), moves=0))


def test_recovers_what_the_data_determine_within_half_a_last_digit(space, end, noisy_twin):
    off = (space.values(end.u) - np.array([g.value for g in TABLE_3_1.values()])) / PRECISION
    determined = identifiability(space, [noisy_twin], end).determined()
    known = [n.split(" of")[0] for n, yes in determined.items() if yes]
    # Heights and diagonal trade off along the valley, and the inner points hardly slide.
    assert {"K_N", "K_T", "beta_ext", "mu_ext", "theta_0"} <= set(known) and "mu_int" not in known
    assert max(abs(off[space.names.index(n)]) for n in known) < 0.5


@pytest.mark.slow
def test_from_half_a_digit_off_long_moves_lead_out_of_dents(space, truth, noisy_twin):
    """Where a descent stops hangs on its last bits: of three starts none ends higher than without long moves, and one
    at the noise at least; the friction of the inner points is what the data see least."""

    def ended(seed, **effort):
        signs = np.random.default_rng(seed).choice([-1.0, 1.0], 12)
        start = space.units(space.values(truth) + 0.5 * PRECISION * signs)
        return polish(space, [noisy_twin], start, effort=Effort(windows=(), **effort))

    ends = [(ended(seed), ended(seed, moves=0)) for seed in (1, 2, 3)]
    assert all(far.chi2 <= without.chi2 for far, without in ends)
    far = min((far for far, _ in ends), key=lambda end: end.chi2)
    known = identifiability(space, [noisy_twin], far)
    off = np.abs(space.values(far.u) - space.values(truth)) / PRECISION
    errors = np.array([known.digits()[name] for name in known.names])
    assert far.chi2 < NEARLY and not known.determined()["mu_int"]
    # As from a start beside the truth: half a digit where the data determine so much, five standard errors along the
    # valley, in which heights and diagonal trade off.
    assert off[[space.names.index(n) for n in ("K_N", "K_T", "beta_ext", "mu_ext", "theta_0")]].max() < 0.5
    assert (off / errors).max() < 5, dict(zip(known.names, zip(off, errors, strict=True), strict=True))


@pytest.mark.parametrize("sample_rate", [1000.0, 700.0], ids=["outputs", "between outputs"])
def test_a_simulation_ends_where_the_residual_does(space, truth, twin, sample_rate, monkeypatch):
    """What is simulated beyond it does not change a bit, by a spline through the outputs either."""
    seen = replace(twin, gyro=replace(twin.gyro, sample_rate=sample_rate))
    own = residuals(space, [seen], truth[None])
    assert seen.residual_duration < seen.duration
    monkeypatch.setattr(Target, "residual_duration", property(lambda one: one.duration))
    np.testing.assert_array_equal(own, residuals(space, [seen], truth[None]))


def test_the_residual_is_the_noise(end):
    # 4000 samples scatter by 2 %, and the target's step is half of the model's.
    assert 0.9 < end.chi2 < 1.15
    np.testing.assert_allclose(np.degrees(end.rms), 0.05, rtol=0.15)


def test_errors_are_of_the_size_of_what_is_missed(space, end, noisy_twin):
    """Each parameter is off by some of its standard errors, not by many: the Fisher information is believed."""
    known = identifiability(space, [noisy_twin], end)
    values = dict(zip(space.names, np.array([g.value for g in TABLE_3_1.values()]), strict=True))
    pulls = [
        (v - values[n.split(" of")[0]]) / e for n, v, e in zip(known.names, known.values, known.errors, strict=True)
    ]
    # Twelve numbers of unit variance, with the bias of the dents (below a tenth of a digit).
    assert np.abs(pulls).max() < 5
    assert set(known.digits()) == set(known.names) and known.weakest


def test_an_unknown_that_does_nothing_is_found_out(space, end, noisy_twin):
    """A direction without information gets a large error, not a small one."""
    blind = replace(end, jacobian=end.jacobian.copy())
    blind.jacobian[:, 0] = 0.0
    known = identifiability(space, [noisy_twin], blind)
    assert known.errors[0] > 1e2 * identifiability(space, [noisy_twin], end).errors[0]
    assert not known.determined()[known.names[0]]


def test_above_the_noise_floor_nothing_is_determined(space, end, noisy_twin):
    """A sharp valley is not the right one: a twin that stuck at 1.4 times the noise had small errors, all wrong."""
    assert end.at_floor and any(identifiability(space, [noisy_twin], end).determined().values())
    stuck = replace(end, chi2=1.39)
    assert not stuck.at_floor and not any(identifiability(space, [noisy_twin], stuck).determined().values())


def test_unknowns_that_act_alike_are_named_as_a_pair(space, end, noisy_twin):
    alike = replace(end, jacobian=end.jacobian.copy())
    alike.jacobian[:, 1] = alike.jacobian[:, 0] * 1.7 + 1e-3 * alike.jacobian[:, 2]
    pairs = identifiability(space, [noisy_twin], alike).pairs
    assert pairs[0][:2] == ("K_N", "K_T") and pairs[0][2] < -0.99


def test_a_profile_has_its_bottom_at_the_end(space, end, noisy_twin):
    known = identifiability(space, [noisy_twin], end)
    values, chi2 = profile(space, [noisy_twin], end, "beta_ext", 40 * known.errors[3], points=3)
    assert chi2[1] < chi2[0] and chi2[1] < chi2[2]
    assert values[1] == pytest.approx(space.values(end.u)[space.names.index("beta_ext")])


def test_every_run_has_its_own_release_angle(space, truth, table_3_1, noisy_twin):
    z = Unknowns(space, [noisy_twin, noisy_twin]).z(truth)
    assert len(z) == 13
    z[-1] += 0.1
    r = residuals(space, [noisy_twin, noisy_twin], z[None])[0].reshape(2, -1)
    assert np.mean(np.square(r[1])) > 10 * np.mean(np.square(r[0]))


def counted_simulations(monkeypatch):
    """The list to which the simulations of each target are counted from now on."""
    asked, whole = [], unknowns.releases

    def counted(space, targets, chromosomes, *more):
        asked.extend(len(own) for own in chromosomes)
        return whole(space, targets, chromosomes, *more)

    monkeypatch.setattr(unknowns, "releases", counted)
    return asked


def test_another_run_s_angle_costs_no_simulation(space, truth, noisy_twin, monkeypatch):
    """Slopes of two runs with eleven shared numbers: two simulations for each of these, two for the own angle, one."""
    seen = seen_until(noisy_twin, 0.0)
    z = Unknowns(space, [seen] * 2).z(truth)
    zs = np.array([z, *(z + s * 1e-3 * row for s in (1, -1) for row in np.eye(len(z)))])
    alone = [residuals(space, [seen] * 2, row[None])[0] for row in zs[[0, 3, -1]]]
    asked = counted_simulations(monkeypatch)
    together = residuals(space, [seen] * 2, zs)
    assert asked == [25, 25] and len(zs) == 27
    np.testing.assert_array_equal(together[[0, 3, -1]], alone)


def test_slopes_move_all_release_angles_in_one_simulation(space, truth, noisy_twin, monkeypatch):
    """A target has rows of its own: eleven shared numbers and one row more give what thirteen rows would."""
    descent = Descent(Unknowns(space, [seen_until(noisy_twin, 0.0)] * 2), workers=1)
    # A release angle at the end of its range is moved inwards.
    at, h = descent.place(np.append(descent.unknowns.z(truth)[:-1], 1.0)), np.linspace(1e-3, 2e-3, 13)
    up, down = np.diag(np.append(h[:-1], 0.0)), np.diag(h)
    one_by_one = (descent.residuals(at.z + up) - descent.residuals(at.z - down)) / np.diag(up + down)[:, None]
    asked = counted_simulations(monkeypatch)
    J = descent.jacobian(at, h)
    assert asked == [24, 24] and J.shape == (len(at.r), 13)
    # The same simulations; the steps that were taken differ from h by rounding of z.
    np.testing.assert_allclose(J, one_by_one.T, rtol=1e-11, atol=0)
    half = len(at.r) // 2
    assert not J[half:, 11].any() and not J[:half, 12].any() and J[:half, 11].any() and J[half:, 12].any()


def test_where_no_step_gains_the_slopes_are_not_taken_again():
    """At the bottom of a bowl: slopes over two step sizes, then dampings alone, each larger than those before."""

    class Bowl(Descent):
        slopes_taken, tried = 0, 0

        def residuals(self, zs):
            self.tried += len(zs)
            return 1.0 + np.sum(np.square(zs - 0.5), axis=1, keepdims=True)

        def jacobian(self, at, h):
            self.slopes_taken += 1
            return super().jacobian(at, h)

    bowl = Bowl(alone("a", "b", "c"))
    end = bowl.descend(bowl.place(np.full(3, 0.5)), 1.0)
    assert bowl.slopes_taken == 2 and bowl.tried == 1 + 2 * 6 + 3 * len(FACTORS)
    assert end.chi2 == 1.0 and FACTORS[0] * BEYOND_ALL > FACTORS[-1]


def test_signal_costs_are_the_mean_squares(space, truth, noisy_twin):
    r = residuals(space, [noisy_twin], truth[None])[0]
    assert signal_costs(space, [noisy_twin], 1e-5, [truth]) == [pytest.approx(np.mean(np.square(r)), rel=1e-12)]


def test_a_run_s_own_angle_is_found(space, end, noisy_twin):
    """A record whose stated tilt is wrong by 0.3 mrad: the angle comes out, and the error falls to the noise."""
    wrong = target("off", noisy_twin.t, noisy_twin.crv, noisy_twin.gyro, noisy_twin.tilt - 3e-4)
    e = run_error(space, end, wrong, "holdout")
    assert e.tilt == pytest.approx(0.1170, abs=2e-5)
    assert e.over_noise < 1.15 < e.over_noise_stated


class Dents(Descent):
    """One unknown in a valley about 0.2 with a dent every fifth of the range, and one that is only a valley."""

    def __init__(self, noise=1.0):
        super().__init__(alone("a", "b"))
        self.noise = noise

    def residuals(self, zs):
        off = zs - 0.2
        parts = 4.0 * off[:, :1], 5.0 * (1.0 - np.cos(10.0 * np.pi * off[:, :1])), 9.0 * off[:, 1:]
        alike = self.noise * np.tile([1.0, -1.0], 3)
        return np.repeat(np.concatenate(parts, axis=1), 2, axis=1) + alike


def test_long_moves_leave_a_dent_in_the_windows_where_they_are_cheap():
    start = np.array([0.58, 0.5])
    stuck = polishing._in_window(Dents(), start, polishing.CHEAP_WINDOW)
    assert abs(stuck.z[0] - 0.2) > 0.3 and stuck.z[1] == pytest.approx(0.2, abs=1e-3) and stuck.chi2 > 1.5
    free = polishing._in_window(Dents(), start, 0.0)
    assert free.z == pytest.approx([0.2, 0.2], abs=0.02) and free.chi2 < NEARLY
