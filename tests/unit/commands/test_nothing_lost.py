"""Minutes of work are told even where their files cannot be written at the end; what was found is made up."""

import json

import pytest

from rockref.discover import add_effect, diagnose, fit_baseline, plan
from rockref.model import storage
from rockref.model.errors import InputError
from tests.command import run as typed
from tests.unit.discover import fakes

#: Command, the engine behind it, and a word that its result is known by.
COMMANDS = {
    "diagnose": (diagnose, "diagnose", ["anywhere"], "quadratic_drag is missing"),
    "fit": (fit_baseline, "fit_baseline", ["anywhere"], "K_N"),
    "add": (add_effect, "add_effect", ["anywhere", "quadratic_drag"], "90 % of the excess"),
    "plan": (plan, "plan", [], "viscous_friction"),
}


@pytest.fixture(scope="module")
def found():
    made = fakes.made_experiment()
    return {
        "diagnose": fakes.diagnosis("named", made),
        "fit": fakes.fitted(made=made),
        "add": fakes.addition(made),
        "plan": fakes.planned(),
    }


def run(capsys, monkeypatch, tmp_path, found, command, *more):
    """Run a command whose disk is full when the work is done."""
    module, name, arguments, word = COMMANDS[command]

    def full(path, pieces):
        raise InputError("E-WRITE", str(path), "cannot be written (No space left on device)", "Check its space.")

    monkeypatch.setattr(module, name, lambda *a, **k: found[command])
    monkeypatch.setattr(storage, "write_pieces", full)
    code, out, err = typed(capsys, command, *arguments, "-o", tmp_path / "out", *more)
    assert code == 2 and "[E-WRITE]" in err and not list(tmp_path.iterdir())
    return out, word


@pytest.mark.parametrize("command", COMMANDS)
def test_words_are_printed_and_no_file_is_claimed(capsys, monkeypatch, tmp_path, found, command):
    out, word = run(capsys, monkeypatch, tmp_path, found, command)
    assert word in out and "wrote" not in out


@pytest.mark.parametrize("command", COMMANDS)
def test_json_is_printed_whole(capsys, monkeypatch, tmp_path, found, command):
    out, _ = run(capsys, monkeypatch, tmp_path, found, command, "--json")
    assert json.loads(out).get("written", []) == []


def test_a_page_that_cannot_be_drawn_loses_neither_the_verdict_nor_the_file(capsys, monkeypatch, tmp_path, found):
    from rockref.report.views import diagnosis_page

    def too_large(*a):
        raise InputError("E-PAGE-SIZE", "index.html", "is too large", "Give fewer runs.")

    monkeypatch.setattr(diagnose, "diagnose", lambda *a, **k: found["diagnose"])
    monkeypatch.setattr(diagnosis_page, "diagnosis_page", too_large)
    output, page = tmp_path / "verdict.json", tmp_path / "page"
    code, out, err = typed(capsys, "diagnose", "anywhere", "-o", output, "--report", page)
    assert code == 2 and "[E-PAGE-SIZE]" in err
    assert "quadratic_drag is missing" in out and json.loads(output.read_text())["verdict"] == "named"
