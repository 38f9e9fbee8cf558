"""Tables: every fault is found with its line and column, and good numbers arrive in SI units."""

import gzip
import math

import numpy as np
import pytest

from rockref.measure.reading.table import read_table
from rockref.model.errors import InputError
from tests.refusal import refused

NEEDED = ("t", "wx", "wy", "wz")
HEADER = "t_s,wx_deg_s,wy_deg_s,wz_deg_s\n"
ROWS = "0.000,1.0,2.0,3.0\n0.001,1.5,2.5,3.5\n"

BAD = {
    "header only": (HEADER, "E-EMPTY", "", "no row"),
    "no header": ("0.000,1,2,3\n0.001,1,2,3\n", "E-HEADER", "line 1", "numbers"),
    "comment first": ("# gyro 7\n" + HEADER + ROWS, "E-HEADER", "line 1", "comment"),
    "lines above": ("Logger X200\nSerial 7\n" + HEADER + ROWS, "E-HEADER", "line 1", "the names stand in line 3"),
    "header again": (HEADER + ROWS + HEADER + ROWS, "E-FIELDS", "line 4", "the header stands there again"),
    "remark between rows": (HEADER + ROWS + "# marker\n0.002,1,2,3\n", "E-FIELDS", "line 4", "a line of text"),
    "time of day": (HEADER + "00:00:01.5,1,2,3\n", "E-NUMBER", "line 2, column t_s", "'00:00:01.5'"),
    "too many columns": (",".join(f"c{i}" for i in range(70)) + "\n", "E-HEADER", "line 1", "70 columns"),
    "semicolons": ("t_s;wx_deg_s;wy_deg_s;wz_deg_s\n0;1;2;3\n", "E-DELIMITER", "line 1", "semicolons"),
    "tabs": (HEADER.replace(",", "\t") + "0\t1\t2\t3\n", "E-DELIMITER", "line 1", "tabs"),
    "semicolons below": (HEADER + "0;1;2;3\n", "E-DELIMITER", "line 2", "semicolons"),
    "column missing": ("t_s,wx_deg_s,wy_deg_s\n0,1,2\n", "E-COLUMN-MISSING", "line 1", "wz_deg_s"),
    "column misspelt": ("t_s,wx_deg_s,wy_deg_s,w_z_deg_s\n0,1,2,3\n", "E-COLUMN-MISSING", "line 1", "'w_z_deg_s'"),
    "column twice": ("t_s,wx_deg_s,wx_deg_s,wy_deg_s,wz_deg_s\n", "E-COLUMN-TWICE", "line 1", "columns 2"),
    "same quantity in two units": ("t_s,wx_deg_s,wx_rad_s,wy_deg_s,wz_deg_s\n", "E-COLUMN-TWICE", "line 1", "wx_rad_s"),
    "unit unknown": (HEADER.replace("wx_deg_s", "wx_rpm") + ROWS, "E-UNIT", "line 1", "'rpm'"),
    "unit missing": (HEADER.replace("wx_deg_s", "wx") + ROWS, "E-UNIT", "line 1", "no unit"),
    "time unit unknown": (HEADER.replace("t_s", "t_min") + ROWS, "E-UNIT", "line 1", "t_s or t_ms"),
    "text in numbers": (HEADER + ROWS + "0.002,1,abc,3\n", "E-NUMBER", "line 4, column wy_deg_s", "'abc'"),
    "empty field": (HEADER + "0.000,1,,3\n", "E-NUMBER", "line 2, column wy_deg_s", "empty"),
    "underscore": (HEADER + "0.000,1_000,2,3\n", "E-NUMBER", "line 2, column wx_deg_s", "'1_000'"),
    "minus of typography": (HEADER + ROWS + "0.002,−1,2,3\n", "E-NUMBER", "line 4, column wx_deg_s", "−1"),
    "hexadecimal": (HEADER + "0x0,1,2,3\n", "E-NUMBER", "line 2, column t_s", "'0x0'"),
    "complex": (HEADER + "0,1j,2,3\n", "E-NUMBER", "line 2, column wx_deg_s", "'1j'"),
    "long text": (HEADER + "0,1,2," + "x" * 200 + "\n", "E-NUMBER", "line 2, column wz_deg_s", "xxx..."),
    "not a number": (HEADER + ROWS + "0.002,nan,2,3\n", "E-NOT-FINITE", "line 4, column wx_deg_s", "'nan'"),
    "infinity": (HEADER + "0.000,1,2,-Inf\n", "E-NOT-FINITE", "line 2, column wz_deg_s", "'-Inf'"),
    "overflow": (HEADER + "0.000,1,2,1e999\n", "E-NOT-FINITE", "line 2, column wz_deg_s", "too large"),
    "too few fields": (HEADER + "0.000,1,2\n" + ROWS, "E-FIELDS", "line 2", "3 fields for 4 columns"),
    "too many fields": (HEADER + ROWS + "0.002,1,2,3,4\n", "E-FIELDS", "line 4", "5 fields for 4 columns"),
    "every row too long": (HEADER + "0.0,1,2,3,4\n0.1,1,2,3,4\n", "E-FIELDS", "line 2", "5 fields"),
    "cut off": (HEADER + ROWS + "0.002,1.", "E-FIELDS", "line 4", "cut off"),
    "empty line": (HEADER + ROWS + "\n0.002,1,2,3\n", "E-BLANK", "line 4", "empty line"),
    "line of blanks": (HEADER + "  \n" + ROWS, "E-BLANK", "line 2", "empty line"),
    "decimal commas": (HEADER + "0,000,1,0,2,0,3,0\n", "E-DECIMAL-COMMA", "line 2", "8 fields for 4 columns"),
    "decimal commas, whole time": (HEADER + "0,1,0,2,0,3,0\n", "E-DECIMAL-COMMA", "line 2", "7 fields"),
    "endless line": (HEADER + "0," + "1" * 5000 + ",2,3\n", "E-FIELDS", "line 2", "characters"),
    "endless header": ("t_s," * 2000 + "\n", "E-FIELDS", "line 1", "characters"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_table_is_refused_with_its_place(tmp_path, case):
    text, code, place, words = BAD[case]
    path = tmp_path / "run01.csv"
    path.write_text(text, encoding="utf-8")
    caught = refused(read_table, path, NEEDED)
    error = caught
    assert error.code == code
    assert error.where == f"{path}, {place}" if place else error.where == str(path)
    assert words in str(error)
    assert error.cure.endswith((".", "?"))


def test_bad_row_among_columns_that_are_left_unread(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("note,t_s,wx_deg_s,wy_deg_s,wz_deg_s\na,0,1,2,3\nb,1,1,2,3,9\n")
    with pytest.raises(InputError, match="line 3: 6 fields for 5 columns"):
        read_table(path, NEEDED)
    path.write_text("note,t_s,wx_deg_s,wy_deg_s,wz_deg_s\na,0,1,2,3\nb,1,1,2,c\n")
    with pytest.raises(InputError, match="line 3, column wz_deg_s: 'c'"):
        read_table(path, NEEDED)


def test_table_bomb_of_rows_is_refused_before_it_is_split(tmp_path):
    path = tmp_path / "a.csv.gz"
    path.write_bytes(gzip.compress(HEADER.encode() + b"\n" * 10_000_000))
    with pytest.raises(InputError, match="more than 2000000 rows") as caught:
        read_table(path, NEEDED)
    assert caught.value.code == "E-ROWS"


@pytest.mark.parametrize("rows", [2, 3])
def test_limit_of_rows_is_inclusive(tmp_path, rows):
    path = tmp_path / "a.csv"
    path.write_text(HEADER + "".join(f"{i},1,2,3\n" for i in range(rows)))
    if rows == 2:
        assert read_table(path, NEEDED, max_rows=2).rows == 2
    else:
        with pytest.raises(InputError, match="more than 2 rows"):
            read_table(path, NEEDED, max_rows=2)


def test_values_arrive_in_si_units(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("wz_mrad_s,t_ms,wx_deg_s,wy_rad_s\n4,500,180,2\n-4,1500,-90,1e-1\n")
    table = read_table(path, NEEDED)
    assert table.columns["t"].tolist() == [0.5, 1.5]
    assert np.allclose(table.columns["wx"], [math.pi, -math.pi / 2], rtol=1e-15)
    assert table.columns["wy"].tolist() == [2.0, 0.1]
    assert np.allclose(table.columns["wz"], [4e-3, -4e-3], rtol=1e-15)
    assert table.names["wz"] == "wz_mrad_s"
    assert not table.columns["t"].flags.writeable


def test_pose_columns_are_read_where_they_are(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("t_s,x_mm,y_m,z_m,qw,qx,qy,qz\n0,100,2,3,1,0,0,0\n")
    table = read_table(path, ("t", "x", "y", "z", "qw", "qx", "qy", "qz"))
    assert table.columns["x"].tolist() == [0.1]
    assert table.columns["qw"].tolist() == [1.0]


def test_unknown_columns_are_left_unread_and_said(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("comment,t_s,wx_deg_s,wy_deg_s,wz_deg_s\nhello,0,1,2,3\n,1,1,2,3\n")
    table = read_table(path, NEEDED)
    assert table.columns["t"].tolist() == [0.0, 1.0]
    assert [n.code for n in table.notices] == ["W-COLUMN-UNREAD"]
    assert "'comment'" in table.notices[0].what


def test_blanks_and_line_ends_do_not_matter(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b" t_s , wx_deg_s,wy_deg_s,wz_deg_s\r\n 0 , 1,2,3\r\n1,1,2,3\r\n\r\n")
    table = read_table(path, NEEDED)
    assert table.rows == 2
    assert table.notices == ()


PLAIN = HEADER + "0.000,1,2,3\n0.001,4,5,6\n"
READ = {
    "quoted fields": PLAIN.replace("1,2,3", '"1","2","3"').replace("t_s", '"t_s"'),
    "a line that names the separator": "sep=,\n" + PLAIN,
    "a row of units": PLAIN.replace(HEADER, HEADER + "s,deg/s,deg/s,deg/s\n"),
    "units in brackets": PLAIN.replace(HEADER, HEADER + "[s],[°/s],[°/s],[°/s]\n"),
    "a footer": PLAIN + "# stopped by hand\nSamples: 2\n",
    "commas at the end of rows": PLAIN.replace("3\n", "3,\n").replace("6\n", "6,\n"),
    "commas at the end of all lines": PLAIN.replace("\n", ",\n"),
    "all at once": 'SEP=,\n"t_s",wx_deg_s,wy_deg_s,wz_deg_s,\ns,deg/s,deg/s,deg/s,\n'
    '"0.000",1,2,3,\n0.001,4,5,6,\nEnd of file,,,,\n',
}


@pytest.mark.parametrize("case", READ)
def test_dialects_of_commas_are_read(tmp_path, case):
    path = tmp_path / "a.csv"
    path.write_text(READ[case], encoding="utf-8")
    table = read_table(path, NEEDED)
    assert table.columns["t"].tolist() == [0.0, 0.001]
    assert np.allclose(np.degrees(table.columns["wz"]), [3.0, 6.0], rtol=1e-15)


REFUSED = {
    "another separator": ("sep=;\n" + PLAIN.replace(",", ";"), "E-DELIMITER", "line 1"),
    "decimal commas in quotes": (PLAIN.replace("4,5", '"4,1",5'), "E-DECIMAL-COMMA", "line 3, column wx_deg_s"),
    "units of another kind": (PLAIN.replace(HEADER, HEADER + "s,rad/s,rad/s,rad/s\n"), "E-UNIT", "line 2"),
    "a word below a row of units": (
        PLAIN.replace(HEADER, "sep=,\n" + HEADER + "s,deg/s,deg/s,deg/s\n").replace("5", "five"),
        "E-NUMBER",
        "line 5, column wy_deg_s",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_other_dialects_are_refused_with_their_line(tmp_path, case):
    text, code, place = REFUSED[case]
    path = tmp_path / "a.csv"
    path.write_text(text, encoding="utf-8")
    error = refused(read_table, path, NEEDED)
    assert error.code == code and error.where == f"{path}, {place}"
