"""The shipped vectors: whole, of the stated form, on the stated branch, with bars that can tell right from wrong."""

import gzip
import hashlib
import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from golden.generator.admission import RESOLVED, RESOLVED_BY_SCHEMES
from golden.generator.bounds.answers import ANSWERS
from golden.generator.bounds.arithmetic import converted
from golden.generator.bounds.bars import FIFTY, converted_floats_of, is_flag
from rockref.conformance.backends.call import ask
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.faults.mistakes import BY_ID
from rockref.conformance.judge.compare_answer import compare
from rockref.conformance.rules import ORDER, PIECES
from rockref.conformance.vectors import shipped as vectors
from rockref.conformance.vectors.fields import branch_of
from rockref.engines import run
from rockref.model.errors import InputError

LAYERS = ("L0", "L1", "L2", "L3", "L4", "L5s", "L7")
FOLDER = Path(str(vectors.folder()))
SCHEMA = json.loads((FOLDER / "schema.json").read_text())
RUNS = vectors.trajectory_names() + vectors.window_names()


def exactly(vector):
    q = {k: converted(x, FIFTY.number) for k, x in vector.inputs.items()}
    return ANSWERS[vector.piece](q, FIFTY)


def test_every_file_is_in_the_manifest_with_its_digest():
    listed = vectors.manifest()["files"]
    there = {p.relative_to(FOLDER).as_posix() for p in FOLDER.rglob("*") if p.is_file()} - {"MANIFEST.json"}
    assert set(listed) == there
    for name, facts in listed.items():
        data = (FOLDER / name).read_bytes()
        assert (hashlib.sha256(data).hexdigest(), len(data)) == (facts["sha256"], facts["bytes"]), name


def test_the_vectors_are_small_enough_for_a_wheel():
    assert sum(f["bytes"] for f in vectors.manifest()["files"].values()) < 8e6


def test_an_altered_file_is_refused(tmp_path, monkeypatch):
    (tmp_path / "L0.json").write_bytes(b"{}")
    whole = vectors.manifest()
    monkeypatch.setattr(vectors, "folder", lambda: tmp_path)
    monkeypatch.setattr(vectors, "manifest", lambda: whole)
    with pytest.raises(InputError, match="E-VECTORS"):
        vectors.read_bytes("L0.json")
    with pytest.raises(InputError, match="is not there"):
        vectors.read_bytes("L1.json")
    monkeypatch.setattr(vectors, "LARGEST", 1)
    with pytest.raises(InputError, match="has more than 1 bytes"):
        vectors.read_bytes("L0.json")


@pytest.mark.parametrize("name", ["MANIFEST", *LAYERS, "LS", "LE", "LB", *(f"L5/{n}" for n in RUNS)])
def test_files_have_the_form_of_the_schema(name):
    jsonschema.validate(json.loads((FOLDER / f"{name}.json").read_text()), SCHEMA)


def test_the_schema_states_the_bars_of_admission():
    told = SCHEMA["$defs"]["vector"]["properties"]["resolving"]
    assert told["additionalProperties"]["minimum"] == RESOLVED_BY_SCHEMES < RESOLVED
    assert f": {RESOLVED:g} at least, and {RESOLVED_BY_SCHEMES:g} in layer LS" in told["description"]
    for layer in (*LAYERS, "LS"):
        least = RESOLVED_BY_SCHEMES if layer == "LS" else RESOLVED
        assert all(v >= least for vector in vectors.layer(layer) for v in vector.resolving.values()), layer


@pytest.mark.parametrize("layer", LAYERS)
def test_ids_are_unique_and_pieces_known(layer):
    ids = [v.id for v in vectors.layer(layer)]
    assert len(set(ids)) == len(ids)
    assert {v.piece for v in vectors.layer(layer)} <= {*PIECES, "simulate"}


@pytest.mark.parametrize("layer", LAYERS)
def test_hexadecimal_and_decimal_are_the_same_number(layer):
    document = json.loads((FOLDER / f"{layer}.json").read_text())

    def walk(thing):
        if isinstance(thing, dict):
            if "hex" in thing:
                assert np.array_equal(np.array(vectors.from_hex(thing["hex"])), np.array(thing["decimal"]))
            for inner in thing.values():
                walk(inner)
        elif isinstance(thing, list):
            for inner in thing:
                walk(inner)

    walk(document)


@pytest.mark.parametrize("layer", ["L0", "L1", "L2", "L3", "L7"])
def test_expected_values_are_the_exact_ones_rounded_once(layer):
    for vector in vectors.layer(layer):
        found = exactly(vector)
        for name, expected in vector.expect.items():
            value = found[name]
            right = np.array(value) if is_flag(value) else np.array(converted_floats_of(value))
            assert np.array_equal(right, expected.value), (vector.id, name)


def test_points_take_the_stated_branch():
    seen = set()
    for vector in (v for v in vectors.layer("L1") if v.piece == "contact_law"):
        found = exactly(vector)
        assert {k: found[k] for k in ("touching", "sliding")} == {k: vector.branch[k] for k in ("touching", "sliding")}
        force = vector.inputs["K_N"] * vector.inputs["xi"] + vector.inputs["C_N"] * vector.inputs["xi_rate"]
        assert vector.branch["tension cut"] == bool(vector.inputs["xi"] >= 0 and force < 0), vector.id
        flagged = {"stick": (True, False), "slip": (True, True), "above the plate": (False, False)}
        for flag, branch in flagged.items():
            if flag in vector.flags:
                assert (found["touching"], found["sliding"]) == branch, vector.id
        seen.add((found["touching"], found["sliding"], vector.branch["tension cut"]))
    assert seen == {
        (False, False, False),
        (True, False, False),
        (True, True, False),
        (True, False, True),
        (True, True, True),
    }


def test_short_runs_take_the_stated_pattern():
    signs = np.array(list("-sS"))
    for vector in vectors.layer("L5s"):
        r = run(vectors.problem_of(vector.inputs), engine="numpy")
        code = r.anchored.astype(int) + (r.anchored & r.sliding)
        # A foot without friction sticks or slides as its last bit is: nothing follows from it.
        firm = np.asarray(vector.inputs["mu_0"]) > 0
        stated = [list(row) for row in vector.branch["rows"]]
        assert np.array_equal(signs[code][:, firm], np.array(stated)[:, firm]), vector.id
        assert np.array_equal(r.anchored, np.array(stated) != "-"), vector.id
        assert len(stated) == len(r.t) and {len(row) for row in stated} == {len(vector.inputs["P"])}, vector.id


def test_short_runs_that_are_judged_elsewhere_stand_at_the_end():
    places = [v.place for v in vectors.layer("L5s")]
    without = places.index(next(p for p in places if p is not None))
    assert set(places[:without]) == {None} and None not in places[without:]
    assert len(set(places[without:])) == len(places) - without and max(places[without:]) < without + 1


def test_steps_take_the_stated_pattern():
    patterns = []
    for vector in vectors.layer("L4"):
        out = ask(NumpyEngine(), vector)
        assert branch_of(out["anchored"], out["sliding"]) == vector.branch, vector.id
        pattern = vector.flags[2]
        assert [i for i, c in enumerate(pattern) if c == "s"] == vector.branch["stick"], vector.id
        assert [i for i, c in enumerate(pattern) if c == "S"] == vector.branch["slip"], vector.id
        patterns += [pattern] if vector.flags[0] != "elsewhere" else []
    assert len(set(patterns)) == len(patterns) > 100, "each once, but for those of another block"
    assert len(patterns) < len(vectors.layer("L4"))


@pytest.mark.parametrize("layer", LAYERS)
def test_every_vector_hunts_mistakes_of_its_rules_and_moves_them_by_a_hundred_bars(layer):
    for vector in vectors.layer(layer):
        rules = {vector.rule} | {e.rule for e in vector.expect.values()}
        assert vector.hunts and set(vector.hunts) == set(vector.resolving), vector.id
        assert min(vector.resolving.values()) >= 100, vector.id
        assert {BY_ID[m].rule for m in vector.hunts} <= rules, vector.id


def test_short_runs_of_other_integrators_hunt_mistakes_of_their_rules():
    """Outside is there what is two bars off: ten tell a mistake from another integrator."""
    for vector in vectors.layer("LS"):
        rules = {vector.rule} | {e.rule for e in vector.expect.values()}
        assert vector.hunts and {BY_ID[m].rule for m in vector.hunts} <= rules, vector.id
        assert min(vector.resolving.values()) >= 10, vector.id
        assert all(np.all(e.bar > 0) for e in vector.expect.values()), vector.id


@pytest.mark.parametrize("layer", ["L0", "L2", "L3", "L7"])
def test_the_stated_resolving_power_is_what_the_mistakes_do(layer):
    for vector in vectors.layer(layer)[::4]:
        for id_, stated in vector.resolving.items():
            worst = max(c.worst for c in compare(vector, ask(BY_ID[id_].backend(), vector)))
            # Written with two digits.
            assert min(worst, 1e99) == pytest.approx(stated, rel=0.06), (vector.id, id_)


def test_no_input_of_a_piece_is_the_same_in_all_its_vectors():
    """What never changes may stand as a number in the code of a backend, and nobody sees it."""
    seen = {}
    for vector in (v for layer in LAYERS for v in vectors.layer(layer)):
        # A step that is shown by itself is also asked as part of a run.
        piece = "run" if vector.piece in ("step", "simulate") else vector.piece
        for name, value in vector.inputs.items():
            if name != "names":
                seen.setdefault((piece, name), set()).add(np.asarray(value).tobytes())
    assert [k for k, values in seen.items() if len(values) == 1] == []


def test_every_rule_has_vectors():
    shown = {e.rule for layer in LAYERS for v in vectors.layer(layer) for e in v.expect.values()}
    # A moving plate has a layer of its own (test_shaken.py), which a backend may leave out.
    assert shown >= set(ORDER) - {"S2", "B1"}


@pytest.mark.parametrize("name", RUNS)
def test_runs_are_whole(name):
    run = vectors.trajectory(name)
    t = run.columns["t_s"]
    assert np.all(np.diff(t) > 0)
    assert all(np.all(np.isfinite(c)) for c in run.columns.values())
    assert all(np.all(np.diff(run.columns[f"bar_{k}"]) >= 0) for k in ("W_rad_s", "x_m")), "bars grow with the run"
    Lambda = run.columns["Lambda"].reshape(-1, 3, 3)
    # Drift of the plain update over some 1e5 steps of rounding.
    assert np.abs(Lambda @ Lambda.swapaxes(1, 2) - np.eye(3)).max() < 1e-12


def test_trajectories_reach_the_second_main_impact():
    for name in (
        "table_3_1",
        "planar",
        "out_of_plane",
        "spinning",
        "two_coefficients",
        "four_points",
        "oblique_inertia",
    ):
        run = vectors.trajectory(name)
        assert len(run.meta["impacts"]) >= 2, name
        assert run.meta["horizon_s"]["float64"] >= run.meta["impacts"][1]["t_s"], name
        assert all(i["bar_s"] < 1e-8 for i in run.meta["impacts"])


def test_the_bars_at_the_horizon_are_a_millionth_of_the_signal():
    for name in vectors.trajectory_names():
        run = vectors.trajectory(name)
        rows = run.columns["t_s"] <= run.meta["horizon_s"]["float64"]
        signal = np.abs(run.columns["W_rad_s"]).max()
        if signal:
            assert run.columns["bar_W_rad_s"][rows].max() <= 1e-6 * signal, name


def put(folder, name, content):
    """A file of vectors with the manifest that belongs to it."""
    path = folder / name
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content)
    listed = {name: {"sha256": hashlib.sha256(content).hexdigest()}}
    text = json.dumps({"files": listed, "trajectories": ["run"], "windows": []})
    (folder / "MANIFEST.json").write_text(text)


@pytest.mark.parametrize(
    "content",
    [b"", b"[]", b"{}", b'{"sets":{},"vectors":[{}]}', b'{"sets":{},"vectors":[3]}', b"[" * 100_000, b"\xff", b"null"],
    ids=lambda content: str(content[:12]),
)
def test_a_file_that_is_not_as_shipped_is_refused_though_its_digest_is_right(tmp_path, monkeypatch, content):
    put(tmp_path, "L0.json", content)
    monkeypatch.setattr(vectors, "folder", lambda: tmp_path)
    monkeypatch.setattr(vectors, "manifest", vectors.manifest.__wrapped__)
    with pytest.raises(InputError, match="not as it was shipped"):
        vectors.layer.__wrapped__("L0")


def test_numbers_and_packed_files_of_vectors_are_not_larger_than_they_may_be(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match="characters"):
        vectors.from_hex(["0x1." + "0" * 10_000_000 + "p0"])
    meta = (FOLDER / "L5/static.json").read_bytes()
    put(tmp_path, "L5/run.csv.gz", gzip.compress(bytes(vectors.LARGEST + 1), mtime=0))
    listed = json.loads((tmp_path / "MANIFEST.json").read_text())
    (tmp_path / "L5/run.json").write_bytes(meta)
    listed["files"]["L5/run.json"] = {"sha256": hashlib.sha256(meta).hexdigest()}
    (tmp_path / "MANIFEST.json").write_text(json.dumps(listed))
    monkeypatch.setattr(vectors, "folder", lambda: tmp_path)
    monkeypatch.setattr(vectors, "manifest", vectors.manifest.__wrapped__)
    with pytest.raises(InputError, match="E-SIZE"):
        vectors.trajectory.__wrapped__("run")
