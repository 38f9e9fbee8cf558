"""`rockref identify`: what it refuses leaves nothing behind, what it searches instead is said, and how it ends."""

import copy
import json

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.identify.search import Progress, Settings
from tests import command
from tests.shipped import two_runs
from tests.unit.report.made_up import IDENTIFICATION


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
    code, _, err = command.run(capsys, "identify", *words)
    assert code == 2
    return err


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


class TestTheEnd:
    """The search is made up; its result is printed and written."""

    @pytest.fixture
    def ended(self, capsys, here, monkeypatch):
        """Run the command to an end at the noise floor, or above it; what it was asked comes along."""

        def run(*words, floor=True):
            record, asked = copy.deepcopy(IDENTIFICATION), {}
            record["least_squares"]["at_noise_floor"] = floor

            def answered(question, settings, work, folder, *, resume, report):
                asked.update(settings=settings, folder=str(folder), resume=resume, workers=work.workers)
                report(question.space, "search", Progress(1, settings.generations, 0.5, np.full(12, 0.5), 3.0))
                return record, Model.table_3_1()

            monkeypatch.setattr("rockref.identify.from_experiment.answered", answered)
            return *command.run(capsys, "identify", "EIGHT", "-o", "found", "--workers", "1", *words), asked

        return run

    @pytest.mark.parametrize("floor, code", [(True, 0), (False, 1)])
    def test_the_exit_code_is_1_above_the_noise_floor_and_both_files_are_written(self, ended, here, floor, code):
        found, out, err, _ = ended(floor=floor)
        assert found == code and err.startswith("searching on features of the runs") and err.count("\n") == 1
        assert ("Nothing is determined" in out) is not floor
        next_one = "compare EIGHT --model found/model.toml" if floor else "diagnose EIGHT"
        assert out.endswith(f"wrote found/identification.json\nwrote found/model.toml\nNext: rockref {next_one}\n")
        record = json.loads((here / "found/identification.json").read_text())
        assert record["least_squares"]["at_noise_floor"] is floor and record["runs"] == IDENTIFICATION["runs"]
        assert Model.load(here / "found/model.toml").parameters == Model.table_3_1().parameters

    def test_json_is_what_is_in_the_file(self, ended, here):
        code, out, err, _ = ended("--json")
        assert (code, err.count("\n")) == (0, 1) and out == (here / "found/identification.json").read_text()

    def test_generations_are_told_where_they_are_wanted(self, ended):
        _, _, err, _ = ended("--verbose")
        assert "search cost 0.5000  K_N " in err and err.count("\n") == 2

    def test_what_was_asked_for_reaches_the_search(self, ended):
        *_, asked = ended("--generations", "7", "--population", "8", "--seed", "3", "--resume")
        assert asked == {"settings": Settings(8, 7, 3), "folder": "found", "resume": True, "workers": 1}
