"""What fills the page, and the listening run by which the page fits."""

import numpy as np
import pytest

import rockref
from rockref.api import Model
from rockref.effects.catalogue import EFFECTS, parse
from rockref.lab import layout, pack
from rockref.measure import load_experiment
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.report.html.encoding import unpacked
from rockref.report.html.inline import as_json
from tests.shipped import ROOT

EXPERIMENT = ROOT / "data/experiments/mystery-04"


@pytest.fixture(scope="module")
def experiment():
    return load_experiment(EXPERIMENT)


@pytest.fixture(scope="module")
def packed(experiment):
    return pack.pack(Model.table_3_1(), experiment)


def test_rates_are_packed_exactly(packed, experiment):
    for run, shown in zip(experiment.runs, packed["experiment"]["runs"], strict=True):
        for axis in range(3):
            rates = unpacked(shown["rates"][axis])
            # The text of the record has two digits after the point; rad/s and back loses some 1e-15 of it.
            np.testing.assert_allclose(rates, run.crv[:, axis] * DEGREES, rtol=0, atol=1e-9)


def test_rates_off_the_resolution_are_packed_as_floats():
    values = np.array([0.1, 0.123456789, -7.0])
    column = pack.column(values, 0.01)
    assert column["unit"] == 0.0 and column["n"] == 3


def test_impacts_noise_and_spread(packed):
    run = packed["experiment"]["runs"][0]
    assert run["impacts"][0] == pytest.approx(0.5085, abs=1e-3)
    # The data sheet's noise is 0.05 deg/s; of 500 calm samples it is known to some 5 %.
    assert run["noise"] == pytest.approx([0.05] * 3, rel=0.15)
    before, between, after = np.array(run["spread"])
    assert np.all(before < between) and np.all(between < after)


def test_every_effect_has_its_place_and_its_words(packed):
    assert {entry["id"] for entry in packed["effects"]} == set(EFFECTS)
    row = layout.values_of((parse("quadratic_drag:c=0.4"),))
    place = packed["layout"]["values"]["quadratic_drag"]
    assert row[place["on"]] == 1.0 and row[place["c"]] == 0.4 and sum(np.isfinite(row)) == len(row)
    assert not any(layout.values_of((EFFECTS["quadratic_drag"](),)))
    # What is infinite is a word: JSON has no number for it.
    bandwidth = next(e for e in packed["effects"] if e["id"] == "gyro_bandwidth")
    assert bandwidth["quantities"][0]["absent"] == "inf"
    assert "<" not in as_json(packed)


def test_the_model_that_is_given_is_where_the_page_begins():
    model = Model.four_points().replace(K_N=5e7, mass=60.0, effects=(parse("gyro_scale:x=1.01"),))
    start = pack.start(model)
    assert start["numbers"]["K_N"] == 5e7 and start["numbers"]["points"] == 4.0 and start["numbers"]["mass"] == 60.0
    assert start["effects"] == {"gyro_scale": {"x": 1.01, "y": 1.0, "z": 1.0}}
    idle = [p["name"] for p in pack.parameters(model, 1e-3) if not p["acts"]]
    assert "beta_int" in idle and "K_N" not in idle


@pytest.mark.parametrize(
    "change", [{"points": "custom", "custom_points": Model().body()[1]}, {"effects": (parse("tag_frame"),)}]
)
def test_models_without_sliders_are_refused(change):
    with pytest.raises(InputError, match="E-LAB"):
        pack.start(Model().replace(**change))


# A run that listens to a record of the same block leaves white noise, and of another block more.
SAMPLES, SIGMA = 1000, np.full(3, 0.05 / DEGREES)


@pytest.fixture(scope="module")
def module():
    pytest.importorskip("wasmtime", reason="wasmtime runs WebAssembly outside a browser: the extra `lab`")
    from rockref.lab.wasm import Module

    return Module()


@pytest.fixture(scope="module")
def record():
    return recorded()


def recorded(effects=()):
    """What the block of Table 3.1 shows, its gyroscope having these effects."""
    from rockref.measure.gyroscope import record
    from rockref.measure.records.release import Gyro

    response = rockref.simulate(Model.table_3_1(), 1.2, output_rate=4000.0, engine="auto")
    rng = np.random.default_rng(1)
    gyro = Gyro(sample_rate=1000.0, noise=SIGMA[0], bandwidth=300.0, resolution=0.0)
    return np.ascontiguousarray(record(response.t, response.W, gyro, rng, effects)[1][:SAMPLES])


def loss(module, record, model, memory=(0.04, 1.0), steps=16, effects=()):
    """Mean robust loss of the innovations, 25 log(1 + r^2/25)."""
    r = np.zeros((SAMPLES, 3))
    row, values = np.array(layout.model_row(model)), np.array(layout.values_of(effects))
    gyro = 1000.0, 300.0, 0.0
    release = model.parameters.theta_0, 0.0, 0
    how = *memory, 5e-5, steps, 0
    module.call("innovations_of", row, values, *gyro, *release, *how, record, SAMPLES, SIGMA, r)
    return np.mean(25 * np.log1p(r**2 / 25))


def test_the_truth_leaves_white_noise(module, record):
    # White noise leaves 0.945; its mean over 3000 samples is known to 0.02, and impacts in steps three times as
    # long as those of the record add up to 0.1.
    assert 0.9 < loss(module, record, Model.table_3_1()) < 1.1


@pytest.mark.parametrize(
    "words", ["clock_error:rate=1.03", "clock_error:rate=1.02,growth=0.25", "clock_error:rate=1.06,growth=1"]
)
def test_a_wrong_clock_leaves_white_noise_where_it_is_known(module, words):
    """The last one has moved by a twentieth before the record ends, and moves no more."""
    effect = (parse(words),)
    shown = recorded(effect)
    assert 0.9 < loss(module, shown, Model.table_3_1(), effects=effect) < 1.1
    assert loss(module, shown, Model.table_3_1()) > 1.3


def test_without_listening_the_run_is_the_free_one(module, record):
    assert loss(module, record, Model.table_3_1(), (1e9, 1e9), 50) == pytest.approx(0.945, abs=0.06)


@pytest.mark.parametrize("words", ["quadratic_drag:c=0.4", "gyro_scale:x=1.02", "compliant_support"])
def test_another_block_leaves_more(module, record, words):
    truth = loss(module, record, Model.table_3_1())
    # Five deviations of a mean over 3000 samples.
    assert loss(module, record, Model.table_3_1(), effects=(parse(words),)) > truth + 0.1


def test_a_short_memory_bears_more(module, record):
    other = Model.table_3_1().replace(delta_diag=6.6e-3)
    long, short = (loss(module, record, other, memory) for memory in ((0.04, 1.0), (0.005, 0.1)))
    assert short - 0.945 < 0.5 * (long - 0.945)
