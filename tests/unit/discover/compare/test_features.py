"""Losses, pairs and envelopes by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.compare.features import (
    envelope_differences,
    features,
    impact_pairs,
    losses,
    spectrum_differences,
)
from rockref.measure import rocking_block
from tests.unit.discover.synthetic import DEGREE, recorded

BLOCK = rocking_block(54.0, 0.100, 0.688)
NOISE = np.full(3, 0.003 * DEGREE)


@pytest.fixture(scope="module")
def seen():
    t, crv = recorded(Model.table_3_1(), 0.117, 1.6)
    return t, crv, features(t, crv, BLOCK, NOISE)


def ledger(seen, **values):
    return replace(seen[2].ledger, **{k: np.array(v, dtype=float) for k, v in values.items()})


def test_losses_are_weighted_by_energy(seen):
    made = ledger(
        seen,
        times=[1.0, 2.0, 3.0],
        impact_loss=[1.0, 0.5, 0.25],
        energy_before=[10.0, 8.0, 7.0],
        energy_after=[9.0, 7.5, 6.75],
        free_loss=[1.0, 0.5],
        apex_energy=[8.0, 2.0],
    )
    found = losses(made, 3)
    assert found.impact == pytest.approx(1.75 / 25.0)
    assert found.free == pytest.approx(1.5 / 16.5)
    # From 8 to 2 in one cycle.
    assert found.cycle == pytest.approx(0.75)
    assert found.count == 3


def test_losses_leave_out_what_is_not_known(seen):
    made = ledger(
        seen,
        times=[1.0, 2.0],
        impact_loss=[1.0, math.nan],
        energy_before=[10.0, 8.0],
        energy_after=[9.0, math.nan],
        free_loss=[1.0],
        apex_energy=[8.0],
    )
    found = losses(made, 2)
    assert found.impact == pytest.approx(0.1) and found.free == pytest.approx(1.0 / 9.0)
    assert math.isnan(found.cycle)


def test_no_impacts_no_losses(seen):
    found = losses(seen[2].ledger, 0)
    assert math.isnan(found.impact) and math.isnan(found.free) and found.count == 0


def test_pairs_end_where_the_swings_part(seen):
    f = seen[2]
    times = f.impacts.times.copy()
    times[1] += 0.6 * (times[1] - times[0])
    late = replace(f, impacts=replace(f.impacts, times=times))
    assert [p.number for p in impact_pairs(f, f, f, 0.0)] == [1, 2]
    assert [p.number for p in impact_pairs(f, late, late, 0.0)] == [1]


def test_pairs_end_where_the_sides_differ(seen):
    f = seen[2]
    other = replace(f, impacts=replace(f.impacts, signs=-f.impacts.signs))
    assert impact_pairs(f, other, other, 0.0) == ()


def test_pair_keeps_the_stated_error_beside_the_aligned_one(seen):
    f = seen[2]
    stated = replace(f, impacts=replace(f.impacts, times=f.impacts.times + 0.004))
    aligned = replace(f, impacts=replace(f.impacts, times=f.impacts.times + 0.001))
    pair = impact_pairs(f, stated, aligned, -0.001)[1]
    assert pair.error == pytest.approx(0.004) and pair.aligned_error == pytest.approx(0.0, abs=1e-12)


def test_scaled_signal_has_wider_envelopes_and_higher_lines(seen):
    t, crv, f = seen
    g = features(t, 1.1 * crv, BLOCK, NOISE)
    for e in envelope_differences(f, g, np.zeros(2)):
        assert e.width == pytest.approx(1.1, abs=0.01)
        assert e.period == pytest.approx(1.0, abs=0.01)
    for s in spectrum_differences(f, g):
        assert s.distance == pytest.approx(0.1, abs=1e-9)
        assert s.peak_model[1] == pytest.approx(1.1 * s.peak_measured[1])


def test_an_envelope_in_the_noise_is_none(seen):
    f = seen[2]
    assert [e.width for e in envelope_differences(f, f, np.full(2, 1.0))] == [None, None]


def test_a_run_without_second_impact_has_no_arc():
    t, crv = recorded(Model.table_3_1(), 0.117, 0.9)
    f = features(t, crv, BLOCK, NOISE)
    assert len(f.impacts) == 1 and f.envelope is None and f.spectrum is None
    assert envelope_differences(f, f, np.zeros(2)) == () and spectrum_differences(f, f) == ()
