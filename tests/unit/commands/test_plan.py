"""`rockref plan`: words, the file and JSON of a made-up plan; what was asked for reaches the engine."""

import json

import pytest

from rockref.discover import plan as engine
from rockref.discover.diagnosis_record import plain
from rockref.discover.plan import Release
from rockref.discover.progress import StageReport
from tests import command
from tests.unit.discover import fakes

run = command.of("plan")


@pytest.fixture(scope="module")
def found():
    return fakes.planned()


@pytest.fixture
def calls(monkeypatch, found):
    """What the engine was called with; it says two stages."""
    made = []

    def plan(*a, progress, **k):
        progress(StageReport(1, 2, "simulating the release 0.117 rad")), progress(StageReport(2, 2, "limits"))
        made.append((a, k))
        return found

    monkeypatch.setattr(engine, "plan", plan)
    return made


def test_words_and_the_file_with_the_record(capsys, calls, found, tmp_path):
    path = tmp_path / "plan.json"
    code, out, err = run(capsys, "-o", path)
    assert code == 0 and err == "1/2 simulating the release 0.117 rad\n2/2 limits\n"
    assert "would help most next" in out and f"wrote {path}\nNext: rockref plan --runs " in out
    assert json.loads(path.read_text()) == plain(found.to_dict())


def test_json_is_the_record_and_nothing_else(capsys, calls, found, tmp_path):
    path = tmp_path / "plan.json"
    code, out, _ = run(capsys, "--json", "-o", path)
    assert code == 0 and out == path.read_text() and json.loads(out) == plain(found.to_dict())


def test_releases_and_candidates_are_those_that_were_named(capsys, calls):
    words = ("--runs", "0.117x2,0.1t", "-e", "gyro_scale", "-e", "adhesion", "--seed", 7, "--workers", 1)
    run(capsys, *words)
    ((_, planned, candidates), more) = calls[0]
    assert list(planned) == [Release(0.117), Release(0.117), Release(0.1, True)]
    assert candidates == ["gyro_scale", "adhesion"]
    assert more == {"seed": 7, "workers": 1}


def test_stages_are_told_where_they_are_wanted(capsys, calls):
    _, _, err = run(capsys, "--verbose")
    assert [line.split(" s  ")[1] for line in err.splitlines()] == [
        "1/2 simulating the release 0.117 rad",
        "2/2 limits",
    ]
