"""Scoring: verdicts first, the truth after; what is there is not done again."""

import json

import pytest

from rockref.blind.cases import making, plan, sealing
from rockref.blind.scoring import evaluation
from rockref.model.errors import InputError


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A sealed test of two cases without data: a control, and a cable."""

    def make_one(root, name, case):
        path = tmp_path / name
        path.mkdir(exist_ok=True)
        (path / "experiment.toml").write_text(f"name = '{name}'\n")
        effects = [{"id": id, "size": s, "form": "catalogue", "parameters": {"k": 5.0}} for id, s in case.effects]
        content = {"name": name, "kind": case.kind, "effects": effects, "class": []}
        sealing.write_json(tmp_path / making.PARTS / f"{name}.json", content)
        return name

    monkeypatch.setattr(making, "make_one", make_one)
    making.make(tmp_path, 1, cases=plan.listed(1, ["none", "cable_restraint"]), workers=1)
    return tmp_path


def recorded(folder, name, word, *effects):
    (folder / name / evaluation.VERDICT).write_text(json.dumps({"verdict": word, "effects": effects, "seconds": 3.0}))


def test_recorded_verdicts_are_scored_and_nothing_is_diagnosed(folder, monkeypatch):
    monkeypatch.setattr(evaluation, "_diagnose", lambda *a: pytest.fail("diagnosed again"))
    recorded(folder, "case-001", "none")
    recorded(folder, "case-002", "named", "cable_restraint")
    found = evaluation.score(folder, workers=1, with_rivals=False)
    rows = {row["score"]: row for row in found["scores"]}
    assert rows["controls: false alarms"]["value"] == 0 and rows["single: truth first"]["value"] == 1
    assert found["failures"] == [] and all(found["sealed"].values())
    assert json.loads((folder / "scores.json").read_text())["marks"] == found["marks"]
    assert json.loads((folder / sealing.OPENED).read_text())["cases"][1]["effects"][0]["id"] == "cable_restraint"


def test_missing_verdicts_are_made_before_the_truth_is_opened(folder, monkeypatch):
    recorded(folder, "case-001", "none")
    asked = []

    def diagnose(case, threads):
        assert not (folder / sealing.OPENED).exists()
        asked.append(case.name)
        return {"verdict": "named", "effects": ["adhesion"]}

    monkeypatch.setattr(evaluation, "_diagnose", diagnose)
    found = evaluation.score(folder, workers=1, with_rivals=False)
    assert asked == ["case-002"]
    assert found["marks"][1]["wrong_name"] and found["marks"][1]["seconds"] is not None
    # Again: nothing is asked, and the answer is the same.
    again = evaluation.score(folder, workers=1, with_rivals=False)
    assert asked == ["case-002"] and again["scores"] == found["scores"]


def test_a_case_that_breaks_the_discoverer_counts_against_it(folder, monkeypatch):
    def broken(case, threads):
        raise ZeroDivisionError("no")

    monkeypatch.setattr(evaluation, "_diagnose", broken)
    found = evaluation.score(folder, workers=1, with_rivals=False)
    assert [m["verdict"] for m in found["marks"]] == ["error", "error"]
    assert not found["marks"][1]["first"] and not found["marks"][0]["false_alarm"]


def test_verdicts_changed_after_the_opening_and_changed_cases_are_told(folder):
    recorded(folder, "case-001", "none")
    recorded(folder, "case-002", "none")
    assert all(evaluation.score(folder, workers=1, with_rivals=False)["sealed"].values())
    recorded(folder, "case-002", "named", "cable_restraint")
    (folder / "case-001" / "experiment.toml").write_text("name = 'other'\n")
    sealed = evaluation.score(folder, workers=1, with_rivals=False)["sealed"]
    assert sealed == {"truth": True, "cases": False, "verdicts_as_first_committed": False}


def test_a_finished_test_is_not_made_again_and_another_plan_is_not_mixed_in(folder, tmp_path):
    with pytest.raises(InputError, match="sealed"):
        making.make(folder, 1, cases=[], workers=1)
    half = tmp_path / "half"
    (half / making.PARTS).mkdir(parents=True)
    (half / making.PARTS / "plan").write_text('["another"]')
    with pytest.raises(InputError, match="another plan"):
        making.make(half, 1, cases=plan.listed(1, ["none"]), workers=1)


def test_what_is_no_blind_test_is_refused(tmp_path):
    with pytest.raises(InputError, match="no blind test"):
        evaluation.score(tmp_path, workers=1)


def test_rivals_are_asked_once_and_marked_as_the_discoverer_is(folder, monkeypatch):
    asked = []

    def always(case):
        asked.append(case.name)
        return {"verdict": "named", "effects": ["cable_restraint"]}

    def broken(case):
        raise ZeroDivisionError("no")

    monkeypatch.setattr(evaluation.rivals, "METHODS", {"always": always, "broken": broken})
    monkeypatch.setattr(evaluation, "_diagnose", lambda *a: {"verdict": "none", "effects": []})
    found = evaluation.score(folder, workers=1)["rivals"]
    rows = {id: {row["score"]: row["value"] for row in table} for id, table in found.items()}
    assert set(rows) == {"always", "broken", "ranking without holdout"}
    assert rows["always"]["single: truth first"] == 1 and rows["always"]["controls: false alarms"] == 1
    assert rows["broken"]["single: truth first"] == 0 and rows["broken"]["controls: false alarms"] == 0
    assert evaluation.score(folder, workers=1)["rivals"] == found and asked == ["case-001", "case-002"]
    assert "ZeroDivisionError" in (folder / "case-001" / evaluation.RIVALS).read_text()


def test_a_verdict_that_is_there_is_left_alone(folder, monkeypatch):
    monkeypatch.setattr(evaluation, "_diagnose", lambda *a: pytest.fail("diagnosed again"))
    recorded(folder, "case-001", "none")
    before = (folder / "case-001" / evaluation.VERDICT).read_bytes()
    assert evaluation.judge_case(str(folder), "case-001", None) == "case-001"
    assert (folder / "case-001" / evaluation.VERDICT).read_bytes() == before
