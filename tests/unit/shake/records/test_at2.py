"""PEER AT2: values that touch, counts, units, headers."""

import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record

ROWS = ("  .1000000E-02-.2000000E-02  .3000000E-02  .0000000E+00-.1000000E-02", "  .5000000E-03  .2500000E-02")
G = 9.80665


def test_values_that_touch_and_a_short_last_line(at2):
    base = read(at2(*ROWS))
    # Digits of a sum are those of the text times g: one rounding.
    assert base.a[:, 0] / G == pytest.approx([1e-3, -2e-3, 3e-3, 0.0, -1e-3, 5e-4, 2.5e-3], rel=1e-15)
    assert (base.t_0, base.dt, base.name) == (0.0, 0.005, "a")
    assert not base.a[:, 1:].any()


@pytest.mark.parametrize(
    "sizes", ["NPTS=     7, dt=  .00500", "NPTS=7,DT=0.005 SEC,", "NPTS=  7 DT= 5.0E-3", "   7    .0050   NPTS, DT"]
)
def test_ways_to_write_the_fourth_line(at2, sizes):
    assert read(at2(*ROWS, sizes=sizes)).dt == 0.005


@pytest.mark.parametrize(
    "change, code, line",
    [
        ({"sizes": "NPTS= 8, DT= .00500 SEC"}, "E-RECORD-COUNT", 4),
        ({"third": "VELOCITY TIME SERIES IN UNITS OF CM/S"}, "E-RECORD-KIND", 3),
        ({"third": "DISPLACEMENT TIME SERIES IN UNITS OF CM"}, "E-RECORD-KIND", 3),
        ({"third": "ACCELERATION TIME SERIES"}, "E-RECORD-UNIT", 3),
        ({"third": "ACCELERATION TIME SERIES IN UNITS OF COUNTS"}, "E-RECORD-UNIT", 3),
        ({"sizes": "NPTS= 7, DT= 5.0 SEC"}, "E-RECORD-STEP", 4),
    ],
)
def test_what_is_no_acceleration_or_not_whole_is_refused(at2, change, code, line):
    with pytest.raises(InputError) as caught:
        read(at2(*ROWS, **change))
    assert caught.value.code == code and caught.value.where.endswith(f"line {line}")


def test_stars_of_an_overflow_are_named_with_their_line(at2):
    with pytest.raises(InputError, match=r"line 6: '\*{4}'.*E-RECORD-NUMBER"):
        read(at2(ROWS[0], "  ****  .2500000E-02"))


def test_lines_that_end_twice_are_read(at2, tmp_path):
    text = at2(*ROWS).read_text(encoding="utf-8").replace("\n", "\r\r\n")
    twice = tmp_path / "twice.AT2"
    twice.write_bytes(text.encode())
    assert read(twice) == read(at2(*ROWS))


@pytest.mark.parametrize(
    "field, direction", [("140", 140.0), ("N (CWB)", 0.0), ("360", 0.0), ("UP", "up"), ("DWN", "down"), ("H1", None)]
)
def test_direction_stands_in_the_second_line(at2, field, direction):
    assert read_record(at2(*ROWS, second=f"Somewhere, 1/1/2000, {field}")).channels[0].direction == direction
