"""The command that a verb proposes: what was given is carried on, and a shell takes it as it is."""

import shlex
from types import SimpleNamespace

import pytest

from rockref.api import Model
from rockref.effects import catalogue
from rockref.report.terminal import next_command

OWN = SimpleNamespace(id="eddy_brake", file="my effects/eddy.py:EddyBrake")


@pytest.fixture
def own_effect(monkeypatch):
    monkeypatch.setitem(catalogue.OWN, OWN.id, OWN)


def verdict(kind, *effects):
    return {"verdict": kind, "effects": list(effects)}


def test_a_folder_with_a_space_is_quoted():
    assert shlex.split(next_command.after_import("my block")) == ["rockref", "compare", "my block"]


def test_the_model_that_a_diagnosis_began_with_is_named_again():
    said = next_command.after_diagnosis(verdict("named", "gyro_scale"), "e", "m.toml", Model())
    assert said == "rockref add e gyro_scale --model m.toml"
    assert next_command.after_diagnosis(verdict("none"), "e", "m.toml", Model()).endswith(
        "--model m.toml --report report"
    )


def test_a_pair_is_added_one_after_the_other():
    first, second = next_command.after_diagnosis(verdict("pair", "gyro_scale", "plate_tilt"), "e").split(" && ")
    assert first == "rockref add e gyro_scale --output with_gyro_scale.toml"
    assert second == "rockref add e plate_tilt --model with_gyro_scale.toml"


def test_of_a_class_the_first_member_is_tried():
    assert next_command.after_diagnosis(verdict("class", "a", "b"), "e") == "rockref add e a"


def test_an_effect_of_the_users_own_is_named_by_its_file(own_effect):
    said = next_command.after_diagnosis(verdict("pair", OWN.id, "gyro_scale"), "e")
    first, second = (shlex.split(one) for one in said.split(" && "))
    assert first[3] == OWN.file
    assert second[4:] == ["--model", "with_eddy_brake.toml", "--effect", OWN.file]


def test_an_addition_is_compared_with_what_it_began_with():
    addition = SimpleNamespace(model=SimpleNamespace(effects=[OWN]))
    said = shlex.split(next_command.after_addition(addition, "e", "new.toml"))
    assert said[3:] == ["--model", "baseline", "--model", "new.toml", "--effect", OWN.file]


def test_a_comparison_leads_to_what_the_last_model_lacks():
    models = [Model(), Model()]
    assert next_command.after_comparison("e", ["baseline"], models[:1]) == "rockref diagnose e --report report"
    said = next_command.after_comparison("e", ["baseline", "new.toml"], models)
    assert said == "rockref diagnose e --model new.toml --report report"


def test_a_plan_keeps_its_candidates():
    plan = SimpleNamespace(outlook=SimpleNamespace(runs=["0.117"]), further=[{"run": "0.1t"}])
    said = next_command.after_plan(plan, "table_3_1", ["gyro_scale"])
    assert said == "rockref plan --runs 0.117,0.1t --effect gyro_scale"


def test_where_the_page_was_written_the_next_command_is_another():
    then = next_command.after_diagnosis
    assert then(verdict("none"), "e", page=True) == "rockref fit e"
    assert then(verdict("something_else"), "e", page=True) == "rockref compare e --report compared"
