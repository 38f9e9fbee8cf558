"""The simpler methods find what they can find."""

import json
import sys
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.blind.cases import making, plan, sealing
from rockref.blind.scoring import evaluation
from rockref.blind.scoring.judging import VERDICT
from tests.shipped import ROOT
from tests.unit.discover.synthetic import GYRO

sys.path.insert(0, str(ROOT / "benchmarks"))
import rivals  # noqa: E402

BLOCK = SimpleNamespace(mass=54.0, width=0.100, height=0.688)
RADIUS = 0.5 * np.hypot(BLOCK.width, BLOCK.height)
INERTIA = 4 / 3 * BLOCK.mass * RADIUS**2


def housner(torque, tilt=0.117, seconds=2.4, h=1e-4):
    """Rate about X at 1 kHz of Housner's block with a further torque(t, lean, rate) about its edge."""
    alpha, lean, w, found = np.arctan2(BLOCK.width, BLOCK.height), tilt, 0.0, []
    for i in range(round(seconds / h)):
        if i % 10 == 0:
            found.append(-w)
        side = 1.0 if lean > 0 else -1.0
        gravity = -BLOCK.mass * 9.81 * RADIUS * np.sin(alpha - abs(lean)) * side
        w += h * (gravity + torque(i * h, lean, w)) / INERTIA
        before, lean = lean, lean + h * w
        if before * lean < 0:
            w *= 0.97
    return np.arange(len(found)) * 1e-3, np.column_stack([found, np.zeros(len(found)), np.zeros(len(found))])


def parts(torque):
    t, crv = housner(torque)
    rng = np.random.default_rng(0)
    library, y = rivals.weak_rows(t, crv + 1e-4 * rng.normal(size=crv.shape), 0.117, False, BLOCK)
    found = rivals.sparse_parts(np.column_stack(list(library.values())), y)
    return {name: part for name, part in zip(library, found, strict=True) if part > 0}


@pytest.mark.parametrize(
    ("name", "torque"),
    [
        ("rolling_resistance", lambda t, lean, w: -0.8 * np.sign(w)),
        ("plate_tilt", lambda t, lean, w: 0.5),
        ("lingering_wire_pull", lambda t, lean, w: 2.0 * np.exp(-t / 0.3)),
    ],
)
def test_sparse_regression_finds_a_torque_of_its_library(name, torque):
    found = parts(torque)
    assert max(found, key=lambda k: found[k]) == name


def test_sparse_parts_drop_what_is_not_there():
    rng = np.random.default_rng(1)
    A = rng.normal(size=(200, 5))
    found = rivals.sparse_parts(A, 3.0 * A[:, 1] - 2.0 * A[:, 4] + 0.01 * rng.normal(size=200))
    assert list(np.flatnonzero(found)) == [1, 4]


def test_residual_correlation_takes_the_nearest_trace(monkeypatch, tmp_path):
    rng = np.random.default_rng(2)
    release = (0.117, False)
    traces = {name: {release: rng.normal(size=(50, 3))} for name in ("none", "adhesion", "gyro_drift")}
    run = SimpleNamespace(
        release_tilt=0.117, block_turned=0.0, crv=traces["none"][release] - 0.5 * traces["gyro_drift"][release]
    )
    experiment = SimpleNamespace(fit_runs=lambda: (run,), mass=54.0, width=0.1, height=0.688, baseline="x", gyro=None)
    monkeypatch.setattr(rivals, "_traces", lambda *a: traces)
    monkeypatch.setattr("rockref.measure.experiment.load_experiment", lambda *a, **k: experiment)
    found = rivals.residual_correlation(tmp_path)
    assert found["effects"] == ["gyro_drift"] and found["correlation"] == pytest.approx(-1.0)


def test_a_ranking_is_taken_at_its_word():
    ranking = [{"effect": "adhesion", "z": 40.0}, {"effect": "clock_error", "z": 3.0}]
    assert rivals.first_of_ranking({"verdict": "none", "ranking": ranking})["effects"] == ["adhesion"]
    assert rivals.first_of_ranking({"ranking": [{"effect": "adhesion", "z": 2.0}]})["verdict"] == "none"
    assert rivals.first_of_ranking({})["verdict"] == "none"


def experiment_of(*runs):
    return SimpleNamespace(fit_runs=lambda: runs, **vars(BLOCK), baseline="eight_points", gyro=GYRO)


@pytest.mark.parametrize("turned", [False, True])
def test_sparse_regression_names_the_torque_that_a_case_has(monkeypatch, tmp_path, turned):
    t, crv = housner(lambda t, lean, w: -0.8 * np.sign(w))
    turn = np.pi if turned else 0.0
    run = SimpleNamespace(t=t, crv=-crv if turned else crv, release_tilt=0.117, block_turned=turn)
    unread = SimpleNamespace(t=None, crv=None, release_tilt=0.117, block_turned=0.0)
    monkeypatch.setattr("rockref.measure.experiment.load_experiment", lambda *a, **k: experiment_of(unread, run))
    found = rivals.sparse_regression(tmp_path)
    assert found["effects"] == ["rolling_resistance"] and 0.5 < found["explained"] <= 1.0


def test_sparse_regression_says_nothing_where_nothing_is_left(monkeypatch, tmp_path):
    run = SimpleNamespace(t=np.arange(3), crv=np.zeros((3, 3)), release_tilt=0.117, block_turned=0.0)
    rows = {"baseline": np.ones(9), "plate_tilt": np.arange(9.0)}
    monkeypatch.setattr("rockref.measure.experiment.load_experiment", lambda *a, **k: experiment_of(run))
    monkeypatch.setattr(rivals, "weak_rows", lambda *a: (rows, np.zeros(9)))
    assert rivals.sparse_regression(tmp_path) == {"verdict": "none", "effects": [], "explained": 0.0}


@pytest.mark.parametrize("baseline, known", [("eight_points", False), ("four_points", True)])
def test_traces_are_what_an_effect_changes_in_the_record(monkeypatch, baseline, known):
    from rockref.effects import catalogue

    pytest.importorskip("numba")
    kinds = {id: catalogue.EFFECTS[id] for id in ("gyro_scale", "foot_defects")}
    monkeypatch.setattr(catalogue, "EFFECTS", kinds)
    monkeypatch.setattr(rivals, "STRETCH", 0.4)
    rivals._traces.cache_clear()
    releases = ((0.117, False), (0.117, True))
    found = rivals._traces((BLOCK.mass, BLOCK.width, BLOCK.height, baseline), releases, GYRO)
    rivals._traces.cache_clear()
    # Where the eight points are known, defects of the feet are no effect but the baseline.
    assert ("foot_defects" in found) is known
    scale = kinds["gyro_scale"].typical().values()
    for release in releases:
        wanted = found["none"][release] * (np.array([scale[a] for a in "xyz"]) - 1)
        np.testing.assert_allclose(found["gyro_scale"][release], wanted, atol=1e-12)
    # Turned, the block swings the other way.
    upright, turned = (found["none"][r][-1, 0] for r in releases)
    assert upright > 0.1 and turned < -0.1


def test_answers_are_made_once_and_marked_beside_the_discoverer(tmp_path, monkeypatch, capsys):
    asked = []

    def always(case):
        asked.append(case.name)
        return {"verdict": "named", "effects": ["cable_restraint"]}

    def broken(case):
        raise ZeroDivisionError("no")

    def make_one(root, name, case):
        (tmp_path / name).mkdir()
        (tmp_path / name / "experiment.toml").write_text(f"name = '{name}'\n")
        (tmp_path / name / VERDICT).write_text(json.dumps({"verdict": "none", "effects": []}))
        effects = [{"id": id, "size": s, "form": "catalogue", "parameters": {"k": 5.0}} for id, s in case.effects]
        truth = {"name": name, "kind": case.kind, "effects": effects, "class": []}
        sealing.write_json(tmp_path / making.PARTS / f"{name}.json", truth)
        return name

    monkeypatch.setattr(making, "make_one", make_one)
    monkeypatch.setattr(rivals, "METHODS", {"always": always, "broken": broken})
    making.make(tmp_path, 1, cases=plan.listed(1, ["none", "cable_restraint"]), workers=1)
    assert rivals.main([str(tmp_path)]) == 2, "no truth is opened before the verdicts stand"
    evaluation.score(tmp_path, workers=1)
    assert rivals.main([str(tmp_path)]) == 0 == rivals.main([str(tmp_path)])
    lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    rows = {cells[0]: cells[1:] for cells in lines}
    assert rows["score"] == ["discoverer", "always", "broken", rivals.RANKING, "n"]
    assert rows["controls: false alarms"] == ["0.0 %", "100.0 %", "0.0 %", "0.0 %", "1"]
    assert rows["single: truth first"] == ["0.0 %", "100.0 %", "0.0 %", "0.0 %", "1"]
    assert asked == ["case-001", "case-002"] and not any("seconds" in row for row in rows)
