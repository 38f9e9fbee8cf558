"""Vectors that show a decision whatever else a foot does: pieces and runs name the rule of one that asks for more."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "benchmarks"))
from strangers import Runs, planted, seen
from strangers_list import Mistake

CONE = "cone(F_N, sliding and anchored, mu_0, mu)"
SLIDES = "slides = not sticks(F_T, limit)"
MISTAKES = (
    Mistake("static coefficient for a foot that sinks", ("T6",), CONE,
            "cone(F_N, sliding and anchored and xi_rate <= 0, mu_0, mu)"),
    Mistake("static coefficient for a foot that is dragged back", ("T6",), CONE,
            "cone(F_N, sliding and anchored and (u_t - s) @ v_slide >= 0, mu_0, mu)"),
    Mistake("a new foot slides beyond twice the cone", ("T2",), SLIDES,
            "slides = not sticks(F_T, limit if anchored else 4 * limit)"),
    Mistake("turns below some billionths are none", ("I3",), "    if angle == 0:\n        return H\n",
            "    if angle < 2e-9:\n        return 0 * H\n"),
    Mistake("velocity in axes that lean where it moves the place", ("I1",), "x_next = x + h * v",
            "x_next = x + h * Lambda.T @ v"),
)  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES, ids=lambda m: m.says)
def test_pieces_name_it(mistake):
    found = seen(planted(mistake), mistake)
    assert found["named"], found


@pytest.mark.parametrize("mistake", MISTAKES[:1] + MISTAKES[2:], ids=lambda m: m.says)
@pytest.mark.parametrize("hidden", [(), ("F", "anchored")], ids=["forces", "no forces"])
def test_runs_name_it(mistake, hidden):
    found = seen(Runs(planted(mistake), {}, hidden), mistake)
    assert found["named"], found


def test_who_asks_whether_a_foot_slides_by_what_sliding_leaves_is_seen_by_runs():
    twice = "a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n"
    mistake = Mistake("two passes, the second with what the first left", ("T6", "S1", "T2"), twice,
                      twice + "    " + twice.replace("state,", "state | memory,"))  # fmt: skip
    found = seen(Runs(planted(mistake), {}), mistake)
    assert found["detected"] and found["named"], found
