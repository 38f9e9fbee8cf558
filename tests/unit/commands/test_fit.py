"""`rockref fit`: exit code by the gates, the model written; the fit itself is made up."""

import json
from dataclasses import replace

import pytest

from rockref import Model, cli
from rockref.discover import fitting
from rockref.model.errors import InputError
from tests.unit.discover import fakes


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        cli.main(["fit", *map(str, arguments)])
    return end.value.code, *capsys.readouterr()


@pytest.mark.parametrize("passed, code", [(True, 0), (False, 1)])
def test_exit_code_says_whether_the_gates_were_passed(capsys, monkeypatch, tmp_path, passed, code):
    monkeypatch.setattr(fitting, "fit_experiment", lambda *a, **k: fakes.fitted(passed))
    path = tmp_path / "model.toml"
    found, out, _ = run(capsys, "anywhere", "-o", path)
    assert found == code and ("Not trustworthy" in out) is not passed
    # The model is written all the same: it says itself whether its gates were passed.
    assert Model.load(path).parameters == Model.table_3_1().parameters
    assert "K_N" in out and "5.500e+07" in out and f"wrote {path}" in out.replace("\n", "")


def test_json_has_parameters_and_gates(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(fitting, "fit_experiment", lambda *a, **k: fakes.fitted())
    _, out, _ = run(capsys, "anywhere", "-o", tmp_path / "m.toml", "--json")
    record = json.loads(out)
    assert record["parameters"]["quadratic_drag.c"]["low"] == 0.38
    assert record["gates"]["passed"] is True and record["gates"]["checks"][0]["name"] == "starts_agree"


def test_json_has_no_number_that_json_has_not(capsys, monkeypatch, tmp_path):
    """An interval may have no upper end, as that of a bandwidth."""
    found = fakes.fitted()
    monkeypatch.setattr(fitting, "fit_experiment", lambda *a, **k: replace(found, mean_loss=float("inf")))
    _, out, _ = run(capsys, "anywhere", "-o", tmp_path / "m.toml", "--json")
    assert json.loads(out, parse_constant=pytest.fail)["mean_loss"] is None


def test_unknown_effect_is_named(capsys, tmp_path):
    with pytest.raises(InputError, match="quadratic_drag"):
        fitting.known_effects(("quadratic_dra",))
    code, _, err = run(capsys, tmp_path / "nowhere", "-o", tmp_path / "m.toml")
    assert code == 2 and "[E-FOLDER]" in err and not (tmp_path / "m.toml").exists()


def test_a_model_that_could_not_be_written_is_refused_before_the_work(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(fitting, "fit_experiment", lambda *a, **k: pytest.fail("the work was begun"))
    code, _, err = run(capsys, "anywhere", "-o", tmp_path)
    assert code == 2 and "[E-WRITE]" in err and "is a folder" in err
