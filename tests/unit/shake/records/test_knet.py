"""K-NET by obspy, where it is installed; a clear word where it is not."""

import sys

import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record

HEADER = """Origin Time       1996/08/11 03:12:00
Lat.              38.920
Long.             140.630
Depth. (km)       7
Mag.              5.9
Station Code      AKT013
Station Lat.      39.6069
Station Long.     140.3213
Station Height(m) 34
Record Time       1996/08/11 03:12:39
Sampling Freq(Hz) 100Hz
Duration Time(s)  10
Dir.              {direction}
Scale Factor      2000(gal)/8388608
Max. Acc. (gal)   4.383
Last Correction   1996/08/11 03:00:00
Memo.             """.split("\n")


@pytest.fixture
def knet(write):
    counts = [-18000] * 600 + [-18000 + 41943] * 400
    rows = ["".join(f"{c:8d} " for c in counts[i : i + 8]) for i in range(0, 1000, 8)]
    return write("a.EW", *(line.format(direction="E-W") for line in HEADER), *rows)


def test_counts_become_acceleration_less_the_offset(knet):
    pytest.importorskip("obspy", reason="obspy is not installed (extra records)")
    record = read_record(knet)
    # 41943 counts of 2000/8388608 gal are 0.1 m/s2 to the rounding of the count.
    assert record.base.a[700, 0] == pytest.approx(0.1, rel=2e-5)
    assert record.base.a[0, 0] == 0.0 and record.base.dt == 0.01
    assert record.channels[0].direction == 90.0


def test_without_obspy_the_extra_is_named(knet, monkeypatch):
    monkeypatch.setitem(sys.modules, "obspy", None)
    with pytest.raises(InputError, match=r"rockref\[records\].*E-RECORD-OBSPY"):
        read(knet)
