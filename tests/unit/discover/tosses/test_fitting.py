"""`fit` and `add` on tosses with known truth, through the commands."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import cli
from rockref.api import Model
from rockref.discover.tosses.fit import TossFit
from rockref.discover.tosses.fitting import add_to_tosses, at_values, fit_tosses, unfitted
from rockref.discover.tosses.parameters import effect_parameters
from rockref.effects.shape.mass_eccentricity import MassEccentricity
from rockref.measure.tosses.load import load_tosses
from rockref.model.errors import InputError
from tests.tosses import made, stated, write_tosses

pytest.importorskip("numba")
CENTRE = 5e-3


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    true = stated().replace(effects=(MassEccentricity(0, 0, CENTRE),))
    x, Lambda, _ = made(true, 24, frames=50, seed=2, noise=2e-5)
    return write_tosses(tmp_path_factory.mktemp("made") / "tosses", x, Lambda)


def run(capsys, *words):
    with pytest.raises(SystemExit) as end:
        cli.main([*map(str, words)])
    return end.value.code, *capsys.readouterr()


@pytest.mark.slow
def test_add_finds_what_is_missing_and_compare_reads_the_model(capsys, folder, tmp_path):
    model = tmp_path / "with.toml"
    code, out, _ = run(capsys, "add", "mass_eccentricity", folder, "-o", model, "--report", tmp_path / "p", "--json")
    assert code == 0
    record = json.loads(out)
    # Made with 5 mm; noise and the few impacts of eighteen tosses leave some tenths of a millimetre.
    assert record["parameters"]["mass_eccentricity.z"]["value"] == pytest.approx(CENTRE, abs=4e-4)
    assert record["holdout_falls_by"]["low"] > 0
    assert (tmp_path / "p" / "index.html").is_file()
    loaded = Model.load(model)
    assert loaded.effects[0].z == pytest.approx(CENTRE, abs=4e-4)
    rows = json.loads(run(capsys, "compare", folder, "--model", model, "--json")[1])["rows"]
    held = next(r for r in rows if r["use"] == "holdout" and r["start"] == "flight")
    after = next(e["after"] for e in record["errors"] if e["use"] == "holdout" and e["start"] == "flight")
    assert held["position_percent"]["mean"] == pytest.approx(after["position_percent"]["mean"], abs=0.01)


def test_a_fit_that_begins_at_a_model_keeps_its_effects(folder):
    begun = stated().replace(effects=(MassEccentricity(0, 0, CENTRE),))
    base, own = unfitted(begun)
    assert not base.effects and list(own) == ["mass_eccentricity"]
    z = at_values(effect_parameters("mass_eccentricity"), own)
    assert effect_parameters("mass_eccentricity")[2].value(z[2]) == pytest.approx(CENTRE)
    found = fit_tosses(load_tosses(folder), (), begun, iterations=1)
    assert [e.id for e in found.model.effects] == ["mass_eccentricity"]
    assert "holdout" not in json.dumps(found.to_dict())


def test_the_command_fit_writes_what_it_found(capsys, folder, tmp_path):
    model = tmp_path / "law.toml"
    code, out, _ = run(capsys, "fit", folder, "-o", model)
    assert code == 0
    assert "K_N" in out and "Held-out tosses were not looked at" in out
    assert Model.load(model).custom_points is not None


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (("add", "gyro_drift"), "E-EFFECT", "not for tosses"),
        (("add", "mass_eccentrcity"), "E-EFFECT", "mass_eccentricity"),
        (("identify",), "E-KIND", "not for tosses"),
        (("fit", "--model", "table_3_1"), "E-KIND", "released block"),
    ],
)
def test_what_is_not_served_is_said(capsys, folder, tmp_path, words, code, said):
    name, *rest = words
    asked = [name, *rest, folder] if name == "add" else [name, folder, *rest]
    ended, _, error = run(capsys, *asked, "-o", tmp_path / "out")
    assert ended == 2
    assert code in error and said in " ".join(error.split())
    assert not (tmp_path / "out").is_file()


def test_what_the_model_has_is_not_added_again(folder):
    """Before and after would be the same fit."""
    model = stated().replace(effects=(MassEccentricity(0, 0, CENTRE),))
    with pytest.raises(InputError, match="is in the model already"):
        add_to_tosses("mass_eccentricity", load_tosses(folder), model)


@pytest.mark.parametrize(
    ("words", "work"),
    [
        (("compare", "FOLDER", "--report", "PLACE"), "compare.compare"),
        (("diagnose", "FOLDER", "--report", "PLACE"), "diagnose.diagnose"),
        (("diagnose", "FOLDER", "--save-model", "PLACE"), "diagnose.diagnose"),
        (("diagnose", "FOLDER", "-o", "PLACE"), "diagnose.diagnose"),
        (("fit", "FOLDER", "-o", "PLACE"), "fitting.fit_tosses"),
        (("add", "mass_eccentricity", "FOLDER", "-o", "PLACE"), "fitting.add_to_tosses"),
        (("add", "mass_eccentricity", "FOLDER", "--report", "PLACE"), "fitting.add_to_tosses"),
        (("reproduce", "cube", "PLACE", "--data", "FOLDER"), "compare.compare"),
    ],
)
def test_what_cannot_be_written_is_refused_before_the_work(capsys, folder, tmp_path, monkeypatch, words, work):
    monkeypatch.setattr(f"rockref.discover.tosses.{work}", lambda *a, **k: pytest.fail("the work was begun"))
    monkeypatch.setattr("rockref.workflows.reproduce_cube.compare", lambda *a, **k: pytest.fail("the work was begun"))
    (tmp_path / "file").write_text("here is no folder")
    places = {"FOLDER": folder, "PLACE": tmp_path / "file" / "out"}
    ended, _, error = run(capsys, *(places.get(word, word) for word in words))
    assert ended == 2
    assert "E-WRITE" in error and "folder" in error


@pytest.mark.parametrize(("verdict", "code"), [("not_trustworthy", 1), ("none", 0), ("named", 0)])
def test_a_diagnosis_that_is_not_to_be_trusted_ends_with_one(capsys, folder, monkeypatch, verdict, code):
    found = SimpleNamespace(to_dict=lambda: {"verdict": verdict}, model=stated())
    monkeypatch.setattr("rockref.discover.tosses.diagnose.diagnose", lambda *a, **k: found)
    ended, out, _ = run(capsys, "diagnose", folder, "--json")
    assert ended == code and json.loads(out)["verdict"] == verdict


def few(folder, use, count):
    """The tosses of the folder with this many of a use."""
    whole = load_tosses(folder)
    kept = [t for t in whole.tosses if t.use != use]
    return replace(whole, tosses=(*kept, *whole.used(use)[:count]))


def test_too_few_tosses_are_refused(folder):
    with pytest.raises(InputError, match="has 7 tosses of use fit") as error:
        fit_tosses(few(folder, "fit", 7))
    assert error.value.code == "E-SIZE"


@pytest.mark.parametrize("held, uses", [(0, {"fit"}), (6, {"fit", "holdout"})])
def test_without_held_out_tosses_an_addition_has_no_proof(folder, monkeypatch, held, uses):
    monkeypatch.setattr(TossFit, "run", lambda self, z, iterations: (z, float(np.abs(z).sum())))
    found = add_to_tosses("mass_eccentricity", few(folder, "holdout", held))
    assert {use for use, _ in found.errors} == uses and bool(found.proof) is bool(held)
    assert found.after.fit.effects == ("mass_eccentricity",) and found.before.fit.effects == ()
