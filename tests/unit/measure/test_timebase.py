"""The time column runs forward, at the stated rate, without holes."""

from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

from rockref.measure.table import Table
from rockref.measure.timebase import regular_samples
from rockref.model.errors import InputError


def table(t):
    t = np.asarray(t, dtype=np.float64)
    columns = {"t": t, "wx": 10.0 * t}
    return Table(Path("run.csv"), MappingProxyType(columns), MappingProxyType({"t": "t_s", "wx": "wx_deg_s"}), "", ())


CLEAN = np.arange(1000) / 1000.0


def test_clean_time_passes_untouched():
    source = table(CLEAN)
    t, columns, filled, notices = regular_samples(source, 1000.0)
    assert t is source.columns["t"]
    assert list(columns) == ["wx"]
    assert filled == () and notices == []


def changed(row, value):
    t = CLEAN.copy()
    t[row] = value
    return t


@pytest.mark.parametrize(
    ("t", "rate", "code", "where", "words"),
    [
        (changed(500, 0.1), 1000.0, "E-TIME", "line 502", "from 0.499 to 0.1"),
        (changed(500, 0.499), 1000.0, "E-TIME", "line 502", "from 0.499 to 0.499"),
        (CLEAN[::-1], 1000.0, "E-TIME", "line 3", "from 0.999"),
        (CLEAN * 2.0, 1000.0, "E-RATE", "t_s", "500 Hz"),
        (CLEAN / 2.0, 1000.0, "E-RATE", "t_s", "2000 Hz"),
        (CLEAN * 1000.0, 1000.0, "E-RATE", "t_s", "1 Hz"),
        (CLEAN * 1.03, 1000.0, "E-RATE", "t_s", "not at 1000 Hz"),
        (
            np.delete(CLEAN, slice(300, 304)),
            1000.0,
            "E-GAP",
            "line 302",
            "4 samples are missing between 0.299",
        ),
        (np.delete(CLEAN, np.arange(5, 995, 50)), 1000.0, "E-GAP", "t_s", "20 of 1000 samples"),
        (CLEAN + 0.2, 1000.0, "E-START", "t_s", "starts at 0.2"),
        (CLEAN - 0.2, 1000.0, "E-START", "t_s", "starts at -0.2"),
        (CLEAN[:1], 1000.0, "E-SHORT", "run.csv", "one row"),
    ],
)
def test_faulty_time_is_refused_with_its_line(t, rate, code, where, words):
    with pytest.raises(InputError) as caught:
        regular_samples(table(t), rate)
    assert caught.value.code == code
    assert where in caught.value.where
    assert words in caught.value.what


@pytest.mark.parametrize(
    ("t", "code"),
    [
        (CLEAN * 1.005, "W-RATE"),
        (CLEAN + 0.01, "W-START"),
        (changed(500, 0.4993), "W-JITTER"),
    ],
)
def test_what_can_be_worked_with_is_said(t, code):
    got, _, filled, notices = regular_samples(table(t), 1000.0)
    assert [n.code for n in notices] == [code]
    assert np.array_equal(got, t)
    assert filled == ()


def test_short_holes_are_filled_on_the_line_between_their_ends():
    t, columns, filled, notices = regular_samples(table(np.delete(CLEAN, [200, 201, 202, 700])), 1000.0)
    assert filled == (200, 201, 202, 700)
    assert np.allclose(t, CLEAN, rtol=0.0, atol=1e-15)
    assert np.allclose(columns["wx"], 10.0 * CLEAN, rtol=0.0, atol=1e-14)
    assert [n.code for n in notices] == ["W-GAP-FILLED"]
    assert "4 samples were missing, the first at 0.2 s" in notices[0].what


def test_stamps_rounded_to_the_millisecond_are_no_gaps():
    t = np.round(np.arange(1200) / 600.0, 3)
    _, _, filled, notices = regular_samples(table(t), 600.0)
    assert filled == () and notices == []
