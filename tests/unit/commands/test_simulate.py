"""`rockref simulate`: files whole or not at all, facts for people and machines."""

import json
from dataclasses import replace

import numpy as np
import pytest

from rockref import Model, api
from rockref.model.rotation import exponential
from tests.command import run
from tests.unit.report.page_checks import faults_of


def test_table_and_summary(capsys, tmp_path):
    path = tmp_path / "out.csv"
    code, out, err = run(capsys, "simulate", "-o", path, "--duration", 0.6, "--rate", 1000)
    assert (code, err) == (0, "")
    # The source's block meets the plate at 0.5104 s (1e-4 s: the step's own error is 3e-5).
    assert "main impacts (s)      0.5104" in out
    rows = path.read_text(encoding="ascii").splitlines()
    assert rows[0].startswith("t_s,wx_deg_s,wy_deg_s,wz_deg_s,x_m") and len(rows) == 602


def test_json_says_everything(capsys, tmp_path):
    path = tmp_path / "out.csv.gz"
    code, out, _ = run(capsys, "simulate", "four_points", "--duration", 0.05, "--turned", "--json", "-o", path)
    facts = json.loads(out)
    assert code == 0
    assert facts["turned"] is True and facts["overturned"] is False and facts["overturned_at_s"] is None
    assert facts["output"]["rows"] == 101 and facts["main_impacts_s"] == []
    assert path.is_file()


def test_json_has_no_number_that_json_has_not(capsys):
    """A delay alone leaves the bandwidth where it is absent, at infinity."""
    code, out, _ = run(capsys, "simulate", "--duration", 0.05, "--effect", "gyro_bandwidth:delay=0.001", "--json")
    facts = json.loads(out, parse_constant=pytest.fail)
    assert code == 0 and facts["effects"]["gyro_bandwidth"]["frequency"] is None


def test_model_file_and_effects(capsys, tmp_path):
    file = tmp_path / "model.toml"
    Model.table_3_1().replace(mass=27.0).save(file)
    arguments = ("simulate", file, "--duration", 0.05, "--effect", "gyro_scale:x=1.1,y=1,z=1", "--json")
    code, out, _ = run(capsys, *arguments, "--effect", "gyro_drift:bias_x=0.01")
    assert code == 0
    assert set(json.loads(out)["effects"]) == {"gyro_scale", "gyro_drift"}


def test_largest_rates_are_those_of_the_table(capsys, tmp_path):
    """What the gyroscope shows, in words, as JSON and in the file."""
    path = tmp_path / "out.csv"
    arguments = ("simulate", "--duration", 0.05, "--effect", "gyro_scale:x=2", "-o", path)
    facts = json.loads(run(capsys, *arguments, "--json")[1])
    written = np.loadtxt(path, delimiter=",", skiprows=1, usecols=(1, 2, 3))
    assert facts["largest_rates_deg_s"] == list(np.abs(written).max(axis=0))
    plain = json.loads(run(capsys, "simulate", "--duration", 0.05, "--json")[1])
    assert facts["largest_rates_deg_s"][0] == 2 * plain["largest_rates_deg_s"][0]
    assert f"X {facts['largest_rates_deg_s'][0]:.2f}" in run(capsys, *arguments)[1]


def test_effect_on_the_command_line_replaces_that_of_the_file(capsys, tmp_path):
    from rockref.effects.catalogue import parse

    file = tmp_path / "model.toml"
    Model.table_3_1().replace(effects=(parse("gyro_scale:x=1.1,y=1,z=1"),)).save(file)
    _, out, _ = run(capsys, "simulate", file, "--duration", 0.05, "--effect", "gyro_scale:x=1,y=1,z=1.2", "--json")
    assert json.loads(out)["effects"]["gyro_scale"]["z"] == 1.2
    assert json.loads(out)["effects"]["gyro_scale"]["x"] == 1.0


def test_overturned_block_is_a_result_and_is_said(capsys, monkeypatch):
    standing = api.simulate(Model.table_3_1(), duration=0.05, output_rate=1000.0, engine="auto")
    leaning = np.stack([exponential(np.array([a, 0.0, 0.0])) for a in np.linspace(0.0, 1.5, len(standing.t))])
    monkeypatch.setattr(api, "simulate", lambda *a, **k: replace(standing, Lambda=leaning))
    code, out, _ = run(capsys, "simulate")
    assert code == 0
    # The first row beyond 45 degrees of 1.5 rad over 50 rows is the 27th.
    assert "The block overturned: beyond 45 degrees at 0.0270 s." in out


@pytest.mark.parametrize(
    "arguments, said",
    [
        (("simulate", "--model", "no_such.toml"), "no_such.toml"),
        (("simulate", "--effect", "gyro_scal"), "gyro_scale"),
        (("simulate", "-o", "out.txt"), "E-PATH"),
        (("simulate", "-o", "no_folder/out.csv"), "E-PATH"),
    ],
)
def test_bad_input_ends_with_2_and_leaves_nothing(capsys, tmp_path, monkeypatch, arguments, said):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *arguments)
    assert (code, out) == (2, "")
    assert said in err and err.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_lost_numbers_leave_no_file(capsys, tmp_path, monkeypatch):
    from rockref.model.errors import NumericalError

    def lose(*arguments, **options):
        raise NumericalError("E-NAN", "step 7", "lost", "Use a smaller step.")

    monkeypatch.setattr(api, "simulate", lose)
    code, _, err = run(capsys, "simulate", "-o", tmp_path / "out.csv")
    assert code == 2 and "step 7" in err
    assert list(tmp_path.iterdir()) == []


def test_few_rows_are_remarked_on(capsys):
    """The first main impact is at 0.5104 s, which a row a tenth of a second does not show to four digits."""
    code, out, err = run(capsys, "simulate", "--duration", 0.6, "--rate", 10)
    assert code == 0 and "0.5104" not in out
    assert "--rate: 10 rows a second" in err and "[W-ROWS]" in err
    code, out, err = run(capsys, "simulate", "--duration", 0.6, "--rate", 100)
    assert "0.5104" in out and err == ""


def test_old_spellings_work_with_a_remark(capsys, tmp_path):
    path = tmp_path / "r.csv"
    code, out, err = run(capsys, "simulate", "four_points", "--duration", 0.05, "--out", path)
    assert code == 0 and path.is_file() and err.count("W-SPELLING") == 2
    code, _, err = run(capsys, "simulate", "-m", "four_points", "--duration", 0.05, "--output", path)
    assert code == 0 and "W-SPELLING" not in err


def test_a_page_of_a_release(capsys, tmp_path):
    code, out, _ = run(capsys, "simulate", "--duration", 0.6, "--report", tmp_path / "page")
    text = (tmp_path / "page/index.html").read_text()
    assert code == 0 and f"wrote {tmp_path / 'page/index.html'}" in out
    assert faults_of(text) == [] and "main impact at 0.510 s; the largest rate is" in text
