"""Scoring: verdicts first, the truth after; what is there is not done again."""

import json

import pytest

from rockref.blind.cases import making, plan, sealing
from rockref.blind.scoring import evaluation, judging
from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, Number
from rockref.discover.verdict.calibration import calibration
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
    (folder / name / judging.VERDICT).write_text(json.dumps({"verdict": word, "effects": effects, "seconds": 3.0}))


def test_recorded_verdicts_are_scored_and_nothing_is_diagnosed(folder, monkeypatch):
    monkeypatch.setattr(judging, "diagnosed", lambda *a: pytest.fail("diagnosed again"))
    recorded(folder, "case-001", "none")
    recorded(folder, "case-002", "named", "cable_restraint")
    found = evaluation.score(folder, workers=1)
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

    monkeypatch.setattr(judging, "diagnosed", diagnose)
    found = evaluation.score(folder, workers=1)
    assert asked == ["case-002"]
    assert found["marks"][1]["wrong_name"] and found["marks"][1]["seconds"] is not None
    # Again: nothing is asked, and the answer is the same.
    again = evaluation.score(folder, workers=1)
    assert asked == ["case-002"] and again["scores"] == found["scores"]


def test_a_case_that_breaks_the_discoverer_counts_against_it(folder, monkeypatch):
    def broken(case, threads):
        raise ZeroDivisionError("no")

    monkeypatch.setattr(judging, "diagnosed", broken)
    found = evaluation.score(folder, workers=1)
    assert [m["verdict"] for m in found["marks"]] == ["error", "error"]
    assert not found["marks"][1]["first"] and not found["marks"][0]["false_alarm"]


def test_verdicts_changed_after_the_opening_and_changed_cases_are_told(folder):
    recorded(folder, "case-001", "none")
    recorded(folder, "case-002", "none")
    assert all(evaluation.score(folder, workers=1)["sealed"].values())
    recorded(folder, "case-002", "named", "cable_restraint")
    (folder / "case-001" / "experiment.toml").write_text("name = 'other'\n")
    sealed = evaluation.score(folder, workers=1)["sealed"]
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


def test_a_verdict_that_is_there_is_left_alone(folder, monkeypatch):
    monkeypatch.setattr(judging, "diagnosed", lambda *a: pytest.fail("diagnosed again"))
    recorded(folder, "case-001", "none")
    before = (folder / "case-001" / judging.VERDICT).read_bytes()
    assert judging.judge_case(str(folder), "case-001", None) == "case-001"
    assert (folder / "case-001" / judging.VERDICT).read_bytes() == before


def test_a_refused_record_is_told_from_a_failure(folder, monkeypatch):
    def refused(case, threads):
        raise InputError("E-SPIKE", "run01.csv", "one wild sample", "Leave it out.")

    monkeypatch.setattr(judging, "diagnosed", refused)
    found = evaluation.score(folder, workers=1)
    assert [m["verdict"] for m in found["marks"]] == ["refused", "refused"]
    assert {row["score"]: row["value"] for row in found["scores"]}["sound records: refused"] == 1
    assert json.loads((folder / "case-001" / judging.VERDICT).read_text())["code"] == "E-SPIKE"


def evidence(*objectives, loss=0.95):
    """Evidence for nothing and for a cable, by their objectives."""
    number = Number(value=5.0, low=4.0, high=6.0, unit="N/m", z=1.0, size=1.0)
    hypotheses = [
        HypothesisEvidence(
            effects=effects, objective=o, eigenvalues=[2.0] * 11, loss=loss, loss_by_run_and_axis={"01": [0.95] * 3},
            blocks={"01": 0.0}, farthest=1.0, numbers={"cable_restraint.k": number} if effects else {},
            held_out={"02": 1.0 - 0.3 * len(effects)},
        )
        for effects, o in zip([(), ("cable_restraint",)], objectives, strict=True)
    ]  # fmt: skip
    return Evidence("x", "0", 1000, {"02": 1000}, hypotheses)


def test_stored_evidence_is_decided_again_and_nothing_is_written(folder):
    recorded(folder, "case-001", "none")
    recorded(folder, "case-002", "none")
    with pytest.raises(InputError, match="has not been scored"):
        evaluation.judge(folder)
    assert evaluation.score(folder, workers=1)["marks"][1]["first"] is False
    evidence(5000.0, 1000.0).save(folder / "case-002" / judging.EVIDENCE)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    control, cable = evaluation.judge(folder)["marks"]
    assert control["verdict"] == "none", "without evidence the stored verdict stands"
    assert (cable["verdict"], cable["said"], cable["right"]) == ("named", ["cable_restraint"], True)
    assert cable["probability"] > 0.99 * calibration().trust
    assert cable["covered"] == [True] and cable["size_errors"] == [0.0]
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before


def test_a_case_with_evidence_and_no_verdict_is_not_diagnosed(folder, monkeypatch):
    monkeypatch.setattr(judging, "diagnosed", lambda *a: pytest.fail("diagnosed"))
    for name in ("case-001", "case-002"):
        evidence(1000.0, 1000.0).save(folder / name / judging.EVIDENCE)
    found = evaluation.score(folder, workers=1)
    assert [m["verdict"] for m in found["marks"]] == ["none", "none"]


def test_a_case_with_neither_is_told(folder):
    with pytest.raises(InputError, match="has neither"):
        judging.decided(folder / "case-001")
