"""The judge: who is right passes, who is wrong is named, who misbehaves is told so."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rockref import cli
from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.load import load
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge.claims import ClaimCheck
from rockref.conformance.judge.compare_answer import compare, grade_of
from rockref.conformance.judge.findings import LAYERS, Findings, judge
from rockref.conformance.judge.properties import PropertyCheck
from rockref.conformance.judge.trajectories import RunCheck
from rockref.conformance.judge.verdict import LOOP, UNASKED, as_json, verdict
from rockref.conformance.reports import terminal
from rockref.conformance.reports.junit import junit
from rockref.conformance.reports.page import badge
from rockref.conformance.reports.page import page as page_of
from rockref.model.errors import InputError

EXAMPLE = Path(__file__).resolve().parents[4] / "examples/backend_numpy.py"
PIECES = ("L0", "L1", "L2", "L3", "L7")
QUICK = (*PIECES, "L4", "L5s")

# Some planted mistakes divide by zero: that is the mistake, and the judge has to live with it.
pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning:planted")


def judged(backend, layers=QUICK, profile="float64"):
    return verdict(judge(backend, layers, profile), backend)


class Only:
    """The pieces of another backend that are named, and its runs."""

    def __init__(self, other, *pieces):
        self.simulate = other.simulate
        for piece in pieces:
            setattr(self, piece, getattr(other, piece))


@pytest.mark.parametrize("target", ["numpy", "longdouble", f"{EXAMPLE}:Backend"])
def test_correct_backends_pass(target):
    v = judged(load(target))
    assert v.passed, terminal.text(v)
    assert v.findings.checks and all(c.grade in ("bitwise", "inside", "not shown") for c in v.findings.checks)


def test_single_precision_passes_its_own_profile_only():
    backend = load("float32")
    assert not judged(backend, PIECES).passed
    v = judged(backend, QUICK, "float32")
    assert v.passed, terminal.text(v)


def test_another_integrator_passes_as_another_scheme_only():
    backend = load("scheme")
    assert not judged(backend).passed
    assert judged(backend, QUICK, "scheme").passed


@pytest.mark.parametrize(
    "worst, grade", [(0, "bitwise"), (1, "inside"), (1.01, "look"), (10, "look"), (10.1, "outside")]
)
def test_grades(worst, grade):
    assert grade_of(worst) == grade


def planted(old, new):
    """The tutorial backend with one line changed."""
    text = EXAMPLE.read_text()
    assert text.count(old) == 1, old
    space = {"__name__": "planted"}
    exec(compile(text.replace(old, new), "planted.py", "exec"), space)
    return space["Backend"]()


@pytest.mark.parametrize(
    "rule, old, new",
    [
        ("G1", "np.diag([depth**2 + height**2, width**2 + height**2, width**2 + depth**2])",
         "np.diag([width**2 + height**2, depth**2 + height**2, width**2 + depth**2])"),
        ("G2", "inwards = 1 - delta_diag / (np.hypot(width, depth) / 2)", "inwards = 1 - delta_diag / (width / 2)"),
        ("P2", "return 2 * beta * np.sqrt(K * mass)", "return 2 * beta * K * mass"),
        ("K1", "rate = v + np.cross(Lambda @ W, r)", "rate = v + np.cross(W, r)"),
        ("N1", "return max(K_N * xi + C_N * xi_rate, 0.0)", "return max(K_N * xi, 0.0) + max(C_N * xi_rate, 0.0)"),
        ("N2", " if xi >= 0 else 0.0", ""),
        ("T5", "return s if anchored and xi >= 0 else u_t", "return s"),
        ("T1", "return -K_T * (u_t - s) - C_T * v_slide", "return -K_T * (u_t - s)"),
        # On the cone itself both sides are right; at its tip this divides nothing by nothing.
        ("T3", "return np.hypot(*F_trial) <= limit", "return np.hypot(*F_trial) < limit"),
        ("T2", "return np.hypot(*F_trial) <= limit", "return max(abs(F_trial)) <= limit"),
        ("T6", "return (mu if was_sliding else mu_0) * F_N", "return mu_0 * F_N"),
        ("T6", "return (mu if was_sliding else mu_0) * F_N", "return 1.1 * (mu if was_sliding else mu_0) * F_N"),
        ("T3", "return mu * F_N / np.hypot(*F_trial) * F_trial", "return np.clip(F_trial, -mu * F_N, mu * F_N)"),
        ("T4", "return u_t + (F_T + C_T * v_slide) / K_T", "return u_t + F_T / K_T"),
        ("A1", "force = F.sum(axis=0) - [0, 0, mass * g]", "force = F.sum(axis=0) - Lambda @ [0, 0, mass * g]"),
        ("A2", "moment = np.cross(r, F).sum(axis=0)", "moment = np.cross(F, r).sum(axis=0)"),
        ("A3", "return force, moment, Lambda.T @ moment", "return force, moment, moment"),
        ("I1", "x_next = x + h * v + h * h / 2 * a", "x_next = x + h * v"),
        ("I2", "T - np.cross(W, J @ W)", "T"),
        ("I2", "Theta = h * W + h * h / 2 * A", "Theta = h * W"),
        ("I3", "Lambda_next = Lambda + Lambda @ E", "Lambda_next = Lambda + E @ Lambda"),
        ("I3", "+ 2 * (np.sin(angle / 2) / angle) ** 2 * H @ H", ""),
        ("S1", "Lambda_next, v + h * a, W + h * A, E", "Lambda_next, v, W, E"),
        ("I4", "v_next = v + h / 2 * (a + a_next)", "v_next = v + h * a"),
        ("I5", "gain = h / 2 * T + E.T @ half", "gain = h / 2 * T + E @ half"),
        (
            "S2",
            'if state["a"] is None:',
            'if state["a"] is None and state.update(a=np.zeros(3), T=np.zeros(3), F=0 * problem.points.P):',
        ),
        ("S2", "if count == wanted[len(kept)]:", "if count == wanted[len(kept)] or not kept:"),
        ("M1", '{"crv_deg_s": np.degrees(W)}', '{"crv_deg_s": W}'),
    ],
)  # fmt: skip
def test_a_planted_mistake_is_named(rule, old, new):
    if rule == "S2" and "not kept" in new:
        new = "if count == max(wanted[len(kept)] - 1, 0):"
    backend = planted(old, new)
    v = judged(backend, (*PIECES, "L4"))
    if v.passed:
        v = judged(backend)
    assert v.rule == rule, terminal.text(v)
    told = as_json(v)
    assert told["verdict"] == "FAIL" and told["rule"] == rule
    assert told["first_divergence"]["vector"] == v.check.vector


def test_the_sentence_has_rule_equation_vector_and_numbers():
    v = judged(planted("return max(K_N * xi + C_N * xi_rate, 0.0)", "return K_N * xi + C_N * xi_rate"), PIECES)
    text = terminal.text(v)
    assert "FIRST DIVERGENCE  rule N1" in text and "(3.5a)" in text and "L1-N1-" in text
    assert "expected 0 +-" in text and "would-be tension" in text
    assert text.rstrip().endswith("FAIL (N1)")
    assert "\x1b[" not in text and "\x1b[31m" in terminal.text(v, colour=True)


def test_without_pieces_the_short_runs_tell_the_rule():
    wrong = planted("return max(K_N * xi + C_N * xi_rate, 0.0)", "return max(K_N * xi - C_N * xi_rate, 0.0)")
    v = verdict(judge(Only(wrong), QUICK))
    assert v.rule == "N1"
    wrong = planted("Lambda_next = Lambda + Lambda @ E", "Lambda_next = Lambda + E @ Lambda")
    assert verdict(judge(Only(wrong), QUICK)).rule == "I3"


class FourFeet:
    """Right, but for blocks on four points: no short run is asked on those."""

    def simulate(self, problem):
        out = vars(NumpyEngine().simulate(problem))
        shown = {k: np.array(out[k]) for k in ("t", "W", "x", "Lambda")}
        shown["W"][1:] += 1e-9 * (problem.points.n == 4)
        return shown


def test_whole_steps_are_put_to_who_shows_runs_only():
    v = judged(FourFeet())
    assert v.rule == "I5" and v.check.vector.endswith("-run") and "four_points" in terminal.text(v)
    assert "no short run tells by which rule" in v.says
    steps = [c for c in v.findings.checks if c.layer == "L4"]
    assert len({c.vector for c in steps}) == len(vectors.layer("L4"))
    assert judged(Only(NumpyEngine())).passed


def test_who_shows_steps_is_asked_for_steps():
    checks = judge(Only(NumpyEngine(), "step"), ["L4"]).checks
    assert checks and not [c for c in checks if c.vector.endswith("-run")]


def test_what_runs_cannot_tell_apart_is_said():
    wrong = planted("return max(K_N * xi + C_N * xi_rate, 0.0)", "return max(K_N * xi - C_N * xi_rate, 0.0)")
    v = verdict(judge(Only(wrong), QUICK))
    assert as_json(v)["alike"] == ["K1", "P1", "P2"] and "runs cannot tell it from K1" in terminal.text(v)
    assert as_json(judged(Only(wrong, "kinematics", "contact_law")))["alike"] == []


def test_a_pass_says_what_was_not_asked():
    def passed(without, target="numpy", profile="float64"):
        """The verdict of who answered the first layer and, as it is told, all but some."""
        found = judge(load(target), ["L0"], profile)
        found.layers = tuple(n for n in LAYERS if n not in without)
        return verdict(found)

    quick = passed(("L5", "L6"))
    assert terminal.text(quick).endswith("PASS (quick: long runs and properties were not asked)\n")
    assert "conforms (quick)" in badge(quick)
    assert terminal.text(passed(("L5", "L7"), "float32", "float32")).endswith("PASS (float32; not asked: L5 L7)\n")
    assert terminal.text(passed(())).endswith("\nPASS\n")


def test_a_wrong_run_of_right_pieces_is_the_loop():
    right, late = NumpyEngine(), NumpyEngine()
    late.simulate = lambda problem: right.simulate(
        replace(problem, start=replace(problem.start, v=problem.start.v * 1.001))
    )
    v = judged(late)
    assert v.rule == "S2" and "All pieces pass" in v.says


def with_a_wrong_run(layers):
    """The verdict on the law asked in some layers, with a run that is outside."""
    pieces, run = ("step", "contact_law", "assemble"), RunCheck("run-0001", "a run", "outside", 30.0)
    return verdict(Findings({}, "float64", layers, runs=[run], pieces=pieces))


@pytest.mark.parametrize("layers", [("L5",), ("L0", "L5"), ("L1", "L2", "L5"), ("L1", "L4", "L5"), ("L5s", "L5")])
def test_where_not_all_pieces_were_asked_it_is_not_said_that_they_pass(layers):
    v = with_a_wrong_run(layers)
    assert v.status == "FAIL" and v.rule is None and v.says == UNASKED


def test_where_all_pieces_were_asked_the_run_that_is_made_of_them_is_wrong():
    v = with_a_wrong_run(("L1", "L2", "L4", "L5"))
    assert v.rule == "S2" and v.says == LOOP


@pytest.mark.parametrize("layers", [["L5s"], ["L0", "L5s"], ["L0", "L2", "L3", "L4", "L5s", "L7"], ["L4"]])
def test_a_wrong_cone_is_not_called_the_loop_where_the_contact_law_was_not_asked(layers):
    box = planted("mu * F_N / np.hypot(*F_trial) * F_trial", "np.clip(F_trial, -mu * F_N, mu * F_N)")
    v = verdict(judge(box, layers))
    assert v.status == "FAIL" and v.rule == "T3" and LOOP not in v.says


class Broken:
    """Answers that no one can use."""

    def __init__(self, answer):
        self.answer = answer

    def simulate(self, problem):
        return self.answer(problem)


def test_a_rule_that_its_piece_shows_right_is_not_blamed_for_the_runs():
    """The first wrong result of the runs is a normal force; the contact law was asked by itself and is right."""
    v = verdict(judge(Only(BY_ID["Z04"].backend(), "contact_law"), ["L1", "L5s"]))
    wrong = [c.rule for c in v.findings.failures if c.layer == "L5s"]
    assert v.rule == BY_ID["Z04"].rule == "K1" and "N1" in wrong and v.rules["N1"] != "pass"


@pytest.mark.parametrize(
    "answer, said",
    [
        (lambda p: 1 / 0, "ZeroDivisionError"),
        (
            lambda p: {"W": np.full((2, 3), np.nan), "x": np.full((2, 3), np.nan), "Lambda": None, "F": None},
            "not a finite",
        ),
        (lambda p: {"W": "soon"}, ""),
        (lambda p: None, ""),
        (lambda p: {"W": np.zeros((7, 2))}, "W has shape (7, 2), not"),
        (lambda p: {"W": [[1, 2], [3]]}, "rows of different lengths"),
        (lambda p: vars(NumpyEngine().simulate(p)) | {"t": [0.0]}, "t has shape (1,), not"),
        (lambda p: vars(NumpyEngine().simulate(p)) | {"t": "soon"}, "t holds no numbers"),
        (lambda p: sys.exit(3), "SystemExit: 3"),
    ],
)
def test_unusable_answers_are_failures_not_errors(answer, said):
    v = verdict(judge(Broken(answer), ["L5s"]))
    assert not v.passed
    assert any(said in c.note for c in v.findings.failures)
    json.dumps(as_json(v), allow_nan=False)


def turned(law, key):
    """A backend whose rows lie along the last axis."""

    def simulate(problem):
        out = vars(law.simulate(problem))
        return {k: out[k] for k in ("W", "x", "Lambda")} | {key: np.moveaxis(out[key], 0, -1)}

    return Broken(simulate)


@pytest.mark.parametrize("key", ["W", "x", "Lambda"])
def test_rows_of_another_shape_speak_of_no_rule(key):
    v = verdict(judge(turned(NumpyEngine(), key), ["L5s"]))
    assert v.rule is None and f"{key} has shape" in v.check.note and "speaks of no rule" in v.says
    # Of three rows the places have the right shape by chance.
    assert set(v.rules.values()) <= {"no answer", "not shown", "pass", "fail"}
    assert v.rules["S2"] == ("fail" if key == "x" else "no answer")


def test_too_few_rows_are_the_fault_of_the_run():
    law = NumpyEngine()
    v = verdict(judge(Broken(lambda p: {k: vars(law.simulate(p))[k][:-1] for k in ("W", "x", "Lambda")}), QUICK))
    assert v.rule == "S2" and "rows, not" in v.check.note
    json.dumps(as_json(v), allow_nan=False)


def ended(words):
    """The exit code of a command."""
    with pytest.raises(SystemExit) as end:
        cli.main(words)
    return end.value.code


def test_a_backend_that_asks_to_end_the_program_has_failed(tmp_path, capsys):
    path = tmp_path / "exits.py"
    path.write_text("import sys\nclass Backend:\n    def simulate(self, problem):\n        sys.exit(0)\n")
    assert ended(["conform", f"{path}:Backend", "--layers", "L5s,L6"]) == 1
    assert "SystemExit" in capsys.readouterr().out
    path.write_text("import sys\nsys.exit(0)\n")
    assert ended(["conform", f"{path}:Backend", "--quick"]) == 2
    assert "SystemExit" in capsys.readouterr().err


def test_a_backend_without_simulate_is_refused():
    with pytest.raises(InputError, match="E-BACKEND"):
        judge(object())
    with pytest.raises(InputError, match="E-LAYER"):
        judge(NumpyEngine(), ["L9"])
    with pytest.raises(InputError, match="E-PROFILE"):
        judge(NumpyEngine(), ["L0"], profile="float16")


def test_results_that_a_piece_does_not_give_are_not_shown():
    vector = next(v for v in vectors.layer("L1") if v.rule == "T4")
    checks = compare(vector, {"F_N": 1.0})
    assert {c.grade for c in checks} == {"not shown"}


@pytest.mark.parametrize(
    "F_T, said",
    [(np.zeros(3), "has shape (3,), not (2,)"), (np.array(["a", "b"]), "is no number"), ([[1], [2, 3]], "unusable")],
    ids=["three", "words", "ragged"],
)
def test_a_result_of_another_form_is_outside_and_speaks_of_no_rule(F_T, said):
    vector = next(v for v in vectors.layer("L1") if "F_T" in v.expect)
    (check,) = [c for c in compare(vector, {"F_T": F_T}) if c.name == "F_T"]
    assert check.failed and not check.weighed and said in check.note


def test_a_wrong_decision_takes_the_blame_for_the_force():
    vector = next(v for v in vectors.layer("L1") if "just outside" in v.flags)
    stuck = {"sliding": False, "touching": True, "F_T": np.zeros(2), "s": np.zeros(2)}
    checks = {c.name: c for c in compare(vector, stuck)}
    assert checks["sliding"].failed and not checks["sliding"].follows
    assert checks["F_T"].failed and checks["F_T"].follows


def test_junit_badge_and_page():
    from xml.etree import ElementTree

    v = judged(planted("return -K_T * (u_t - s) - C_T * v_slide", "return -K_T * (u_t - s)"), ("L1", "L2"))
    root = ElementTree.fromstring(junit(v))
    suites = {s.get("name"): s for s in root}
    assert set(suites) == {"L1", "L2"} and int(suites["L1"].get("failures")) > 0 == int(suites["L2"].get("failures"))
    assert ElementTree.fromstring(badge(v)).tag.endswith("svg") and "fails T1" in badge(v)
    page = page_of(v)
    # The rule that is wrong stands at the head, with what was expected and got, and its text in the law.
    assert '<section class="card" id="rule-T1">' in page and "<dt>Got</dt>" in page and "def trial_force(" in page
    assert 'href="#law-T1"' in page and 'id="law-T1"' in page
    assert "FIRST DIVERGENCE" in page and "<script" not in page and "http" not in page.replace("http://www.w3.org", "")


def test_junit_lists_properties_and_effects():
    from xml.etree import ElementTree

    findings = judge(NumpyEngine(), ["L2"])
    findings.properties = [PropertyCheck("no tension", True), PropertyCheck("a cone", False, "|F_T| = 2")]
    findings.effects = [ClaimCheck("quadratic_drag", "inside", 0.5), ClaimCheck("plate_tilt", "outside", 55.0)]
    v = verdict(findings)
    assert v.status == "FAIL"
    suites = {s.get("name"): s for s in ElementTree.fromstring(junit(v))}
    assert {k: (s.get("tests"), s.get("failures")) for k, s in suites.items() if k != "L2"} == {
        "L6": ("2", "1"),
        "LE": ("2", "1"),
    }
    assert [f.get("message") for k in ("L6", "LE") for f in suites[k].iter("failure")] == ["|F_T| = 2", "55 bars"]


def test_targets_that_are_no_backend_are_named():
    for target in ("nonsense", "no_such_module:Backend", "missing.py:Backend", f"{EXAMPLE}:Nobody"):
        with pytest.raises(InputError, match="E-BACKEND"):
            load(target)


def test_a_file_that_cannot_be_run_is_named(tmp_path):
    path = tmp_path / "bad.py"
    path.write_text("def f(:\n")
    with pytest.raises(InputError, match="SyntaxError"):
        load(f"{path}:Backend")
