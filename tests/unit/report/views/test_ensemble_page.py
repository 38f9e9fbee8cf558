"""The page of an ensemble: the block in a plane, and what is left out where motions have one size."""

import math

import numpy as np
import pytest

from rockref import Model
from rockref.report.views.ensemble_page import in_a_plane, write_ensemble


def test_the_block_in_a_plane_is_the_block():
    block = in_a_plane(Model(width=0.2, depth=0.1, height=0.6, points="four_points"))
    assert block.alpha == pytest.approx((math.atan2(0.05, 0.3),) * 2)
    # A uniform block: p^2 = 3 g/(4 R), R half the diagonal.
    assert block.p[0] ** 2 == pytest.approx(3 * 9.81 / (4 * math.hypot(0.05, 0.3)))


def test_one_motion_has_no_curve_and_many_have_a_spectrum(tmp_path):
    def row(k, pga, pgv):
        return {
            "record": "a", "factor": pga, "step_s": 1e-5, "pga_m_s2": pga, "pgv_m_s": pgv, "fell": k % 2 == 0,
            "tilt_rad": 0.1 * k, "slide_m": 0.0, "twist_rad": 0.0,
        }  # fmt: skip

    page = write_ensemble([row(k, 1.0, 0.1) for k in range(4)], Model.table_3_1(), tmp_path)
    assert "there is no curve" in page.read_text(encoding="utf-8")
    sizes = np.random.default_rng(2).uniform(1, 3, (12, 2))
    page = write_ensemble([row(k, *sizes[k]) for k in range(12)], Model.table_3_1(), tmp_path)
    text = page.read_text(encoding="utf-8")
    assert "overturning spectrum" in text and text.count("data:image/png") >= 5
