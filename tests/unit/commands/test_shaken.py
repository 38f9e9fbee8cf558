"""`rockref compare` of tests on a shake table, and `rockref plan --outcomes`."""

import json

import pytest

pytest.importorskip("numba")

from tests.unit.commands.test_shake import SMALL, record  # noqa: F401
from tests.unit.commands.test_simulate import run
from tests.unit.report.page_checks import faults_of


@pytest.fixture(scope="module")
def folder(record, tmp_path_factory):  # noqa: F811
    """Tests of two motions that a run of another seed has made."""
    path = tmp_path_factory.mktemp("table")
    turned = record.read_text().replace("ax", "b").replace("ay", "ax").replace("b [", "ay [")
    (path / "a.csv").write_text(record.read_text())
    (path / "b.csv").write_text(turned)
    (path / "experiment.toml").write_text(
        'name = "table"\nkind = "shaken"\n[draws]\nheading_deg = 180\nfeet_mm = 0.02\n'
    )
    rows = [
        f"{name},{factor},{int(factor > 2)},{tilt}"
        for name in ("a.csv", "b.csv")
        for factor, tilt in ((0.1, 0.01), (0.1, 0.02), (4, ""), (4, ""), (0.5, 2))
    ]
    (path / "tests.csv").write_text("\n".join(["record,factor,fell,tilt_deg", *rows]) + "\n")
    return path


def test_a_model_is_scored_beside_the_regression_and_the_answer_comes_last(capsys, folder, tmp_path):
    arguments = ("compare", folder, "--model", "table_3_1", "--runs", 2, "--step", 4e-5)
    code, out, _ = run(capsys, *arguments, "--report", tmp_path)
    assert code == 0 and "10 tests of 2 motions, 4 fell; 2 runs a test and model" in out
    assert "Repeats agree in 4 of 4 pairs" in out and "wrote" in out.splitlines()[-1]
    assert out.splitlines()[-2].startswith("Largest tilt of table_3_1")
    assert not faults_of((tmp_path / "index.html").read_text(encoding="utf-8"))
    code, out, _ = run(capsys, *arguments, "--json")
    facts = json.loads(out)
    bar, model = facts["predictions"]
    assert code == 0 and facts["runs_a_test"] == 2 and model["name"] == "table_3_1"
    # Small motions do not fell this block and large ones do, whatever is drawn.
    assert model["accuracy"]["mean"] == 1.0
    assert {d["quantity"]: d["runs"] for d in facts["maxima"]} == {"tilt": 20}


def test_options_of_releases_are_refused(capsys, folder):
    assert run(capsys, "compare", folder, "--check")[0] == 2
    assert "[E-ARGUMENT]" in run(capsys, "compare", "data/experiments/mystery-01", "--runs", 3)[2]
    assert "[E-ARGUMENT]" in run(capsys, "diagnose", folder, "--fresh")[2]


def test_plan_says_how_many_tests_tell_two_probabilities(capsys):
    code, out, _ = run(capsys, "plan", "--outcomes", "0.5,0.6", "--tests", 226)
    assert code == 0 and out.splitlines()[-1].startswith("388 independent tests a side tell 0.5 from 0.6")
    assert "226 tests a side see a difference of 0.133" in out and "0.090 on either side" in " ".join(out.split())
    facts = json.loads(run(capsys, "plan", "--outcomes", "0.5,0.6", "--json")[1])
    assert (facts["tests_a_side"], facts["rule_of_thumb"], facts["tests"]) == (388, 400, 388)
    assert "[E-ARGUMENT]" in run(capsys, "plan", "--tests", 3)[2]
    assert "[E-TYPE]" in run(capsys, "plan", "--outcomes", "0.5")[2]
