"""The fit of a baseline on runs that a known model made: what was put in comes out, and the gates say what holds."""

from functools import cache

import numpy as np
import pytest

from rockref import Model
from rockref.discover import fit_baseline as engine
from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit_gates import Gate, off_bounds, same_place
from rockref.discover.fit_store import FitStore
from rockref.discover.progress import StageCounter
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment

TRUE = Model.table_3_1().replace(mu_ext=0.22, beta_ext=0.2)
RUNS = [{}, {"turned": True}, {"tilt": 0.11, "use": "holdout"}]


@cache
def made(*effects: str):
    """Runs of a block with other friction and damping than Table 3.1's, and with these effects."""
    return experiment(TRUE.replace(effects=tuple(map(parse, effects))), RUNS, duration=0.9, noisy=True)


def fit(monkeypatch, e, *given, **options):
    monkeypatch.setattr(engine, "opened", lambda path: (e, e))
    return engine.fit_baseline("folder", *given, workers=1, end=0.8, **options)


def test_the_numbers_that_were_put_in_come_out_and_every_gate_is_passed(monkeypatch):
    found = fit(monkeypatch, made())
    assert found.outcome == "trustworthy" and len(found.gates) == 5
    law = found.evidence.law
    # A tenth of the way across the prior: two runs of 0.8 s leave ridges between friction and damping.
    assert law["mu_ext"].value == pytest.approx(0.22, rel=0.08) and law["beta_ext"].value == pytest.approx(0.2, rel=0.1)
    assert law["K_T"].unit == "N/m" and law["K_T"].value == pytest.approx(TRUE.parameters.K_T, rel=0.05)
    # Innovations are as large as the noise of the gyroscope, 0.05 deg/s.
    assert found.evidence.error["total"] == pytest.approx(0.05, rel=0.1)
    assert found.model.origin["gates_passed"] is True and found.model.parameters.mu_ext == law["mu_ext"].value


def test_where_an_effect_is_missing_the_fit_and_the_model_say_so(monkeypatch):
    monkeypatch.setattr(engine.Search, "anywhere", lambda search, h: h)  # no other start explains a wrong scale
    found = fit(monkeypatch, made("gyro_scale:x=1.03,y=1.03,z=1.03"))
    assert found.outcome == "effect_missing" and found.passed
    assert [gate.name for gate in found.gates] == ["innovations_white"]
    assert found.model.origin["gates_passed"] == "an effect is missing: run rockref diagnose"


def test_an_effect_that_is_named_is_fitted_along(monkeypatch):
    monkeypatch.setattr(engine.Search, "anywhere", lambda search, h: h)
    found = fit(monkeypatch, made("gyro_scale:x=1.03,y=1.03,z=1.03"), ("gyro_scale",), check=False)
    assert found.effects == ("gyro_scale",) and found.outcome == "not_checked"
    assert found.evidence.numbers["gyro_scale.x"].value == pytest.approx(1.03, abs=0.005)


def test_a_second_fit_starts_where_the_first_one_ended(monkeypatch):
    store = FitStore(on_disk=False)
    first = fit(monkeypatch, made(), check=False, store=store)
    said = []
    second = fit(monkeypatch, made(), check=False, store=store, progress=said.append)
    assert not first.from_store and second.from_store
    lines = [report.line for report in said if report.line]
    assert lines[0] == "the baseline: from what was found before, at F"
    # It goes on from there, by the covariance about that fit in place of the one about an earlier stage: another
    # draw of its spikes moves the objective by less than the two nats that count as one.
    assert second.evidence.objective == pytest.approx(first.evidence.objective, abs=2.0)


def test_a_model_begins_at_its_own_numbers():
    e = made()
    model = TRUE.replace(effects=(parse("quadratic_drag:c=0.4"),))
    fitter = engine.prepared(e, e, model, 0.8, 1, 0, StageCounter({}))
    z = engine.model_start(fitter.problem, engine.baseline_model(e, model))
    started = fitter.problem.job(fitter.parameters(FittedModel(("quadratic_drag",), z)), z).models[0]
    assert started.effects[0].values()["c"] == pytest.approx(0.4)
    assert started.parameters.beta_ext == pytest.approx(0.2)


def test_the_frequency_of_a_shaking_base_is_the_model_s_own():
    shaken = TRUE.replace(effects=(parse("base_vibration:amplitude=0.1,frequency=12.5"),))
    assert engine.stated_tone(shaken) == 12.5 and engine.stated_tone(TRUE) is None


def test_another_start_moves_the_law_and_leaves_effects_near(monkeypatch):
    e = made()
    fitter = engine.prepared(e, e, TRUE.replace(effects=(parse("quadratic_drag:c=0.4"),)), 0.8, 1, 0, StageCounter({}))
    parameters = fitter.problem.parameters(("quadratic_drag",))
    h = FittedModel(("quadratic_drag",), np.full(len(parameters), 0.8))
    z = engine.other_start(fitter, h, seed=1)
    moved = {p.name: abs(value - 0.8) for p, value in zip(parameters, z, strict=True)}
    assert moved["quadratic_drag.c"] < 0.3 and max(moved[n] for n in ("K_N", "mu_int", "beta_int")) > 0.1
    assert all(value == 0.0 for p, value in zip(parameters, z, strict=True) if p.run is not None)


def test_gates_compare_shared_numbers_alone():
    fitter = engine.prepared(made(), made(), None, 0.8, 1, 0, StageCounter({}))
    parameters = fitter.problem.parameters()
    z, width = np.zeros(len(parameters)), np.full(len(parameters), 0.01)
    at = [p.name for p in parameters].index("mu_int")
    tilt = [p.name for p in parameters].index("tilt_offset[0]")
    off = z.copy()
    off[[at, tilt]] = 0.2, 3.2  # a tilt belongs to its own run
    gate = same_place("stages_agree", parameters, off, z, width)
    assert not gate.passed and "mu_int" in gate.sentence and gate.value == pytest.approx(2.0)
    assert off_bounds(parameters, off).passed
    off[at] = -3.2
    assert not off_bounds(parameters, off).passed


@pytest.mark.parametrize(
    "white, others, outcome",
    [(True, True, "trustworthy"), (True, False, "not_trustworthy"), (False, False, "effect_missing")],
)
def test_innovations_that_are_not_white_say_that_an_effect_is_missing(white, others, outcome):
    from tests.unit.discover import fakes

    gates = [Gate("starts_agree", others, 0.0, 1.0, ""), Gate("innovations_white", white, 0.0, 1.0, "")]
    assert engine.outcome_of(gates, fakes.fitted().evidence) == (outcome, "")
    assert engine.outcome_of([], fakes.fitted().evidence)[0] == "not_checked"
    assert {outcome, "not_checked"} <= set(engine.GATES_SAID)
