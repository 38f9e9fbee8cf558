"""The protocol from the side of a backend: whatever is asked, one line is answered, and nothing else is done."""

import io
import json
import subprocess
import sys

import numpy as np
import pytest

from rockref import cli
from rockref.conformance import vectors
from rockref.conformance.backends import json_lines
from rockref.conformance.backends.law import NumpyEngine


class Careless:
    """A backend with methods that are no pieces."""

    called = False

    def simulate(self, problem):
        """Never asked here."""

    def close(self):
        """Must not be called from outside."""
        type(self).called = True


def said(*lines: str | bytes, backend=None) -> list[dict]:
    out = io.StringIO()
    json_lines.serve(backend or NumpyEngine(), lines, out)
    return [json.loads(line) for line in out.getvalue().splitlines()]


@pytest.mark.parametrize(
    "line, words",
    [
        ("rubbish", "is no JSON"),
        (b'{"cmd":"\xff\xfe"}\n', "is no JSON"),
        ("[1, 2]", "is no JSON object"),
        ("[" * 100_000, "is no JSON"),
        ("{}", "unknown command"),
        ('{"cmd":["run"]}', "unknown command"),
        ('{"cmd":"run"}', "unknown piece"),
        ('{"cmd":"run","id":"a","piece":["rotate"],"in":{}}', "unknown piece"),
        ('{"cmd":"run","id":"a","piece":"rotate"}', "'in' is no object"),
        ('{"cmd":"run","id":"a","piece":"rotate","in":[]}', "'in' is no object"),
        ('{"cmd":"run","piece":"rotate","in":{"Theta":"x"}}', "Error"),
        ('{"cmd":"run","id":"a","piece":"simulate","in":{"mass":1}}', "KeyError"),
    ],
)
def test_a_request_that_cannot_be_used_is_answered_and_the_next_one_too(line, words):
    good = '{"cmd":"run","id":"b","piece":"rotate","in":{"Theta":[0,0,0]}}'
    bad, after = said(line, good)
    assert words in bad["error"]
    assert after["out"]["Lambda"] == np.eye(3).tolist()


def test_only_pieces_are_called():
    for name in ("close", "__class__", "__init__"):
        (reply,) = said(json.dumps({"cmd": "run", "id": "a", "piece": name, "in": {}}), backend=Careless())
        assert "unknown piece" in reply["error"]
    assert not Careless.called


def test_text_among_numbers_takes_no_room():
    """NumPy gives every place the room of the longest text: a megabyte here, five thousand times."""
    answer = {"F_N": [["x" * 1_000_000], *([["y"]] * 5000)]}
    assert json_lines.readable(answer, "contact_law") == answer
    assert json_lines.readable({"F_N": [[1, 2.5], [True, 3]]}, "contact_law")["F_N"].shape == (2, 2)


@pytest.mark.parametrize("said_", [5, "rotate", {"rotate": 1}, None, [["rotate"], 3]])
def test_pieces_are_named_in_a_list_or_not_at_all(said_):
    assert json_lines.capabilities({"capabilities": said_}, ("rotate", "step")) == []


def test_a_file_of_requests_that_is_none_is_refused_with_its_line(tmp_path, capsys):
    asked = json_lines.line(json_lines.of_vector(vectors.layer("L1")[0]))
    for bad, words in (("rubbish", "is no JSON"), ("[]", "is no JSON object")):
        (tmp_path / "requests.jsonl").write_text(asked + "\n" + bad + "\n")
        with pytest.raises(SystemExit) as end:
            cli.main(["conform", "answer", "numpy", str(tmp_path / "requests.jsonl")])
        out, err = capsys.readouterr()
        assert end.value.code == 2 and out == ""
        assert "line 3" in err and words in err and "[E-REQUEST]" in err


def test_a_program_outlives_a_line_that_is_no_utf_8():
    asked = b'\xff\n{"cmd":"run","id":"b","piece":"rotate","in":{"Theta":[0,0,0]}}\n'
    serving = "from rockref.conformance import jsonlines, law_backend; jsonlines.serve(law_backend.NumpyEngine())"
    ended = subprocess.run([sys.executable, "-c", serving], input=asked, capture_output=True, check=True)
    bad, good = map(json.loads, ended.stdout.splitlines())
    assert "is no JSON" in bad["error"] and good["out"]["Lambda"] == np.eye(3).tolist()
