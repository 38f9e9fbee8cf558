"""`rockref shake` and `rockref simulate --base`: extremes, tables, resumed ensembles, what is refused."""

import csv
import json
import math

import pytest

pytest.importorskip("numba")

from rockref.shake import ensemble
from tests.unit.commands.test_simulate import run
from tests.unit.report.page_checks import faults_of


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    """Half a second of shaking along y, then along x."""
    path = tmp_path_factory.mktemp("records") / "pulse.csv"
    rows = [f"{0.01 * k:.2f},{0.5 * math.cos(9 * k):.6f},{3 * math.sin(0.13 * k):.6f}" for k in range(50)]
    path.write_text("\n".join(["t [s],ax [m/s2],ay [m/s2]", *rows, "0.50,0,0"]) + "\n")
    return path


SMALL = ("--step", 4e-5, "--after", 0.2, "--heading", 180, "--feet", 2e-5)


def test_one_run_says_its_extremes_and_ends_when_it_is_over(capsys, record, tmp_path):
    path = tmp_path / "rows.csv"
    options = ("--step", 4e-5, "--rate", 1000, "--duration", 1.0)
    code, out, _ = run(capsys, "simulate", "--base", record, "--rotate", 30, *options, "-o", path)
    assert code == 0 and "largest tilt (deg)" in out and "record of 0.50 s" in out
    assert len(path.read_text().splitlines()) == 1002
    code, out, _ = run(capsys, "simulate", "--base", record, "--scale", 5, *options, "--json")
    facts = json.loads(out)
    assert code == 0 and facts["fell"] is True and facts["ended"] == "fell" and facts["end"] < 1.0
    assert facts["tilt"] >= math.pi / 4


@pytest.mark.parametrize(
    "options, code",
    [(("--turned",), "E-OPTION"), (("--effect", "quadratic_drag:c=0.4"), "E-BASE"), (("--scale", "nan"), "E-RANGE")],
)
def test_what_belongs_to_a_release_or_to_the_room_is_refused(capsys, record, options, code):
    ended, out, err = run(capsys, "simulate", "--base", record, "--duration", 0.1, *options)
    assert ended == 2 and not out and f"[{code}]" in err


def test_the_page_of_an_ensemble_has_fragility_and_spectrum(capsys, record, tmp_path):
    other = tmp_path / "slow.csv"
    rows = [f"{0.02 * k:.2f},{0.5 * math.cos(4 * k):.6f},{3 * math.sin(0.13 * k):.6f}" for k in range(50)]
    other.write_text("\n".join(["t [s],ax [m/s2],ay [m/s2]", *rows]) + "\n")
    options = ("--runs", 8, "--scale", "0.3,3", *SMALL[2:], "--step", "4e-5,5e-5", "--report", tmp_path / "r")
    code, out, _ = run(capsys, "shake", "table_3_1", record, other, *options, "-o", tmp_path / "e")
    page = (tmp_path / "r" / "index.html").read_text(encoding="utf-8")
    assert code == 0 and out.splitlines()[-1].endswith("index.html: 8 runs") and not faults_of(page)
    assert "overturning spectrum" in page
    assert [line.split()[1] for line in out.splitlines()[1:5]] == ["4e-05", "5e-05"] * 2


def test_no_scheduler_is_told(capsys, record, tmp_path):
    pytest.importorskip("distributed")
    options = ("--runs", 2, *SMALL, "--dask", "tcp://127.0.0.1:1", "-o", tmp_path / "e")
    assert "[E-DASK]" in run(capsys, "shake", "table_3_1", record, *options)[2]


def test_an_interrupted_ensemble_goes_on_to_the_same_table(capsys, record, tmp_path, monkeypatch):
    monkeypatch.setattr(ensemble, "BLOCK", 4)
    monkeypatch.setattr("rockref.shake.ensemble_store.BLOCK", 4)
    arguments = ("shake", "table_3_1", record, "--runs", 10, "--scale", "0.5,4", *SMALL)
    code, out, _ = run(capsys, *arguments, "-o", tmp_path / "whole")
    assert code == 0 and "fell" in out
    table = (tmp_path / "whole" / "runs.csv").read_bytes()
    rows = list(csv.DictReader(table.decode().splitlines()))
    assert [row["run"] for row in rows] == [str(k) for k in range(10)]
    assert {row["fell"] for row in rows if row["factor"] == "4.0"} == {"True"}

    made = ensemble.Ensemble.rows

    def interrupted(self, first, last, workers=None):
        if first >= 4:
            raise KeyboardInterrupt
        return made(self, first, last, workers)

    monkeypatch.setattr(ensemble.Ensemble, "rows", interrupted)
    code, _, err = run(capsys, *arguments, "-o", tmp_path / "halves", "--workers", 1)
    assert code == 130 and "goes on" in err and not (tmp_path / "halves" / "runs.csv").exists()
    asked = []
    monkeypatch.setattr(ensemble.Ensemble, "rows", lambda self, a, b, w=None: asked.append(a) or made(self, a, b, w))
    assert run(capsys, *arguments, "-o", tmp_path / "halves")[0] == 0
    assert asked == [4, 8] and (tmp_path / "halves" / "runs.csv").read_bytes() == table

    code, out, err = run(capsys, *arguments, "--seed", 1, "-o", tmp_path / "halves")
    assert code == 2 and "E-ENSEMBLE" in err and not out
    (tmp_path / "halves" / "parts" / "000001.json").write_text("[1")
    code, _, err = run(capsys, *arguments, "-o", tmp_path / "halves")
    assert code == 2 and "E-ENSEMBLE" in err and "000001.json" in err
