"""The moves of a diagnosis, on bowls in place of fits: the race, the challenge, the pruning of a pair, gains."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import diagnose
from rockref.discover.diagnose import Look, challenge, race, ranked, there, without
from rockref.discover.evidence import CLIP
from rockref.discover.families import Family, by_sample, gain_between, gain_over
from rockref.discover.fit import Parameter, Point

WINDOWS, SAMPLES = 40, 60


def series(shift: int = 0):
    """Forty windows of sixty samples; with `shift` all cuts but the first and the last stand elsewhere."""
    cuts = np.arange(WINDOWS + 1) * SAMPLES
    cuts[1:-1] += shift
    length = np.diff(cuts)
    return SimpleNamespace(start=cuts[:-1], stop=cuts[1:], length=length, count=3 * length, run_of=np.zeros(WINDOWS))


@dataclass
class Bowl:
    """A fit whose loss is a bowl about `bottom`; each iteration goes half of the way down, or stays where it is."""

    bottom: np.ndarray
    floor: float = 1.0
    stuck: bool = False
    series: SimpleNamespace = field(default_factory=series)
    iterations: int = 0

    @property
    def parameters(self):
        names = ["K_N", "rolling_resistance.lever", "quadratic_drag.c"][: len(self.bottom)]
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in names)

    def point(self, z, corrections):
        mean = self.floor + float(np.sum((np.asarray(z) - self.bottom) ** 2))
        return Point(np.array(z, float), corrections, 0.5 * mean * self.series.count, 0.0), None

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        if self.stuck:
            return point
        z = point.z + (self.bottom - point.z) * (1 - 0.5**iterations)
        return self.point(z, point.corrections)[0]


def family(effects, bowl, z):
    return Family(effects, bowl, bowl.point(z, np.zeros((WINDOWS, 5)))[0])


def test_who_falls_far_behind_the_leader_stays_where_it_is():
    start = family((), Bowl(np.array([0.0]), floor=1.2), [0.0])
    good = Bowl(np.array([0.0, 0.2]), floor=1.0)
    bad = Bowl(np.array([0.0, 0.2]), floor=1.19)
    found = race([family(("a",), good, [0.0, 0.0]), family(("b",), bad, [0.0, 0.0])], start, seed=0)
    assert good.iterations == diagnose.ITERATIONS and bad.iterations == 1
    assert gain_over(start, found[0]) > gain_over(start, found[1])


def test_a_race_that_nobody_leads_ends_early():
    start = family((), Bowl(np.array([0.0])), [0.0])
    bowls = [Bowl(np.array([0.0, 0.001])) for _ in range(3)]
    race([family(("a",), b, [0.0, 0.0]) for b in bowls], start, seed=0)
    assert all(b.iterations == 2 for b in bowls)


def test_an_effect_that_only_found_a_better_valley_loses_its_gain():
    """The baseline is stuck at z = 0.3; begun where the effect's fit ended, it is as good without the effect."""
    kept = family((), Bowl(np.array([0.0]), stuck=True), [0.3])
    wider = family(("rolling_resistance",), Bowl(np.array([0.0, 0.0])), [0.0, 0.4])
    wider.point = wider.fit.point([0.0, 0.0], wider.point.corrections)[0]
    gain = gain_over(kept, wider)
    assert gain > 100
    look = Look(kept, [wider], {"rolling_resistance": gain})
    challenge(look, wider, seed=0)
    assert look.gains["rolling_resistance"] == pytest.approx(0.0, abs=1e-9)
    assert look.kept.point.z[0] == 0.0


def test_an_effect_that_is_there_keeps_its_gain():
    kept = family((), Bowl(np.array([0.0]), floor=1.2, stuck=True), [0.0])
    wider = family(("rolling_resistance",), Bowl(np.array([0.0, 0.5]), floor=1.0), [0.0, 0.5])
    gain = gain_over(kept, wider)
    look = Look(kept, [wider], {"rolling_resistance": gain})
    challenge(look, wider, seed=0)
    assert look.gains["rolling_resistance"] == gain > 100


def test_no_challenge_where_the_cuts_have_moved():
    kept = family((), Bowl(np.array([0.0])), [0.3])
    wider = family(("gyro_scale",), Bowl(np.array([0.0, 0.0]), series=series(7)), [0.0, 0.0])
    look = Look(kept, [wider], {"gyro_scale": 500.0})
    challenge(look, wider, seed=0)
    assert look.gains == {"gyro_scale": 500.0} and look.kept is kept


@pytest.mark.parametrize("floor, left", [(1.0, ("quadratic_drag",)), (1.2, ("rolling_resistance", "quadratic_drag"))])
def test_a_pair_loses_the_effect_that_came_to_nothing_unless_the_fit_suffers(monkeypatch, floor, left):
    pair = family(("rolling_resistance", "quadratic_drag"), Bowl(np.array([0.1, 0.0, 1.0])), [0.1, 0.05, 1.0])
    single = Bowl(np.array([0.1, 1.0]), floor=floor)
    asked = []

    def baseline(setup, effects, z):
        asked.append((effects, tuple(z)))
        return single, single.point(z, np.zeros((WINDOWS, 5)))[0]

    monkeypatch.setattr(diagnose, "baseline", baseline)
    assert without(None, pair, "rolling_resistance").effects == left
    assert asked == [(("quadratic_drag",), (0.1, 1.0))]


def test_gains_over_moved_windows_are_clipped_like_all_others():
    """All windows far off before, at the noise after: clipped, the gain is the same however the windows are cut."""
    kept = family((), Bowl(np.array([0.0]), floor=4.0), [0.0])
    same = family(("inertia_deviation",), Bowl(np.array([0.0, 1.0])), [0.0, 1.0])
    moved = family(("gyro_scale",), Bowl(np.array([0.0, 1.0]), series=series(7)), [0.0, 1.0])
    most = CLIP * kept.fit.series.count.sum()
    assert gain_between(kept, same) == pytest.approx(most)
    assert gain_between(kept, moved) == pytest.approx(most)


def test_the_loss_by_sample_sums_to_the_loss():
    one = family((), Bowl(np.array([0.0]), floor=1.3, series=series(5)), [0.2])
    assert by_sample(one).sum() == pytest.approx(one.point.loss.sum())
    assert len(by_sample(one)) == WINDOWS * SAMPLES


def test_a_look_keeps_the_better_family_of_each_name_best_first():
    kept = family((), Bowl(np.array([0.0]), floor=1.2), [0.0])
    worse = family(("rolling_resistance",), Bowl(np.array([0.0, 1.0]), floor=1.15), [0.0, 1.0])
    better = family(("rolling_resistance",), Bowl(np.array([0.0, 1.0]), floor=1.05), [0.0, 1.0])
    other = family(("quadratic_drag",), Bowl(np.array([0.0, 1.0]), floor=1.10), [0.0, 1.0])
    look = ranked(kept, [worse, other, better], lambda line: None, in_full=True)
    assert look.order == [better, other] and look.in_full
    assert look.gains["rolling_resistance"] == gain_over(kept, better)


@pytest.mark.parametrize("size, found", [(0.05, False), (1.0, True)])
def test_a_gain_without_a_size_is_no_effect(size, found):
    kept = family((), Bowl(np.array([0.0]), floor=1.2), [0.0])
    wider = family(("rolling_resistance",), Bowl(np.array([0.0, size])), [0.0, size])
    assert there(ranked(kept, [wider], lambda line: None), second=False) is found
    assert not there(Look(kept, [], {}), second=False)
