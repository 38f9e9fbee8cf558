"""What is missing, from outcomes: on made-up runs whose answer is known, without the law."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.objective import WHITE
from rockref.discover.outcomes import diagnose as engine
from rockref.discover.outcomes.candidates import CANDIDATES, Setting, displacement
from rockref.discover.outcomes.likelihood import log_density, log_probabilities
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.report.terminal.outcome_text import candidates_table
from rockref.shake.ensemble import Draws
from rockref.shake.experiment import ShakenExperiment

MODEL = Model.four_points()
T = 0.01 * np.arange(401)
BASE = BaseMotion(0.0, 0.01, np.column_stack([np.sin(2 * np.pi * T), np.cos(3 * T), 0.1 * T]), "made")
SETTING = Setting(MODEL, (BASE, BASE), Draws(feet=3e-5))
BY_ID = {c.id: c for c in CANDIDATES}


@pytest.mark.parametrize("candidate", CANDIDATES, ids=lambda c: c.id)
def test_a_candidate_of_no_size_changes_nothing_and_one_of_typical_size_does(candidate):
    none, some = (candidate.apply(SETTING, size) for size in (0.0, candidate.typical))
    assert np.allclose(none.motions[0].a, BASE.a, rtol=0, atol=1e-15) and none.draws == SETTING.draws
    assert none.model.parameters == MODEL.parameters
    changed = not np.array_equal(some.motions[0].a, BASE.a) or some.draws != SETTING.draws or some.model != MODEL
    assert changed and some.motions[0] is some.motions[1]


def test_custom_points_and_stated_properties_are_scaled_too():
    points = MODEL.body()[1]
    for model in (
        MODEL.replace(points="custom", custom_points=points),
        MODEL.replace(properties={k: getattr(points, k) for k in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}),
    ):
        one = BY_ID["contact_friction"].apply(replace(SETTING, model=model), np.log(2.0)).model.body()[1]
        assert np.allclose(one.mu, 2 * points.mu, rtol=1e-14) and np.array_equal(one.C_N, points.C_N)


def test_the_displacement_of_whole_sines_is_theirs():
    # Straight lines between samples: an error of (w dt)^2/12 of the amplitude, twice.
    expected = -np.sin(2 * np.pi * T) / (2 * np.pi) ** 2
    assert np.max(np.abs(displacement(BASE)[:, 0] - expected)) < 1e-3 / (2 * np.pi) ** 2
    assert not displacement(BASE)[:, 2].any()


def test_a_density_is_that_of_students_t_and_survives_a_test_that_always_falls():
    rng = np.random.default_rng(0)
    y = rng.normal(size=(4000, 2))
    counted = np.ones(y.shape, bool)
    normal = -0.5 * np.log(2 * np.pi) - 0.5 * np.array([0.0, 4.0])
    # Mean and variance of 4000 values are known to some hundredths.
    assert np.allclose(log_density(np.array([0.0, 2.0]), y, counted), normal, atol=0.1)
    counted[:, 1] = False
    assert np.isfinite(log_density(np.zeros(2), y, counted)).all()


def test_a_fall_that_no_run_shows_is_improbable_not_impossible():
    outcomes = {"fell": np.zeros((9, 1))}
    found = log_probabilities(("fell",), {"fell": np.ones(1)}, outcomes)
    assert found[0, 0] == pytest.approx(np.log(0.5 / 10))


def made_up(setting, runs, step, after, seed, workers):
    """Tilts that grow with the motion and with damping; slides that friction shortens; falls beyond a tilt."""
    rng = np.random.default_rng(seed)
    pga = np.array([np.abs(base.a[:, 0]).max() for base in setting.motions])
    noise = rng.normal(size=(3, runs, len(pga)))
    tilt = 0.1 * pga**2 * np.exp(0.3 * noise[0]) * (MODEL.parameters.beta_ext / setting.model.parameters.beta_ext)
    slide = 0.01 * pga * np.exp(0.3 * noise[1]) * (MODEL.parameters.mu_ext / setting.model.parameters.mu_ext) ** 2
    return {"fell": (tilt > 0.5).astype(float), "tilt": tilt, "slide": slide, "twist": 0.01 * np.exp(noise[2])}


def diagnosis(monkeypatch, truth=None, size=0.0, change=lambda outcomes: outcomes):
    motions = tuple(BASE.scaled(f) for f in np.tile(np.geomspace(0.7, 2.8, 6), 16))
    setting = Setting(MODEL, motions, Draws())
    hidden = setting if truth is None else BY_ID[truth].apply(setting, size)
    found = {k: v[0] for k, v in change(made_up(hidden, 1, 0, 0, 99, None)).items()}
    e = ShakenExperiment(
        "made", np.repeat(np.arange(16), 6).astype(str), found["fell"],
        {k: found[k] for k in ("tilt", "slide", "twist")}, None, motions, {}, Draws(), "",
    )  # fmt: skip
    monkeypatch.setattr(engine, "simulated", made_up)
    return engine.diagnose_outcomes(e, MODEL, tuple(BY_ID[k] for k in ("contact_damping", "contact_friction")))


def test_a_hidden_effect_is_named_with_its_size(monkeypatch):
    found = diagnosis(monkeypatch, "contact_friction", -0.4)
    assert found.verdict.word == "named" and found.verdict.effects == ("contact_friction",)
    number = found.evidence.of(("contact_friction",)).numbers["contact_friction.log_factor"]
    # 72 slides with a scatter of 0.3 tell half a friction's logarithm to 0.02; three of that.
    assert number.value == pytest.approx(-0.4, abs=0.06) and number.low < number.value < number.high
    assert "ends with the sizes" not in found.sentence()
    found.evidence.signature["open_ends"] = ["contact_friction"]
    assert found.sentence().endswith("The interval of contact_friction ends with the sizes that were tried.")
    assert any("no further tried" in row[1] for row in candidates_table(found.to_dict()).rows)


def test_nothing_is_named_where_nothing_is_hidden(monkeypatch):
    assert diagnosis(monkeypatch).verdict.word == "none"


def test_what_no_candidate_explains_is_said(monkeypatch):
    found = diagnosis(monkeypatch, change=lambda outcomes: outcomes | {"twist": 5.0 * outcomes["twist"] ** 0.2})
    assert found.verdict.word == "something_else" and "no candidate explains" in found.sentence()
    assert found.verdict.best.loss > WHITE


def test_tests_without_records_and_of_one_motion_are_refused():
    e = ShakenExperiment("made", np.array(["a", "a"]), np.ones(2), {}, None, None, {}, Draws(), "")
    for one, code in ((e, "E-RECORD"), (replace(e, motions=(BASE, BASE)), "E-MOTIONS")):
        with pytest.raises(InputError) as refused:
            engine.diagnose_outcomes(one, MODEL)
        assert refused.value.code == code
