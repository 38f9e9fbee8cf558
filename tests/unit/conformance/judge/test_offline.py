"""Questions and answers as files, and the lines of the protocol."""

import io
import json

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends import json_lines
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.judge import offline
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.vectors import flat, problem_of
from rockref.model.errors import InputError

LAYERS = ("L0", "L1", "L4")


@pytest.fixture(scope="module")
def responses(tmp_path_factory):
    """The law's answers to the questions of three layers, as a file."""
    out = io.StringIO()
    json_lines.serve(NumpyEngine(), offline.text(LAYERS).splitlines(), out)
    path = tmp_path_factory.mktemp("offline") / "responses.jsonl"
    path.write_text(out.getvalue())
    return path


def test_every_question_has_one_line_and_its_own_id():
    asked = [json.loads(line) for line in offline.text(LAYERS).splitlines()]
    assert asked[0] == {"cmd": "start", "protocol": 1}
    ids = [q["id"] for q in asked[1:]]
    assert ids == [v.id for layer in LAYERS for v in vectors.layer(layer)] + [v.id for v in vectors.steps_as_runs()]
    assert len(set(ids)) == len(ids)


def test_recorded_answers_are_judged_as_live_ones(responses):
    backend = offline.Recorded(responses)
    assert backend.layers == set(LAYERS)
    v = verdict(judge(backend, LAYERS))
    assert v.passed
    live = judge(NumpyEngine(), LAYERS)
    assert [c.grade for c in v.findings.checks] == [c.grade for c in live.checks]


def test_a_missing_answer_is_a_failure(responses, tmp_path):
    lines = responses.read_text().splitlines(keepends=True)
    path = tmp_path / "holes.jsonl"
    left_out = vectors.layer("L1")[9].id
    path.write_text("".join(line for line in lines if f'"{left_out}"' not in line))
    v = verdict(judge(offline.Recorded(path), ["L1"]))
    assert {c.vector for c in v.findings.failures} == {left_out}
    assert f"no answer to {left_out}" in v.check.note


def test_what_a_file_leaves_out_is_remarked(responses, tmp_path):
    lines = responses.read_text().splitlines(keepends=True)
    cut = 1 + len(vectors.layer("L0")) + 10
    for order in (1, -1):
        path = tmp_path / f"cut{order}.jsonl"
        path.write_text("".join(lines[:cut][::order]))
        backend = offline.Recorded(path)
        first = vectors.layer("L1")[10].id
        assert (
            f"{len(vectors.layer('L1')) - 10}, first {first}, of the {len(vectors.layer('L1'))} questions of L1 are"
            in (" ".join(backend.remarks))
        )
        assert any("None of the" in r and "L4" in r for r in backend.remarks)
        assert not any("L0" in r for r in backend.remarks)
        assert backend.remarks[0] in verdict(judge(backend, ["L0"])).findings.remarks


def test_answers_are_found_in_any_order_and_without_the_start(responses, tmp_path):
    lines = [line for line in responses.read_text().splitlines(keepends=True) if '"protocol"' not in line]
    path = tmp_path / "shuffled.jsonl"
    path.write_text("".join(lines[::-1]))
    assert verdict(judge(offline.Recorded(path), LAYERS)).passed


def test_empty_answers_show_no_piece(tmp_path):
    path = tmp_path / "empty.jsonl"
    asked = [v for layer in LAYERS for v in vectors.layer(layer)]
    law, lines = NumpyEngine(), []
    for v in asked:
        known = json_lines.answer(law, json.loads(json_lines.line(json_lines.of_vector(v)))) if v.layer == "L1" else {}
        lines.append(json_lines.line({"id": v.id, "out": {}} | known))
    path.write_text("".join(lines))
    findings = judge(offline.Recorded(path), LAYERS)
    assert set(findings.pieces) == {"kinematics", "contact_law"}
    assert not [c for c in findings.failures if c.layer in ("L0", "L1")]


@pytest.mark.parametrize(
    "text, said",
    [
        ("", "no answers"),
        ('{"cmd":"start","protocol":1}\n', "line 1"),
        ("not json\n", "line 1"),
        ("[]\n", "line 1"),
        ('{"id":"a","out":{}}\n{"x":1}\n', "line 2"),
    ],
)
def test_a_file_that_cannot_be_used_is_named(tmp_path, text, said):
    path = tmp_path / "bad.jsonl"
    path.write_text(text)
    with pytest.raises(InputError, match=said):
        offline.Recorded(path)


def test_doubles_cross_the_wire_bit_by_bit():
    numbers = np.array([0.1, 1 / 3, 5e-324, -0.0, 1.7976931348623157e308])
    back = np.array(json.loads(json_lines.line({"a": numbers}))["a"])
    assert back.tobytes() == numbers.tobytes()


def test_a_problem_crosses_the_wire_whole():
    problem = vectors.trajectory("window_spinning_0415ms").problem
    back = problem_of(json.loads(json_lines.line(flat(problem))))
    for key, value in flat(problem).items():
        assert np.array_equal(np.asarray(value), np.asarray(flat(back)[key])), key


def test_a_python_backend_answers_for_itself():
    start = json_lines.answer(NumpyEngine(), {"cmd": "start", "protocol": 1})
    assert start["protocol"] == 1 and "contact_law" in start["capabilities"]
    assert "error" in json_lines.answer(NumpyEngine(), {"cmd": "dance"})
    wrong = json_lines.answer(NumpyEngine(), {"cmd": "run", "id": "a", "piece": "rotate", "in": {}})
    assert wrong["id"] == "a" and "TypeError" in wrong["error"]


def test_pieces_that_a_program_says_it_has_not_are_not_judged(tmp_path):
    law = NumpyEngine()
    out = io.StringIO()
    for row in offline.text(("L0", "L1")).splitlines():
        request = json.loads(row)
        if request["cmd"] == "start":
            reply = {"protocol": 1, "capabilities": ["simulate", "contact_law"]}
        elif request["piece"] == "contact_law":
            reply = json_lines.answer(law, request)
        else:
            reply = {"id": request["id"], "error": "no such piece"}
        out.write(json_lines.line(reply))
    for content in (out.getvalue(), out.getvalue().partition("\n")[2]):
        path = tmp_path / "some.jsonl"
        path.write_text(content)
        findings = judge(offline.Recorded(path), ["L0", "L1"])
        assert findings.pieces == ("contact_law",) and findings.checks and not findings.failures


def test_what_a_program_says_in_place_of_an_answer_is_the_note_of_the_failure(responses, tmp_path):
    lines, wrong = responses.read_text().splitlines(keepends=True), vectors.layer("L1")[9].id
    path = tmp_path / "error.jsonl"
    said = json_lines.line({"id": wrong, "error": "no idea"})
    path.write_text("".join(said if f'"{wrong}"' in line else line for line in lines))
    v = verdict(judge(offline.Recorded(path), ["L1"]))
    assert {c.vector for c in v.findings.failures} == {wrong} and "says: no idea" in v.check.note
