"""One look further, on bowls in place of fits: the race, the challenge, gains and sizes."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover import window_rules as rules
from rockref.discover.fit.families import gain_over, mean_loss, room
from rockref.discover.looking import look as looking
from rockref.discover.looking.look import Look, challenge, race, ranked, there
from rockref.discover.looking.screen import Trial
from tests.unit.discover.bowls import ALONE, Bowl, family, series


def test_who_falls_far_behind_the_leader_stays_where_it_is():
    start = family((), Bowl(np.array([0.0]), floor=1.2), [0.0])
    good = Bowl(np.array([0.0, 0.2]), floor=1.0)
    bad = Bowl(np.array([0.0, 0.2]), floor=1.19)
    found = race(ALONE, [family(("a",), good, [0.0, 0.0]), family(("b",), bad, [0.0, 0.0])], start, seed=0)
    assert good.iterations == looking.ITERATIONS and bad.iterations == 1
    assert gain_over(start, found[0]) > gain_over(start, found[1])


def test_a_race_that_nobody_leads_ends_early():
    start = family((), Bowl(np.array([0.0])), [0.0])
    bowls = [Bowl(np.array([0.0, 0.001])) for _ in range(3)]
    race(ALONE, [family(("a",), b, [0.0, 0.0]) for b in bowls], start, seed=0)
    assert all(b.iterations == 2 for b in bowls)


def test_an_effect_that_only_found_a_better_valley_loses_its_gain():
    """The baseline is stuck at z = 0.3; begun where the effect's fit ended, it is as good without the effect."""
    kept = family((), Bowl(np.array([0.0]), stuck=True), [0.3])
    wider = family(("rolling_resistance",), Bowl(np.array([0.0, 0.0])), [0.0, 0.4])
    wider.point = wider.fit.point([0.0, 0.0], wider.point.corrections)[0]
    gain = gain_over(kept, wider)
    assert gain > 100
    look = Look(kept, [wider], {"rolling_resistance": gain})
    challenge(look, wider, 0, print)
    assert look.gains["rolling_resistance"] == pytest.approx(0.0, abs=1e-9)
    assert look.kept.point.z[0] == 0.0


def test_an_effect_that_is_there_keeps_its_gain():
    kept = family((), Bowl(np.array([0.0]), floor=1.2, stuck=True), [0.0])
    wider = family(("rolling_resistance",), Bowl(np.array([0.0, 0.5]), floor=1.0), [0.0, 0.5])
    gain = gain_over(kept, wider)
    look = Look(kept, [wider], {"rolling_resistance": gain})
    challenge(look, wider, 0, print)
    assert look.gains["rolling_resistance"] == gain > 100


def test_no_challenge_where_the_cuts_have_moved():
    kept = family((), Bowl(np.array([0.0])), [0.3])
    wider = family(("gyro_scale",), Bowl(np.array([0.0, 0.0]), series=series(7)), [0.0, 0.0])
    look = Look(kept, [wider], {"gyro_scale": 500.0})
    challenge(look, wider, 0, print)
    assert look.gains == {"gyro_scale": 500.0} and look.kept is kept


@pytest.mark.parametrize(
    ("size", "in_full", "doubted"), [(0.1, False, True), (0.22, False, True), (0.3, False, False), (0.1, True, False)]
)
def test_who_leads_by_a_trifle_is_challenged_before_anyone_is_fitted_in_full(size, in_full, doubted):
    """The family is stuck at z = 0.3, and as good without the effect where that one ended. Of a second effect a quarter
    of its typical size is a trifle."""
    kept = family(("adhesion",), Bowl(np.array([0.0]), stuck=True), [0.3])
    wider = family(("adhesion", "rolling_resistance"), Bowl(np.array([0.0, size])), [0.0, size])
    look = Look(kept, [wider], {"rolling_resistance": gain_over(kept, wider)}, in_full)
    lines = []
    looking.doubt_trifle(look, True, 0, lines.append)
    assert bool(lines) == doubted == (look.kept.point.z[0] == 0.0)
    assert rules.is_detected(look.gains["rolling_resistance"], np.inf, True) != doubted


def test_a_look_at_nobody_doubts_nobody():
    looking.doubt_trifle(Look(family((), Bowl(np.array([0.0])), [0.0]), [], {}), False, 0, pytest.fail)


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


def test_of_two_fits_of_one_name_the_one_with_fewer_windows_out_of_step_goes_on():
    """A gain is clipped window by window: it hears that half of the windows are nearer, not that they have arrived."""
    kept = family((), Bowl(np.array([0.0]), floor=1.1), [0.0])
    nearer = family(("rolling_resistance",), Bowl(np.array([0.0, 1.0]), floor=1.0), [0.0, 1.0])
    kept.point.loss[::2] *= 4.0
    nearer.point.loss[::2] *= 3.0
    arrived = family(("rolling_resistance",), Bowl(np.array([0.0, 1.0]), floor=1.02), [0.0, 1.0])
    assert gain_over(kept, nearer) > gain_over(kept, arrived) and mean_loss(nearer) > mean_loss(arrived)
    for families in ([nearer, arrived], [arrived, nearer]):
        look = ranked(kept, families, lambda line: None)
        assert look.order == [arrived]
        assert look.gains["rolling_resistance"] == gain_over(kept, nearer)


def left(effects, share):
    """A family that leaves this share of its windows structured."""
    z = [0.0, 1.0][: len(effects) + 1]
    found = family(effects, Bowl(np.array(z)), z)
    found.point.loss[: round(share * len(found.point.loss))] *= 4.0
    return found


@pytest.mark.parametrize(
    "promised, size, stuck, smoothed",
    [(100.0, 0.3, True, True), (20.0, 0.3, True, False), (100.0, 0.02, True, False), (100.0, 0.3, False, False)],
    ids=["promised and not gained", "hardly promised", "promised of a trifle", "gained"],
)
def test_where_no_step_gains_what_it_promises_a_candidate_goes_on_from_averages(
    monkeypatch, promised, size, stuck, smoothed
):
    start = family((), Bowl(np.zeros(1), floor=1.0 + size**2, stuck=True), [0.0])
    there = np.array([0.0, size])
    f = family(("rolling_resistance",), Bowl(there, stuck=stuck), [0.0, 0.0])
    trial = Trial(f.effects, promised + 10.0, 0.0, f.fit, f.point, promised, there)
    asked = []

    def averaged(setup, found, seed):
        asked.append(found.effects)
        return family(found.effects, found.fit, there)

    monkeypatch.setattr(looking, "screen", lambda *a: [trial])
    monkeypatch.setattr(looking, "averaged", averaged)
    families = looking.from_near(ALONE, (), start, 0)
    assert asked == ([f.effects] if smoothed else [])
    gain = max(gain_over(start, found) for found in families)
    assert (gain > rules.DETECTED) is (smoothed or not stuck)


def test_a_trifle_that_gains_something_keeps_nobody_from_averages(monkeypatch):
    start = family((), Bowl(np.zeros(1), floor=1.05, stuck=True), [0.0])
    small, there = np.array([0.0, 0.02]), np.array([0.0, 0.0, 0.3])
    trifle = family(("rolling_resistance",), Bowl(small, stuck=True), small)
    other = family(("quadratic_drag",), Bowl(there, floor=0.95, stuck=True), [0.0, 0.0, 0.0])
    trials = [
        Trial(trifle.effects, 170.0, 160.0, trifle.fit, trifle.point, 160.0, small),
        Trial(other.effects, 110.0, 0.0, other.fit, other.point, 100.0, there),
    ]
    monkeypatch.setattr(looking, "screen", lambda *a: trials)
    monkeypatch.setattr(looking, "averaged", lambda setup, f, seed: family(f.effects, f.fit, there))
    families = looking.from_near(ALONE, (), start, 0)
    assert gain_over(start, families[0]) > rules.DETECTED
    assert max(families, key=lambda f: gain_over(start, f)).effects == other.effects


@pytest.mark.parametrize(
    "at_first, near, far, asked",
    [
        pytest.param(0.15, 0.0, 0.0, ["near"], id="near, and a small step leads on"),
        pytest.param(0.05, 0.05, 0.0, ["near"], id="near, and too little is structured"),
        pytest.param(0.1, 0.1, 0.0, ["near", "far"], id="near, and no small step leads on"),
        pytest.param(0.4, 0.0, 0.0, ["far"], id="far off"),
        pytest.param(0.4, 0.0, 0.4, ["far", "near"], id="far off, and nothing leads on there"),
        pytest.param(0.9, 0.9, 0.9, ["far"], id="too far off for small steps"),
    ],
)
def test_where_candidates_begin(monkeypatch, at_first, near, far, asked):
    """Shares of structured windows: at first, and with the candidate, begun where the family is or far from it."""
    seen: list[str] = []

    def way(name, share):
        def found(*_):
            seen.append(name)
            return [left(("rolling_resistance",), share)]

        return found

    monkeypatch.setattr(looking, "candidates_beside", lambda setup, effects: ())
    monkeypatch.setattr(looking, "refit", lambda family, *_: family)
    monkeypatch.setattr(looking, "from_near", way("near", near))
    monkeypatch.setattr(looking, "from_far", way("far", far))
    look = looking.look_further(ALONE, left((), at_first), 0, lambda line: None)
    assert seen == asked and look.in_full == ("far" in asked)


@pytest.fixture
def fought(monkeypatch):
    """A duel in which those asked end at given floors; who was begun anew, and beside whom, comes back."""
    asked = SimpleNamespace(anew=None, valley=None)

    def prepare(look, anew, valley=()):
        def fitted_anew(setup, begun, kept, say, sure):
            asked.anew = (list(begun), sure)
            return list(anew)

        def in_the_valley_of(setup, winner, others, kept):
            asked.valley = (winner.effects, others)
            return list(valley)

        monkeypatch.setattr(looking, "candidates_beside", lambda setup, effects: ())
        monkeypatch.setattr(looking, "own_z", lambda setup, effects: np.zeros(1))
        monkeypatch.setattr(looking, "fitted_anew", fitted_anew)
        monkeypatch.setattr(looking, "in_the_valley_of", in_the_valley_of)
        return looking.duel(ALONE, look, lambda line: None), asked

    return prepare


LEVER, DRAG = ("rolling_resistance",), ("quadratic_drag",)


def at(effects, floor):
    z = [0.0, 1.0] if effects else [0.0]
    return family(effects, Bowl(np.array(z), floor=floor), z)


def gains_of(lever, drag):
    return {"rolling_resistance": lever, "quadratic_drag": drag}


def test_a_plain_winner_that_is_clean_and_alone_needs_no_duel(fought):
    kept, winner, rival = at((), 1.5), at(LEVER, 1.0), at(DRAG, 1.4)
    best, asked = fought(Look(kept, [winner, rival], gains_of(2 * looking.PLAIN, 100.0)), [])
    assert best is winner and asked.anew is None


def test_a_near_rival_is_fitted_afresh_and_may_win(fought):
    kept, winner, rival = at((), 1.2), at(LEVER, 1.1), at(DRAG, 1.12)
    better = at(DRAG, 1.0)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    best, asked = fought(look, [better])
    assert best is better and asked.anew == ([LEVER, DRAG], LEVER)
    # The gain is not plain: the others begin once more where the winner ended.
    assert asked.valley == (DRAG, [LEVER])
    assert [f.effects for f in look.order] == [DRAG, LEVER]
    assert look.gains["quadratic_drag"] == pytest.approx(gain_over(kept, better))


def test_after_a_plain_gain_nobody_begins_again_where_the_winner_ended(fought, monkeypatch):
    monkeypatch.setattr(looking, "PLAIN", 100.0)
    kept, winner, rival = at((), 1.2), at(LEVER, 1.0), at(DRAG, 1.02)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    best, asked = fought(look, [at(DRAG, 1.01)])
    assert best.effects == LEVER and asked.anew is not None and asked.valley is None
    assert look.gains["quadratic_drag"] > gain_over(kept, rival)


@pytest.fixture
def much(monkeypatch):
    """The bowls' gains count as much."""
    monkeypatch.setattr(rules, "WELL_ABOVE_NOISE", 100.0)


def test_without_much_of_a_gain_a_winner_at_the_noise_is_fitted_afresh_with_all_others(fought):
    """Round feet gained 283 units where a trifle of a scale had ended, and 408 fitted afresh."""
    kept, winner, rival = at((), 1.2), at(LEVER, 0.9), at(DRAG, 1.05)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    assert gain_over(kept, winner) < rules.WELL_ABOVE_NOISE
    _, asked = fought(look, [at(DRAG, 0.95)])
    assert asked.anew == ([LEVER, DRAG], LEVER)


def test_a_winner_at_the_noise_stands_against_rivals_begun_in_its_valley_alone(fought, much):
    kept, winner, rival = at((), 1.2), at(LEVER, 0.9), at(DRAG, 1.05)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    best, asked = fought(look, [], valley=[at(DRAG, 0.95)])
    assert best is winner and asked.anew is None and asked.valley == (LEVER, [DRAG])
    assert look.gains["quadratic_drag"] == pytest.approx(gain_over(kept, at(DRAG, 0.95)))


def test_a_winner_at_the_noise_that_loses_in_its_own_valley_is_fitted_afresh_with_all_others(fought, much):
    kept, winner, rival = at((), 1.2), at(LEVER, 0.96), at(DRAG, 1.05)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    better = at(DRAG, 0.9)
    best, asked = fought(look, [better], valley=[better])
    assert best is better and asked.anew == ([LEVER, DRAG], LEVER)


def test_a_winner_that_may_come_down_to_the_noise_is_taken_on_before_the_duel(fought, much):
    """It began a third of a size off, where it leaves less than it gains."""
    kept, rival = at((), 1.4), at(DRAG, 1.39)
    winner = family(LEVER, Bowl(np.array([0.0, 1.0]), floor=0.95), [0.0, 0.7])
    assert 0 < room(winner) < gain_over(kept, winner)
    look = Look(kept, [winner, rival], gains_of(gain_over(kept, winner), gain_over(kept, rival)))
    best, asked = fought(look, [], valley=[])
    assert best.effects == LEVER and best.point.z[1] > 0.95 and asked.anew is None
