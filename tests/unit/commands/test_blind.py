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


@pytest.mark.parametrize(
    "options, said",
    [
        (("--effects", "none,gyro_scal"), "gyro_scal"),
        (("--effects", ""), "[E-EFFECT]"),
        (("--effects", " , "), "[E-EFFECT]"),
        (("--near", 0), "[E-RANGE]"),
    ],
)
def test_an_unknown_effect_and_no_case_at_all_are_refused(capsys, tmp_path, options, said):
    code, printed = run(capsys, "make", tmp_path / "b", "--seed", 1, *options)
    assert code == 2 and said in printed.err and not (tmp_path / "b").exists()


def test_a_file_in_the_place_of_the_folder_is_refused_with_what_to_do(capsys, tmp_path):
    (tmp_path / "file").write_text("mine")
    code, printed = run(capsys, "make", tmp_path / "file", "--seed", 1, "--cases", 1)
    assert code == 2 and "Name another folder. [E-WRITE]" in " ".join(printed.err.split())


def test_a_folder_that_is_no_blind_test_is_refused(capsys, tmp_path):
    code, printed = run(capsys, "score", tmp_path)
    assert code == 2 and "rockref blind make" in printed.err


def test_make_hands_over_what_was_asked_for(capsys, tmp_path, monkeypatch):
    asked = {}

    def make(folder, seed, near, other, **more):
        asked.update(more, seed=seed, near=near, other=other)
        return {"truth_sha256": "abc", "cases": {"case-001": {}}}

    monkeypatch.setattr(making, "make", make)
    code, printed = run(capsys, "make", tmp_path, "--seed", 7, "--effects", "none, plate_tilt+gyro_drift:2", "--json")
    assert code == 0 and json.loads(printed.out)["truth_sha256"] == "abc"
    assert asked["seed"] == 7 and [c.effects for c in asked["cases"]] == [
        (),
        (("plate_tilt", 1.0), ("gyro_drift", 2.0)),
    ]


def test_other_blocks_are_asked_for_by_number(capsys, tmp_path, monkeypatch):
    asked = []
    made = {"truth_sha256": "abc", "cases": {"case-001": {}, "case-002": {}}}
    monkeypatch.setattr(making, "make", lambda folder, seed, *numbers, **more: asked.append((numbers, more)) or made)
    code, printed = run(capsys, "make", tmp_path, "--seed", 7, "--cases", 9)
    assert code == 0 and printed.out == f"2 cases in {tmp_path}; truth sealed, SHA-256 abc\n"
    run(capsys, "make", tmp_path, "--seed", 7, "--other", 4)
    run(capsys, "make", tmp_path, "--seed", 7, "--near", 1, "--other", 2, "--effects", "none")
    assert [numbers for numbers, _ in asked] == [(6, 3), (0, 4), (1, 2)]
    assert asked[0][1]["cases"] is None and sorted(c.block for c in asked[2][1]["cases"]) == ["near", "other", "other"]


def found_with(value, met, **more):
    row = {"score": "a", "value": value, "low": 0.3, "high": 0.9, "n": 4, "hits": 2, "goal": ">= 0.9", "met": met}
    rows = {"near": [row | {"percent": True}], "other": []}
    return {
        "by_block": rows,
        "by_word": [],
        "reliability": {"near": []},
        "failures": ["case-001"],
        "sealed": {"truth": True},
    } | more


@pytest.mark.parametrize("command", ["score", "judge"])
def test_check_ends_with_1_where_a_goal_is_missed(capsys, tmp_path, monkeypatch, command):
    monkeypatch.setattr(evaluation, command, lambda *a, **k: found_with(0.5, False))
    code, printed = run(capsys, command, tmp_path, "--check")
    assert code == 1 and "| a | 2 of 4 (30.0 % to 90.0 %) | >= 0.9 **missed** |" in printed.out
    assert "- case-001" in printed.out and run(capsys, command, tmp_path)[0] == 0


def test_scores_that_meet_their_goals_pass_the_check(capsys, tmp_path, monkeypatch):
    found = found_with(0.95, True)
    monkeypatch.setattr(evaluation, "score", lambda *a, **k: found)
    code, printed = run(capsys, "score", tmp_path, "--check", "--json")
    assert code == 0 and printed.err == "" and json.loads(printed.out) == found


def test_what_is_not_as_it_was_sealed_is_told(capsys, tmp_path, monkeypatch):
    monkeypatch.setattr(evaluation, "score", lambda *a, **k: found_with(0.95, True, sealed={"truth": False}))
    assert "not as it was sealed: truth" in run(capsys, "score", tmp_path)[1].err


def test_probabilities_are_told_where_verdicts_state_them(capsys, tmp_path, monkeypatch):
    row = {"from": 0.9, "to": 0.95, "stated": 0.93, "right": 3, "n": 4, "low": 0.3, "high": 0.95}
    monkeypatch.setattr(evaluation, "judge", lambda *a: found_with(0.95, True, reliability={"other": [row]}))
    printed = run(capsys, "judge", tmp_path)[1].out
    assert "Probabilities, other" in printed and "| 0.9 to 0.95 | 93.0 % | 3 of 4 | 30 to 95 % |" in printed
