"""Stages as data: their order, what is foretold, and what may be left out."""

import pytest

from rockref.discover.progress import StageCounter, StageReport, time_left

SHARES = {"baseline": 1.0, "starts": 4.0, "effects": 3.0, "evidence": 2.0}


@pytest.fixture
def counted():
    """A counter on a clock that is set by hand, and what it reported."""
    now, said = [0.0], []
    return StageCounter(SHARES, said.append, lambda: now[0]), now, said


def test_the_time_left_follows_the_shares_of_the_stages(counted):
    counter, now, said = counted
    counter.begin("baseline", "fitting the baseline")
    assert said == [StageReport(1, 4, "fitting the baseline")]
    now[0] = 10.0
    counter.begin("starts", best="the baseline")
    # Ten seconds a share: 4 + 3 + 2 shares are left.
    assert said[-1] == StageReport(2, 4, "starts", "the baseline", 90.0)
    now[0] = 30.0
    counter.say("loss 3.1")
    assert said[-1].line == "loss 3.1" and said[-1].seconds_left == pytest.approx(70.0)
    now[0] = 100.0  # the stage takes longer than foretold: those that follow are left
    assert counter.seconds_left() == pytest.approx(50.0)


def test_a_stage_that_is_passed_over_costs_nothing(counted):
    counter, now, said = counted
    counter.begin("baseline")
    now[0] = 10.0
    counter.begin("evidence")
    assert said[-1].step == 4 and said[-1].seconds_left == pytest.approx(20.0)


def test_stages_never_go_back_and_the_best_is_reported_once(counted):
    counter, _, said = counted
    counter.begin("effects"), counter.begin("baseline"), counter.begin("nobody knows"), counter.begin("effects")
    assert [report.step for report in said] == [3]
    counter.note("adhesion"), counter.note("adhesion")
    assert [report.best for report in said] == ["", "adhesion"]
    counter.begin("effects", "comparing 30 effects beside adhesion")
    assert (said[-1].step, said[-1].name) == (3, "comparing 30 effects beside adhesion")


@pytest.mark.parametrize("seconds, words", [(2, "about 5 s left"), (42, "about 40 s left"), (150, "about 2 min left")])
def test_an_estimate_is_said_as_one(seconds, words):
    assert time_left(seconds) == words


def test_nothing_is_foretold_from_a_short_first_stage():
    """A minute of compiling within a stage of a twentieth would be twenty minutes."""
    now, said = [0.0], []
    counter = StageCounter({"first": 5.0, "second": 45.0, "third": 50.0}, said.append, lambda: now[0])
    counter.begin("first")
    now[0] = 60.0
    counter.begin("second")
    assert said[-1].seconds_left is None
    now[0] = 100.0
    counter.begin("third")
    assert said[-1].seconds_left == pytest.approx(100.0)
