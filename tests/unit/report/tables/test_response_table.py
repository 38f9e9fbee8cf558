"""A response as a file."""

import gzip
import hashlib
from dataclasses import replace

import numpy as np
import pytest

from rockref import Model, simulate
from rockref.effects.catalogue import parse
from rockref.measure import read_table
from rockref.model.errors import InputError
from rockref.model.rotation import exponential
from rockref.report.tables.response_table import check_name, overturned_at, write_response


@pytest.fixture(scope="module")
def response():
    return simulate(Model.table_3_1(), duration=0.1, output_rate=1000.0, engine="auto")


def test_reading_gives_the_doubles_that_were_written(tmp_path, response):
    facts = write_response(response, tmp_path / "r.csv")
    rows = np.genfromtxt(tmp_path / "r.csv", delimiter=",", names=True)
    assert facts["rows"] == len(rows) == len(response.t) and facts["columns"] == len(rows.dtype.names)
    assert np.array_equal(rows["wx_deg_s"], response.crv[:, 0])
    assert np.array_equal(rows["fz_1ext_N"], response.F[:, 0, 2])
    assert np.array_equal(rows["contact_1ext"].astype(bool), response.anchored[:, 0])


def test_table_is_one_that_experiments_are_read_from(tmp_path, response):
    write_response(response, tmp_path / "r.csv.gz")
    table = read_table(tmp_path / "r.csv.gz", ("t", "wx", "wy", "wz"))
    assert table.columns["wx"] == pytest.approx(response.W[:, 0], abs=1e-15)


def test_same_run_gives_the_same_packed_file(tmp_path, response):
    a = write_response(response, tmp_path / "a.csv.gz")
    b = write_response(response, tmp_path / "b.csv.gz")
    assert a["sha256"] == b["sha256"]
    assert gzip.decompress((tmp_path / "a.csv.gz").read_bytes()).startswith(b"t_s,wx_deg_s")


def test_rates_are_those_that_the_gyroscope_shows(tmp_path):
    model = Model.table_3_1()
    scaled = model.replace(effects=(parse("gyro_scale:x=1.02,y=1,z=1"),))
    shown = []
    for k, one in enumerate((model, scaled)):
        path = tmp_path / f"{k}.csv"
        write_response(simulate(one, duration=0.1, output_rate=1000.0, engine="auto"), path)
        shown.append(np.genfromtxt(path, delimiter=",", names=True)["wx_deg_s"])
    assert shown[1] == pytest.approx(1.02 * shown[0], rel=1e-12)


def test_overturned_at_the_first_row_beyond_45_degrees(response):
    assert overturned_at(response) is None
    leaning = np.stack([exponential(np.array([a, 0.0, 0.0])) for a in np.linspace(0.0, 1.5, len(response.t))])
    fallen = overturned_at(replace(response, Lambda=leaning))
    assert fallen == pytest.approx(response.t[-1] * (np.pi / 4) / 1.5, abs=0.001)


@pytest.mark.parametrize("name", ["r.txt", "r", "missing/r.csv"])
def test_names_that_are_no_tables_are_refused_before_work(tmp_path, name):
    with pytest.raises(InputError, match="E-PATH]"):
        check_name(tmp_path / name)


@pytest.mark.parametrize("rows", [1, 7, 1000])
def test_the_file_is_what_pandas_would_write(tmp_path, response, monkeypatch, rows):
    """Byte for byte, in however many pieces."""
    from rockref.report.tables import response_table

    monkeypatch.setattr(response_table, "ROWS_A_PIECE", rows)
    write_response(response, tmp_path / "r.csv")
    frame = response.to_frame()
    switches = [name for name in frame if frame[name].dtype == bool]
    frame[switches] = frame[switches].astype("int8")
    text = frame.to_csv(index=False, lineterminator="\n")
    facts = write_response(response, tmp_path / "r.csv.gz")
    assert (tmp_path / "r.csv").read_text() == text
    data = (tmp_path / "r.csv.gz").read_bytes()
    assert gzip.decompress(data).decode() == text
    assert facts["sha256"] == hashlib.sha256(data).hexdigest()
