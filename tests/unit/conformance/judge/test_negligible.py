"""What is too small to be physical is a remark, and no verdict; what is larger is one."""

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends.law import NumpyEngine, RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.faults.controls import CONTROLS, along_an_angle, by_squares
from rockref.conformance.judge.compare_answer import compare, weighed_in_bars
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.negligible import FORCE, LENGTH, same_force, size_and_unit
from rockref.conformance.judge.verdict import as_json, verdict
from rockref.conformance.reports import terminal


def test_sizes_belong_to_quantities_and_not_to_runs_of_a_few_steps():
    assert size_and_unit("trace.F_trial") == (FORCE, "N") and size_and_unit("x@3") == (LENGTH, "m")
    assert size_and_unit("F_T@0", "L5s") == (FORCE, "N") and size_and_unit("x@1", "L5s")[0] == 0.0
    assert size_and_unit("K_N") == (0.0, ""), "a stiffness has a relative bar alone"


@pytest.mark.parametrize("off, grade", [(0.9e-9, "negligible"), (1.1e-9, "outside")])
def test_a_force_is_weighed_by_a_nanonewton(off, grade):
    vector = next(v for v in vectors.layer("L1") if "F_N" in v.expect and v.expect["F_N"].value > 1)
    out = NumpyEngine().contact_law(**vector.inputs)
    found = {c.name: c for c in compare(vector, out | {"F_N": out["F_N"] + off})}
    assert found["F_N"].grade == grade
    assert ("differs by" in found["F_N"].note) == (grade == "negligible")


def test_what_is_no_number_is_never_negligible():
    ratio, small = weighed_in_bars(np.array([np.nan, 1e-13]), np.zeros(2), np.full(2, 1e-16), LENGTH)
    assert ratio[0] == np.inf and not small[0] and small[1]


def test_on_the_cone_both_decisions_are_right_and_a_micronewton_off_it_one_alone():
    foot = {"K_N": 2.0**26, "C_N": 0.0, "K_T": 2.0**26, "C_T": 0.0, "mu_0": 0.5, "mu": 0.5, "xi_rate": 0.0}
    q = foot | {"xi": 5 * 2.0**-19, "u_t": np.zeros(2), "v_slide": np.zeros(2), "anchored": True, "sliding": False}
    on = np.array([3.0, 4.0]) * 2.0**-20
    assert same_force(q | {"s": on}) and not same_force(q | {"s": on * (1 + 1e-8)})


@pytest.mark.parametrize("changes", [{"size": by_squares}, {"friction": along_an_angle}])
def test_a_length_by_squares_and_a_direction_by_its_angle_pass(changes):
    v = verdict(judge(RulesBackend(law().replace(**changes)), ["L1", "L4", "L5s"]))
    assert v.passed, terminal.text(v)


def test_a_sum_in_an_order_that_is_drawn_anew_passes_with_a_remark():
    control = next(c for c in CONTROLS if "drawn anew" in c.says)
    v = verdict(judge(control.backend(), ["L2", "L6"], examples=3))
    assert v.passed, terminal.text(v)
    assert any("differ in their bits" in r for r in as_json(v)["remarks"])


def test_a_pass_with_negligible_differences_says_how_many():
    class Shaken(NumpyEngine):
        def contact_law(self, **q):
            out = super().contact_law(**q)
            return out | {"F_N": out["F_N"] + 1e-10 * bool(out["touching"])}

    v = verdict(judge(Shaken(), ["L1"]))
    assert v.passed and "less than 1 nN" in terminal.text(v)
    assert v.rules["N1"] == "look"


@pytest.mark.parametrize("off, passed", [(1e-17, True), (1e-9, False)])
def test_products_of_inertia_that_are_sums_need_not_cancel_to_nothing(off, passed):
    class Summed(NumpyEngine):
        def derived(self, **q):
            out = super().derived(**q)
            return out | {"inertia": out["inertia"] + off * (1 - np.eye(3))}

    assert verdict(judge(Summed(), ["L0"])).passed == passed
