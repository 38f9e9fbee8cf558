"""What the card says of a misfit: windows of real records, with misfits that are put in."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import signature as card
from rockref.discover.windows.series import series
from rockref.measure.impacts import main_impacts
from tests.unit.discover.synthetic import experiment

#: Size of a misfit in noise sigmas: of a step, of a slope per second, of a tone.
STEP, SLOPE, TONE = 3.0, 200.0, 6.0


@pytest.fixture(scope="module")
def windows():
    """Two releases that are alike, a lower one, one turned: three seconds of each."""
    runs = [{}, {}, {"tilt": 0.098}, {"turned": True}]
    made = experiment(Model.table_3_1(), runs, duration=3.0)
    return series(made, made.runs, 0.05, 0.09, 3.0)


@pytest.fixture(scope="module")
def impacts(windows):
    return [main_impacts(run.t, run.crv) for run in windows.runs]


def noise(s, seed=3):
    """(B, M, 3) residuals of a model that is right."""
    return np.random.default_rng(seed).normal(size=(s.B, s.M, 3)) * s.valid[..., None]


def signature(s, r):
    """The card of these residuals; nothing was found."""
    fit = SimpleNamespace(series=s, residual=lambda z, c: r)
    point = SimpleNamespace(z=None, corrections=None, loss=0.5 * np.sum(r**2, axis=(1, 2)))
    return card.signature(fit, point, fit, point)


def misfit_of(s, impacts, moment):
    """Residuals about the main axis of windows that lack a moment(side, way, t): its integral from each start."""
    r, t = noise(s), card.times(s)
    for b, run in enumerate(s.run_of):
        before = np.searchsorted(impacts[run].times, t[b])
        side = np.r_[-impacts[run].signs[0], impacts[run].signs][before]
        way = np.sign(s.measured[b, :, 0])
        r[b, :, 0] += np.cumsum(moment(side, way, t[b])) / s.rate * s.valid[b]
    return r


@pytest.mark.parametrize("axis, name", list(enumerate(card.AXES)))
def test_the_axis_is_that_of_the_largest_misfit(windows, axis, name):
    r = noise(windows)
    r[[0, 13], :, axis] *= STEP
    found = signature(windows, r)
    assert found["axis"] == name and found["axis_shares"][name] > 0.6
    assert sum(found["axis_shares"].values()) == pytest.approx(1)


class TestPhase:
    def test_what_shows_in_every_first_swing_belongs_to_the_release(self, windows):
        r = noise(windows)
        r[windows.first, :, 0] *= STEP
        found = signature(windows, r)
        assert found["phase"] == "release"
        # One axis of three at 9 times its power.
        assert found["loss_at_release"] == pytest.approx(11 / 3, rel=0.2)
        assert found["loss_after"] == pytest.approx(1, rel=0.1)

    @pytest.mark.parametrize("runs", [1, 2])
    def test_a_blow_in_the_first_swing_of_half_the_runs_at_most_does_not(self, windows, runs):
        r = noise(windows)
        r[[*np.flatnonzero(windows.first)[:runs], 20], :, 2] *= 6
        found = signature(windows, r)
        assert found["phase"] == "impacts" and found["loss_at_release"] < 1.5


class TestStretch:
    @pytest.mark.parametrize("name", ["free_arc", "impact"])
    def test_where_the_misfit_is(self, windows, impacts, name):
        near = card.near_impacts(windows, impacts)
        r = noise(windows)
        r[near if name == "impact" else ~near] *= STEP
        r *= windows.valid[..., None]
        shares = signature(windows, r)["stretch_shares"]
        assert shares[name] > 0.95 and sum(shares.values()) == pytest.approx(1)

    def test_an_impact_lasts_thirty_milliseconds(self, windows, impacts):
        near = card.near_impacts(windows, impacts) & windows.valid
        inside = sum(int((i.times < 2.97).sum()) for i in impacts)
        # A few samples of each are lost where a window begins in it.
        assert near.sum() == pytest.approx(30 * inside, rel=0.1)


class TestParity:
    @pytest.mark.parametrize(
        "name, moment",
        [
            ("even", lambda side, way, t: SLOPE * np.ones_like(t)),
            ("odd_in_velocity", lambda side, way, t: -SLOPE * way),
            ("odd_in_side", lambda side, way, t: SLOPE * side),
            ("odd_in_both", lambda side, way, t: SLOPE * side * way),
        ],
    )
    def test_a_moment_has_its_own(self, windows, impacts, name, moment):
        found = signature(windows, misfit_of(windows, impacts, moment))
        assert found["parity"] == name and found["parity_shares"][name] > 0.9
        # The others explain less: a coefficient of one parity is no other's but for the few arcs that there are.
        assert sorted(found["parity_shares"].values())[-2] < 0.8

    def test_a_tone_has_none(self, windows, impacts):
        def moment(side, way, t):
            return SLOPE * np.sin(2 * np.pi * 31.0 * t)

        assert signature(windows, misfit_of(windows, impacts, moment))["parity"] is None

    def test_noise_has_none_and_no_shares(self, windows):
        found = signature(windows, noise(windows))
        assert found["parity"] is None and set(found["parity_shares"].values()) == {None}

    def test_sides_ways_and_distances_are_those_of_a_rocking_block(self, windows, impacts):
        found = card.slopes(windows, impacts, noise(windows)[..., 0])
        assert set(found.side) == set(found.out) == {-1.0, 1.0}
        assert found.distance.min() >= 0 and found.distance.max() <= 1
        # Slopes are in standard deviations of their own noise.
        assert np.std(found.slope) == pytest.approx(1, abs=3 / np.sqrt(2 * len(found.slope)))

    def test_before_the_first_impact_the_block_falls_back(self, windows, impacts):
        first = card.slopes(windows, impacts, noise(windows)[..., 0]).out[:1]
        assert first == [-1.0]

    def test_runs_without_an_impact_have_no_arcs(self, windows, impacts):
        none = [SimpleNamespace(times=np.empty(0), signs=np.empty(0)) for _ in impacts]
        assert len(card.slopes(windows, none, noise(windows)[..., 0]).slope) == 0
        assert card.parity(card.slopes(windows, none, noise(windows)[..., 0]))["parity"] is None


class TestLock:
    def tone(self, s, phases, hertz=23.0, gain=TONE):
        r = noise(s)
        angle = 2 * np.pi * hertz * card.times(s) + np.asarray(phases)[s.run_of][:, None]
        r[..., 1] += gain * np.sin(angle) * s.valid
        return r

    def test_what_comes_again_with_every_release_is_locked_to_it(self, windows):
        found = signature(windows, self.tone(windows, [0.5, 0.5, 0.5, 0.5]))
        assert found["locked_to"] == "release" and found["repeats"] > 0.95

    def test_a_tone_that_goes_on_whenever_the_block_is_let_go_is_locked_to_the_clock(self, windows):
        found = signature(windows, self.tone(windows, [0.0, 1.6, 3.0, 4.0]))
        assert found["locked_to"] == "clock" and found["repeats"] < 0.1 and found["coherence"] > 0.9
        assert found["frequency_hz"] == pytest.approx(23.0, abs=2.0)

    def test_loud_noise_is_locked_to_neither(self, windows):
        r = noise(windows) * 2
        found = signature(windows, r)
        assert found["locked_to"] == "neither" and found["repeats"] < 0.1 and found["coherence"] < card.TONE

    def test_where_nothing_stands_out_nothing_is_said(self, windows):
        found = signature(windows, noise(windows))
        assert found["locked_to"] is None and found["repeats"] is None

    def test_where_no_two_were_released_alike_nothing_is_said(self, windows):
        lone = SimpleNamespace(**vars(windows))
        lone.runs = [
            SimpleNamespace(t=run.t, crv=run.crv, release_tilt=0.1 + 0.003 * k, block_turned=0.0)
            for k, run in enumerate(windows.runs)
        ]
        found = signature(lone, self.tone(windows, [0.5, 0.5, 0.5, 0.5]))
        assert found["locked_to"] is None and found["repeats"] is None
        # A turned block is not released as one that is not.
        for run, turned in zip(lone.runs, (0.0, np.pi, 0.0, 0.0), strict=True):
            run.release_tilt, run.block_turned = 0.1 if turned or run is lone.runs[0] else run.release_tilt, turned
        assert card.repeats(lone, self.tone(windows, [0.5] * 4)[..., 1]) is None

    def test_runs_of_one_swing_have_no_tone(self):
        made = experiment(Model.table_3_1(), [{}, {}], duration=1.0)
        short = series(made, made.runs, 0.05, 0.09, 0.6)
        assert short.first.all() and card.coherence(short, noise(short)[..., 0]) == 0.0
