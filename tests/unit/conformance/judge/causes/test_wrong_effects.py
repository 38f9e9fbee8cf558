"""A wrong claim of an effect is named: left out, a sign, a ratio the other way round, a point that is missing."""

import sys
from dataclasses import replace

import numpy as np
import pytest

from golden.generator.bounds.arithmetic import Doubles
from golden.generator.questions.drawing import DELTA_DIAG, DELTA_LONG, DEPTH, HEIGHT, MASS, TABLE, WIDTH
from golden.independent import exact
from rockref.conformance.backends.executable import Executable
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import claims
from rockref.conformance.judge.causes.wrong_effects import without_point
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.reports import terminal
from rockref.conformance.vectors.claim import with_effect, with_new_points
from rockref.effects import catalogue
from rockref.model.problem import State


def of(effect):
    return next(c for c in claims.claims() if c.effect == effect)


class Mistaken(NumpyEngine):
    """A backend that claims one effect, and makes a mistake in it."""

    def __init__(self, effect, drop=None, **changed):
        super().__init__()
        self.claimed, self.drop, self.changed = effect, drop, changed

    def effect(self, problem, effect, parameters):
        if effect != self.claimed:
            return None
        kind = catalogue.find(effect)
        problem = with_effect(problem, kind(**parameters | self.changed))
        if self.drop is not None:
            problem = without_point(problem, problem.points.names.index(self.drop))
        return self.simulate(problem)

    def sensor(self, effect, parameters, t, crv_deg_s):
        return None if effect != self.claimed else super().sensor(effect, parameters | self.changed, t, crv_deg_s)


def said(backend):
    v = verdict(judge(backend, ["LE"]))
    assert v.status == "FAIL" and {e.effect for e in v.findings.effects if e.failed} == {backend.claimed}
    return next(line for line in terminal.text(v).splitlines() if line.strip().startswith(f"{backend.claimed}:"))


def test_eight_points_made_of_four_are_the_eight_points_of_the_source():
    """A second route to the vector: the plain law on the points of Table 3.1, made without the effect."""
    claim = of("foot_defects")
    problem = claims.problem_of(claim.inputs)
    assert problem.points.n == 4
    P = np.array(exact.contact_points(WIDTH, DEPTH, HEIGHT, list(DELTA_LONG), DELTA_DIAG, Doubles))
    made = {k: np.array(v) for k, v in exact.properties(MASS, **TABLE, m=Doubles).items()}
    names = tuple(f"{i}{kind}" for kind in ("ext", "int") for i in "1234")
    s = problem.start
    eight = replace(
        problem,
        points=replace(problem.points, P=P, **made, names=names),
        start=State.at_rest(s.x, s.Lambda, 8, s.v, s.W),
    )
    check = claims.compare(claim.effect, claim.expect, vars(NumpyEngine().simulate(eight)))
    assert check.grade in ("bitwise", "inside"), check


def test_old_points_keep_what_they_remember_and_new_ones_have_touched_nothing():
    start = claims.problem_of(of("foot_defects").inputs).start
    held = replace(start, s=start.s + 0.25, anchored=np.array([True, False, True, True]), F=np.ones((4, 3)))
    eight = with_new_points(held, 8)
    assert np.array_equal(eight.s[:4], held.s) and np.all(eight.s[4:] == 0)
    assert eight.anchored.tolist() == [True, False, True, True] + 4 * [False] and eight.F is None
    assert with_new_points(held, 4) is held


TYPICAL = of("foot_defects").parameters


@pytest.mark.parametrize("foot", [1, 2, 3, 4])
def test_a_wrong_sign_of_one_foot_is_named(foot):
    name = f"delta_long{foot}"
    line = said(Mistaken("foot_defects", **{name: -TYPICAL[name]}))
    assert f"as if {name} were of the other sign" in line and "bars off" in line


def test_a_sign_that_is_wrong_of_all_feet_is_named():
    wrong = {name: -value for name, value in TYPICAL.items() if name.startswith("delta_long")}
    assert "as if delta_long1 to delta_long4 were of the other sign" in said(Mistaken("foot_defects", **wrong))


@pytest.mark.parametrize("name", [f"{i}{kind}" for kind in ("ext", "int") for i in "1234"])
def test_a_missing_point_is_named(name):
    assert f"as if point {name} were missing" in said(Mistaken("foot_defects", drop=name))


def test_a_ratio_the_other_way_round_is_named():
    wrong = said(Mistaken("foot_defects", mu_int=1 / TYPICAL["mu_int"]))
    assert "as if mu_int were the other way round" in wrong


def test_what_is_left_out_is_named():
    assert "as if it were left out" in said(Mistaken("quadratic_drag", c=0.0, c_v=0.0))
    assert "as if c_v were left out" in said(Mistaken("quadratic_drag", c_v=0.0))
    assert "as if z were of the other sign" in said(Mistaken("gyro_misalignment", z=0.03))


@pytest.mark.parametrize(
    ("effect", "left_out"),
    [
        ("uneven_foot_stiffness", "foot1"),
        ("uneven_foot_stiffness", "tangential_share"),
        ("uneven_foot_damping", "normal_share"),
        ("lingering_wire_pull", "evenness"),
        ("uneven_foot_damping", "foot2"),
        ("uneven_foot_friction", "foot3"),
        ("uneven_contact_normals", "y1"),
        ("uneven_contact_normals", "turning_share"),
        ("spin_friction", "sliding_share"),
        ("hysteretic_contact", "curved_share"),
        ("gyro_saturation", "softness"),
        ("compliant_support", "pitch"),
        ("rounded_feet", "foot3"),
        ("inertia_deviation", "xz"),
        ("gyro_misalignment", "yz"),
        ("gyro_bandwidth", "delay"),
        ("base_vibration", "direction"),
        ("base_vibration", "harmonic_cosine"),
        ("base_vibration", "harmonic_sine"),
        ("cable_restraint", "height"),
        ("cable_restraint", "stiffening"),
        ("foot_defects", "diag3"),
        ("clock_error", "growth"),
    ],
)
def test_a_parameter_that_does_not_show_at_the_typical_size_is_looked_for_in_a_second_vector(effect, left_out):
    absent = catalogue.find(effect).quantities[left_out].absent
    backend = Mistaken(effect, **{left_out: absent})
    v = verdict(judge(backend, ["LE"]))
    failed = [e.vector for e in v.findings.effects if e.failed]
    assert failed and min(failed) > "LE-0031"
    if absent is not None:
        assert f"as if {left_out} were left out" in said(backend)


def test_a_mistake_that_nobody_knows_has_no_name():
    line = said(Mistaken("foot_defects", delta_diag=0.5 * TYPICAL["delta_diag"]))
    assert "bars" in line and "as if" not in line


def test_a_program_is_asked_for_the_eight_points_too(tmp_path):
    """A black box gets the four corners, the parameters by name, and no hint of ours beside them."""
    path = tmp_path / "box.py"
    path.write_text(
        "from rockref.conformance.backends.json_lines import serve\n"
        "from rockref.conformance.backends.law import NumpyEngine\n"
        "class Box:\n"
        "    def simulate(self, problem):\n"
        "        return NumpyEngine().simulate(problem)\n"
        "    def effect(self, problem, effect, parameters):\n"
        "        if effect != 'foot_defects':\n"
        "            return None\n"
        "        wrong = {k: -v if k == 'delta_long2' else v for k, v in parameters.items()}\n"
        "        return NumpyEngine().effect(problem, effect, wrong)\n"
        "serve(Box())\n"
    )
    backend = Executable([sys.executable, str(path)], small=120.0)
    checks = [c for c in claims.judge_claims(backend) if c.grade != "not shown"]
    backend.close()
    assert [c.effect for c in checks] == ["foot_defects"] * 2
    assert "as if delta_long2 were of the other sign" in checks[0].note


def test_of_a_record_that_no_known_mistake_gives_nothing_is_said():
    claim = of("gyro_scale")
    assert claim.piece == "sensor"
    noise = np.random.default_rng(0).normal(size=claim.expect["crv_deg_s"][0].shape)
    check = claims.explained(claim, {"crv_deg_s": noise})
    assert check.failed and check.note == ""
