"""The first swing drawn in a terminal: every line within the width, release and impact marked where they are."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.report.charts.first_swing import swing_in_text

T = np.arange(-500, 1500) * 1e-3
RATE = np.where((T > 0) & (T < 1.0), np.sinh(np.clip(3 * T, 0, 3)), 0.0)


def run(impact):
    return SimpleNamespace(t=T, crv=np.column_stack((RATE, 0 * T, 0 * T)), impact=impact)


@pytest.mark.parametrize("columns", [16, 27, 64])
@pytest.mark.parametrize("impact", [0.2, 0.5, 1.0])
def test_no_line_is_wider_than_the_picture_and_its_scale(columns, impact):
    lines = swing_in_text(run(impact), columns)
    assert max(map(len, lines)) <= columns + len(" +000 deg/s")
    below = "\n".join(lines[6:])
    assert "^ release" in below and f"first impact, {impact:.3f} s" in below


def test_a_mark_stands_below_its_instant():
    *picture, below = swing_in_text(run(1.0), 64)
    seen = (T > -0.25) & (T < 1.4)
    assert below.index("^") == int(np.searchsorted(T[seen], 0.0) / seen.sum() * 64)
    assert below.rindex("^") == int(np.searchsorted(T[seen], 1.0) / seen.sum() * 64)
