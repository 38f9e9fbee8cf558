"""Models beside runs whose making is known."""

import json
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.compare import models
from rockref.discover.compare.models import baseline_model, compare, impact_time_per_tilt
from rockref.discover.compare.record import to_dict
from rockref.discover.compare.sentences import findings
from rockref.effects.catalogue import parse
from rockref.measure import main_impacts
from rockref.model.errors import InputError
from tests.unit.discover.synthetic import DEGREE, GYRO, experiment, with_run

TABLE = Model.table_3_1()
SCALED = TABLE.replace(effects=(parse("gyro_scale:x=1.02,y=1.02,z=1.02"),))


def texts(comparison, kind):
    return [f.text for f in findings(comparison) if f.kind == kind]


@pytest.fixture(scope="module")
def itself():
    e = experiment(TABLE, [{"use": "fit"}, {"use": "holdout", "tilt": 0.105, "turned": True}])
    return compare(e, [TABLE], ["table_3_1"])


def test_model_beside_itself_has_no_error(itself):
    for r in itself.results[0]:
        assert r.tilt_offset == 0.0 and r.shift == 0.0
        assert {e.stretch for e in r.errors} == {"before", "between", "after"}
        # The same numbers by the same filter; only the order of two additions differs.
        assert max(e.rms for e in r.errors) < 1e-12
        assert r.leaves_band is None
        assert [p.error for p in r.impacts] == [0.0] * len(r.impacts)
        assert (r.losses_model.impact, r.losses_model.free) == (r.losses_measured.impact, r.losses_measured.free)
    assert itself.holds_to_second_impact()


def test_model_beside_itself_in_words(itself):
    assert texts(itself, "leaves_band") == [
        "The model stays within the band of noise in all 2 runs, to the end of the record."
    ]
    assert "agrees with all three rates to the noise" in texts(itself, "before_impact")[0]
    assert "takes as long as the block" in texts(itself, "to_second_impact")[0]
    assert "loses as much energy as the block" in texts(itself, "energy")[0]
    assert not texts(itself, "amplitude") and not texts(itself, "leak") and not texts(itself, "offset")


def test_runs_of_one_use_are_told_apart(itself):
    assert itself.of("fit") == (0,) and itself.of("holdout") == (1,) and itself.of() == (0, 1)
    runs = to_dict(itself)["experiment"]["runs"]
    assert runs == {"fit": ["01"], "holdout": ["02"]}


@pytest.fixture(scope="module")
def scaled():
    return compare(experiment(SCALED, [{}, {"tilt": 0.105}]), [TABLE, SCALED], ["plain", "scaled"])


def test_scale_of_the_gyroscope_is_the_ratio_on_every_axis(scaled):
    for r in scaled.results[0]:
        ratios = {axis: r.error("between", axis).ratio for axis in ("main", "transverse", "longitudinal")}
        # Two per cent were put in; the noise-free records leave rounding only.
        assert ratios == pytest.approx(dict.fromkeys(ratios, 1.02), abs=1e-6)
        assert r.error("before", "main").ratio == pytest.approx(1.02, abs=1e-6)
    assert texts(scaled, "amplitude") == ["All three measured rates are 2.0 % larger than the model's, throughout."]


def test_sensor_effect_of_the_model_acts_on_the_measured_channel(scaled):
    assert max(e.rms for r in scaled.results[1] for e in r.errors) < 1e-12


def test_models_side_by_side(scaled):
    spoken = texts(scaled, "side_by_side")
    assert len(spoken) == 3
    assert all("scaled is closest" in text for text in spoken)
    assert scaled.rms(1, "between") < 1e-12 < scaled.rms(0, "between")


def test_wrong_tilt_within_its_uncertainty_is_found_and_taken_out():
    c = compare(experiment(TABLE, [{"tilt": 0.117, "true_tilt": 0.118}]), [TABLE])
    r = c.results[0][0]
    later = impact_time_per_tilt(0.117, TABLE.width, TABLE.height) * 1e-3
    # Housner's linear law against the full model: some per cent.
    assert r.impacts[0].error == pytest.approx(-later, rel=0.1)
    assert r.tilt_offset == pytest.approx(1e-3, rel=0.1)
    assert abs(r.shift) < 0.1 * later
    before = r.error("before", "main")
    assert before.on_clock > 10.0 * before.rms
    assert "explains up to" in texts(c, "first_impact")[0]


def test_wrong_tilt_beyond_its_uncertainty_stays_an_error():
    c = compare(experiment(TABLE, [{"tilt": 0.117, "true_tilt": 0.120}], uncertainty=0.0005), [TABLE])
    r = c.results[0][0]
    assert r.tilt_offset == pytest.approx(0.0005, rel=1e-12)
    assert r.shift > 0.01
    assert r.leaves_band is not None and r.leaves_band.axis == "main"
    assert "more than the" in texts(c, "first_impact")[0]


def test_given_release_is_not_moved():
    e = experiment(TABLE, [{"tilt": 0.117, "true_tilt": 0.118}])
    r = compare(e, [TABLE], releases={"01": {"theta_0": 0.118}}).results[0][0]
    assert r.tilt_offset == 0.0
    assert max(e.rms for e in r.errors) < 1e-12


def test_misaligned_gyroscope_shows_as_leakage_in_degrees():
    turned = TABLE.replace(effects=(parse("gyro_misalignment:x=0,y=0,z=0.02"),))
    c = compare(experiment(turned, [{}, {"tilt": 0.105}]), [TABLE])
    found = next(f for f in findings(c) if f.kind == "leak")
    # sin(0.02) of the main rate, whatever the sign of the turn.
    assert abs(found.values["slope_transverse"]) == pytest.approx(math.sin(0.02), rel=0.02)
    assert "2.0 % about the transverse axis (1.1 degrees)" in found.text
    assert not c.holds_to_second_impact()


def test_offset_of_the_gyroscope_is_named():
    e = experiment(TABLE, [{}])
    shifted = with_run(e, 0, e.runs[0].crv + np.array([0.0, 0.0, 0.3 * DEGREE]))
    found = next(f for f in findings(compare(shifted, [TABLE])) if f.kind == "offset")
    assert found.values == pytest.approx({"offset_longitudinal": 0.3 * DEGREE}, rel=0.02)


def test_departure_is_where_the_disturbance_begins_and_names_the_feet():
    e = experiment(TABLE, [{}])
    t, crv = e.runs[0].t, e.runs[0].crv.copy()
    crv[t >= 0.3, 1] += 1.0 * DEGREE
    left = compare(with_run(e, 0, crv), [TABLE]).results[0][0].leaves_band
    assert left.axis == "transverse"
    # Half of the 5 ms over which the error is averaged.
    assert left.time == pytest.approx(0.3, abs=0.004)
    assert [name for name, _ in left.points] == ["1ext", "2ext"]
    assert left.after_impact is None


def test_turned_block_leans_on_the_other_feet():
    e = experiment(TABLE, [{"turned": True}])
    t, crv = e.runs[0].t, e.runs[0].crv.copy()
    crv[t >= 0.3, 1] += 1.0 * DEGREE
    left = compare(with_run(e, 0, crv), [TABLE]).results[0][0].leaves_band
    assert {name for name, _ in left.points} == {"3ext", "4ext"}


@pytest.fixture(scope="module")
def repeated():
    return compare(experiment(TABLE, [{}, {}, {"tilt": 0.105}], noisy=True), [TABLE])


def test_noise_alone_is_one_noise_width(repeated):
    for r in repeated.results[0]:
        for axis in ("main", "transverse", "longitudinal"):
            # 400 samples and more of white noise scatter by 4 %; the noise is measured to 5 %.
            assert r.error("before", axis).in_noise == pytest.approx(1.0, abs=0.15)
        # Noise moves the instant of the first impact by 0.1 ms, and with it the clatter that follows.
        assert r.error("between", "main").in_noise == pytest.approx(1.0, abs=0.25)
    assert repeated.holds_to_second_impact()


def test_spread_of_repeats_is_the_yardstick_and_is_lent_to_other_releases(repeated):
    assert [m.borrowed for m in repeated.measured] == [False, False, True]
    for r in repeated.results[0]:
        # Repeats that differ by noise only: their standard deviation is the noise, here of two runs, so to a quarter.
        assert r.error("between", "main").in_spread == pytest.approx(1.0, abs=0.3)


def test_runs_without_repeats_have_no_spread(itself):
    assert all(m.repeats is None for m in itself.measured)
    assert all(e.in_spread is None for r in itself.results[0] for e in r.errors)


def test_baseline_is_that_of_the_file():
    e = replace(experiment(TABLE, [{}], duration=0.9), baseline="four_points", mass=27.0)
    model = baseline_model(e)
    assert model.points == "four_points" and model.mass == 27.0 and model.depth == e.width


def test_overturned_block_is_said(itself):
    first, second = itself.results[0]
    c = replace(itself, results=((replace(first, overturned=True), second),))
    assert texts(c, "overturned") == ["The modelled block falls over in run 01."]
    assert not c.holds_to_second_impact()
    assert to_dict(c)["models"][0]["runs"][0]["overturned"] is True


def test_everything_is_plain_json(repeated):
    text = json.dumps(to_dict(repeated), allow_nan=False)
    again = json.loads(text)
    assert again["schema"] == "rockref.compare/1"
    first = again["models"][0]["runs"][0]["errors"][0]
    assert first["rms_deg_s"] == pytest.approx(repeated.results[0][0].errors[0].rms / DEGREE)
    times = main_impacts(repeated.measured[0].run.t, repeated.measured[0].run.crv).times
    assert again["measured"][0]["main_impacts_s"] == pytest.approx(times.tolist())


def test_each_model_is_a_stage_and_the_time_left_runs_to_the_end():
    seen = []
    compare(experiment(TABLE, [{"true_tilt": 0.1172}], duration=0.9), [TABLE, SCALED], progress=seen.append)
    stages = list(dict.fromkeys((r.step, r.of, r.name) for r in seen))
    assert stages == [(1, 2, "simulating 1 run with model 1"), (2, 2, "simulating 1 run with model 2")]
    assert seen[0].seconds_left is None and seen[-1].seconds_left == pytest.approx(0.0)


@pytest.mark.parametrize(
    "change, code",
    [({"kind": "toss", "gyro": None}, "E-KIND"), ({"runs": ()}, "E-RUN")],
)
def test_what_is_no_release_is_refused(change, code):
    e = replace(experiment(TABLE, [{}], duration=0.9), **change)
    with pytest.raises(InputError) as error:
        compare(e, [TABLE])
    assert error.value.code == code


@pytest.mark.parametrize("models, names", [([], None), ([TABLE, TABLE], ["a", "a"]), ([TABLE], ["a", "b"])])
def test_models_need_names_of_their_own(models, names):
    with pytest.raises(InputError) as error:
        compare(experiment(TABLE, [{}], duration=0.9), models, names)
    assert error.value.code == "E-MODELS"


def test_gyroscope_of_the_tests_is_that_of_the_shipped_experiments():
    assert GYRO.sample_rate == 1000.0 and GYRO.range is None


def test_a_block_too_slender_for_the_tilt_of_the_table_has_that_of_its_first_run():
    e = experiment(TABLE, [{"tilt": 0.05}], duration=0.1)
    assert baseline_model(e).parameters.theta_0 == 0.117
    slender = replace(e, width=0.06)
    assert math.atan2(0.06, e.height) < 0.117
    assert baseline_model(slender).parameters.theta_0 == 0.05


@pytest.mark.parametrize(
    "uncertainty, first, offset", [(0.0, 0.52, 0.0), (0.0014, math.nan, 0.0), (0.0014, 9.0, 0.0014)]
)
def test_a_tilt_is_changed_within_its_uncertainty_where_both_first_impacts_are_known(
    itself, uncertainty, first, offset
):
    e = replace(itself.experiment, tilt_uncertainty=uncertainty)
    m = SimpleNamespace(run=itself.measured[0].run, first_impact=first)
    found = models.tilt_offset(m, itself.results[0][0].stated, e)
    assert abs(found) == pytest.approx(offset)


@pytest.mark.parametrize("code, cure", [("E-ENGINE", "own"), ("E-STEP", "check the unit"), ("E-RANGE", "own")])
def test_an_error_of_a_model_names_it_but_for_that_of_the_engine(code, cure):
    with pytest.raises(InputError) as error, models._named("mine", 1e-5):
        raise InputError(code, "here", "is wrong", "own")
    assert cure in error.value.cure and (error.value.where == "here") is (code == "E-ENGINE")
