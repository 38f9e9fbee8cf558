"""The arithmetic probes tell IEEE arithmetic from its usual replacements."""

import importlib.util
import json
from fractions import Fraction

import numpy as np
import pytest

from rockref.engines import machine

SOUND = {
    "rounds_half_to_even": True,
    "numpy_fuses": False,
    "numpy_dot_fuses": True,
    "numpy_flushes_subnormals": False,
    "numba_fuses": None,
    "numba_flushes_subnormals": None,
}


def test_probe_separates_fused_from_plain():
    a, b, c = machine._A, machine._B, machine._C
    fused = float(Fraction(a) * Fraction(b) + Fraction(c))
    assert a * b + c == 0.0
    assert fused == -(2.0**-54)


def test_this_machine_is_described():
    facts = machine.describe()
    assert facts["numpy"] == np.__version__
    assert facts["byte_order"] in ("little", "big")
    # 53 bits where longdouble is double, 64 on x87, 106 or 113 elsewhere.
    assert facts["longdouble_mantissa_bits"] in (53, 64, 106, 107, 113)
    assert json.loads(json.dumps(facts)) == facts


def test_this_machine_is_sound():
    findings = machine.check_arithmetic()
    assert findings["rounds_half_to_even"] is True
    assert machine.is_sound(findings)


def test_flushing_is_seen():
    tiny = np.finfo(np.float64).tiny

    def halve_and_flush(x):
        y = x * 0.5
        return np.where(np.abs(y) < tiny, 0.0, y)

    assert machine._flushes(halve_and_flush)
    assert not machine._flushes(machine._halve)


@pytest.mark.parametrize(
    "fault", ["numpy_fuses", "numpy_flushes_subnormals", "numba_fuses", "numba_flushes_subnormals"]
)
def test_each_fault_is_unsound(fault):
    assert machine.is_sound(SOUND)
    assert not machine.is_sound(SOUND | {fault: True})


def test_other_rounding_is_unsound():
    assert not machine.is_sound(SOUND | {"rounds_half_to_even": False})


def test_without_numba_nothing_is_said_of_it_and_the_machine_is_sound(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    findings = machine.check_arithmetic()
    assert findings["numba_fuses"] is findings["numba_flushes_subnormals"] is None and machine.is_sound(findings)


def plain(left, right):
    """A dot product of products and sums that are each rounded."""
    return sum(a * b for a, b in zip(left.tolist(), right.tolist(), strict=True))


def fused(left, right):
    """A dot product whose every product and sum is rounded once."""
    total = 0.0
    for a, b in zip(left.tolist(), right.tolist(), strict=True):
        total = float(Fraction(a) * Fraction(b) + Fraction(total))
    return total


@pytest.mark.parametrize("dot, fuses", [(plain, False), (fused, True)])
def test_a_fusing_dot_product_is_told_from_a_plain_one(monkeypatch, dot, fuses):
    monkeypatch.setattr(np, "dot", dot)
    assert machine._dot_fuses() is fuses
