"""`rockref sensitivity`: files and JSON, and refusals."""

import json

import pytest

from rockref import cli


def run(capsys, *arguments):
    """Exit code, standard output and standard error of `rockref ARGUMENTS`."""
    with pytest.raises(SystemExit) as end:
        cli.main([str(a) for a in arguments])
    out, err = capsys.readouterr()
    return end.value.code, out, err


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
