"""COSMOS V2: units by code, the interval in ms, a count that is off by one."""

import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record


def lines(code=4, unit="cm/sec2", count=4, values=(1.0, -2.0, 3.0, 4.0), azimuth=90, kind="acceleration"):
    integers, reals = [-999] * 100, [-999.0] * 100
    integers[53], reals[61] = azimuth, 5.0
    return [
        "Corrected acceleration    (Format v01.20 with 13 text lines)",
        *("text" for _ in range(12)),
        " 100 Integer-header values follow on  10 lines, Format= (10I8)",
        *("".join(f"{v:8d}" for v in integers[i : i + 10]) for i in range(0, 100, 10)),
        " 100 Real-header values follow on  20 lines, Format= (5F15.6)",
        *("".join(f"{v:15.6f}" for v in reals[i : i + 5]) for i in range(0, 100, 5)),
        '   1 Comment line(s) follow, each starting with a "|":',
        "| none",
        f"{count:8d} {kind} pts, approx    1 secs, units={unit}({code:02d}),Format=(1E15.6)",
        *(f"{v:15.6e}" for v in values),
        "End-of-data for Chan  1 acceleration",
    ]


@pytest.mark.parametrize(
    "code, unit, worth", [(4, "cm/sec2", 0.01), (2, "g", 9.80665), (10, "gal", 0.01), (11, "mg", 9.80665e-3)]
)
def test_units_go_by_their_code(write, code, unit, worth):
    base = read(write("a.V2c", *lines(code, unit)))
    assert base.a[:, 0] == pytest.approx([worth, -2 * worth, 3 * worth, 4 * worth])
    assert base.dt == 0.005


def test_one_value_less_than_announced_is_said(write):
    record = read_record(write("a.V2c", *lines(count=5)))
    assert len(record.base.a) == 4
    assert "W-RECORD-COUNT" in [notice.code for notice in record.notices]


@pytest.mark.parametrize(
    "change, code",
    [
        ({"code": 50, "unit": "counts"}, "E-RECORD-UNIT"),
        ({"code": 5, "unit": "cm/sec"}, "E-RECORD-UNIT"),
        ({"kind": "velocity"}, "E-RECORD-KIND"),
        ({"count": 6}, "E-RECORD-COUNT"),
    ],
)
def test_counts_other_quantities_and_lost_values_are_refused(write, change, code):
    with pytest.raises(InputError, match=code):
        read(write("a.V2c", *lines(**change)))


@pytest.mark.parametrize("azimuth, direction", [(360, 0.0), (400, "up"), (401, "down"), (0, None), (600, None)])
def test_directions_go_by_their_code(write, azimuth, direction):
    assert read_record(write("a.V2c", *lines(azimuth=azimuth))).channels[0].direction == direction
