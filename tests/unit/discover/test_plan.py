"""Plans: releases from words, information that adds up, cosines, and what a varied run is worth."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover import plan as planning
from rockref.discover.hypotheses.law import law_parameters
from rockref.discover.plan import Release, against, alternatives, cosines, further, outlook, releases_from
from rockref.effects import catalogue
from rockref.model.errors import InputError

TABLE = Model.table_3_1()
FILM, ROLLING = catalogue.find("viscous_friction"), catalogue.find("rolling_resistance")
SHARED = len(law_parameters(TABLE))


def test_releases_from_words():
    found = releases_from("0.117x2, 0.098 ,0.117t")
    assert found == [Release(0.117), Release(0.117), Release(0.098), Release(0.117, True)]
    assert [str(r) for r in found] == ["0.117", "0.117", "0.098", "0.117t"]


@pytest.mark.parametrize("text", ["", "abc", "0.117x0", "0.117xx", "2.0", "-0.1", "0.117x1000", "nan"])
def test_what_is_no_release_is_refused(text):
    with pytest.raises(InputError, match="E-RUNS"):
        releases_from(text)


def says(release: Release, direction: np.ndarray, own: float) -> np.ndarray:
    """A run that sees the first nuisance, and two effects: along `direction` together with it, and by themselves."""
    H = np.zeros((SHARED + 2, SHARED + 2))
    v = np.zeros(SHARED + 2)
    v[0], v[SHARED:] = 1.0, direction
    H += 1e6 * np.outer(v, v)
    H[np.arange(SHARED, SHARED + 2), np.arange(SHARED, SHARED + 2)] += own
    return H


A, B = Release(0.117), Release(0.098)
KNOWN = {A: says(A, np.array([1.0, 0.5]), 1.0), B: says(B, np.array([0.2, 0.9]), 1.0)}


def see(*runs):
    return outlook(TABLE, KNOWN, runs, (FILM, ROLLING))


def test_as_many_repeats_average_the_noise_only():
    free = {A: np.diag([0.0] * SHARED + [400.0, 900.0])}
    one, four = (outlook(TABLE, free, [A] * n, (FILM, ROLLING)) for n in (1, 4))
    for id in ("viscous_friction", "rolling_resistance"):
        # Four times the information halves a limit; Occam's factor, which grows with its logarithm, takes a tenth back.
        assert 1.75 < one.sizes[id] / four.sizes[id] < 2.0
    assert 1.3 < one.sizes["viscous_friction"] / one.sizes["rolling_resistance"] < 1.5


def test_a_varied_run_frees_effects_from_a_nuisance_that_repeats_leave_in_the_way():
    repeats, varied = see(A, A), see(A, B)
    for id in repeats.effects:
        assert varied.sizes[id] < 0.5 * repeats.sizes[id]


def test_the_next_run_is_the_varied_one():
    found = further(TABLE, KNOWN, [A], [A, B], (FILM, ROLLING), see(A))
    assert [f["run"] for f in found] == ["0.098", "0.117"]
    assert [f["repeat"] for f in found] == [False, True]
    assert found[1]["limits_fall_by"] < 1.5 < found[0]["limits_fall_by"]


def test_cosines_of_known_subspaces():
    # Columns e1, e2 for the first effect; one column in their plane, one at 60 degrees to e1 out of it.
    columns = np.array([[1, 0, 0], [0, 1, 0], [0.6, 0.8, 0], [0.5, 0, np.sqrt(0.75)]], float)
    S = columns @ columns.T
    found = cosines(S, [np.array([0, 1]), np.array([2]), np.array([3])])
    assert found[0, 1] == pytest.approx(1.0) and found[0, 2] == pytest.approx(0.5)
    assert found[1, 2] == pytest.approx(0.3)
    np.testing.assert_array_equal(found, found.T)


def test_cosines_do_not_depend_on_the_scale_of_a_number():
    rng = np.random.default_rng(0)
    J = rng.normal(size=(5, 20))
    scale = np.array([1e3, 1e-2, 1.0, 7.0, 1e-4])
    blocks = [np.array([0, 1]), np.array([2, 3, 4])]
    np.testing.assert_allclose(
        cosines(J @ J.T, blocks), cosines((J * scale[:, None]) @ (J * scale[:, None]).T, blocks), atol=1e-6
    )


def test_what_changes_nothing_is_like_nothing():
    found = cosines(np.diag([1.0, 0.0, 0.0]), [np.array([0]), np.array([1, 2])])
    np.testing.assert_array_equal(found, np.eye(2))


def test_a_shaking_base_is_in_no_plan():
    with pytest.raises(InputError, match="phase of its own") as error:
        planning.plan(TABLE, [A], ["base_vibration"])
    assert error.value.code == "E-EFFECT"


def test_comparison_is_between_as_many_runs():
    wanted = alternatives([A, B])
    assert len(wanted) == len(set(wanted)) == 6 and wanted[0] == A
    repeats, varied = against([A, B, A, A], wanted)
    assert repeats == [A] * 4 and len(varied) == 4 and len(set(varied)) == 4


def test_a_simulated_release_sees_a_sensor_scale_to_a_fraction_of_a_per_cent():
    # One second: the first arc and half of the second. The scale of the main axis multiplies 40 deg/s; the noise is
    # 0.05 deg/s in each of a thousand samples, so that its limit is far below its typical 2 or 3 per cent.
    kind = catalogue.find("gyro_scale")
    known = {A: planning.says(TABLE, A, (kind,), duration=1.0)}
    found = outlook(TABLE, known, [A], (kind,))
    assert found.limits["gyro_scale.x"]["limit"] < 0.02
    assert found.limits["gyro_scale.x"]["limit"] < found.limits["gyro_scale.z"]["limit"]


def test_a_planned_record_is_that_of_a_real_gyroscope():
    """Stops come after the filter and the noise: a flat top is flat, in all its samples at the same number."""
    clipped = TABLE.replace(effects=(catalogue.find("gyro_saturation")(range=0.3),))
    plain, cut = (planning.recorded(m, A, planning.GYRO, 3, 0.8).crv for m in (TABLE, clipped))
    flat = np.rint(0.3 / planning.GYRO.resolution) * planning.GYRO.resolution
    assert np.abs(plain).max() > 0.35
    np.testing.assert_array_equal(cut, np.where(np.abs(plain) < 0.3, plain, np.sign(plain) * flat))


def test_a_plan_without_a_release_is_refused():
    with pytest.raises(InputError, match="E-RUNS"):
        planning.plan(TABLE, [])


def test_every_offered_release_is_simulated_once(monkeypatch):
    asked = []

    def made(model, release, effects, gyro, uncertainty, seed, duration, workers):
        asked.append(release)
        return np.diag([1.0] * SHARED + [400.0, 900.0])

    monkeypatch.setattr(planning, "says", made)
    lines = []
    found = planning.plan(TABLE, [A, A, B], ("viscous_friction", "rolling_resistance"), progress=lines.append)
    every = {A, B, *alternatives([A, B])}
    assert sorted(asked) == sorted(every)
    assert len(lines) == len(every) and found.outlook.runs == (A, A, B)
    assert {row["run"] for row in found.further} == {str(r) for r in alternatives([A, B])}


def test_what_a_release_says_is_information():
    """It is symmetric, and never less than none."""
    pytest.importorskip("numba")
    says = planning.says(TABLE, A, (FILM,), planning.GYRO, 0.0014, 0, 1.0, 1)
    assert says.shape == (SHARED + len(planning.switches_of(FILM, TABLE)),) * 2
    assert np.allclose(says, says.T) and np.linalg.eigvalsh(says).min() > -1e-6 * np.abs(says).max()
