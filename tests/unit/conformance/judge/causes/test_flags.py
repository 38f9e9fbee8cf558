"""Flags of contact that speak of no rule of their own."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends import call, richardson
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.causes.flags import (
    first_steps_are_right,
    one_foot,
    rule_of_lost_numbers,
    without_flags_in_company,
    without_late_flags,
    without_lost_numbers,
)
from rockref.conformance.judge.causes.rows_of_the_law import feet_at_the_start
from rockref.conformance.judge.compare_answer import Check, compare


def test_flags_that_follow_from_wrong_forces_name_no_rule():
    """Flags of the row before alone are handed out late (S2); where the contact is late, forces are wrong, too."""
    flag = Check("L5s-S2-0159", "L5s", "S2", "anchored@2", "outside")
    force = Check("L5s-S1-0031", "L5s", "S1", "F_N@1", "outside")
    assert without_late_flags([flag]) == [flag] and without_late_flags([flag, force]) == [force]
    assert without_late_flags([flag, replace(force, name="F_N@0")])[0] == flag


def test_what_is_right_in_first_steps_is_handed_on_wrongly():
    """Rows that lie sixteen steps apart show more than a first step."""
    answers = [(v, {}) for v in vectors.layer("L5s")]
    second, far = (
        Check(v, "L5s", "I4", name, "outside") for v, name in (("L5s-I4-0006", "x@2"), ("L5s-I5-0164", "W@1"))
    )
    assert first_steps_are_right([second, far], answers)
    for name in ("x@1", "F_T@0"):
        assert not first_steps_are_right([second, replace(second, name=name)], answers)
    assert first_steps_are_right([second, replace(second, name="x@1", layer="L4")], answers)


def test_places_that_are_no_numbers_leave_the_word_to_wrong_numbers():
    """A division by zero may be of any rule; what is no number by itself, or is a force, keeps its word."""
    lost = Check("L5s-N1-0019", "L5s", "N1", "x@1", "outside", got=np.nan)
    wrong = Check("L5s-T1-0046", "L5s", "T1", "x@1", "outside", got=0.5)
    assert without_lost_numbers([lost]) == [lost]
    assert without_lost_numbers([lost, wrong]) == [wrong]
    assert without_lost_numbers([lost, replace(wrong, follows=True)])[0] == lost
    assert without_lost_numbers([replace(lost, name="F_N@0"), wrong])[1] == wrong
    assert len(without_lost_numbers([replace(lost, name="F_N@0"), wrong])) == 2


@pytest.mark.parametrize(
    ("lost", "rule"),
    [(lambda f: not np.any(f["dragged"]), "T2"), (lambda f: True, "N1"), (lambda f: np.all(f["dragged"]), "N1")],
)
@pytest.mark.parametrize(("name", "engine"), [("L5s", call), ("LS", richardson)])
def test_feet_without_friction_of_which_places_are_lost_are_held_to_slide(name, engine, lost, rule):
    """Places that are lost after feet that are dragged may be of any rule."""
    answers = []
    for v in vectors.layer(name)[:70]:
        out, feet = dict(engine.ask(NumpyEngine(), v)), feet_at_the_start(v.id)
        if feet is not None and np.any(feet["touching"]) and lost({k: a[feet["touching"]] for k, a in feet.items()}):
            out["x"] = out["x"] * np.nan
        answers.append((v, out))
    check = Check(f"{name}-N1-0019", name, "N1", "x@1", "outside", got=np.nan)
    assert rule_of_lost_numbers(answers, [], check)[0] == rule
    assert rule_of_lost_numbers(answers, [], replace(check, got=0.5)) == ("N1", "")


def failed_with(change):
    """The rules of the failures that are left, by what is wrong: `change` gives the answer to a run from the law's."""
    answers = [(v, change(v, dict(ask(NumpyEngine(), v)))) for v in vectors.layer("L5s") if wanted(v)]
    checks = [c for v, out in answers for c in compare(v, out)]
    return {(c.rule, c.name) for c in without_flags_in_company(checks, answers) if c.failed}


def wanted(vector):
    return one_foot(vector) or "anchored@0" in vector.expect or vector.id.startswith("L5s-N1-002")


def open_in_company(vector, out):
    """The last of several feet that touch is flagged as open."""
    down = np.flatnonzero(out["anchored"][0])
    if len(down) > 1:
        out["anchored"] = np.array(out["anchored"])
        out["anchored"][0, down[-1]] = False
    return out


def test_flags_that_are_wrong_where_forces_are_right_are_handed_out_otherwise():
    assert failed_with(open_in_company) == {("S2", "anchored@0")}


def test_flags_that_are_wrong_in_company_leave_the_word_to_the_forces():
    def pushes_half(vector, out):
        return open_in_company(vector, out) | {"F": out["F"] * (1.0 if one_foot(vector) else 0.5)}

    assert {rule for rule, name in failed_with(pushes_half) if name.startswith("F_N")} == {"N1"}
    assert not any(name == "anchored@0" for _, name in failed_with(pushes_half))


def test_flags_speak_of_the_penetration_where_forces_of_one_foot_are_wrong():
    found = failed_with(lambda v, out: open_in_company(v, out) | {"F": out["F"] * 0.5})
    assert ("K1", "anchored@0") in found
