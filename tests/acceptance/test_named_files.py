"""A user's own effect is a program: whatever a model file says, it is run only if he has named it himself."""

import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
import typer

from rockref import InputError, Model, cli
from rockref.conformance.backends.json_lines import answer
from rockref.conformance.backends.law import NumpyEngine
from rockref.effects import catalogue
from tests.refusal import refused
from tests.shipped import two_runs
from tests.tosses import write_tosses

EXAMPLE = Path(__file__).resolve().parents[2] / "examples/my_effect.py"
#: What every command that reads a model is told, and the function that it hands the model to. EXPERIMENT, TOSSES and
#: MODEL stand for paths.
COMMANDS = {
    "simulate": ("simulate MODEL", "rockref.api.simulate"),
    "compare": ("compare EXPERIMENT --model table_3_1 --model MODEL", "rockref.discover.compare.models.compare"),
    "fit": ("fit EXPERIMENT --model MODEL", "rockref.discover.fit_baseline.fit_baseline"),
    "diagnose": ("diagnose EXPERIMENT --model MODEL", "rockref.discover.diagnose.diagnose"),
    "add": ("add rolling_resistance EXPERIMENT --model MODEL", "rockref.discover.add_effect.add_effect"),
    "identify": ("identify EXPERIMENT --model MODEL", "rockref.identify.from_experiment.question"),
    "plan": ("plan --model MODEL", "rockref.discover.plan.plan"),
    "sensitivity": ("sensitivity --model MODEL", "rockref.studies.sensitivity_study.study"),
    "compare tosses": ("compare TOSSES --model MODEL", "rockref.discover.tosses.compare.compare"),
    "fit tosses": ("fit TOSSES --model MODEL", "rockref.discover.tosses.fitting.fit_tosses"),
    "diagnose tosses": ("diagnose TOSSES --model MODEL", "rockref.discover.tosses.diagnose.diagnose"),
    "add tosses": ("add rolling_resistance TOSSES --model MODEL", "rockref.discover.tosses.fitting.add_to_tosses"),
}


@pytest.fixture(autouse=True)
def nobody_named_anything(monkeypatch):
    monkeypatch.setattr(catalogue, "NAMED", set())
    monkeypatch.setattr(catalogue, "OWN", {})


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with data, a model, and the file of effects that the model names, which leaves a trace where it runs."""
    two_runs(tmp_path / "EXPERIMENT")
    pose = np.zeros((1, 30, 3)), np.broadcast_to(np.eye(3), (1, 30, 3, 3))
    write_tosses(tmp_path / "TOSSES", *pose)
    trace = f"open({str(tmp_path / 'trace')!r}, 'a').write('ran')\n"
    (tmp_path / "mine.py").write_text(EXAMPLE.read_text(encoding="utf-8") + trace, encoding="utf-8")
    model = '[effects.eddy_brake]\nfile = "mine.py:EddyBrake"\nc = 0.05\n'
    (tmp_path / "MODEL").write_text(model, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def said(capsys, words):
    with pytest.raises(SystemExit) as end:
        cli.main(words.split())
    return end.value.code, capsys.readouterr().err


def reads_models(command) -> bool:
    return any(p.name == "model" for p in command.params)


def test_no_command_that_reads_a_model_is_forgotten():
    commands = typer.main.get_command(cli.application()).commands
    # The lab's page runs no Python: a user's own effect has no place in it, and its file is never asked for.
    # An ensemble holds its model: it has a test of its own.
    found = {name for name, command in commands.items() if reads_models(command)} - {"lab", "shake"}
    assert found == {words.split()[0] for words, _ in COMMANDS.values()}
    # one common way for all of them
    assert all("--effect" in [o for p in commands[name].params for o in p.opts] for name in found)
    assert not any(reads_models(c) for group in commands.values() for c in getattr(group, "commands", {}).values())


@pytest.mark.parametrize("name", COMMANDS)
def test_a_file_that_only_the_model_names_is_not_run(capsys, folder, name):
    before = sorted(folder.rglob("*"))
    code, err = said(capsys, COMMANDS[name][0])
    assert code == 2 and "MODEL: [effects.eddy_brake]" in err and "[E-TRUST]" in err
    assert "add --effect mine.py:EddyBrake" in err
    assert sorted(folder.rglob("*")) == before


def test_an_ensemble_runs_no_file_that_only_the_model_names(capsys, folder):
    before = sorted(folder.rglob("*"))
    code, err = said(capsys, "shake MODEL record.csv -o shaken")
    assert code == 2 and "MODEL: [effects.eddy_brake]" in err and "[E-TRUST]" in err
    assert sorted(folder.rglob("*")) == before


@pytest.mark.parametrize("name", COMMANDS)
def test_the_words_of_that_message_are_understood(capsys, monkeypatch, folder, name):
    """The model arrives with its effect where the work would begin, and the effect as the model has it."""
    words, place = COMMANDS[name]
    arrived = []

    def work(*given, **named):
        arrived.append((given, named))
        raise InputError("E-ARRIVED", "here", "stop", "")

    __import__(place.rpartition(".")[0])
    monkeypatch.setattr(place, work)
    code, err = said(capsys, f"{words} --effect mine.py:EddyBrake")
    assert code == 2 and "[E-ARRIVED]" in err and (folder / "trace").exists()
    ((given, named),) = arrived
    flat = [m for a in (*given, *named.values()) for m in (a if isinstance(a, (list, tuple)) else [a])]
    models = [m for m in flat if isinstance(m, Model) and m.effects]
    assert [e.values() for m in models for e in m.effects] == [{"c": 0.05}]
    # What the model has is no candidate beside it; a fit moves what is named.
    assert ("mine.py:EddyBrake" in flat) == (name == "fit")


@pytest.mark.parametrize("words", ["compare EXPERIMENT", "sensitivity", "identify EXPERIMENT", "compare TOSSES"])
@pytest.mark.parametrize("effect", ["mine.py:EddyBrake", "quadratic_drag:c=1"])
def test_a_command_that_adds_none_says_so(capsys, folder, words, effect):
    code, err = said(capsys, f"{words} --effect {effect}")
    assert code == 2 and "this command adds no effect" in err and "[E-EFFECT]" in err


@pytest.mark.parametrize(
    "words", ["compare EXPERIMENT", "diagnose EXPERIMENT", "plan", "sensitivity", "identify EXPERIMENT", "fit TOSSES"]
)
def test_numbers_that_would_change_nothing_are_refused(capsys, folder, words):
    code, err = said(capsys, f"{words} --model MODEL --effect mine.py:EddyBrake:c=0.9")
    assert code == 2 and "own numbers hold. Write mine.py:EddyBrake." in err and "[E-EFFECT]" in err


def test_the_effect_that_is_added_names_its_file_too(capsys, monkeypatch, folder):
    """A second class of the same file is added to a model that has the first."""
    other = (folder / "mine.py").read_text(encoding="utf-8").replace("EddyBrake", "Second").replace("eddy_", "second_")
    with (folder / "mine.py").open("a", encoding="utf-8") as stream:
        stream.write(other.replace("from __future__ import annotations", ""))
    arrived = []

    def work(*given, **named):
        arrived.append(given)
        raise InputError("E-ARRIVED", "here", "stop", "")

    monkeypatch.setattr("rockref.discover.add_effect.add_effect", work)
    code, err = said(capsys, "add mine.py:Second EXPERIMENT --model MODEL")
    assert code == 2 and "[E-ARRIVED]" in err
    assert arrived[0][0] == "mine.py:Second" and arrived[0][2].effects[0].id == "eddy_brake"


def test_another_file_of_that_name_is_not_run(capsys, folder):
    (folder / "other").mkdir()
    shutil.copy(EXAMPLE, folder / "other/mine.py")
    code, err = said(capsys, "simulate MODEL --duration 0.01 --effect other/mine.py:EddyBrake")
    assert code == 2 and "[E-TRUST]" in err and not (folder / "trace").exists()


def test_a_file_is_itself_by_whatever_path(capsys, folder):
    os.symlink(folder / "mine.py", folder / "link.py")
    (folder / "MODEL").write_text('[effects.eddy_brake]\nfile = "link.py:EddyBrake"\n', encoding="utf-8")
    (folder / "deep").mkdir()
    shutil.move(folder / "MODEL", folder / "deep/MODEL")
    assert said(capsys, "simulate deep/MODEL --duration 0.01 --effect deep/../mine.py:EddyBrake")[0] == 0


@pytest.mark.parametrize(
    "line, code",
    [
        ('["mine.py:EddyBrake"]\nc = 1.0', "E-EFFECT"),  # the place of an id is no place for a file
        ('.eddy_brake]\nfile = "mine.py"', "E-EFFECT"),
        ('.eddy_brake]\nfile = "nobody.py:EddyBrake"', "E-FILE"),
        ('.eddy_brake]\nfile = "mine\\u0000.py:EddyBrake"', "E-FILE"),
        ('.eddy_brake]\nfile = "/dev/zero.py:EddyBrake"', "E-FILE"),
    ],
)
def test_other_places_for_a_file_run_none_either(folder, line, code):
    (folder / "MODEL").write_text(f"[effects{line if line.startswith('.') else '.' + line[1:]}\n", encoding="utf-8")
    error = refused(Model.load, "MODEL")
    assert error.code == code and not (folder / "trace").exists()


def test_an_effect_of_another_id_is_refused(folder):
    (folder / "MODEL").write_text('[effects.brake]\nfile = "mine.py:EddyBrake"\n', encoding="utf-8")
    with pytest.raises(
        InputError, match=r"the effect in mine.py:EddyBrake is 'eddy_brake'. Write \[effects.eddy_brake\]"
    ):
        Model.load("MODEL", effects=["mine.py:EddyBrake"])


def test_what_is_to_be_typed_is_one_word_of_a_shell(folder):
    """A path comes from data: it ends no command, and moves no cursor."""
    for path, typed in (("a; rm x.py", "'a; rm x.py:EddyBrake'"), ("a\x1b[2J.py", r"'a\x1b[2J.py:EddyBrake'")):
        shutil.copy(EXAMPLE, path)
        spec = json.dumps(f"{path}:EddyBrake")
        (folder / "MODEL").write_text(f"[effects.eddy_brake]\nfile = {spec}\n", encoding="utf-8")
        error = refused(Model.load, "MODEL")
        assert f"--effect {typed};" in error.cure


def test_in_python_it_is_an_argument_or_was_named_before(folder):
    with pytest.raises(InputError, match="E-TRUST"):
        Model.load("MODEL")
    assert Model.load("MODEL", effects=["mine.py:EddyBrake"]).effects[0].values() == {"c": 0.05}
    assert Model.load("MODEL").effects[0].id == "eddy_brake"
    with pytest.raises(InputError, match="names no class in a file"):
        Model.load("MODEL", effects=["quadratic_drag"])


def test_a_request_to_an_implementation_runs_no_file(folder):
    """The pieces of the judge name effects, too."""
    asked = {"effect": "mine.py:EddyBrake", "parameters": {}, "t": [0.0, 1.0], "crv_deg_s": [[0.0] * 3] * 2}
    said = answer(NumpyEngine(), {"cmd": "run", "id": "1", "piece": "sensor", "in": asked})
    assert "there is no effect" in said["error"] and not (folder / "trace").exists()
