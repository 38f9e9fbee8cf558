"""`compare`, `diagnose`, `fit` and `add` on a folder of tosses: what is printed and written; the fits are made up."""

import json
from types import SimpleNamespace

import pytest

from rockref import Model
from rockref.discover.tosses import diagnose as diagnosing
from rockref.discover.tosses import fitting
from tests.command import run
from tests.tosses import made, stated, write_tosses
from tests.unit.report import toss_records

pytest.importorskip("numba")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    x, Lambda, _ = made(stated(), 10, frames=40, seed=1, noise=2e-5)
    return write_tosses(tmp_path_factory.mktemp("t") / "tosses", x, Lambda)


def answer(monkeypatch, module, name, record, **facts):
    """Make the engine return this record; what it was called with comes back in a list."""
    calls = []
    found = SimpleNamespace(to_dict=lambda: record, model=stated(), **facts)
    monkeypatch.setattr(module, name, lambda *a, **k: calls.append((a, k)) or found)
    return calls


class TestCompare:
    def test_words_and_page(self, capsys, folder, tmp_path):
        code, out, err = run(capsys, "compare", folder, "--report", tmp_path / "page")
        assert (code, err) == (0, "")
        assert "stated values, holdout" in out and "Without a contact model" in out
        assert f"wrote {tmp_path / 'page/index.html'}" in out
        assert (tmp_path / "page/index.html").stat().st_size > 20_000

    def test_json_of_a_model_of_ones_own(self, capsys, folder, tmp_path):
        stated().save(tmp_path / "m.toml")
        code, out, _ = run(capsys, "compare", folder, "--model", tmp_path / "m.toml", "--json")
        record = json.loads(out)
        assert code == 0 and {row["model"] for row in record["rows"]} == {"m"} and record["written"] == []


@pytest.mark.parametrize(
    "command, options",
    [
        (("compare",), ("--check",)),
        (("compare",), ("--engine", "numpy")),
        (("diagnose",), ("--seed", 1)),
        (("diagnose",), ("--workers", 1)),
        (("fit",), ("--no-gates",)),
        (("fit",), ("--seed", 1)),
        (("add", "rounded_corners"), ("--workers", 1)),
    ],
)
def test_options_that_mean_nothing_for_tosses_are_refused(capsys, folder, tmp_path, monkeypatch, command, options):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *command, folder, *options)
    assert (code, out) == (2, "") and "E-ARGUMENT" in err and options[0] in err
    assert list(tmp_path.iterdir()) == []


class TestDiagnose:
    @pytest.mark.parametrize("verdict, code", [("named", 0), ("none", 0), ("not_trustworthy", 1)])
    def test_words_files_and_exit_code(self, capsys, monkeypatch, folder, tmp_path, verdict, code):
        answer(monkeypatch, diagnosing, "diagnose", toss_records.diagnosis(verdict))
        output, saved, page = tmp_path / "verdict.json", tmp_path / "m.toml", tmp_path / "page"
        options = ("-o", output, "--save-model", saved, "--report", page)
        found, out, _ = run(capsys, "diagnose", folder, *options)
        assert found == code and out.startswith(f"{verdict}: Missing")
        assert json.loads(output.read_text())["verdict"] == verdict
        assert Model.load(saved) == stated() and (page / "staircase.png").is_file()
        assert out.count("wrote ") == 3

    def test_json_alone(self, capsys, monkeypatch, folder, tmp_path):
        stated().save(tmp_path / "m.toml")
        calls = answer(monkeypatch, diagnosing, "diagnose", toss_records.diagnosis())
        code, out, _ = run(capsys, "diagnose", folder, "--json", "--model", tmp_path / "m.toml")
        assert code == 0 and json.loads(out) == toss_records.diagnosis()
        assert calls[0][0][1] == stated()

    def test_an_effect_of_ones_own_is_refused_before_the_work(self, capsys, monkeypatch, folder):
        calls = answer(monkeypatch, diagnosing, "diagnose", toss_records.diagnosis())
        code, _, err = run(capsys, "diagnose", folder, "--effect", "examples/my_effect.py:EddyBrake")
        assert code == 2 and "[E-EFFECT]" in err and calls == []


class TestFit:
    @pytest.mark.parametrize("passed, code", [(True, 0), (False, 1)])
    def test_exit_code_is_that_of_the_gates(self, capsys, monkeypatch, folder, tmp_path, passed, code):
        calls = answer(monkeypatch, fitting, "fit_tosses", toss_records.fit(passed), passed=passed)
        path = tmp_path / "m.toml"
        found, out, _ = run(capsys, "fit", folder, "--effect", "mass_eccentricity", "-o", path)
        assert found == code and "90123" in out and f"wrote {path}" in out
        assert Model.load(path) == stated() and calls[0][0][1] == ("mass_eccentricity",)

    def test_json(self, capsys, monkeypatch, folder, tmp_path):
        answer(monkeypatch, fitting, "fit_tosses", toss_records.fit(), passed=True)
        path = tmp_path / "m.toml"
        _, out, _ = run(capsys, "fit", folder, "-o", path, "--json")
        assert json.loads(out) == toss_records.fit() | {"written": [str(path)]}


class TestAdd:
    def sides(self):
        return {name: SimpleNamespace(model=stated()) for name in ("before", "after")}

    def test_words_model_and_page_of_both(self, capsys, monkeypatch, folder, tmp_path):
        answer(monkeypatch, fitting, "add_to_tosses", toss_records.addition(), **self.sides())
        path, page = tmp_path / "m.toml", tmp_path / "page"
        code, out, _ = run(capsys, "add", "mass_eccentricity", folder, "-o", path, "--report", page)
        assert code == 0 and "falls by 4.96" in out and out.count("wrote ") == 2
        assert "without mass_eccentricity" in (page / "index.html").read_text()

    def test_json(self, capsys, monkeypatch, folder, tmp_path):
        answer(monkeypatch, fitting, "add_to_tosses", toss_records.addition(), **self.sides())
        _, out, _ = run(capsys, "add", "mass_eccentricity", folder, "-o", tmp_path / "m.toml", "--json")
        assert json.loads(out)["holdout_falls_by"]["mean"] == 4.96


WORDS = pytest.mark.parametrize(
    "arguments", [["diagnose"], ["fit"], ["add", "mass_eccentricity"]], ids=["diagnose", "fit", "add"]
)


@WORDS
def test_what_was_left_out_of_the_tosses_is_said(capsys, monkeypatch, tmp_path, arguments):
    x, Lambda, _ = made(stated(), 3, frames=8)
    x[1, 4:] += 0.5
    folder = write_tosses(tmp_path / "t", x, Lambda)
    answer(monkeypatch, diagnosing, "diagnose", toss_records.diagnosis())
    answer(monkeypatch, fitting, "fit_tosses", toss_records.fit(), passed=True)
    answer(monkeypatch, fitting, "add_to_tosses", toss_records.addition(), **TestAdd().sides())
    code, _, err = run(capsys, *arguments, folder, "-o", tmp_path / "out")
    assert code == 0 and "toss 1: jumps at frame 4" in err and "[W-TOSS-LEFT-OUT]" in err


@WORDS
def test_a_disk_that_is_full_at_the_end_loses_no_words(capsys, monkeypatch, folder, tmp_path, arguments):
    from rockref.model import storage
    from rockref.model.errors import InputError

    def full(path, pieces):
        raise InputError("E-WRITE", str(path), "cannot be written (No space left on device)", "Check its space.")

    answer(monkeypatch, diagnosing, "diagnose", toss_records.diagnosis())
    answer(monkeypatch, fitting, "fit_tosses", toss_records.fit(), passed=True)
    answer(monkeypatch, fitting, "add_to_tosses", toss_records.addition(), **TestAdd().sides())
    monkeypatch.setattr(storage, "write_pieces", full)
    code, out, err = run(capsys, *arguments, folder, "-o", tmp_path / "out")
    assert code == 2 and "[E-WRITE]" in err and "wrote" not in out
    assert ("90123" in out) or ("3.85" in out)
