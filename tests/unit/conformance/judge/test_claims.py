"""Effects that a backend claims: vectors, engines, backends that claim some, and those that are wrong."""

import json
import sys

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.executable import Executable
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.load import load
from rockref.conformance.judge import claims
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import as_json, verdict
from rockref.conformance.reports import terminal
from rockref.effects.catalogue import EFFECTS
from rockref.engines import has_numba


def test_the_vectors_are_of_effects_of_the_catalogue_and_resolve_them():
    found = claims.claims()
    assert [c.effect for c in found][: len(EFFECTS)] == list(EFFECTS)
    assert [c.id for c in found] == [f"LE-{i:04d}" for i in range(1, len(found) + 1)]
    for claim in found:
        assert claim.resolving >= 100, claim.effect
        assert set(claim.parameters) == set(EFFECTS[claim.effect].quantities), claim.effect


#: What else is not typical in a second vector: what is typically none would not show otherwise.
SHOWN_BY = {"LE-0042": ["tau"]}


def test_parameters_are_the_typical_ones_and_a_second_vector_brings_what_is_typically_none():
    for claim in claims.claims():
        quantities, typical = EFFECTS[claim.effect].quantities, EFFECTS[claim.effect].typical().values()
        second = int(claim.id[3:]) > len(EFFECTS)
        changed = [k for k, v in claim.parameters.items() if v != typical[k]]
        assert not changed or second, claim.id
        there = [k for k in changed if typical[k] not in (0, quantities[k].absent)]
        assert there == SHOWN_BY.get(claim.id, []), claim.id


@pytest.mark.parametrize("name", ["numpy", pytest.param("numba", marks=pytest.mark.skipif(not has_numba(), reason=""))])
def test_the_engines_have_all_effects(name):
    checks = claims.judge_claims(load(name))
    assert [f"{c.effect}: {c.worst:.3g} bars {c.note}" for c in checks if c.failed] == []
    assert len(checks) >= 20


class Some(NumpyEngine):
    """Claims drag alone; says that it has it, and leaves it out where told so."""

    def __init__(self, right):
        super().__init__()
        self.right = right

    def effect(self, problem, effect, parameters):
        if effect != "quadratic_drag":
            return None
        return super().effect(problem, effect, parameters) if self.right else self.simulate(problem)


def test_only_what_is_claimed_is_judged():
    v = verdict(judge(Some(right=True), ["LE"]))
    graded = {e.effect: e.grade for e in v.findings.effects}
    assert v.passed and graded["quadratic_drag"] in ("bitwise", "inside") and graded["adhesion"] == "not shown"


def test_a_false_claim_is_named():
    v = verdict(judge(Some(right=False), ["LE"]))
    assert v.status == "FAIL" and v.rule is None
    assert [e.effect for e in v.findings.effects if e.failed] == ["quadratic_drag"]
    assert "quadratic_drag" in terminal.text(v)
    json.dumps(as_json(v), allow_nan=False)


def test_a_backend_without_effects_claims_none():
    findings = judge(load("scheme"), ["LE"])
    assert findings.effects == [] and verdict(findings).status == "NOTHING JUDGED"


def test_programs_claim_effects_too(tmp_path):
    path = tmp_path / "law.py"
    path.write_text(
        "from rockref.conformance.backends.json_lines import serve\n"
        "from rockref.conformance.backends.law import NumpyEngine\n"
        "class Law(NumpyEngine):\n"
        "    def effect(self, problem, effect, parameters):\n"
        "        return super().effect(problem, effect, parameters) if effect == 'adhesion' else None\n"
        "serve(Law())\n"
    )
    backend = Executable([sys.executable, str(path)], small=120.0)  # scipy is loaded at the first filter
    checks = claims.judge_claims(backend)
    backend.close()
    inside = [c.effect for c in checks if c.grade in ("bitwise", "inside")]
    assert "adhesion" in inside and "gyro_scale" in inside
    assert not [c for c in checks if c.failed]


def test_bars_are_rounding_not_physics():
    for claim in claims.claims():
        for name, (value, bar) in claim.expect.items():
            assert bar.max() <= 1e-8 * max(np.abs(value).max(), 1e-3), (claim.effect, name)
    assert vectors.manifest()["files"]["LE.json"]["bytes"] < 1e6


def test_of_a_run_with_an_effect_only_the_rates_are_indispensable():
    claim = next(c for c in claims.claims() if c.effect == "quadratic_drag")
    right = {name: value for name, (value, _) in claim.expect.items()}
    assert set(right) == {"W", "x", "Lambda"}
    assert claims.compare(claim.effect, claim.expect, {"W": right["W"]}).grade == "bitwise"
    for answer, said in (({"x": right["x"]}, "W has shape None"), ({"W": right["W"][:-1]}, "W has shape")):
        check = claims.compare(claim.effect, claim.expect, answer)
        assert check.failed and said in check.note and f"not {right['W'].shape}" in check.note
