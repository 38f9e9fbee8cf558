"""The judge's ear: logs among the answers, buffers that are not flushed, byte order marks, and where a crash was."""

import gzip
import sys

import pytest

from rockref.conformance.backends.executable import Executable, Misbehaved, _and
from rockref.conformance.judge.offline import Recorded
from rockref.model.errors import InputError

HELLO = '{"protocol": 1, "name": "x", "capabilities": ["simulate", "step"]}'
LOOP = """
import json, sys
for line in sys.stdin:
    q = json.loads(line)
    {before}
    print(json.dumps({hello} if q["cmd"] == "start" else {{"id": q["id"], "out": {{"t": [1.0]}}}}){flush})
"""


def program(tmp_path, before="pass", flush=", flush=True", text=None):
    path = tmp_path / "backend.py"
    path.write_text(text or LOOP.format(before=before, hello=HELLO, flush=flush))
    return [sys.executable, str(path)]


def asked(backend):
    return backend._run({"cmd": "run", "id": backend._new_id(), "piece": "step", "in": {}}, backend.small)


LOGS = [
    'print(json.dumps({"level": "info", "msg": "started"}), flush=True)',
    'print(json.dumps({"level": "error", "error": "none", "time": 3}), flush=True)',
    'print(json.dumps({"id": "job-7", "event": "step"}), flush=True)',
]


@pytest.mark.parametrize("log", LOGS)
def test_a_log_line_that_is_json_is_no_answer(tmp_path, log):
    backend = Executable(program(tmp_path, before=log), small=20.0)
    assert asked(backend)["t"].tolist() == [1.0]
    assert len([r for r in backend.remarks if "passed over" in r]) == 1
    backend.close()


def test_a_program_that_does_not_flush_is_told_so(tmp_path):
    # A stream of its own: the environment may have taken the buffer from the usual one.
    text = "import sys; sys.stdout = open(1, 'w', buffering=8192, closefd=False)\n"
    text += LOOP.format(before="pass", hello=HELLO, flush=', flush=q["cmd"] == "start"')
    backend = Executable(program(tmp_path, text=text), small=1.0)
    with pytest.raises(Misbehaved, match="flush standard output after every line"):
        asked(backend)


def test_a_byte_order_mark_is_dropped_with_a_remark(tmp_path):
    before = 'print("\\ufeff", end="") if q["cmd"] == "start" else None'
    text = "import sys; sys.stdout.reconfigure(encoding='utf-8')\n" + LOOP.format(
        before=before, hello=HELLO, flush=", flush=True"
    )
    backend = Executable(program(tmp_path, text=text), small=20.0)
    assert asked(backend)["t"].tolist() == [1.0]
    assert any("byte order mark" in remark for remark in backend.remarks)
    backend.close()


def test_a_crash_says_where(tmp_path):
    before = 'assert q["cmd"] == "start", "no"'
    backend = Executable(program(tmp_path, before), small=20.0)
    with pytest.raises(Misbehaved, match=r"exit code 1\) at backend.py, line 5, saying .*AssertionError"):
        asked(backend)


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """A file of answers: a hello and one answer of a known question."""
    path = tmp_path_factory.mktemp("answers") / "answers.jsonl"
    path.write_text(HELLO + '\n{"id": "q", "out": {"t": [1.0]}}\n', encoding="utf-8")
    return path


@pytest.mark.parametrize(("code", "expected"), [("utf-8", None), ("utf-8-sig", "byte order mark"), ("utf-16", "E")])
def test_answers_in_a_file_with_a_mark(tmp_path, answers, code, expected):
    path = tmp_path / "answers.jsonl"
    path.write_bytes(answers.read_text(encoding="utf-8").encode(code))
    if expected == "E":
        with pytest.raises(InputError, match="is UTF-16 text") as caught:
            Recorded(path)
        assert caught.value.code == "E-ENCODING"
        return
    assert any("byte order mark" in remark for remark in Recorded(path).remarks) == (expected is not None)


def test_packed_answers_are_read(tmp_path, answers):
    path = tmp_path / "answers.jsonl.gz"
    path.write_bytes(gzip.compress(answers.read_bytes()))
    assert Recorded(path).name == "x"


@pytest.mark.parametrize(
    ("printed", "words"),
    [
        (["{\n", ' "id": "q1",\n'], "over several lines: write one JSON object a line"),
        (['{"F_N": 600.0}\n'], "neither the question's id nor 'out'"),
        (["step 3\n"], "printed rubbish: 'step 3"),
    ],
)
def test_what_was_printed_in_place_of_an_answer_is_told_by_its_looks(printed, words):
    assert words in _and(printed)


def test_an_answer_without_out_is_told_by_what_it_has(tmp_path):
    program = tmp_path / "mine.py"
    program.write_text(
        "import json, sys\n"
        "for line in sys.stdin:\n"
        "    q = json.loads(line)\n"
        "    hello = {'protocol': 1, 'capabilities': ['rotate']}\n"
        "    a = hello if q['cmd'] == 'start' else {'id': q['id'], 'result': {}}\n"
        "    print(json.dumps(a), flush=True)\n"
    )
    backend = Executable([sys.executable, str(program)])
    try:
        with pytest.raises(Misbehaved, match="has no 'out', but id, result"):
            backend.rotate(Theta=[0.0, 0.0, 1.0])
    finally:
        backend.close()
