"""ESM: three files make one record, whatever their starts and lengths."""

import numpy as np
import pytest

from rockref.model.errors import InputError
from rockref.shake.records.door import read, read_record


def test_three_files_become_one_motion(esm):
    files = [esm([0.0, 1.0, 2.0], "HNN"), esm([0.0, 3.0, 4.0], "HNZ"), esm([0.0, 5.0, 6.0], "HNE")]
    base = read(files)
    # East is x, north is y, up is z; cm/s2 become m/s2 by one rounding.
    assert base.a == pytest.approx(np.array([[0.0, 0.0, 0.0], [0.05, 0.01, 0.03], [0.06, 0.02, 0.04]]))
    assert base.dt == 0.005


def test_starts_and_lengths_that_differ_are_cut_to_what_is_shared(esm):
    early = esm([1.0, 2.0, 3.0, 4.0, 5.0], "HNE", "20190728_160905.700")
    late = esm([30.0, 40.0], "HNN", "2019-07-28 16:09:05.710")
    record = read_record([early, late])
    assert record.base.a[:, :2] == pytest.approx(np.array([[0.03, 0.30], [0.04, 0.40]]))
    assert "W-RECORD-CUT" in [notice.code for notice in record.notices]


def test_a_start_between_samples_is_refused(esm):
    with pytest.raises(InputError, match="E-RECORD-START"):
        read([esm([1.0, 2.0], "HNE"), esm([1.0, 2.0], "HNN", "20190728_160905.7025")])


@pytest.mark.parametrize(
    "change, code",
    [
        ({"DATA_TYPE": "VELOCITY"}, "E-RECORD-KIND"),
        ({"DATA_TYPE": ""}, "E-RECORD-KIND"),
        ({"UNITS": ""}, "E-RECORD-UNIT"),
        ({"UNITS": "cm/s"}, "E-RECORD-UNIT"),
        ({"NDATA": 4}, "E-RECORD-COUNT"),
        ({"NDATA": ""}, "E-RECORD-KEY"),
    ],
)
def test_other_quantities_and_damaged_headers_are_refused(esm, change, code):
    with pytest.raises(InputError, match=code):
        read(esm([0.0, 1.0, 2.0], **change))


def test_components_of_different_intervals_are_refused(esm):
    with pytest.raises(InputError, match="E-RECORD-STEP"):
        read([esm([1.0, 2.0], "HNE"), esm([1.0, 2.0], "HNN", SAMPLING_INTERVAL_S="0.01")])
