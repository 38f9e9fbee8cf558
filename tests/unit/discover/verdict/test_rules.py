"""The verdict as a function of evidence."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, Number, log_evidence
from rockref.discover.fit.objective import WHITE
from rockref.discover.verdict.calibration import calibration
from rockref.discover.verdict.rules import VERDICTS, decide
from rockref.discover.verdict.sentences import sentence

C = calibration()


def hypothesis(effects=(), objective=17000.0, size=1.0, loss=0.94, held=0.95, **changes) -> HypothesisEvidence:
    numbers = {f"{e}.size": Number(size, 0.9 * size, 1.1 * size, "1", size / 3, size) for e in effects}
    by_run = {run: [loss] * 3 for run in ("01", "02", "04")}
    found = HypothesisEvidence(
        effects, objective, [1e4] * (10 + len(effects)), loss, by_run, dict.fromkeys(by_run, 0.0), 1.0, numbers,
        held_out={"03": held},
    )  # fmt: skip
    return replace(found, **changes)


def evidence(*hypotheses: HypothesisEvidence) -> Evidence:
    return Evidence("made up", "0", 36000, {"03": 9000}, list(hypotheses))


NULL = hypothesis(objective=19000.0, loss=1.06, held=1.06)
DRAG = hypothesis(("quadratic_drag",))


def test_a_baseline_that_explains_is_none():
    v = decide(evidence(hypothesis(), hypothesis(("quadratic_drag",), 16996.0)))
    assert (v.word, v.effects) == ("none", ()) and v.probability > C.trust * C.certain


def test_an_effect_that_leads_is_named():
    v = decide(evidence(NULL, DRAG))
    assert (v.word, v.effects) == ("named", ("quadratic_drag",)) and v.probability > C.trust * C.certain


def test_what_chance_gains_counts_for_nothing():
    weak = hypothesis(objective=17300.0, loss=0.96, held=0.97)
    named = evidence(weak, DRAG)
    assert decide(named).word == "named"
    # Of 300 nats an effect that is not there gains 290: with odds and what a number costs, nothing is left.
    assert decide(replace(named, chance=290.0)).word == "none"
    told = replace(named, chance=290.0)
    assert "290 nats by chance" in sentence(decide(told), told)
    assert "by chance" not in sentence(decide(named), named)
    # What gains by thousands stands, and the second of a pair has to gain more than chance.
    assert decide(replace(evidence(NULL, DRAG), chance=290.0)).word == "named"
    both = hypothesis(("quadratic_drag", "gyro_scale"), 16750.0)
    assert decide(replace(evidence(NULL, DRAG, both), chance=290.0)).effects == ("quadratic_drag",)


def test_a_companion_has_to_gain_more_than_another_form_of_the_first_would():
    """Effects with one well-known number each: the second gains what another form leaves, or clearly more."""
    little, more = (hypothesis(("quadratic_drag", "gyro_scale"), DRAG.objective - gain) for gain in (75.0, 150.0))
    assert decide(evidence(NULL, DRAG, little)).effects == ("quadratic_drag",)
    assert set(decide(evidence(NULL, DRAG, more)).effects) == {"quadratic_drag", "gyro_scale"}
    # As the only effect it is believed for as little.
    alone = hypothesis(("quadratic_drag",), NULL.objective - 75.0)
    assert decide(evidence(NULL, alone)).effects == ("quadratic_drag",)


def test_two_effects_are_a_pair():
    v = decide(evidence(NULL, DRAG, hypothesis(("quadratic_drag", "gyro_scale"), 16000.0)))
    assert (v.word, set(v.effects)) == ("pair", {"gyro_scale", "quadratic_drag"})


def test_the_effect_without_which_the_runs_are_explained_worst_comes_first():
    scale = hypothesis(("gyro_scale",), 17500.0)
    both = hypothesis(("quadratic_drag", "gyro_scale"), 16000.0)
    for drag, first in (hypothesis(("quadratic_drag",), 17000.0), "quadratic_drag"), (
        hypothesis(("quadratic_drag",), 18000.0), "gyro_scale"
    ):  # fmt: skip
        assert decide(evidence(NULL, drag, scale, both)).effects[0] == first


def test_what_all_probable_sets_hold_is_named_and_what_may_be_beside_it_is_said():
    more = [hypothesis(("quadratic_drag", e), 16905.0) for e in ("gyro_scale", "inertia_deviation")]
    v = decide(evidence(NULL, DRAG, *more))
    assert (v.word, v.effects, v.reason) == ("named", ("quadratic_drag",), "or_more")
    assert v.probability > C.trust * C.certain and v.best.effects == ("quadratic_drag",)
    assert "may be there" in sentence(v, evidence(NULL, DRAG, *more))


def test_what_held_out_runs_do_not_show_is_indicated():
    v = decide(evidence(replace(NULL, held_out={"03": 0.95}), DRAG))
    assert (v.word, v.reason) == ("indicated", "held_out")
    assert decide(evidence(NULL, replace(DRAG, held_out={}))).word == "indicated"


def test_rivals_that_explain_alike_are_a_class():
    v = decide(evidence(NULL, DRAG, hypothesis(("cable_restraint",), 17004.0)))
    assert v.word == "class" and set(v.effects) == {"quadratic_drag", "cable_restraint"}


def test_stated_probabilities_leave_room_for_what_the_search_misses():
    e = evidence(hypothesis(), hypothesis(("quadratic_drag",), 15000.0))
    v, sure = decide(e), decide(e, replace(C, trust=1.0))
    assert v.word == sure.word and v.effects == sure.effects
    assert v.probability == C.trust * sure.probability < 1.0
    assert sum(a.probability for a in v.alternatives) == pytest.approx(C.trust)


def test_a_trifle_gives_its_probability_to_the_baseline():
    small = hypothesis(("quadratic_drag",), 16500.0, size=0.1)
    assert decide(evidence(hypothesis(), small)).word == "none"


def test_what_alone_explains_the_runs_is_no_trifle():
    small = hypothesis(("viscous_friction",), 9400.0, size=0.1)
    beside = hypothesis(("viscous_friction", "gyro_drift"), 9399.0, size=0.1)
    far = hypothesis(objective=205000.0, loss=19.0, held=19.0)
    v = decide(evidence(small, beside, far))
    assert (v.word, v.effects) == ("named", ("viscous_friction",))
    # What explains the runs without it takes its place.
    other = hypothesis(("hunt_crossley_contact",), 9300.0)
    assert decide(evidence(small, far, other)).effects == ("hunt_crossley_contact",)


def test_what_nothing_explains_is_something_else():
    v = decide(evidence(hypothesis(loss=1.8), hypothesis(("quadratic_drag",), 16000.0, loss=1.5)))
    assert (v.word, v.effects) == ("something_else", ())


def test_another_law_behind_the_same_name_is_indicated():
    null = hypothesis(objective=190000.0, loss=11.0, held=11.0)
    more = hypothesis(("quadratic_drag", "adhesion"), 16990.0, loss=1.28)
    found = evidence(null, hypothesis(("quadratic_drag",), loss=1.3), more)
    v = decide(found)
    assert (v.word, v.effects, v.reason) == ("indicated", ("quadratic_drag",), "remnant")
    assert "96 %" in sentence(v, found) and v.probability > C.trust * C.certain
    too_much = WHITE + 1.2 * C.remnant * (11.0 - WHITE)
    assert decide(evidence(null, hypothesis(("quadratic_drag",), loss=too_much))).word == "something_else"


def test_what_others_could_replace_is_not_named_beside_another_law():
    """Without the first, all is left; without the second, another one does nearly as well."""
    null = hypothesis(objective=190000.0, loss=11.0, held=11.0)
    rival = hypothesis(("cable_restraint", "gyro_drift"), 20000.0, loss=2.3)
    found = evidence(null, hypothesis(("cable_restraint", "plate_tilt"), loss=2.0), rival)
    v = decide(found)
    assert (v.word, v.effects, v.reason) == ("indicated", ("cable_restraint",), "remnant")
    assert "with plate_tilt beside it" in sentence(v, found)
    # Nearly all probability is on sets that hold it, though hardly any on the one that is told.
    assert v.probability > C.trust * C.certain
    # Where each could be replaced, or none, all of them are told.
    other = hypothesis(("plate_tilt", "gyro_scale"), 20000.0, loss=2.3)
    for rivals in ((), (rival, other)):
        v = decide(replace(found, hypotheses=(null, found.hypotheses[1], *rivals)))
        assert set(v.effects) == {"cable_restraint", "plate_tilt"}


def test_an_effect_that_explains_a_part_of_what_another_form_leaves_is_not_named():
    null = hypothesis(objective=60000.0, loss=3.0, held=3.0)
    first = hypothesis(("cable_restraint",), 20000.0, loss=WHITE + 0.1)

    def with_drag(left):
        more = hypothesis(("cable_restraint", "quadratic_drag"), 17000.0, loss=WHITE + left)
        return decide(evidence(null, first, more))

    v = with_drag(0.04)
    assert (v.word, v.effects, v.reason) == ("indicated", ("cable_restraint",), "remnant")
    # What is there explains all of it; and where the first leaves more than another form would, the second is needed.
    assert set(with_drag(0.01).effects) == {"cable_restraint", "quadratic_drag"}
    first = hypothesis(("cable_restraint",), 30000.0, loss=WHITE + 1.0)
    assert set(with_drag(0.05).effects) == {"cable_restraint", "quadratic_drag"}


def test_a_fault_of_the_sensor_is_not_blamed_on_the_block():
    found = replace(evidence(hypothesis(loss=1.8)), sensor_faults=("run01.csv hums at 50 Hz",))
    v = decide(found)
    assert (v.word, v.reason) == ("something_else", "sensor")
    assert "50 Hz" in sentence(v, found) and "moves the block" not in sentence(v, found)


def test_one_axis_of_one_run_is_enough():
    axes = {"01": [0.94, 0.94, 0.94], "02": [0.94, 0.94, 1.5], "04": [0.94, 1.4, 0.94]}
    assert decide(evidence(hypothesis(loss_by_run_and_axis=axes))).word == "something_else"


def test_a_run_that_contradicts_the_others_is_named():
    axes = {"01": [0.94] * 3, "02": [4.0] * 3, "04": [0.94] * 3}
    v = decide(evidence(hypothesis(loss_by_run_and_axis=axes, loss=2.0)))
    assert (v.word, v.run) == ("not_trustworthy", "02")


@pytest.mark.parametrize("more", [0, 1])
def test_effects_of_the_users_model_are_no_finding(more):
    carried = ("gyro_scale",)
    fits = [hypothesis(carried), hypothesis((*carried, "quadratic_drag"), 16500.0 if more else 16990.0)]
    v = decide(replace(evidence(*fits), carried=carried))
    assert v.effects == (("quadratic_drag",) if more else ())


def test_occam_costs_more_for_more_numbers():
    few, many = hypothesis(("a",)), hypothesis(("b",), eigenvalues=[1e4] * 18)
    assert log_evidence(few, C.temperature) > log_evidence(many, C.temperature) + 7 * 0.5 * np.log(1e4 / C.temperature)


def test_every_verdict_has_a_sentence():
    found = [
        evidence(hypothesis()), evidence(NULL, DRAG), evidence(NULL, replace(DRAG, held_out={})),
        evidence(NULL, DRAG, hypothesis(("cable_restraint",), 17004.0)),
        evidence(NULL, DRAG, hypothesis(("quadratic_drag", "gyro_scale"), 16000.0)), evidence(hypothesis(loss=1.8)),
        evidence(hypothesis(loss_by_run_and_axis={"01": [0.94] * 3, "02": [4.0] * 3, "04": [0.94] * 3}, loss=2.0)),
    ]  # fmt: skip
    said = {decide(e).word: sentence(decide(e), e) for e in found}
    assert set(said) == set(VERDICTS)
    assert all(text.endswith(".") for text in said.values())


def test_evidence_is_stored_and_read_back(tmp_path):
    e = evidence(NULL, DRAG)
    e.save(tmp_path / "evidence.json")
    assert Evidence.load(tmp_path / "evidence.json") == e
    assert decide(Evidence.load(tmp_path / "evidence.json")) == decide(e)


def test_there_are_at_most_twelve_numbers_and_each_says_what_it_means():
    import tomllib
    from importlib.resources import files

    table = tomllib.loads((files("rockref.discover.verdict") / "calibration.toml").read_text())
    assert len(table) <= 12
    for entry in table.values():
        assert set(entry) == {"value", "meaning", "calibrated"}
