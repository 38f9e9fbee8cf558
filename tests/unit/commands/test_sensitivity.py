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
