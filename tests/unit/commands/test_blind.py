"""`rockref blind`: what it refuses, and what it prints."""

import json

import pytest

from rockref import cli
from rockref.blind.cases import making
from rockref.blind.scoring import evaluation


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        cli.main(["blind", *map(str, arguments)])
    return end.value.code, capsys.readouterr()


def test_an_effect_that_does_not_exist_is_refused(capsys, tmp_path):
    code, printed = run(capsys, "make", tmp_path / "b", "--seed", 1, "--effects", "none,gyro_scal")
    assert code == 2 and "gyro_scal" in printed.err and not (tmp_path / "b").exists()


@pytest.mark.parametrize("effects", ["", " , "])
def test_no_cases_are_no_blind_test(capsys, tmp_path, effects):
    code, printed = run(capsys, "make", tmp_path / "b", "--seed", 1, "--effects", effects)
    assert code == 2 and "[E-EFFECT]" in printed.err and not (tmp_path / "b").exists()


def test_a_file_in_the_place_of_the_folder_is_refused_with_what_to_do(capsys, tmp_path):
    (tmp_path / "file").write_text("mine")
    code, printed = run(capsys, "make", tmp_path / "file", "--seed", 1, "--cases", 1)
    assert code == 2 and "Name another folder. [E-WRITE]" in " ".join(printed.err.split())


def test_a_folder_that_is_no_blind_test_is_refused(capsys, tmp_path):
    code, printed = run(capsys, "score", tmp_path)
    assert code == 2 and "rockref blind make" in printed.err


def test_make_hands_over_what_was_asked_for(capsys, tmp_path, monkeypatch):
    asked = {}

    def make(folder, seed, n, **more):
        asked.update(more, seed=seed, n=n)
        return {"truth_sha256": "abc", "cases": {"case-001": {}}}

    monkeypatch.setattr(making, "make", make)
    code, printed = run(capsys, "make", tmp_path, "--seed", 7, "--effects", "none, plate_tilt+gyro_drift:2", "--json")
    assert code == 0 and json.loads(printed.out)["truth_sha256"] == "abc"
    assert asked["seed"] == 7 and [c.effects for c in asked["cases"]] == [
        (),
        (("plate_tilt", 1.0), ("gyro_drift", 2.0)),
    ]


def test_check_ends_with_1_where_a_goal_is_missed(capsys, tmp_path, monkeypatch):
    row = {"score": "a", "value": 0.5, "low": 0.3, "high": 0.7, "n": 4, "goal": ">= 0.9", "met": False, "percent": True}
    found = {"scores": [row], "failures": ["case-001"], "rivals": {"r": [row]}, "sealed": {"truth": False}}
    monkeypatch.setattr(evaluation, "score", lambda *a, **k: found)
    code, printed = run(capsys, "score", tmp_path, "--check")
    assert code == 1 and "| a | 50.0 % | 30.0 % to 70.0 % | 4 | >= 0.9 | **no** |" in printed.out
    assert "| score | discoverer | r | n |" in printed.out and "| a | 50.0 % | 50.0 % | 4 |" in printed.out
    assert "not as it was sealed: truth" in printed.err
    assert run(capsys, "score", tmp_path)[0] == 0


def test_make_says_how_many_cases_there_are_and_the_digest_of_the_truth(capsys, tmp_path, monkeypatch):
    asked = {}
    made = {"truth_sha256": "abc", "cases": {"case-001": {}, "case-002": {}}}
    monkeypatch.setattr(making, "make", lambda folder, seed, n, **more: asked.update(more, n=n) or made)
    code, printed = run(capsys, "make", tmp_path, "--seed", 7, "--cases", 2)
    assert code == 0 and printed.out == f"2 cases in {tmp_path}; truth sealed, SHA-256 abc\n"
    assert asked["n"] == 2 and asked["cases"] is None


def test_scores_that_all_meet_their_goals_pass_the_check_and_nothing_else_is_said(capsys, tmp_path, monkeypatch):
    row = {"score": "a", "value": 0.95, "low": 0.8, "high": 1.0, "n": 4, "goal": ">= 0.9", "met": True, "percent": True}
    found = {"scores": [row], "failures": [], "rivals": {}, "sealed": {"truth": True, "verdicts": True}}
    asked = {}
    monkeypatch.setattr(evaluation, "score", lambda *a, **k: asked.update(k) or found)
    code, printed = run(capsys, "score", tmp_path, "--check", "--no-rivals")
    assert code == 0 and printed.err == "" and asked["with_rivals"] is False
    assert "95.0 %" in printed.out and "discoverer" not in printed.out
    code, printed = run(capsys, "score", tmp_path, "--check", "--json")
    assert code == 0 and json.loads(printed.out) == found and asked["with_rivals"] is True
