"""Rows that show something else than what the run goes on with speak of the run (S2); wrong forces that move the block
do not."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.handed_out import rule_of_what_is_shown
from rockref.conformance.judge.compare_answer import Check
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict


class Shown:
    """The law's runs, their rows changed where they are handed out."""

    name, precision = "shown otherwise", "float64"

    def __init__(self, change):
        self.change = change

    def simulate(self, problem):
        rows = dict(vars(NumpyEngine().simulate(problem)))
        return rows | self.change({k: np.array(rows[k]) for k in ("W", "x", "Lambda", "F")})


def forces_at_another_scale(rows):
    return {"F": rows["F"] / 9.81}


def attitudes_late(rows):
    return {"Lambda": np.concatenate([rows["Lambda"][:1], rows["Lambda"][:-1]])}


def attitudes_of_the_start(rows):
    return {"Lambda": np.broadcast_to(rows["Lambda"][0], rows["Lambda"].shape)}


def rates_averaged(rows):
    return {"W": (rows["W"] + np.concatenate([rows["W"][:1], rows["W"][:-1]])) / 2}


def rates_averaged_and_turned_by(rows):
    apart = rates_averaged(rows)["W"] - rows["W"]
    turn = np.cross(apart[:, None, :], np.eye(3)[None]) * 2.0**-17
    return {"W": rows["W"] + apart, "Lambda": rows["Lambda"] + turn}


def forces_and_places(rows):
    return {"F": rows["F"] / 9.81, "x": rows["x"] + np.arange(len(rows["x"]))[:, None] * 1e-9}


@pytest.mark.parametrize(
    ("change", "rule"),
    [
        (forces_at_another_scale, "S2"),
        (attitudes_late, "S2"),
        (attitudes_of_the_start, "I3"),
        (rates_averaged, "S2"),
    ],
)
def test_what_moves_nothing_is_handed_out_otherwise(change, rule):
    found = verdict(judge(Shown(change), ["L5s"]))
    assert found.status == "FAIL" and found.rule == rule, (found.rule, found.check, found.says)


def test_rates_by_which_the_block_turns_are_not_idle():
    answers = [(v, Shown(rates_averaged_and_turned_by).simulate(vectors.problem_of(v.inputs)))
               for v in vectors.layer("L5s")]  # fmt: skip
    told = Check("L5s-I5-0014", "L5s", "I5", "W@1", "outside")
    assert rule_of_what_is_shown(answers, [told], told) == ("I5", "")


def test_forces_that_move_the_block_are_not_idle():
    answers = [(v, Shown(forces_and_places).simulate(vectors.problem_of(v.inputs))) for v in vectors.layer("L5s")[:40]]
    told = Check("L5s-N1-0019", "L5s", "N1", "F_N@0", "outside")
    assert rule_of_what_is_shown(answers, [told], told) == ("N1", "")


def test_forces_too_small_to_be_seen_are_not_idle():
    """A millionth of a newton moves no block by a digit: nothing says that it is not the force that moves it."""

    def hardly(rows):
        return {"F": rows["F"] * (1 + 1e-9)}

    answers = [(v, Shown(hardly).simulate(vectors.problem_of(v.inputs))) for v in vectors.layer("L5s")[:40]]
    told = Check("L5s-N1-0019", "L5s", "N1", "F_N@0", "outside")
    assert rule_of_what_is_shown(answers, [told], told) == ("N1", "")
