"""Ensembles: the compiled loop finds what the rows show, whatever runs beside, and a run is made from its number."""

import json
import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import astuple, replace

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.engines.compiled.engine import simulate
from rockref.model.base_motion import BaseMotion
from rockref.model.errors import InputError
from rockref.shake import ensemble as module
from rockref.shake import extremes
from rockref.shake.ensemble import Draws, Ensemble, run_all, run_ensemble

STEP = 2e-5


def noise(seed: int, size: float) -> BaseMotion:
    """One second of shaking in three directions that grows and dies away."""
    t = np.linspace(0, 1, 101)
    a = np.random.default_rng(seed).normal(size=(101, 3)) * np.sin(np.pi * t)[:, None]
    return BaseMotion(0.0, 0.01, size * a * [3, 3, 1], name=f"noise {seed}")


DRAWS = Draws(heading=180.0, feet=5e-5, friction=0.2)
SHAKEN = Ensemble(
    rockref.Model.table_3_1(), (noise(0, 1.0), noise(1, 1.0)), (0.2, 1.0, 3.0), DRAWS, step=STEP, after=1.0, seed=3
)


@pytest.fixture(scope="module")
def rows():
    return SHAKEN.rows(0, 21, workers=1)


def test_the_loop_finds_what_the_rows_of_a_run_show(rows):
    """Runs of every kind of end; rows by the plain loop at the same ticks, looked at by NumPy."""
    _, every = extremes.limits(STEP)
    body = SHAKEN.model.body()
    for row in rows[:12]:
        problem = SHAKEN.problem(row["run"], body, {})
        response = simulate(problem.replace(output_rate=1 / (every * STEP)))
        expected = extremes.watched(response, extremes.ticks(problem, every)[1])
        for name, value in zip(extremes.COLUMNS, astuple(expected), strict=True):
            if isinstance(value, float):
                # sines and cosines instead of angles: a rounding of each
                np.testing.assert_allclose(row[name], value, rtol=1e-9, atol=1e-12, err_msg=name)
            else:
                assert row[name] == value, name
    assert {row["fell"] for row in rows[:12]} == {True, False} and any(row["impacts"] > 3 for row in rows[:12])


def test_the_bits_of_a_run_depend_on_its_number_alone(rows):
    assert repr(SHAKEN.rows(0, 21, workers=3)) == repr(rows)
    assert repr(SHAKEN.rows(5, 8)) == repr(rows[5:8])
    assert repr(replace(SHAKEN, seed=4).rows(5, 6)) != repr(rows[5:6])


def test_a_block_that_stays_comes_to_rest_after_its_record_and_not_before():
    quiet = replace(SHAKEN, motions=(noise(0, 0.02),), factors=(1.0,), draws=Draws(heading=90.0), after=3.0).rows(0, 2)
    for row in quiet:
        assert row["ended"] == "rest" and 1.5 <= row["end_s"] < 4.0 and not row["fell"]
        assert row["tilt_rad"] < 1e-2 and row["slide_m"] < 1e-4


def test_draws_take_each_motion_and_factor_alike_and_spread_as_they_say():
    own = [SHAKEN.drawn(k) for k in range(600)]
    assert [(d["record"], d["factor"]) for d in own[:7]] == [
        (0, 0.2),
        (0, 1.0),
        (0, 3.0),
        (1, 0.2),
        (1, 1.0),
        (1, 3.0),
        (0, 0.2),
    ]
    feet, friction = np.array([d["feet"] for d in own]), np.log([d["friction"] for d in own])
    # 2400 and 600 normal numbers: their deviations are known to 1.5 and 3 %
    assert abs(feet.std() / 5e-5 - 1) < 0.06 and abs(friction.std() / 0.2 - 1) < 0.12
    heading = np.array([d["heading"] for d in own])
    assert abs(heading).max() <= np.pi and abs(heading).max() > 3 and abs(heading.mean()) < 0.3


def test_steps_are_taken_in_turn_and_a_run_has_the_bits_of_its_own(rows):
    own = replace(SHAKEN, motions=SHAKEN.motions[:1], factors=(3.0,), step=(STEP, 2 * STEP), after=0.2).rows(0, 4, 1)
    assert [row["step_s"] for row in own] == [STEP, 2 * STEP, STEP, 2 * STEP]
    alone = replace(SHAKEN, motions=SHAKEN.motions[:1], factors=(3.0,), step=2 * STEP, after=0.2).rows(0, 4, 1)
    assert repr(own[1]) == repr(alone[1]) and repr(own[3]) == repr(alone[3]) and repr(own[0]) != repr(alone[0])


def test_blocks_that_are_known_are_not_run_again(monkeypatch, rows):
    monkeypatch.setattr(module, "BLOCK", 8)
    kept = {}
    first = run_ensemble(SHAKEN, 21, done=lambda block, own: kept.__setitem__(block, json.loads(json.dumps(own))))
    assert repr(first) == repr(rows) and sorted(kept) == [0, 1, 2]
    del kept[1]
    asked = []
    again = run_ensemble(
        SHAKEN, 21, done=lambda block, own: asked.append(block), have=lambda block, size: kept.get(block)
    )
    assert repr(again) == repr(rows) and asked == [1]


def test_any_executor_runs_the_blocks_and_the_rows_are_the_same(monkeypatch, rows):
    monkeypatch.setattr(module, "BLOCK", 8)
    told = []
    with ThreadPoolExecutor(2) as executor:
        own = run_ensemble(SHAKEN, 21, done=lambda block, found: told.append(block), executor=executor)
    assert repr(own) == repr(rows) and told == [0, 1, 2]
    assert pickle.loads(pickle.dumps(SHAKEN)).drawn(5)["friction"] == SHAKEN.drawn(5)["friction"]  # sent to processes


def test_without_a_compiled_twin_the_law_runs_and_the_same_is_found(monkeypatch):
    short = replace(SHAKEN, motions=(replace(noise(2, 3.0), dt=0.0005),), factors=(1.0,), after=0.01)
    body = short.model.body()
    problems = [short.problem(k, body, {}) for k in range(2)]
    fast = run_all(problems)
    monkeypatch.setattr("rockref.engines.chosen", lambda *a, **k: "numpy")
    slow = run_all(problems)
    for a, b in zip(fast, slow, strict=True):
        np.testing.assert_allclose([a.tilt, a.slide, a.uplift, a.end], [b.tilt, b.slide, b.uplift, b.end], rtol=1e-9)


def test_what_makes_no_ensemble_is_refused():
    with pytest.raises(InputError, match="E-RANGE"):
        Draws(feet=-1e-5)
    points = rockref.Model.table_3_1().body()[1]
    named = replace(points, names=tuple("abcdefgh"))
    with pytest.raises(InputError, match="E-FEET"):
        module.with_feet(named, np.full(4, 1e-5))
    askew = replace(SHAKEN, draws=Draws(feet=0.05))
    with pytest.raises(InputError, match="run 0"):
        askew.rows(0, 1)
