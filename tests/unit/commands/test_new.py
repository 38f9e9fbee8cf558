"""`rockref new`: a folder from logs, what is asked for at once, questions on a terminal."""

import json
import sys
from dataclasses import replace

import pytest

from rockref.measure import load_experiment
from tests import foreign
from tests.command import run
from tests.shipped import ROOT

SIDES = ("--mass", "54kg", "--width", "100mm", "--height", "0.688")


@pytest.fixture(scope="module")
def logs(tmp_path_factory):
    experiment = load_experiment(ROOT / "data/experiments/mystery-05")
    two = replace(experiment, runs=tuple(experiment.run(id) for id in ("01", "06")))
    folder = tmp_path_factory.mktemp("logs")
    foreign.write_logs(two, folder, "arduino")
    return folder


def test_a_folder_is_made_and_the_next_command_is_said_last(capsys, logs, tmp_path):
    code, out, err = run(capsys, "new", tmp_path / "block", logs, *SIDES, "--yes")
    assert code == 0, err
    assert out.splitlines()[-1] == f"Next: rockref compare {tmp_path / 'block'}"
    assert "131 counts a deg/s" in out and "turned" in out
    assert (tmp_path / "block/first_swing.png").read_bytes().startswith(b"\x89PNG")
    assert [r.use for r in load_experiment(tmp_path / "block").runs] == ["fit", "holdout"]


def test_what_is_missing_is_said_at_once(capsys, logs, tmp_path):
    code, _, err = run(capsys, "new", tmp_path / "block", logs, "--width", "100mm", "--yes")
    assert code == 2 and "--mass 54kg --height 688mm" in err
    assert not (tmp_path / "block").exists()


def test_a_folder_with_files_stays_as_it_is(capsys, logs, tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    code, _, err = run(capsys, "new", tmp_path, logs, *SIDES, "--yes")
    assert code == 2 and "[E-FOLDER]" in err
    assert [p.name for p in tmp_path.iterdir()] == ["mine.txt"]


def test_json_is_one_object(capsys, logs, tmp_path):
    code, out, _ = run(capsys, "new", tmp_path / "block", logs, *SIDES, "--json")
    assert code == 0
    assert [r["turned"] for r in json.loads(out)["runs"]] == [False, True]


def test_a_terminal_is_asked(capsys, logs, tmp_path, monkeypatch):
    """Mass, then tilts, sides and hold-out, where the table is not right."""
    answers = iter(["54", False, "6.7deg", "0.11rad", "none", "01"])
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True, raising=False)
    monkeypatch.setattr("typer.prompt", lambda text, default=None, value_proc=str: value_proc(next(answers)))
    monkeypatch.setattr("typer.confirm", lambda text, default=None: next(answers))
    code, _, err = run(capsys, "new", tmp_path / "block", logs, *SIDES[2:])
    assert code == 2 and "E-SIGN" in err  # run 06 is turned, and the answer says that it is not
    answers = iter(["54", False, "6.7deg", "0.11rad", "02", "01"])
    code, _, err = run(capsys, "new", tmp_path / "block", logs, *SIDES[2:])
    assert code == 0, err
    runs = load_experiment(tmp_path / "block").runs
    assert [r.use for r in runs] == ["holdout", "fit"]
    assert runs[0].release_tilt == pytest.approx(0.11694, abs=1e-5) and runs[1].release_tilt == pytest.approx(0.11)


@pytest.mark.parametrize("text", ["6.7", "6.7 furlongs", "-1deg", "deg"])
def test_an_angle_needs_its_unit(capsys, logs, tmp_path, text):
    code, _, err = run(capsys, "new", tmp_path / "block", logs, *SIDES, f"--tilt={text}")
    assert code == 2 and "deg" in err


@pytest.mark.parametrize("width, told", [("80", "write it as 80mm"), ("80kg", "no number with a unit")])
def test_a_length_that_no_block_has_is_asked_for_its_unit(capsys, logs, tmp_path, width, told):
    sides = ("--mass", "54kg", "--width", width, "--height", "0.688")
    code, _, err = run(capsys, "new", tmp_path / "block", logs, *sides, "--yes")
    assert code == 2 and told in " ".join(err.split()) and not (tmp_path / "block").exists()
