"""The search: jumps out of the side valleys that the ridge of the feet has, on a loss with two valleys."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit import search
from rockref.discover.fit.approach import JUMPS, along_ridge
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.fit.coarse import STAGES
from rockref.discover.fit.least_squares import Point
from rockref.discover.fit.search import ARRIVED, arrived, early, jumped, led_on
from rockref.discover.hypotheses.counted import Parameter
from tests.unit.discover.bowls import ALONE, Bowl
from tests.unit.discover.bowls import WINDOWS as BOWLS

WINDOWS = 20
PARAMETERS = baseline_parameters(Model.table_3_1(), 0, 0.0014)
NAMES = [p.name for p in PARAMETERS]
RIDGE = [i for i, n in enumerate(NAMES) if n.startswith("delta_long_") or n == "delta_diag"]


@dataclass
class TwoValleys:
    """Along the mean of the feet's z there is a valley at `deep` and a worse one at 0; a run ends in the nearer."""

    deep: float
    parameters: tuple[Parameter, ...] = PARAMETERS
    runs: int = 0
    series: SimpleNamespace = field(default_factory=lambda: SimpleNamespace(B=WINDOWS, count=np.full(WINDOWS, 150.0)))
    asked: int = 0

    def point(self, z, corrections):
        s = float(np.mean(np.asarray(z)[RIDGE])) if RIDGE else 0.0
        mean = min(0.95 + (s - self.deep) ** 2, 1.10 + s**2)
        return Point(np.array(z, float), corrections, 0.5 * mean * self.series.count, 0.0), None

    def twin(self, log):
        return self

    def run(self, point, iterations, rng, lam=0.0, relative=0.0):
        self.asked += 1
        z = point.z.copy()
        s = float(np.mean(z[RIDGE]))
        z[RIDGE] += (self.deep if abs(s - self.deep) < abs(s) else 0.0) - s
        return self.point(z, point.corrections)[0]


def test_a_jump_moves_heights_and_their_diagonal_distance_alike():
    moves = along_ridge(TwoValleys(0.5))
    assert moves.shape == (len(JUMPS), len(NAMES))
    for move, size in zip(moves, JUMPS, strict=True):
        assert np.all(move[RIDGE] == size) and np.all(np.delete(move, RIDGE) == 0)


def test_four_points_have_no_ridge():
    four = baseline_parameters(Model.four_points(), 0, 0.0014)
    assert along_ridge(TwoValleys(0.5, parameters=four)).shape == (0, len(four))


@pytest.mark.parametrize("deep", [0.55, -0.7])
def test_a_fit_that_stopped_beside_its_valley_jumps_into_it(deep):
    fit = TwoValleys(deep)
    start, _ = fit.point(np.zeros(len(NAMES)), np.zeros((WINDOWS, 5)))
    end = jumped(ALONE, fit, start, np.random.default_rng(0))
    assert np.mean(end.z[RIDGE]) == pytest.approx(deep)
    assert end.objective < start.objective


def test_a_fit_that_has_arrived_stays():
    fit = TwoValleys(0.0)
    start, _ = fit.point(np.zeros(len(NAMES)), np.zeros((WINDOWS, 5)))
    assert jumped(ALONE, fit, start, np.random.default_rng(0)) is start
    assert fit.asked == 0


def test_jumps_that_do_not_help_are_not_kept():
    fit = TwoValleys(5.0)
    start, _ = fit.point(np.zeros(len(NAMES)), np.zeros((WINDOWS, 5)))
    assert jumped(ALONE, fit, start, np.random.default_rng(0)) is start
    assert fit.asked == len(JUMPS)


@dataclass
class Rough(Bowl):
    """A bowl that only averaged samples show: sample by sample nothing moves; a share of its windows is structured."""

    name: str = "rolling_resistance"
    bad: float = 0.0

    def point(self, z, corrections):
        point, r = super().point(z, corrections)
        point.loss[: round(self.bad * BOWLS)] += self.series.count[0]
        return point, r

    def run(self, point, iterations, rng, relative=0.0):
        return super().run(point, iterations, rng, relative) if self.averaged > 1 else point


def stands(floor: float, z: float, **more):
    fit = Rough(np.zeros(1), floor=floor, **more)
    return fit, fit.point(np.array([z]), np.zeros((BOWLS, 5)))[0]


def test_a_fit_above_the_noise_is_led_on_by_averages():
    fit, point = stands(0.95, 0.5)
    assert not arrived(fit, point)
    led = led_on(fit, point, 0)
    # Each iteration goes half of the way that is left.
    assert abs(led.z[0]) == pytest.approx(0.5 / 2 ** sum(n for _, n in STAGES)) and arrived(fit, led)


@pytest.mark.parametrize("floor, z", [(ARRIVED - 0.01, 0.0), (1.6, 0.5)], ids=["arrived", "hopeless"])
def test_a_fit_that_is_down_or_hopeless_stays_where_it_is(floor, z):
    fit, point = stands(floor, z)
    assert led_on(fit, point, 0) is point


@pytest.mark.parametrize(
    "name, bad, led", [("baseline", 0.1, True), ("baseline", 0.4, False), ("clock_error", 0.4, True)]
)
def test_a_baseline_that_lacks_something_is_not_led_on(name, bad, led):
    fit, point = stands(1.0, 0.5, name=name, bad=bad)
    assert (led_on(fit, point, 0) is not point) == led


@pytest.mark.parametrize(
    "effects, bad, gone_on",
    [((), 0.4, True), ((), 0.6, False), (("clock_error",), 0.6, True)],
    ids=["baseline", "baseline that lacks something", "effect"],
)
def test_a_baseline_that_most_windows_contradict_is_not_gone_on_with(monkeypatch, effects, bad, gone_on):
    """On short windows, after the first iterations; an effect may still find its place."""
    fit, point = stands(1.0, 0.0, bad=bad)
    further = fit.point(np.array([0.1]), np.zeros((BOWLS, 5)))[0]
    monkeypatch.setattr(search, "staged", lambda *_: fit)
    monkeypatch.setattr(search, "nominal", lambda parameters, z: z)
    monkeypatch.setattr(search, "approached", lambda fit, z: point)
    monkeypatch.setattr(search, "onward", lambda setup, fit, point, iterations: further)
    _, found = early(ALONE, effects, np.zeros(1), 12)
    assert (found is further) == gone_on


def test_averages_that_lead_higher_are_not_followed():
    fit, point = stands(1.2, 0.0)
    fit.bottom = np.array([3.0])
    astray = fit.point(point.z, point.corrections)[0]
    led = led_on(fit, point, 0)
    assert led is point and point.objective < astray.objective


@pytest.mark.parametrize("masses, valley", [((0.6, -0.6), 0.7), ((-0.6,), 0.0), ((), 0.0)])
def test_a_plate_begins_with_several_masses_and_the_one_in_the_valley_goes_on(monkeypatch, masses, valley):
    """What the others end at is the side valley, where a fit that begins with one mass stays."""
    fit = TwoValleys(0.7)
    moves = np.zeros((len(masses), len(NAMES)))
    moves[:, RIDGE] = np.array(masses).reshape(-1, 1)
    monkeypatch.setattr(search, "staged", lambda *_: fit)
    monkeypatch.setattr(search, "approached", lambda fit, z: fit.point(z, np.zeros((WINDOWS, 5)))[0])
    monkeypatch.setattr(search, "of_other_masses", lambda fit, p: [fit.point(p.z + m, p.corrections)[0] for m in moves])
    _, best = early(ALONE, ("compliant_support",), np.zeros(len(NAMES)), search.TRIED)
    assert np.mean(best.z[RIDGE]) == pytest.approx(valley)
    assert fit.asked == 1 + len(masses)
