"""The measured channel."""

import numpy as np
import pytest

from rockref.model.channel import crv_deg_s


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_degrees_a_second_about_the_body_axes_in_their_order(dtype):
    W = np.array([[np.pi, np.pi / 2, -np.pi / 180]], dtype)
    crv = crv_deg_s(W)
    assert crv.dtype == dtype
    # pi itself is rounded to float64 at best
    bound = max(4e-16, float(2 * np.finfo(dtype).eps))
    assert crv.astype(float) == pytest.approx(np.array([[180, 90, -1]]), rel=bound)
