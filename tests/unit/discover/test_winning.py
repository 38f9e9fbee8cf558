"""Who wins a look, on bowls in place of fits: trifles, rivals that had not arrived, and effects that are none."""

import numpy as np
import pytest

from rockref.discover import verdict as rules
from rockref.discover.families import gain_over
from rockref.discover.looking import Look
from rockref.discover.winning import CONTENDS, to_the_end, upheld
from tests.unit.discover.bowls import ALONE, Bowl, family

ROLLING, DRAG = ("rolling_resistance",), ("quadratic_drag",)


def quiet(line):
    pass


def looked(kept, *order):
    """A look whose gains are those of its families over the one that was kept."""
    return Look(kept, list(order), {f.effects[-1]: gain_over(kept, f) for f in order})


def test_a_trifle_that_gains_most_gives_way_to_an_effect_with_a_size():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    trifle = family(ROLLING, Bowl(np.array([0.0, 0.1]), floor=1.0), np.array([0.0, 0.1]))
    whole = family(DRAG, Bowl(np.array([0.0, 0.0, 0.8]), floor=1.05), np.array([0.0, 0.0, 0.8]))
    look = looked(kept, trifle, whole)
    assert look.gains["rolling_resistance"] > look.gains["quadratic_drag"] > rules.DETECTED
    assert upheld(look, trifle, False, 0, quiet) is whole
    # Alone, the trifle is no effect; nor is a whole size that gains nothing.
    assert upheld(looked(kept, trifle), trifle, False, 0, quiet) is None
    idle = family(DRAG, Bowl(np.array([0.0, 0.0, 0.8]), floor=1.195), np.array([0.0, 0.0, 0.8]))
    assert upheld(looked(kept, trifle, idle), trifle, False, 0, quiet) is None


def test_a_baseline_that_does_as_well_from_there_leaves_no_effect():
    kept = family((), Bowl(np.array([0.5]), floor=1.0), np.array([-0.4]))
    wider = family(ROLLING, Bowl(np.array([0.5, 0.0]), floor=1.0), np.array([0.5, 0.4]))
    look = looked(kept, wider)
    assert look.gains["rolling_resistance"] > rules.DETECTED
    assert upheld(look, wider, False, 0, quiet) is None


def test_a_rival_that_had_not_arrived_overtakes():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.04), np.array([0.0, 0.5]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=1.0), np.array([0.0, 0.0, 0.77]))
    look = looked(kept, winner, rival)
    assert CONTENDS < look.gains["quadratic_drag"] / look.gains["rolling_resistance"] < 1
    best = to_the_end(ALONE, look, winner, False, 0, quiet)
    assert best.effects == DRAG
    assert [f.effects for f in look.order] == [DRAG, ROLLING]
    assert look.gains["quadratic_drag"] > look.gains["rolling_resistance"]


@pytest.mark.parametrize("noise, gap, ahead", [(1.0, 0.4, False), (2.0, 0.35, True)], ids=["far behind", "hopeless"])
def test_rivals_that_cannot_win_are_not_fitted_on(noise, gap, ahead):
    """One that gains too little; and one beside a winner that most windows contradict: another effect is missing."""
    kept = family((), Bowl(np.zeros(1), floor=noise + 0.2 + 0.1 * ahead, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=noise + 0.1 * ahead), np.array([0.0, 0.5]))
    rival = family(DRAG, Bowl(np.array([0.0, 0.0, 1.0]), floor=noise), np.array([0.0, 0.0, 1.0 - gap]))
    look = looked(kept, winner, rival)
    assert (look.gains["quadratic_drag"] > CONTENDS * look.gains["rolling_resistance"]) is ahead
    assert to_the_end(ALONE, look, winner, False, 0, quiet).effects == ROLLING
    assert rival.fit.iterations == 0


def test_what_ends_as_a_trifle_wins_only_if_nothing_else_is_there():
    kept = family((), Bowl(np.zeros(1), floor=1.2, stuck=True), np.zeros(1))
    winner = family(ROLLING, Bowl(np.array([0.0, 0.5]), floor=1.03), np.array([0.0, 0.5]))
    trifle = family(DRAG, Bowl(np.array([0.0, 0.0, 0.1]), floor=1.0), np.array([0.0, 0.0, 0.1]))
    look = looked(kept, winner, trifle)
    assert to_the_end(ALONE, look, winner, False, 0, quiet).effects == ROLLING
