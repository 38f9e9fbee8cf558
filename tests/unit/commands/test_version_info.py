"""`rockref doctor` prints what the machine module found, and its exit code follows the finding."""

import json

import pytest

from rockref.engines import machine
from tests import command


def run(capsys, *arguments):
    return command.run(capsys, "doctor", *arguments)[:2]


@pytest.fixture
def quick(monkeypatch):
    """Findings of a sound machine without numba, so that nothing is compiled."""
    findings = {"rounds_half_to_even": True, "numpy_fuses": False, "numpy_flushes_subnormals": False}
    findings |= {"numba_fuses": None, "numba_flushes_subnormals": None, "numpy_dot_fuses": True}
    monkeypatch.setattr(machine, "check_arithmetic", lambda: findings)
    return findings


def test_lines(capsys, quick):
    code, out = run(capsys)
    values = dict(line.split(None, 1) for line in out.splitlines())
    assert code == 0
    assert values["numpy_fuses"] == "no" and values["numba_fuses"] == "not installed"
    assert values["numpy"][0].isdigit() and "is plain IEEE 754" in out.splitlines()[-1]


def test_json(capsys, quick):
    code, out = run(capsys, "--json")
    printed = json.loads(out)
    assert code == 0
    assert printed["arithmetic"] == quick
    assert printed["machine"]["longdouble_mantissa_bits"] >= 53


def test_unsound_arithmetic_ends_with_1(capsys, quick):
    quick["numba_fuses"] = True
    code, out = run(capsys)
    assert code == 1 and "is not plain IEEE 754" in out.splitlines()[-1]
