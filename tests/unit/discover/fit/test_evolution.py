"""A population leaps out of valleys that a descent ends in."""

from types import SimpleNamespace

import numpy as np

from rockref.discover.fit.evolution import DISTINCT, children, descended, evolved, survivors
from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit.stages import S1
from rockref.discover.hypotheses.parameter import Parameter

#: Valleys of the landscape lie one apart in each number, and the deepest at this place.
DEEPEST = np.array([-2.0, 1.0])
NUMBERS = (*(Parameter(name, None, 0.0) for name in ("a", "b")), Parameter("roll_offset[0]", None, 0.0, run=0))


def depth(z: np.ndarray) -> float:
    """A bowl about the deepest place, with a dent at every whole number (Rastrigin's)."""
    away = z[:2] - DEEPEST
    return float(1 + away @ away / 4 + (1 - np.cos(2 * np.pi * away)).sum())


class Valleys:
    """A fitter of two numbers whose descent ends at the bottom of the nearest dent."""

    problem = SimpleNamespace(parameters=lambda effects=(): NUMBERS)

    def evaluate_all(self, field, stage):
        for h in field:
            h.loss = depth(h.z)

    def tempered(self, h, stage, most):
        h.z[:2] = np.rint(h.z[:2])
        h.loss = depth(h.z)


def fits(*places: tuple[float, ...]) -> list[FittedModel]:
    """Fits at these places, evaluated."""
    found = [FittedModel((), np.array([*at, 0.0])) for at in places]
    Valleys().evaluate_all(found, S1)
    return found


def test_a_population_finds_the_deepest_valley_where_no_descent_does():
    start = [(2.0, -2.0), (1.0, 2.0), (0.0, -1.0), (2.0, 1.0), (1.0, 0.0), (0.0, 2.0)]
    alone = fits(*start)
    descended(Valleys(), alone, S1)
    assert min(h.loss for h in alone) > 1.9
    ends = [evolved(Valleys(), fits(*start), S1, 6, np.random.default_rng(seed)) for seed in range(20)]
    # Chance leads the leaps: what counts is that most get far below what descents reach.
    assert sum(found[0].loss < 1.3 for found in ends) >= 15
    assert any(np.array_equal(found[0].z[:2], DEEPEST) for found in ends)
    assert all([h.loss for h in found] == sorted(h.loss for h in found) and len(found) == 6 for found in ends)


def test_who_gains_little_has_arrived():
    near, far = fits((-2.001, 1.0), (0.4, 0.4))
    assert descended(Valleys(), [near, far], S1) == [far]


def test_children_stay_within_the_prior_and_one_alone_has_itself():
    members = fits((2.4, -2.4), (-2.4, 2.4), (0.0, 0.0))
    rng = np.random.default_rng(0)
    born = [h.z for _ in range(50) for h in children(Valleys(), members, rng)]
    assert np.abs(born).max() <= 2.5 and np.ptp(born, axis=0)[0] == 5.0
    (only,) = children(Valleys(), members[:1], np.random.default_rng(0))
    assert np.array_equal(only.z, members[0].z)


def test_children_take_the_law_of_one_member_and_the_effect_of_another_with_its_numbers():
    one, two = (
        FittedModel((e,), np.array([at, at, 0.0, size]), loss=1.0) for e, at, size in (("a", 1, 5), ("b", 2, 7))
    )
    rng = np.random.default_rng(0)
    born = [h for _ in range(50) for h in children(Valleys(), [one, two], rng)]
    assert {(*h.effects, h.z[3]) for h in born} == {("a", 5.0), ("b", 7.0)}
    from_one = [h for h in born if h.z[0] in (0.5, 1.5)]  # one moved by half the difference; two never stands there
    assert {h.effects for h in from_one} == {("a",), ("b",)}


def test_fits_in_one_valley_count_once_whatever_their_releases():
    better, near, other = fits((0.0, 0.0), (0.9 * DISTINCT, 0.0), (1.1 * DISTINCT, 0.0))
    better.loss, near.loss, other.loss = 1.0, 1.1, 1.2
    near.z[2] = 2.0
    assert survivors(Valleys(), [other, near, better], 3) == [better, other]


def test_neither_one_effect_nor_one_valley_crowds_a_population():
    bent = [FittedModel((e,), np.zeros(3), loss=1 + k / 10) for k, e in enumerate("abc")]
    far = [FittedModel(("a",), np.array([k, 0.0, 0.0]), loss=k) for k in (2.0, 3.0, 4.0)]
    assert survivors(Valleys(), [*far, *bent], 9, 2) == [bent[0], bent[1], far[0]]
    assert survivors(Valleys(), [*far, *bent], 2, 2) == bent[:2]
