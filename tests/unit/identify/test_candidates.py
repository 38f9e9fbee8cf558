"""Simulated candidates: the same numbers from the law and from the compiled engine, nothing from what cannot be."""

import numpy as np
import pytest

from rockref.identify import candidates
from rockref.identify.candidates import OUTPUT_RATE, Releases, rates, records


def test_without_the_compiled_engine_the_law_itself_is_asked(table_3_1, monkeypatch):
    pytest.importorskip("numba")
    problems = [table_3_1.problem(0.02, 2e-5, OUTPUT_RATE, theta_0=tilt) for tilt in (0.117, 0.100)]
    compiled = rates(problems)
    monkeypatch.setattr(candidates, "has_numba", lambda: False)
    np.testing.assert_allclose(rates(problems), compiled, rtol=0, atol=1e-9)
    shorter = table_3_1.problem(0.01, 2e-5, OUTPUT_RATE, theta_0=0.117)
    together = rates([shorter, problems[0]])
    np.testing.assert_array_equal(together[0, : len(rates([shorter])[0])], rates([shorter])[0])
    assert np.isnan(together[0, -1]).all() and np.isfinite(together[1]).all()
    # The smaller the lean, the farther from the balance, and the faster it falls.
    assert abs(compiled[1, -1, 0]) > 1.5 * abs(compiled[0, -1, 0]) > 0


def test_where_no_model_can_be_released_every_record_is_nothing(table_3_1, twin):
    tipped = [0.2, 0.3]
    assert max(np.arctan2(table_3_1.width, table_3_1.height), 0.0) < min(tipped)
    [(t, crv)] = records([Releases(twin, [table_3_1] * 2, tipped, [{}] * 2, [table_3_1.body()] * 2, 0.1)])
    assert crv.shape == (2, len(t), 3) and np.isnan(crv).all()
