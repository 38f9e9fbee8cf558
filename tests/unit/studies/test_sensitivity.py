"""What changes a response and until when: families that agree with themselves, digits by their definition, growth."""

import json

import numpy as np
import pytest

from rockref import Model
from rockref.model.errors import InputError
from rockref.model.parameters import TABLE_3_1
from rockref.report.terminal.sensitivity_text import digits_table, sentences
from rockref.studies.agreement import difference, horizon
from rockref.studies.predictability import growth, slope
from rockref.studies.sensitivity import (
    RELEASE_ERROR,
    family,
    last_digits,
    release_angle,
    significant_digits,
    stated_digits,
    time_steps,
    unit_of_digit,
)
from rockref.studies.sensitivity_study import record, study


@pytest.fixture(scope="module")
def small(table_3_1):
    return study(table_3_1, seed=3, duration=2.6, steps=(1e-5, 5e-6), trials=2, workers=1)


def test_a_response_agrees_with_itself_for_ever_and_parts_where_it_is_bent():
    t = np.arange(0, 2, 5e-4)
    a = np.stack([np.sin(20 * t), np.cos(30 * t), np.sin(40 * t)], axis=-1)
    b = a.copy()
    b[t > 1.2, 1] *= 1.5
    assert np.all(np.isinf(horizon(t, a, a)))
    found = horizon(t, a, b)
    # The difference is averaged over 0.1 s, so it is seen at most that much before the bend.
    assert np.isinf(found[0]) and np.isinf(found[2]) and 1.1 < found[1] < 1.25


def test_fewer_agree_to_a_tenth_than_to_a_half(small):
    for f in small.families().values():
        assert np.all(f.horizons[0] <= f.horizons[1])
        assert len(f.crv) == len(f.labels) == len(f.impacts)


def test_the_early_motion_does_not_depend_on_the_step(table_3_1, small):
    """The source: reducing the time step does not alter the early stages of the motion."""
    assert np.all(small.steps.horizons[0] > 1.3)
    assert small.steps.labels[0] == "5e-06 s", "the finest is the reference"
    same = time_steps(table_3_1, (1e-5, 1e-5), 0.7, workers=1)
    assert np.all(np.isinf(same.horizons))


def test_the_last_digits_are_changed_by_half_and_the_release_angle_kept(table_3_1):
    f = last_digits(table_3_1, seed=1, trials=2, duration=0.7, workers=1)
    # The same angle: before anything but the first two feet touch, the swing is the same to a part in a hundred.
    early = f.t < 0.45
    assert np.abs(f.crv[1:, early, 0] - f.crv[0, early, 0]).max() < 0.01 * np.abs(f.crv[0, early, 0]).max()
    assert not np.array_equal(f.crv[1], f.crv[2])
    again = last_digits(table_3_1, seed=1, trials=2, duration=0.7, workers=1)
    np.testing.assert_array_equal(f.crv, again.crv)


def test_a_larger_angle_takes_longer_to_the_first_impact(table_3_1):
    """The source: the release angle makes only a slight shift in time; laid over one another the runs agree longer."""
    f = release_angle(table_3_1, RELEASE_ERROR, 1.0, workers=1)
    first = [i[0] for i in f.impacts]
    assert first[1] < first[0] < first[2]
    assert first[2] - first[1] == pytest.approx(0.0226, rel=0.1)
    assert np.all(f.horizons[0] > family(f.labels, f.crv).horizons[0])


@pytest.mark.parametrize(
    ("value", "precision", "digits"),
    [(0.1170, 1e-4, 4), (6e7, 1e7, 1), (1e-5, 1e-6, 2), (0.30, 0.01, 2), (0.006, 1e-4, 2)],
)
def test_digits_of_a_printed_value(value, precision, digits):
    assert stated_digits(value, precision) == digits
    assert unit_of_digit(value, digits) == pytest.approx(precision)


def test_table_3_1_has_the_digits_that_its_definition_asks_for(small):
    """Finer digits change less; the found number is the first that changes less than a tenth."""
    assert [d.name for d in small.digits] == list(TABLE_3_1)
    for d in small.digits:
        assert d.change < 0.1
        assert (d.change_stated < 0.1) >= (d.stated >= d.found)
    assert (
        {d.name: d.stated for d in small.digits}["theta_0"] == 4 == {d.name: d.found for d in small.digits}["theta_0"]
    )


def test_a_threshold_that_is_larger_asks_for_fewer_digits(table_3_1, small):
    loose = significant_digits(table_3_1, threshold=0.8, workers=1)
    assert all(a.found <= b.found for a, b in zip(loose, small.digits, strict=True))
    assert sum(a.found for a in loose) < sum(b.found for b in small.digits)


def test_differences_grow_from_impact_to_impact_and_do_not_depend_on_the_workers(table_3_1):
    one = growth(table_3_1, runs=6, seed=2, duration=2.3, workers=1)
    two = growth(table_3_1, runs=6, seed=2, duration=2.3, workers=2)
    np.testing.assert_array_equal(one.factors, two.factors)
    assert np.all(one.factors[:, 0] == 1.0) and one.per_impact > 3 and one.spread > 1
    assert one.digits_per_impact == pytest.approx(np.log10(one.per_impact))


def test_growth_needs_two_impacts(table_3_1):
    """Table 3.1 strikes at 0.51 and at 1.34 s."""
    with pytest.raises(InputError, match="reaches 1 of two main impacts in 1.0 s") as refused:
        growth(table_3_1, runs=2, duration=1.0, workers=1)
    assert refused.value.code == "E-IMPACTS"


@pytest.fixture(scope="module")
def large(table_3_1):
    """Four times as large, and so twice as slow: it strikes at 1.0 and at 2.7 s."""
    sides = {name: 4 * getattr(table_3_1, name) for name in ("width", "depth", "height")}
    return table_3_1.replace(mass=64 * table_3_1.mass, K_N=16 * 6e7, K_T=16 * 5e7, **sides)


def test_a_slow_block_is_followed_to_its_second_impact(large):
    (found, *_) = significant_digits(large, step=2e-5, workers=1, duration=3.5)
    assert found.name == "K_N" and np.isfinite(found.change)


def test_a_study_that_ends_before_the_second_impact_is_refused_at_once(large):
    said = []
    with pytest.raises(InputError, match="reaches 1 of two main impacts in 1.6 s"):
        study(large, 1, 1.6, (2e-5, 1e-5), 2, workers=1, report=said.append)
    assert said == ["time step"]


def test_the_record_is_plain_and_says_seed_and_versions(small):
    import json

    found = json.loads(json.dumps(record(small), allow_nan=False))
    assert found["seed"] == 3 and found["versions"]["numpy"]
    assert set(found["families"]) == {"time_step", "last_digits", "release_angle"}
    assert len(found["significant_digits"]) == 12


def test_no_motion_about_an_axis_is_no_difference_unless_the_other_moves():
    t, a = np.arange(3.0), np.array([[1.0, 0, 0]] * 3)
    b = np.array([[1.5, 0, 0.1]] * 3)
    np.testing.assert_array_equal(difference(t, a, b, 2.0), [0.5, 0.0, np.inf])


def test_one_time_step_is_compared_with_nothing(table_3_1):
    with pytest.raises(InputError, match="Give two at least"):
        time_steps(table_3_1, (1e-5,), 0.1)


def test_a_block_in_its_plane_until_a_foot_is_off_is_written_as_json(table_3_1):
    """Its other axes are at rest, so a change is infinite; JSON has no such number. A height of zero has no digits."""
    even = table_3_1.replace(delta_long=(4e-4, 4e-4, 4e-4, 4e-4))
    found = record(study(even, 1, 1.6, (2e-5, 1e-5), 2, workers=1))
    json.dumps(found, allow_nan=False)
    changes = {d["name"]: d["change_stated"] for d in found["significant_digits"]}
    assert changes["delta_long_1"] is None and changes["K_N"] == 0.0
    table, said = digits_table(found), " ".join(sentences(found))
    assert "∞" in [row[3] for row in table.rows] and "∞: " in table.note and "in its plane" not in said
    low = significant_digits(table_3_1.replace(delta_long=(9e-4, 8e-4, 0.0, 4e-4)), workers=1, most=4)
    assert "delta_long_3" not in [d.name for d in low] and len(low) == 11


def test_a_digit_that_tips_the_block_over_is_needed():
    """0.117 rad less half of its first digit is a release, and more is beyond the balance: neither sign may fail."""
    pytest.importorskip("numba")
    model = Model.four_points()
    (tilt,) = [d for d in significant_digits(model, step=4e-5, workers=1, most=4) if d.name == "theta_0"]
    assert tilt.value + 0.05 > np.arctan2(model.width, model.height) > tilt.value + 0.005
    # Four even feet stay in their plane, where no digit of a tilt that is one changes anything.
    assert (tilt.found, tilt.change) == (2, 0.0)


def test_a_single_number_has_no_slope():
    assert np.isnan(slope(np.array([1.0]))) and np.isnan(slope(np.array([])))
    assert slope(np.array([5.0, 7.0, 9.0])) == pytest.approx(2.0)
