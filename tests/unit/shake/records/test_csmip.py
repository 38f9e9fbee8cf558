"""CSMIP V2: columns of ten that touch, several channels in a file."""

import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record

VALUES = ("  1.171726-12.626200 -7.202959  8.110211  8.140768-151.94748123.4567891234.56789", "  2.500000")
ANNOUNCED = "     9 points of accel data equally spaced at  .005 sec, in cm/sec2. (8f10.6)"


def channel(direction, *rows, announced=ANNOUNCED):
    return [
        f"Corrected accelerogram   1.CI.WLT      Chan  1: {direction}     from   ",
        "     9 points of instrument- and baseline-corrected accel, veloc and displ data",
        "At equally-spaced intervals of    .005  sec.",
        "    1  100    1    3    3  100 -999",
        announced,
        *(rows or VALUES),
        "     9 points of veloc data equally spaced at  .005 sec, in cm/sec.  (8f10.6)",
        *VALUES,
        "/&  ----------  End of data for channel  1  ----------",
    ]


def test_columns_that_touch_are_cut_by_their_width(write):
    base = read(write("one.V2", *channel("90 Deg")))
    cm = [1.171726, -12.6262, -7.202959, 8.110211, 8.140768, -151.94748, 123.456789, 1234.56789, 2.5]
    # One rounding.
    assert base.a[:, 0] == pytest.approx([0.01 * v for v in cm], rel=1e-15)
    assert base.dt == 0.005


def test_three_channels_of_a_file(write):
    lines = [line for direction in ("180 Deg", "Up", " 90 Deg") for line in channel(direction)]
    record = read_record(write("three.v2", *lines))
    assert [c.direction for c in record.channels] == [180.0, "up", 90.0]
    # South has east to its left.
    assert record.base.a[:, 0] == pytest.approx(record.channels[0].a)
    assert record.base.a[:, 1] == pytest.approx(record.channels[2].a)


def test_the_older_way_to_say_it(write):
    old = "  9 POINTS OF ACCEL DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: CM/SEC/SEC)"
    assert read(write("old.V2", *channel("DN", announced=old))).dt == 0.02


@pytest.mark.parametrize(
    "announced, rows, code",
    [
        (ANNOUNCED.replace("9 points", "19 points"), VALUES, "E-RECORD-"),
        (ANNOUNCED, (VALUES[0].replace("1.171726", "********"), VALUES[1]), "E-RECORD-NUMBER"),
        ("     9 points of accel data equally spaced at  .005 sec.", VALUES, "E-RECORD-UNIT"),
        (ANNOUNCED.replace("cm/sec2", "counts"), VALUES, "E-RECORD-UNIT"),
    ],
)
def test_damaged_blocks_and_counts_are_refused(write, announced, rows, code):
    with pytest.raises(InputError, match=code):
        read(write("bad.V2", *channel("90 Deg", *rows, announced=announced)))


def test_four_channels_are_no_motion_of_a_plate(write):
    with pytest.raises(InputError, match="E-RECORD-CHANNELS"):
        read(write("four.v2", *(line for _ in range(4) for line in channel("Up"))))
