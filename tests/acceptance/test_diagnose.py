"""The diagnosis of two shipped experiments, from the folder to the verdict: nothing hidden, and one effect."""

import json
from pathlib import Path

import pytest

from rockref.discover.diagnose import diagnose
from rockref.discover.diagnosis_record import KEYS, plain

EXPERIMENTS = Path(__file__).resolve().parents[2] / "data/experiments"
ANSWERS = {a["name"]: a for a in json.loads((EXPERIMENTS / "answers.json").read_text(encoding="utf-8"))}


@pytest.mark.slow
@pytest.mark.parametrize("name", ["mystery-08", "mystery-04"])
def test_verdict_is_right_or_a_class_that_holds_the_truth(name):
    truth = ANSWERS[name]["effects"]
    found = plain(diagnose(EXPERIMENTS / name).to_dict())
    assert set(KEYS) <= set(found)
    error = found["error"]
    if not truth:
        assert found["verdict"] == "none" and found["effects"] == []
        return
    assert found["verdict"] in ("named", "indicated", "class") and set(truth) <= set(found["effects"])
    assert len(found["effects"]) <= 3
    # The gap to the noise closes on runs that were never fitted.
    for use in ("fit", "holdout"):
        assert error["with_effect"][use] < 0.5 * error["baseline"][use]
