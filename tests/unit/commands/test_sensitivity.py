"""`rockref sensitivity`: files and JSON, and refusals."""

import json

import pytest
from matplotlib.figure import Figure

from rockref.studies.sensitivity import STEPS
from tests.command import run
from tests.unit.report import made_up


@pytest.mark.slow
def test_writes_figures_and_result(capsys, tmp_path):
    steps = ("--step", "1e-5", "--step", "5e-6")
    code, out, _ = run(
        capsys, "sensitivity", "-o", tmp_path / "s", *steps, "--duration", 2.0, "--trials", 2, "--workers", 1, "--json"
    )
    assert code == 0
    result = json.loads(out)
    assert result == json.loads((tmp_path / "s/sensitivity.json").read_text())
    assert result["families"]["time_step"]["labels"] == ["5e-06 s", "1e-05 s"]
    assert result["growth"]["factor_per_impact"] > 1
    assert len(list((tmp_path / "s").glob("*.svg"))) == len(list((tmp_path / "s").glob("*.png"))) == 4


def test_a_model_that_is_not_there_is_unusable_input(capsys, tmp_path):
    code, _, err = run(capsys, "sensitivity", "-m", tmp_path / "no.toml", "-o", tmp_path / "s")
    assert code == 2 and "no.toml" in err


@pytest.mark.parametrize(
    "step, code", [("0", "E-RANGE"), ("nan", "E-RANGE"), ("-1e-6", "E-RANGE"), ("2e-4", "E-STEP"), ("1e-3", "E-RATE")]
)
def test_a_step_that_is_none_is_refused_and_leaves_nothing(capsys, tmp_path, step, code):
    """Zero ended in a traceback; at 2e-4 s, beyond the stable 8.4e-5 s, noise was given as a finding."""
    words = ("--step", "1e-5", "--step", step, "--duration", 1.6, "--trials", 2)
    ended, out, err = run(capsys, "sensitivity", "-o", tmp_path / "s", *words)
    assert (ended, out) == (2, "") and f"[{code}]" in err
    assert not (tmp_path / "s").exists()


class TestOfAMadeUpStudy:
    """The minutes of simulation are made up, and so are the figures."""

    @pytest.fixture
    def calls(self, monkeypatch):
        calls = []

        def study(*a):
            a[-1]("time step")
            calls.append(a[:-1])
            return made_up.study()

        figures = {"growth": Figure(), "angles": Figure()}
        monkeypatch.setattr("rockref.studies.sensitivity_study.study", study)
        monkeypatch.setattr("rockref.report.charts.sensitivity_figures.sensitivity_figures", lambda found: figures)
        return calls

    def test_words_tables_and_a_line_for_every_file(self, capsys, calls, tmp_path):
        folder = tmp_path / "new" / "s"
        code, out, _ = run(capsys, "sensitivity", "-o", folder)
        assert code == 0 and "A small difference grows 10 times" in out and "Significant digits of Table 3.1" in out
        told = [line.removeprefix("wrote ") for line in out.splitlines() if line.startswith("wrote ")]
        assert sorted(told) == sorted(map(str, folder.iterdir())) and len(told) == 5
        for name in ("growth", "angles"):
            assert (folder / f"{name}.png").read_bytes().startswith(b"\x89PNG") and (folder / f"{name}.svg").is_file()
        assert calls[0][3] == STEPS

    def test_json_is_what_is_in_the_file_with_the_model_and_the_steps_that_were_asked_for(
        self, capsys, calls, tmp_path
    ):
        words = ("--step", "1e-5", "--step", "5e-6", "--seed", 3, "--trials", 4, "--duration", 2, "--workers", 1)
        code, out, err = run(capsys, "sensitivity", "-o", tmp_path / "s", *words, "--json")
        assert (code, err) == (0, "") and out == (tmp_path / "s/sensitivity.json").read_text()
        assert json.loads(out)["model"] == "table_3_1" and json.loads(out)["growth"]["factor_per_impact"] == 10
        assert calls[0][1:] == (3, 2.0, (1e-5, 5e-6), 4, 1)
