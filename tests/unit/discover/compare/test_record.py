"""A comparison as plain values: nothing that JSON has not."""

import json

import numpy as np

from rockref.discover.diagnosis_record import plain


def test_what_is_not_finite_is_nothing_and_numbers_are_python_s():
    given = {1: (np.float64(2.5), np.int64(3)), "a": np.array([1.0, np.nan]), "b": [float("inf"), np.bool_(True)]}
    found = plain(given)
    assert found == {"1": [2.5, 3], "a": [1.0, None], "b": [None, True]}
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    assert plain(np.float32("nan")) is None and plain(np.array(0.5)) == 0.5 and plain("text") == "text"
