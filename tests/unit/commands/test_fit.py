"""`rockref fit`: exit code and last lines by the outcome, the model written; the fit itself is made up."""

import json
from dataclasses import replace

import pytest

from rockref import Model
from rockref.discover import fit_baseline as engine
from rockref.model.errors import InputError
from tests import command
from tests.unit.discover import fakes

run = command.of("fit")


@pytest.mark.parametrize(
    "outcome, code, said, then",
    [
        ("trustworthy", 0, "Trustworthy: all gates are passed.", "rockref compare anywhere --model"),
        ("effect_missing", 0, "An effect is missing: run rockref diagnose.", "rockref diagnose anywhere"),
        ("not_trustworthy", 1, "Not trustworthy: a gate was not passed.", "rockref compare anywhere --model"),
    ],
)
def test_the_outcome_is_said_last_and_decides_the_exit_code(capsys, monkeypatch, tmp_path, outcome, code, said, then):
    monkeypatch.setattr(engine, "fit_baseline", lambda *a, **k: fakes.fitted(outcome))
    path = tmp_path / "model.toml"
    found, out, _ = run(capsys, "anywhere", "-o", path)
    *_, verdict, wrote, after = out.splitlines()
    assert found == code and verdict == said
    # The model is written all the same: it says itself whether its gates were passed.
    assert Model.load(path).parameters == Model.table_3_1().parameters
    assert wrote == f"wrote {path}" and after.startswith(f"Next: {then}")
    assert "K_N 5.900e+07 (5.500e+07 to 6.300e+07) N/m" in out
    assert len(out.splitlines()) <= 12


def test_all_tables_are_shown_where_they_are_asked_for(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(engine, "fit_baseline", lambda *a, **k: fakes.fitted())
    _, out, _ = run(capsys, "anywhere", "-o", tmp_path / "m.toml", "--full")
    assert "in priors" in out and "starts_agree" in out


def test_json_has_parameters_and_gates(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(engine, "fit_baseline", lambda *a, **k: fakes.fitted())
    _, out, _ = run(capsys, "anywhere", "-o", tmp_path / "m.toml", "--json")
    record = json.loads(out)
    assert record["parameters"]["K_N"]["low"] == 5.5e7 and record["outcome"] == "trustworthy"
    assert record["gates"]["passed"] is True and record["gates"]["checks"][0]["name"] == "starts_agree"


def test_json_has_no_number_that_json_has_not(capsys, monkeypatch, tmp_path):
    """An interval may have no upper end, as that of a bandwidth."""
    found = fakes.fitted()
    monkeypatch.setattr(engine, "fit_baseline", lambda *a, **k: replace(found, noise=float("inf")))
    _, out, _ = run(capsys, "anywhere", "-o", tmp_path / "m.toml", "--json")
    assert json.loads(out, parse_constant=pytest.fail)["error"]["noise_floor"] is None


def test_unknown_effect_is_named(capsys, tmp_path):
    with pytest.raises(InputError, match="quadratic_drag"):
        engine.known_effects(("quadratic_dra",))
    code, _, err = run(capsys, tmp_path / "nowhere", "-o", tmp_path / "m.toml")
    assert code == 2 and "[E-FOLDER]" in err and not (tmp_path / "m.toml").exists()


def test_a_model_that_could_not_be_written_is_refused_before_the_work(capsys, monkeypatch, tmp_path):
    monkeypatch.setattr(engine, "fit_baseline", lambda *a, **k: pytest.fail("the work was begun"))
    code, _, err = run(capsys, "anywhere", "-o", tmp_path)
    assert code == 2 and "[E-WRITE]" in err and "is a folder" in err
