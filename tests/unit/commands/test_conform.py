"""`rockref conform`: what is judged, printed and written, with which exit code; the small layers are real."""

import io
import json
import sys
from xml.etree import ElementTree

import pytest

from rockref.conformance import vectors
from rockref.conformance.faults import run as zoo
from rockref.conformance.judge import findings as judging
from rockref.conformance.judge import offline
from tests import command
from tests.shipped import ROOT
from tests.unit.commands import terminal

run = command.of("conform")
#: The law with a gyroscope that is wrong by a half.
WRONG = """from rockref.conformance.backends.law import NumpyEngine
class Backend(NumpyEngine):
    def channel(self, **q):
        return {k: 1.5 * v for k, v in super().channel(**q).items()}
"""


@pytest.fixture
def wrong(tmp_path):
    (tmp_path / "wrong.py").write_text(WRONG)
    return f"{tmp_path / 'wrong.py'}:Backend"


class TestJudging:
    def test_files_say_what_the_words_say(self, capsys, tmp_path):
        junit, badge, html = (tmp_path / name for name in ("j.xml", "b.svg", "p.html"))
        words = ("--layers", "L0, L7", "--junit", junit, "--badge", badge, "--html", html)
        code, out, err = run(capsys, "numpy", *words)
        assert (code, err) == (0, "") and "PASS" in out and "layers L0 L7\n" in out
        assert {s.get("name") for s in ElementTree.parse(junit).getroot()} == {"L0", "L7"}
        assert "conforms" in badge.read_text() and "PASS" in html.read_text()

    @pytest.mark.parametrize("more", [(), ("--json",)])
    def test_who_falls_short_ends_with_1_and_is_told_the_rule(self, capsys, wrong, tmp_path, more):
        code, out, _ = run(capsys, wrong, "--layers", "L7", "--badge", tmp_path / "b.svg", *more)
        assert code == 1 and "fails M1" in (tmp_path / "b.svg").read_text()
        assert json.loads(out)["rule"] == "M1" if more else out.endswith("FAIL (M1)\n")

    @pytest.mark.parametrize("option, coloured", [(None, False), ("--no-colour", False), ("--colour", True)])
    def test_a_file_has_no_colours_unless_they_are_asked_for(self, capsys, option, coloured):
        _, out, _ = run(capsys, "numpy", "--layers", "L7", *filter(None, [option]))
        assert ("\x1b[" in out) is coloured

    def test_a_terminal_sees_how_far_the_judge_is_and_then_nothing_of_it(self, capsys, monkeypatch):
        seen = terminal.put_in_place(monkeypatch)
        _, out, _ = run(capsys, "numpy", "--layers", "L7")
        assert "L7   " in seen.getvalue() and "%" in seen.getvalue() and "%" not in out
        assert seen.getvalue().endswith("\r" + " " * 40 + "\r")

    def test_json_is_told_no_progress(self, capsys, monkeypatch):
        seen = terminal.put_in_place(monkeypatch)
        _, out, _ = run(capsys, "numpy", "--layers", "L7", "--json")
        assert json.loads(out)["verdict"] == "PASS" and seen.getvalue() == ""

    @pytest.mark.parametrize(
        "words, layers, profile, examples",
        [
            ((), judging.LAYERS, "float64", 50),
            (("--quick",), ("L0", "L1", "L2", "L3", "L4", "L5s", "LS", "L7", "LE", "LB"), "float64", 50),
            (("--quick", "--layers", "L6"), ("L6",), "float64", 50),
            (("--profile", "float32", "--examples", 3), judging.LAYERS, "float32", 3),
        ],
    )
    def test_layers_profile_and_examples_are_those_that_were_asked_for(
        self, capsys, monkeypatch, words, layers, profile, examples
    ):
        asked = []

        def judge(backend, *a):
            asked.append(a)
            return judging.Findings(judging.described(backend), profile, tuple(layers))

        monkeypatch.setattr(judging, "judge", judge)
        code, out, _ = run(capsys, "numpy", *words)
        assert asked == [(list(layers), profile, None, examples)]
        assert code == 1 and "NOTHING JUDGED" in out

    @pytest.mark.parametrize(
        "words, code",
        [
            (("numpy", "more"), "E-ARGUMENT"),
            (("exe",), "E-ARGUMENT"),
            (("judge",), "E-ARGUMENT"),
            (("judge", "a", "b"), "E-ARGUMENT"),
            (("answer", "numpy"), "E-ARGUMENT"),
            (("example", "fortran"), "E-ARGUMENT"),
            (("nobody",), "E-BACKEND"),
            (("numpy", "--profile", "float16", "--layers", "L7"), "E-PROFILE"),
        ],
    )
    def test_what_cannot_be_done_is_refused(self, capsys, words, code):
        found, out, err = run(capsys, *words)
        assert found == 2 and out == "" and f"[{code}]" in err


class TestByFiles:
    def test_questions_answers_and_verdict(self, capsys, tmp_path):
        asked, answered = tmp_path / "requests.jsonl", tmp_path / "responses.jsonl"
        assert run(capsys, "export", "--layers", "L2,L7", "-o", asked) == (0, f"wrote {asked}\n", "")
        assert asked.read_text() == offline.text(("L2", "L7"))
        assert run(capsys, "answer", "numpy", asked, "-o", answered) == (0, f"wrote {answered}\n", "")
        # Only what has answers is judged: of all layers, these two.
        code, out, _ = run(capsys, "judge", answered, "--json")
        record = json.loads(out)
        assert code == 0 and record["verdict"] == "PASS" and record["layers"] == ["L2", "L7"]

    def test_without_a_file_they_are_printed(self, capsys, tmp_path):
        _, out, _ = run(capsys, "export", "--layers", "L7")
        assert out == offline.text(("L7",))
        (tmp_path / "requests.jsonl").write_text(out)
        _, out, _ = run(capsys, "answer", "numpy", tmp_path / "requests.jsonl")
        said = [json.loads(line) for line in out.splitlines()]
        assert [a["id"] for a in said[1:]] == [v.id for v in vectors.layer("L7")]

    @pytest.mark.parametrize("backend", [(), ("numpy",)])
    def test_a_backend_in_python_is_served_as_a_program(self, capsys, monkeypatch, backend):
        words = '{"cmd":"start","protocol":1}\n\n{"cmd":"dance"}\nrubbish\n{"cmd":"stop"}\n{"cmd":"start"}\n'
        monkeypatch.setattr(sys, "stdin", io.StringIO(words))
        code, out, _ = run(capsys, "serve", *backend)
        start, dance, rubbish = map(json.loads, out.splitlines())
        assert code == 0 and "contact_law" in start["capabilities"]
        assert "unknown command 'dance'" in dance["error"] and "no JSON" in rubbish["error"]


class TestExamples:
    @pytest.mark.parametrize(
        "words, name", [((), "backend_numpy.py"), (("python",), "backend_numpy.py"), (("c",), "backend_c/backend.c")]
    )
    def test_the_tutorial_is_handed_out(self, capsys, tmp_path, words, name):
        text = (ROOT / "examples" / name).read_text(encoding="utf-8")
        assert run(capsys, "example", *words) == (0, text, "")
        assert run(capsys, "example", *words, "-o", tmp_path / "mine") == (0, f"wrote {tmp_path / 'mine'}\n", "")
        assert (tmp_path / "mine").read_text(encoding="utf-8") == text


class TestZoo:
    """A zoo of one mistake and one control."""

    @pytest.fixture
    def calls(self, monkeypatch):
        calls = []

        def run_zoo(black_box, progress):
            calls.append(black_box)
            if progress is not None:
                progress("zoo", 0.5)
            return zoo.summary([self.mistake, self.control])

        monkeypatch.setattr(zoo, "run_zoo", run_zoo)
        return calls

    mistake = {
        "id": "Z01", "kind": "mistake", "rule": "N1", "says": "tension", "detected": True, "named": "N1",
        "attributed": True, "vector": "L1-0001", "layer": "L1", "bars": 1e9, "failed_vectors": 3, "black_box": None,
    }  # fmt: skip
    control = {"id": "C01", "kind": "control", "says": "the law", "rejected": False, "named": None, "bars": 0.5}

    def test_words_and_page(self, capsys, calls, tmp_path):
        code, out, err = run(capsys, "zoo", "--quick", "-o", tmp_path / "zoo.md")
        assert (code, err, calls) == (0, "", [False]) and "detected 1/1, attributed 1/1" in out
        assert "| Z01 | N1 | tension |" in (tmp_path / "zoo.md").read_text()
        run(capsys, "zoo", "--quick", "-o", tmp_path / "zoo.csv")
        assert (tmp_path / "zoo.csv").read_text().splitlines()[1].startswith("Z01,N1,tension,L1-0001,1.0e+09,N1")

    def test_a_control_that_is_rejected_ends_with_1(self, capsys, calls, monkeypatch):
        monkeypatch.setattr(self, "control", self.control | {"rejected": True})
        code, out, _ = run(capsys, "zoo", "--json")
        assert code == 1 and json.loads(out)["controls_rejected"] == 1 and calls == [True]

    @pytest.mark.parametrize("more, told", [((), True), (("--json",), False)])
    def test_a_terminal_sees_how_far_it_is(self, capsys, calls, monkeypatch, more, told):
        seen = terminal.put_in_place(monkeypatch)
        run(capsys, "zoo", *more)
        assert ("zoo   50%" in seen.getvalue()) is told
