"""The calibrated block and its symmetric twin: what differs, and what the signals are."""

import numpy as np
import pytest

pytest.importorskip("numba")

from rockref import Model
from rockref.model.errors import InputError
from rockref.shake import defects, ensemble
from rockref.shake.motion_size import motion_size, pulse_frequency
from rockref.shake.pulses import one_sine


def test_the_twin_differs_by_the_heights_of_its_feet_alone():
    own = Model.table_3_1()
    twin = defects.symmetric_twin(own)
    (block, points), (block_of_twin, points_of_twin) = own.body(), twin.body()
    assert np.array_equal(block.inertia, block_of_twin.inertia)
    moved = points_of_twin.P - points.P
    assert not moved[:, :2].any() and moved[:, 2].sum() == pytest.approx(0.0, abs=1e-15)
    # Mirrored in both vertical planes through the centre, feet come to lie on feet.
    for mirror in ([-1, 1, 1], [1, -1, 1]):
        assert {tuple(np.round(p, 12)) for p in points_of_twin.P * mirror} == {
            tuple(np.round(p, 12)) for p in points_of_twin.P
        }


def test_signals_have_their_peak_both_directions_and_a_seed_of_their_own():
    a, b = defects.signal(1, 3.0), defects.signal(2, 3.0)
    assert motion_size(a)[0] == pytest.approx(3.0) and a == defects.signal(1, 3.0) and a != b
    x, y, z = a.a.T
    # 1401 samples that hang together over a few: about a hundred independent ones, a tenth each; three of them.
    assert not z.any() and abs(np.corrcoef(x, y)[0, 1]) < 0.3
    assert 0.5 < np.std(x) / np.std(y) < 2.0


def test_the_pulse_of_a_pulse_is_itself():
    base = one_sine(2.0, 0.5, 0.001)
    # Straight lines cut the sine by (w dt)^2/12 = 1e-5.
    assert pulse_frequency(*motion_size(base)) == pytest.approx(4 * np.pi, rel=2e-5)


def test_levels_are_kept_and_not_run_again(tmp_path, monkeypatch):
    monkeypatch.setattr(defects, "LEVELS", (30.0,))
    for name, value in (("RISE", 0.1), ("STRONG", 0.3), ("LENGTH", 0.5), ("AFTER", 0.3)):
        monkeypatch.setattr(defects, name, value)
    first = defects.run_level(tmp_path, 0, 3, 4e-5, 1)
    monkeypatch.setattr(ensemble, "run_all", None)
    again = defects.run_level(tmp_path, 0, 3, 4e-5, 1)
    assert all(np.array_equal(first[key], again[key]) for key in first)
    with pytest.raises(InputError, match="E-ENSEMBLE"):
        defects.run_level(tmp_path, 0, 3, 2e-5, 1)


def test_a_difference_that_no_signal_shows_is_not_known_to_be_nothing():
    found = defects.difference(np.zeros(200), np.zeros(200))
    # No event in 200 trials: up to 3/200 of them, by the rule of three.
    assert found.mean == 0.0 and -3 / 200 < found.low < -0.01 and 0.01 < found.high < 3 / 200
    both = defects.difference(np.array([1.0, 1.0, 1.0, 0.0]), np.array([0.0, 1.0, 0.0, 1.0]))
    assert both.mean == 0.25 and both.low < 0 < both.high
