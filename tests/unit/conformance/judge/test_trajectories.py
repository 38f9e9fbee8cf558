"""Whole runs: rows against rows, the first divergent sample, the event before it, the closed form of the drop."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.load import load
from rockref.conformance.backends.rule_set import simulate
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge import trajectories
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.trajectories import RunCheck, judge_rows, judge_runs
from rockref.conformance.judge.verdict import as_json, verdict
from rockref.conformance.reports import terminal
from rockref.conformance.reports.page import page as page_of
from rockref.conformance.reports.terminal import impact_lines, run_line
from rockref.engines import has_numba

RUNS = vectors.window_names() + vectors.trajectory_names()
compiled = pytest.mark.skipif(not has_numba(), reason="needs the extra fast")


@compiled
def test_the_compiled_engine_passes_every_run():
    trajectories = judge_runs(load("numba"), "float64")
    assert [r.id for r in trajectories] == list(RUNS)
    assert [f"{r.id} {r.worst}" for r in trajectories if r.failed] == []
    assert all(i["grade"] in ("bitwise", "inside") for r in trajectories for i in r.impacts)


@pytest.mark.slow
def test_the_law_passes_every_run():
    assert [r.id for r in judge_runs(load("numpy"), "float64") if r.failed] == []


@pytest.mark.slow
def test_single_precision_passes_its_own_profile():
    assert [r.id for r in judge_runs(load("float32"), "float32") if r.failed] == []


@pytest.mark.slow
def test_another_integrator_passes_as_another_scheme():
    assert [r.id for r in judge_runs(load("scheme"), "scheme") if r.failed] == []


@compiled
def test_the_law_passes_as_another_scheme_too():
    assert [r.id for r in judge_runs(load("numba"), "scheme") if r.failed] == []


class Shifted:
    """The rows of a run, with a step put into one quantity from some row on."""

    def __init__(self, name, row, size):
        self.name, self.row, self.size = name, row, size

    def out(self, run):
        t = run.columns
        rows = {
            "t": t["t_s"],
            "W": t["W_rad_s"].copy(),
            "x": t["x_m"].copy(),
            "Lambda": t["Lambda"].reshape(-1, 3, 3).copy(),
        }
        rows[self.name][self.row :] += self.size
        return rows


def test_the_first_divergent_sample_and_the_event_before_it():
    run = vectors.trajectory("window_table_3_1_0500ms")
    judged = judge_rows(run, Shifted("W", 60, 1e-6).out(run), "float64")
    assert judged.grade == "outside" and judged.first["row"] == 60 and judged.first["quantity"] == "W"
    assert judged.first["got"] - judged.first["expected"] == pytest.approx(1e-6, rel=1e-6)
    assert judged.event[0] <= judged.first["t_s"] < min(e[0] for e in run.meta["events"] if e[0] > judged.event[0])


def test_expected_rows_are_bitwise():
    run = vectors.trajectory("table_3_1")
    assert judge_rows(run, Shifted("W", 10**6, 0).out(run), "float64").grade == "bitwise"


def test_after_the_horizon_nothing_is_compared():
    run = vectors.trajectory("spinning")
    past = int(np.sum(run.columns["t_s"] <= run.meta["horizon_s"]["float32"])) + 1
    assert judge_rows(run, Shifted("W", past, 100.0).out(run), "float32").grade == "bitwise"
    assert judge_rows(run, Shifted("W", past - 3, 100.0).out(run), "float32").grade == "outside"


def test_a_late_main_impact_is_seen_even_where_rows_are_right():
    run = vectors.trajectory("table_3_1")
    rows = Shifted("W", 10**6, 0).out(run)
    i = int(np.searchsorted(rows["t"], run.meta["impacts"][0]["t_s"]))
    rows["Lambda"][i - 1, 2, 1] += 1e-7
    judged = judge_rows(run, rows, "float64")
    assert judged.impacts[0]["grade"] == "outside" and judged.impacts[1]["grade"] == "bitwise"


def test_rows_at_other_instants_are_named():
    run = vectors.trajectory("drop")
    rows = Shifted("W", 10**6, 0).out(run)
    rows["t"] = rows["t"] + 2e-5
    judged = judge_rows(run, rows, "float64")
    assert judged.failed and "row 0 is at t = 2e-05 s, not 0 s" in judged.note


@pytest.mark.parametrize("answer", [{"W": np.zeros((3, 3))}, {"x": None}, {"W": "none"}])
def test_unusable_rows_are_failures(answer):
    run = vectors.trajectory("drop")
    judged = judge_rows(run, answer, "float64")
    assert judged.failed and judged.note


def test_the_drop_is_its_closed_form():
    """Free fall from 1 mm, then eight Kelvin-Voigt feet in parallel: m z'' = -m g + K z - C z', without tension."""
    run = vectors.trajectory("drop")
    p = run.problem
    m, g = float(p.block.mass), float(p.block.g)
    # The internal feet lie 0.05 mm lower; the external ones touch later: before that, four feet.
    inner = p.points.P[:, 2] == p.points.P[:, 2].min()
    K, C = p.points.K_N[inner].sum(), p.points.C_N[inner].sum()
    fall = np.sqrt(2 * 1e-3 / g)
    t = run.columns["t_s"]
    before = t < fall
    gap = run.columns["x_m"][:, 2] - p.start.x[2] + 1e-3
    assert np.allclose(gap[before], 1e-3 - g * t[before] ** 2 / 2, rtol=0, atol=1e-15)
    v = -g * fall
    omega, beta = np.sqrt(K / m), C / (2 * m)
    damped = np.sqrt(omega**2 - beta**2)
    rest = -m * g / K

    def sunk(s):
        a, b = -rest, (v + beta * -rest) / damped
        return rest + np.exp(-beta * s) * (a * np.cos(damped * s) + b * np.sin(damped * s))

    rows = (t > fall) & (sunk(t - fall) > -4e-5) & (t < fall + 0.5 * np.pi / damped)
    assert rows.sum() >= 1
    converged = run.columns["converged_x_m"][rows, 2] - p.start.x[2] + 1e-3
    # The converged run has a step of 1e-7 s, of second order but for the touch, which falls between two steps: g h t.
    assert np.allclose(converged, sunk(t[rows] - fall), rtol=0, atol=1e-9)


def test_a_black_box_is_told_where_it_parts_and_whom_it_resembles():
    class Box:
        def simulate(self, problem):
            return simulate(BY_ID["Z28"].backend().rules, problem)

    backend = Box()
    findings = judge(backend, ["L5s"])
    run = vectors.trajectory("window_spinning_0415ms")
    findings.runs = [judge_rows(run, vars(backend.simulate(run.problem)), "float64")]
    v = verdict(findings, backend)
    assert v.rule == "I3" and v.run.id == run.id
    assert "Z28" in [id_ for id_, _ in v.neighbours]
    text = terminal.text(v)
    assert "first divergent sample of window_spinning_0415ms" in text and "the event before it" in text
    assert "resembles Z28, rule I3" in text
    assert as_json(v)["neighbours"][0]["rule"] == "I3"


def test_where_no_short_run_diverges_that_is_said():
    findings = judge(load("numpy"), ["L5s"])
    findings.pieces = ()
    run = vectors.trajectory("window_table_3_1_0500ms")
    findings.runs = [judge_rows(run, Shifted("W", 60, 1e-6).out(run), "float64")]
    v = verdict(findings)
    text = terminal.text(v)
    assert v.status == "FAIL" and v.rule is None and "No short run diverges" in text
    assert f"first divergent sample of {run.id}: t = {v.run.first['t_s']:.6g} s" in text


def test_longer_steps_are_another_problem():
    run = vectors.trajectory("step_2e-5")
    base = vectors.trajectory("table_3_1")
    assert replace(run.problem, step=1e-5).step == base.problem.step
    first = run.columns["W_rad_s"][-1] - base.columns["W_rad_s"][-1]
    assert np.abs(first).max() > 1e-6, "the step matters, and the vectors show it"


def test_where_no_attitudes_are_shown_nothing_is_said_of_impacts():
    run = vectors.trajectory("table_3_1")
    judged = judge_rows(run, {"W": run.columns["W_rad_s"]}, "float64")
    assert judged.grade == "bitwise" and judged.impacts == [] and run.meta["impacts"]


def test_a_run_that_is_not_answered_fails_by_itself_and_the_judge_goes_on(monkeypatch):
    names = ("window_table_3_1_0500ms", "drop")
    monkeypatch.setattr(trajectories, "window_names", lambda: names[:1])
    monkeypatch.setattr(trajectories, "trajectory_names", lambda: names[1:])

    class DropsOnly:
        def simulate(self, problem):
            if problem.duration != vectors.trajectory("drop").problem.duration:
                raise RuntimeError("too long")
            return Shifted("W", 0, 0).out(vectors.trajectory("drop"))

    told = []
    found = judge(DropsOnly(), ["L5"], progress=lambda *a: told.append(a))
    assert [(r.id, r.grade, r.note) for r in found.runs] == [
        (names[0], "outside", "RuntimeError: too long"),
        (names[1], "bitwise", ""),
    ]
    assert told == [("L5", 0.5), ("L5", 1.0)]


def test_the_page_shows_where_a_run_parts():
    run = vectors.trajectory("window_table_3_1_0500ms")
    findings = judge(load("numpy"), ["L7"])
    findings.runs = [judge_rows(run, Shifted("W", row, 1e-6).out(run), "float64") for row in (60, 10**6)]
    page = page_of(verdict(findings))
    assert f"first outside: {run.columns['t_s'][60]:.5g} s" in page
    # The run that is right is left out where one is wrong.
    assert page.count("<svg") == page.count(f"<h3>{run.id}: outside") == 1


def test_a_verdict_on_an_impact_names_run_impact_instants_and_deviation():
    late = {"t_s": 0.51, "bar_s": 1e-10, "got_s": 0.510002, "bars": 2e4, "grade": "outside"}
    missing = {"t_s": 1.3, "bar_s": 1e-9, "got_s": None, "bars": np.inf, "grade": "outside"}
    right = {"t_s": 0.2, "bar_s": 1e-10, "got_s": 0.2, "bars": 0.0, "grade": "bitwise"}
    run = RunCheck("planar", "", "outside", worst=1.0, impacts=[right, late, missing])
    lines = impact_lines(run)
    assert len(lines) == 2 and "main impact 2 of planar" in lines[0] and "main impact 3" in lines[1]
    assert "expected at 0.51 s" in lines[0] and "2e-06 s late (2e+04 bars)" in lines[0] and "did not come" in lines[1]
    assert "main impact 2, 3 outside" in run_line(run)
