"""Delimiters, decimal marks, headers and rows of a logger's text."""

import zipfile

import numpy as np
import pytest

from rockref import InputError
from rockref.measure.importing.channels import find_channels
from rockref.measure.importing.layout import read_log
from rockref.measure.importing.recording import recording

ROWS = [(k * 0.01, 0.1 * k, -0.2 * k, 0.3 + k) for k in range(30)]


def text(delimiter, decimal, header="t,gx,gy,gz", ending=""):
    lines = [header.replace(",", delimiter)] if header else []
    lines += [delimiter.join(f"{v:.3f}".replace(".", decimal) for v in row) + ending for row in ROWS]
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    "delimiter, decimal", [(",", "."), (";", "."), (";", ","), ("\t", "."), ("\t", ","), (" ", ".")]
)
def test_the_layout_is_found(tmp_path, delimiter, decimal):
    path = tmp_path / "log.txt"
    path.write_text("# made by a logger\n\n" + text(delimiter, decimal))
    log = read_log(path)
    assert log.names == ("t", "gx", "gy", "gz")
    assert log.values == pytest.approx(np.round(ROWS, 3))


def test_a_delimiter_at_the_end_of_rows_is_no_column(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text(";", ".", ending=";"))
    assert find_channels(read_log(path)).rates == (1, 2, 3)


@pytest.mark.parametrize(
    "content, code",
    [
        (text(",", ","), "E-DECIMAL-COMMA"),
        ("a word\nand another\n", "E-LAYOUT"),
        (text(",", ".", header=""), "E-HEADER"),
        (text(",", ".", header="a,b,c,d"), "E-COLUMN-MISSING"),
        (text(",", ".").replace("\n0.1", "\n1,0.1"), "E-FIELDS"),
    ],
)
def test_what_cannot_be_read_is_said(tmp_path, content, code):
    path = tmp_path / "log.csv"
    path.write_text(content)
    with pytest.raises(InputError, match=f"{code}]"):
        find_channels(read_log(path))


def test_a_phone_archive_is_read(tmp_path):
    path = tmp_path / "phone.zip"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("2026/Gyroscope.csv", text(",", "."))
        archive.writestr("Metadata.csv", "a,b\n")
    assert read_log(path).values.shape == (30, 4)
    path.write_bytes(b"PK\x03\x04 cut off")
    with pytest.raises(InputError, match="E-ZIP]"):
        read_log(path)


def test_columns_are_named_by_words_or_places(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text(",", ".", header="when,a,b,c"))
    log = read_log(path)
    assert find_channels(log, ("when", "c", "b", "a")).rates == (3, 2, 1)
    assert find_channels(log, ("1", "4", "3", "2")).time == 0
    with pytest.raises(InputError, match="E-COLUMN-MISSING]"):
        find_channels(log, ("1", "4", "3", "5"))


def test_garbled_rows_are_counted(tmp_path):
    path = tmp_path / "log.csv"
    lines = text(",", ".").splitlines()
    lines[5] = "0.04,?,0.1,0.2"
    path.write_text("\n".join(lines))
    log = read_log(path)
    one = recording(log, find_channels(log))
    assert len(one.t) == 29 and [n.code for n in one.notices] == ["W-ROWS-LOST"]


def test_a_unit_says_that_columns_are_rates_in_any_language(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text(";", ",", header="Zeit/ms;Drehrate x/(mrad/s);Drehrate y/(mrad/s);Drehrate z/(mrad/s)"))
    found = find_channels(read_log(path))
    assert (found.time, found.rates, found.rate_unit, found.ticks) == (0, (1, 2, 3), "mrad_s", (1e-3,))


def test_an_axis_may_stand_before_the_unit(tmp_path):
    path = tmp_path / "log.csv"
    rows = "\n".join(",".join(f"{v:g}" for v in (*row, 0.1, 0.2, 9.8)) for row in ROWS)
    path.write_text(f"t_us,gyro_x_dps,gyro_y_dps,gyro_z_dps,acc_x_m_s2,acc_y_m_s2,acc_z_m_s2\n{rows}\n")
    found = find_channels(read_log(path))
    assert (found.rates, found.accelerations) == ((1, 2, 3), (4, 5, 6))


def recorded(tmp_path, content, rate=None):
    path = tmp_path / "log.csv"
    path.write_text(content)
    log = read_log(path)
    return recording(log, find_channels(log), rate)


def test_a_row_of_units_under_the_names_belongs_to_them(tmp_path):
    content = text(",", ".").replace("t,gx,gy,gz\n", "time,gx,gy,gz\n[s],[deg/s],[deg/s],[deg/s]\n")
    one = recorded(tmp_path, content)
    assert (one.channels.rate_unit, one.channels.ticks) == ("deg_s", (1.0,))
    assert len(one.t) == len(ROWS)


def test_rows_that_are_lost_do_not_slow_the_rate(tmp_path):
    lines = text(",", ".").replace("\n0.070,0.700,", "\n0.070,nan,").splitlines()
    assert recorded(tmp_path, "\n".join(lines)).rate == pytest.approx(100.0)


def test_rows_of_another_sensor_are_left_out(tmp_path):
    lines = text(",", ".", header="t,gx,gy,gz").splitlines()
    both = [lines[0] + ",ax,ay,az"]
    for k, line in enumerate(lines[1:]):
        both += [line + ",,,", f"{k * 0.01 + 0.004:.3f},,,,0.1,0.2,9.8"]
    one = recorded(tmp_path, "\n".join(both))
    assert one.rate == pytest.approx(100.0) and one.chip == pytest.approx(np.round(ROWS, 3)[:, 1:])
    assert "another sensor" in one.notices[0].what


def test_a_clock_that_is_set_back_is_refused_with_its_row(tmp_path):
    rows = [(t - 0.05 if k >= 20 else t, *rates) for k, (t, *rates) in enumerate(ROWS)]
    lines = ["t,gx,gy,gz", *(",".join(f"{v:.3f}" for v in row) for row in rows)]
    with pytest.raises(InputError, match="runs back by 40 ms at row 21 of 30") as refused:
        recorded(tmp_path, "\n".join(lines))
    assert refused.value.code == "E-TIME"


def test_a_stated_rate_counts_rows_where_the_clock_is_coarse(tmp_path):
    lines = ["t,gx,gy,gz", *(f"{np.floor(row[0] * 10) / 10:.1f},1,2,{row[3]:.1f}" for row in ROWS)]
    with pytest.raises(InputError, match="State the sample rate"):
        recorded(tmp_path, "\n".join(lines))
    assert recorded(tmp_path, "\n".join(lines), 100.0).t == pytest.approx(np.arange(len(ROWS)) / 100.0)


def test_counts_without_their_sign_are_taken_as_meant(tmp_path):
    counts = np.rint(1000.0 * np.sin(np.arange(60)))
    lines = ["t_ms,gx,gy,gz", *(f"{10 * k},{int(c) % 65536},{-int(c) % 65536},5" for k, c in enumerate(counts))]
    one = recorded(tmp_path, "\n".join(lines))
    assert np.array_equal(one.chip[:, 0], counts) and np.array_equal(one.chip[:, 1], -counts)
    assert [n.code for n in one.notices] == ["W-SIGN-LOST"]


def test_dates_with_points_begin_with_the_day(tmp_path):
    """Two seconds about midnight of the first of March: read as the third of January, they would be a month apart."""
    stamps = ["01.03.2026 23:59:59.", "02.03.2026 00:00:00."]
    lines = ["time,gx_deg_s,gy_deg_s,gz_deg_s"]
    lines += [f"{stamps[k // 100]}{k % 100:02d}0000,{k}.5,2.5,3.5" for k in range(200)]
    assert recorded(tmp_path, "\n".join(lines)).t == pytest.approx(np.arange(200) / 100.0)


def test_rates_without_axes_in_their_names_are_proposed_by_their_places_and_taken_by_a_word(tmp_path):
    path = tmp_path / "log.csv"
    path.write_text(text(";", ",", header="Zeit,Drehrate quer [°/s],Drehrate kipp [°/s],Drehrate hoch [°/s]"))
    with pytest.raises(InputError, match="as --columns 1,2,3,4:"):
        find_channels(read_log(path))
    found = find_channels(read_log(path), ("Zeit", "hoch", "quer", "kipp"))
    assert (found.time, found.rates, found.rate_unit) == (0, (3, 1, 2), "deg_s")
    with pytest.raises(InputError, match="'Drehrate' is no column"):
        find_channels(read_log(path), ("Zeit", "Drehrate", "quer", "kipp"))
