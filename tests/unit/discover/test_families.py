"""Gains of fitted families, on bowls in place of fits."""

import numpy as np
import pytest

from rockref.discover.evidence import CLIP
from rockref.discover.families import by_sample, gain_between
from tests.unit.discover.bowls import SAMPLES, WINDOWS, Bowl, family, series


def test_gains_over_moved_windows_are_clipped_like_all_others():
    """All windows far off before, at the noise after: clipped, the gain is the same however the windows are cut."""
    kept = family((), Bowl(np.array([0.0]), floor=4.0), [0.0])
    same = family(("inertia_deviation",), Bowl(np.array([0.0, 1.0])), [0.0, 1.0])
    moved = family(("gyro_scale",), Bowl(np.array([0.0, 1.0]), series=series(7)), [0.0, 1.0])
    most = CLIP * kept.fit.series.count.sum()
    assert gain_between(kept, same) == pytest.approx(most)
    assert gain_between(kept, moved) == pytest.approx(most)


def test_the_loss_by_sample_sums_to_the_loss():
    one = family((), Bowl(np.array([0.0]), floor=1.3, series=series(5)), [0.2])
    assert by_sample(one).sum() == pytest.approx(one.point.loss.sum())
    assert len(by_sample(one)) == WINDOWS * SAMPLES
