"""The page of an ensemble: the block in a plane, and what is left out where motions have one size."""

import math

import numpy as np
import pytest

from rockref import Model
from rockref.model.base_motion import BaseMotion
from rockref.report.views.ensemble_page import in_a_plane, write_ensemble
from rockref.report.views.ensemble_runs import again, chosen_runs
from rockref.shake.ensemble import Draws, Ensemble


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


def test_chosen_runs_are_the_first_fall_the_narrowest_escape_and_the_usual_run():
    rows = [
        {"fell": fell, "tilt_rad": tilt, "pga_m_s2": pga}
        for fell, tilt, pga in ((1, 0.8, 3.0), (0, 0.1, 9.0), (1, 0.8, 2.0), (0, 0.3, 1.0), (0, 0.2, 1.0))
    ]
    assert [k for _, k in chosen_runs(rows)] == [2, 3, 4]
    assert [k for _, k in chosen_runs(rows[:1])] == [0] and chosen_runs(rows[1:2])[0][1] == 0


def test_a_chosen_run_is_the_run_of_the_table_and_is_replayed(tmp_path):
    pytest.importorskip("numba")
    base = BaseMotion(0.0, 0.1, np.array([[0.0, 0, 0], [3.0, 1, 0], [-3.0, 1, 0], [0.0, 0, 0]]), "pulse")
    ensemble = Ensemble(Model.four_points(), (base,), (1.0, 1.3), Draws(heading=20.0), step=4e-5, after=0.5)
    rows = ensemble.rows(0, 4, workers=1)
    response = again(ensemble, 3, rows[3]["end_s"])
    L = response.Lambda
    # Rows are every 5 ms, ticks every 0.5 ms: between them a block turns by less than a hundredth of its tilt.
    lean = np.arctan2(np.hypot(L[:, 0, 2], L[:, 1, 2]), L[:, 2, 2]).max()
    assert lean == pytest.approx(rows[3]["tilt_rad"], rel=1e-2)
    text = write_ensemble(rows, ensemble.model, tmp_path, ensemble).read_text(encoding="utf-8")
    assert text.count('figure class="player"') == len(chosen_runs(rows)) > 0
