"""The law in WebAssembly has the bits of the NumPy text, and what the judge asks of it holds."""

import hashlib
import importlib.util
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("wasmtime", reason="wasmtime runs WebAssembly outside a browser: the extra `lab`")

import rockref
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge.findings import judge
from rockref.effects.catalogue import EFFECTS
from rockref.lab import build, golden, layout
from rockref.lab.backend import WasmBackend
from rockref.lab.wasm import binary


@pytest.fixture(scope="module")
def backend():
    return WasmBackend()


def test_binary_is_the_one_that_is_named_and_small():
    # 200 kB: what a page of 2 MB can spare, twice over in base64.
    assert len(binary()) < 200_000
    assert build.DIGEST.read_text() == f"{hashlib.sha256(binary()).hexdigest()}  law.wasm\n"


def test_header_is_that_of_the_catalogue_and_the_compiled_engine():
    assert layout.HEADER.read_text() == layout.header()


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("ziglang") is None, reason="the compiler is in the extra `lab`")
def test_the_compiler_makes_the_same_bytes_again():
    assert build.compiled() == binary()


@pytest.mark.parametrize("layers", [("L0", "L1", "L2", "L3", "L4", "L5s", "L7"), ("L5",), ("LE",)])
def test_the_judge_finds_nothing_outside(backend, layers):
    found = judge(backend, layers=layers)
    assert not [c for c in (*found.checks, *found.runs, *found.effects) if c.failed]
    assert len(found.checks) + len(found.runs) + len(found.effects) >= 29
    assert "LE" not in layers or {c.effect for c in found.effects if c.grade != "not shown"} == set(EFFECTS)


@pytest.mark.parametrize("change", [{}, {"points": "four_points"}, {"inertia": np.diag([2.2, 2.0, 0.1]) + 0.01}])
def test_every_row_has_the_bits_of_the_numpy_text(backend, change):
    problem = rockref.Model.table_3_1().replace(**change).problem(0.02, theta_0=0.01)
    ours, law = backend.simulate(problem), rockref.simulate(problem, engine="numpy")
    for name in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(law, name), err_msg=name)
    # A point that is not anchored has no anchor; what stands there is read by nobody.
    np.testing.assert_array_equal(ours.s[law.anchored], law.s[law.anchored])


@pytest.mark.parametrize("stiffening", [0.0, 0.5])
def test_a_cable_has_the_bits_of_the_numpy_text(backend, stiffening):
    """Its anchor and its numbers are the C text's, too; the way of the run is some tens of micrometres."""
    cable = {"k": 5.0, "c": 0.3, "stiffening": stiffening, "reference": 1e-5}
    problem = rockref.Model.table_3_1().problem(0.02, theta_0=0.01)
    law = rockref.simulate(replace(problem, effects=(EFFECTS["cable_restraint"](**cable),)), engine="numpy")
    ours = backend.effect(problem, "cable_restraint", cable)
    for name in ("x", "v", "Lambda", "W", "F"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(law, name), err_msg=name)
    assert not np.array_equal(law.W, rockref.simulate(problem, engine="numpy").W)


def test_inner_points_at_their_own_distances_have_the_bits_of_the_numpy_text(backend):
    """Of factors whose logarithms add up to nothing: roundings of other logarithms are no matter of the text."""
    defects = EFFECTS["foot_defects"].typical().values() | {"diag1": 0.5, "diag2": 2.0, "diag3": 2.0, "diag4": 0.5}
    problem = rockref.Model.four_points().problem(0.02, theta_0=0.01)
    ours, law = backend.effect(problem, "foot_defects", defects), NumpyEngine().effect(problem, "foot_defects", defects)
    for name in ("x", "v", "Lambda", "W", "F"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(law, name), err_msg=name)
    alike = defects | dict.fromkeys(("diag1", "diag2", "diag3", "diag4"), 1.0)
    assert not np.array_equal(law.W, NumpyEngine().effect(problem, "foot_defects", alike).W)


def test_a_run_goes_on_bit_for_bit(backend):
    problem = rockref.Model.table_3_1().problem(0.02, theta_0=0.01)
    whole = backend.simulate(problem)
    half = backend.simulate(replace(problem, duration=0.01))
    rest = backend.simulate(replace(problem, duration=0.01, start=half.final_state))
    np.testing.assert_array_equal(rest.W[-1], whole.W[-1])


def test_a_changed_last_bit_changes_the_digest(backend):
    response = rockref.simulate(rockref.Model.table_3_1(), duration=2e-3)
    before = golden.digest(response)
    response.W[-1, 0] = np.nextafter(response.W[-1, 0], 1.0)
    assert golden.digest(response) != before


@pytest.mark.parametrize("run", golden.RUNS, ids=[run[0] for run in golden.RUNS])
def test_golden_digests_are_those_of_the_law(backend, run):
    pytest.importorskip("numba", reason="the NumPy text takes a minute for these runs")
    stated = next(row["sha256"] for row in golden.read()["runs"] if row["title"] == run[0])
    assert golden.digest(golden.response(run, "numba")) == stated
    assert page_digest(backend, run) == stated


@pytest.mark.slow
def test_golden_digests_are_those_of_the_numpy_text():
    assert golden.digest(golden.response(golden.RUNS[1])) == golden.read()["runs"][1]["sha256"]


def page_digest(backend, run):
    """What the page computes: release, run and digest, all in the module."""
    _, name, release, duration = run
    model = getattr(rockref.Model, name)()
    rows = round(duration * golden.RATE) + 1
    states, out = np.zeros((rows, 32)), np.zeros(64, np.uint8)
    row = np.array(layout.model_row(model))
    given = model.parameters.theta_0, int(release.get("turned", False)), release.get("out_of_plane", 0.0)
    every = round(1 / (golden.RATE * golden.STEP))
    arguments = row, np.zeros(layout.count_values()), *given, golden.STEP, every, rows, states, None, None
    assert backend.module.call("run_model", *arguments) == rows
    backend.module.call("digest_of", states, rows, out)
    return out.tobytes().decode()


@pytest.mark.parametrize("length", [0, 1, 55, 56, 63, 64, 65, 119, 120, 1000])
def test_digest_is_sha_256(backend, length):
    data, out = np.arange(length, dtype=np.int32).astype(np.uint8), np.zeros(64, np.uint8)
    backend.module.call("sha256", data, length, out)
    assert out.tobytes().decode() == hashlib.sha256(data.tobytes()).hexdigest()
