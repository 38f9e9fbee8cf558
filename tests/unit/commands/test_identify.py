"""`rockref identify` before the work: what it refuses leaves nothing behind, and what it searches instead is said."""

import pytest

from rockref import InputError, cli
from tests.shipped import two_runs


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The folder that the command runs in, with an experiment on eight points and one that states four."""
    monkeypatch.chdir(tmp_path)
    stated = two_runs(tmp_path / "FOUR") / "experiment.toml"
    text = stated.read_text(encoding="utf-8")
    stated.write_text(text.replace('"eight_points"', '"four_points"'), encoding="utf-8")
    assert '"four_points"' in stated.read_text(encoding="utf-8")
    two_runs(tmp_path / "EIGHT")
    return tmp_path


def refused(capsys, *words):
    with pytest.raises(SystemExit) as end:
        cli.main(["identify", *words])
    assert end.value.code == 2
    return capsys.readouterr().err


@pytest.mark.parametrize(
    "words, code",
    [
        (("nowhere",), "E-FOLDER"),
        (("EIGHT", "--genes", "13"), "E-KEY"),
        (("EIGHT", "--model", "four_points"), "E-MOOT"),
        (("EIGHT", "--search-runs", "07"), "E-RUN"),
        (("EIGHT", "--search-runs", "01, 01"), "E-RUN"),
    ],
)
def test_what_is_refused_leaves_no_folder(capsys, here, words, code):
    assert f"[{code}]" in refused(capsys, *words)
    assert sorted(p.name for p in here.iterdir()) == ["EIGHT", "FOUR"]


@pytest.mark.parametrize("folder, remarks", [("FOUR", 1), ("EIGHT", 0)])
def test_an_experiment_that_states_other_points_is_told_what_is_searched(capsys, here, monkeypatch, folder, remarks):
    def work(*given, **named):
        raise InputError("E-STOP", "here", "stop", "")

    monkeypatch.setattr("rockref.identify.from_experiment.answered", work)
    told = refused(capsys, folder)
    assert "[E-STOP]" in told and told.count("[W-MOOT]") == remarks
    assert told.count("FOUR: states four_points as its baseline, and eight points are searched") == remarks


def test_remarks_of_the_reader_are_said_before_the_work(capsys, here, monkeypatch):
    def work(*given, **named):
        raise InputError("E-STOP", "here", "stop", "")

    monkeypatch.setattr("rockref.identify.from_experiment.answered", work)
    path = here / "EIGHT/experiment.toml"
    path.write_text(path.read_text(encoding="utf-8").replace('"holdout"', '"fit"'), encoding="utf-8")
    told = refused(capsys, "EIGHT")
    assert "[W-NO-HOLDOUT]" in told and told.index("[W-NO-HOLDOUT]") < told.index("[E-STOP]")
