"""Tables of one's own: units in the names, or no reading."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record


@pytest.mark.parametrize(
    "header, worth",
    [
        ("t [s],ax [m/s2]", 1.0),
        ("t_s,ax_g", 9.80665),
        ("time (s),ax (cm/s^2)", 0.01),
        ("t_s,ax_cm_s2", 0.01),
        ("t [s],ax [mg]", 9.80665e-3),
    ],
)
def test_units_stand_in_the_names(write, header, worth):
    base = read(write("own.csv", header, "0.00,0", "0.01,1", "0.02,-2.5"))
    assert base.a[:, 0] == pytest.approx([0.0, worth, -2.5 * worth])
    assert base.dt == pytest.approx(0.01)


def test_axes_stand_in_the_names_too(write):
    base = read(write("own.csv", "az [g],t [ms],note,ay [m/s2]", "0.1,0,x,1", "0.2,4,y,2"))
    assert base.a == pytest.approx(np.array([[0.0, 1.0, 0.980665], [0.0, 2.0, 1.96133]]))
    assert base.dt == pytest.approx(0.004)


def test_missing_rows_become_straight_lines_and_are_said(write):
    record = read_record(write("own.csv", "t [s],ax [m/s2]", "0.0,0", "0.1,1", "0.2,2", "0.5,5", "0.6,0"))
    assert record.base.a[:, 0] == pytest.approx([0, 1, 2, 3, 4, 5, 0])
    (gap,) = [notice for notice in record.notices if notice.code == "W-RECORD-GAP"]
    assert "2 rows are missing" in gap.what


@pytest.mark.parametrize(
    "lines, code",
    [
        (("t [s],ax", "0,0", "1,1"), "E-RECORD-UNIT"),
        (("t,ax [g]", "0,0", "1,1"), "E-RECORD-UNIT"),
        (("t [s],ax [m/s]", "0,0", "1,1"), "E-RECORD-UNIT"),
        (("t [s],ax [g],ax [m/s2]", "0,0,0", "1,1,1"), "E-COLUMN-TWICE"),
        (("ax [g],ay [g]", "0,0", "1,1"), "E-COLUMN-MISSING"),
        (("t [s],ax [g]", "0,0", "0.01,", "0.02,1"), "E-RECORD-NUMBER"),
        (("t [s],ax [g]", "0,0", "0.01,1", "0.013,2", "0.03,1"), "E-RECORD-TIME"),
        (("t [s],ax [g]", "0,0", "0.01,1", "0.01,2"), "E-RECORD-TIME"),
        (("t [s];ax [g]", "0;0", "0,01;1"), "E-DELIMITER"),
        (("acceleration", "0", "1"), "E-RECORD-FORMAT"),
    ],
)
def test_what_does_not_say_what_it_is_is_refused(write, lines, code):
    with pytest.raises(InputError, match=code):
        read(write("own.csv", *lines))
