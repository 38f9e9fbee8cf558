"""Remarks on records: each kind once, and none on what is sound."""

import numpy as np
import pytest

from rockref.shake.records.checks import remarks

DT = 0.005
T = np.arange(2000) * DT
# A sound record: two tones in an envelope, as a derivative, so that its velocity returns to zero.
SOUND = np.gradient(np.sin(np.pi * T / 10) ** 2 * (np.sin(9 * T) + 0.4 * np.sin(31 * T)), DT)


def codes(a):
    return [n.code for n in remarks(np.column_stack([a, 0 * a, 0 * a]), DT, "file")]


def test_a_sound_record_is_left_alone_in_any_resolution():
    assert codes(SOUND) == []
    for resolution in (0.001, 0.01, 0.1):
        assert codes(np.round(SOUND / resolution) * resolution) == []


@pytest.mark.parametrize(
    "fault, code",
    [
        (lambda a: np.clip(a, -6.0, 6.0), "W-RECORD-CLIPPED"),
        (lambda a: np.where((T > 3.0) & (T < 3.2), 0.123, a), "W-RECORD-STUCK"),
        (lambda a: a + 0.5, "W-RECORD-OFFSET"),
        (lambda a: a * (T < 6.13), "W-RECORD-DRIFT"),
        (lambda a: a * (-1.0) ** np.arange(len(a)), "W-RECORD-COARSE"),
        (lambda a: np.concatenate([a[700:], np.zeros(700)]), "W-RECORD-STEP"),
    ],
)
def test_each_fault_is_named(fault, code):
    assert code in codes(fault(SOUND))
