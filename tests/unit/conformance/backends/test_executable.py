"""Programs as backends: the tutorial in C, and programs that crash, hang, or print rubbish."""

import shutil
import sys
import textwrap
import time
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rockref import cli
from rockref.commands.conform import parted
from rockref.conformance import vectors
from rockref.conformance.backends import executable
from rockref.conformance.backends.executable import Executable, Misbehaved
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.reports import terminal
from rockref.conformance.reports.junit import junit
from rockref.conformance.rules import PIECES
from rockref.conformance.vectors import problem_of
from rockref.model.errors import InputError

LAYERS = ("L0", "L1", "L2", "L3", "L4", "L5s", "L7")


def judged(path, profile="float64"):
    backend = Executable([str(path)])
    try:
        return verdict(judge(backend, LAYERS, profile))
    finally:
        backend.close()


def test_the_tutorial_in_c_passes(compiled):
    v = judged(compiled())
    assert v.passed, terminal.text(v)
    assert v.findings.backend["language"] == "C"
    assert set(v.findings.pieces) == {"kinematics", "contact_law", "step"}


def test_the_tutorial_in_c_says_which_pieces_it_has_not(compiled):
    backend = Executable([str(compiled())])
    with pytest.raises(Misbehaved, match="no such piece"):
        backend._run({"cmd": "run", "id": "q1", "piece": "rotate", "in": {}}, 5.0)
    backend.close()


def test_its_twin_with_a_mistake_is_named(compiled):
    v = judged(compiled("-DMISTAKE"))
    assert v.rule == "T3" and v.check.vector.startswith("L1-")


JS = Path(__file__).resolve().parents[4] / "examples/backend_js/backend.js"


@pytest.mark.skipif(shutil.which("node") is None, reason="no Node.js on this machine")
@pytest.mark.parametrize("options, rule", [((), None), (("--mistake",), "T3")])
def test_the_tutorial_in_javascript_shows_every_piece_and_passes_and_its_twin_is_named(options, rule):
    backend = Executable(["node", str(JS), *options])
    try:
        v = verdict(judge(backend, LAYERS))
    finally:
        backend.close()
    assert v.rule == rule and v.passed == (rule is None), terminal.text(v)
    assert v.findings.backend["language"] == "JavaScript" and set(v.findings.pieces) == set(PIECES)


def test_in_single_precision_it_passes_its_own_profile(compiled):
    path = compiled("-DREAL=float")
    assert judged(path, "float32").passed
    assert not judged(path).passed


ONLY_RUNS = '{"protocol":1,"name":"odd","capabilities":["simulate"]}'
START = 'print(\'{"protocol":1,"name":"odd","capabilities":["contact_law"]}\', flush=True)'


def program_text(body):
    """Lines of a program that starts well; `body` is what it does with each further line (in `line`)."""
    text = ["import json, sys, time", "first = sys.stdin.readline()", START, "for line in sys.stdin:"]
    return [*text, textwrap.indent(textwrap.dedent(body), "    "), ""]


def program(tmp_path, body):
    """A program that starts well; `body` is what it does with each further line (in `line`)."""
    path = tmp_path / "odd.py"
    path.write_text("\n".join(program_text(body)))
    return [sys.executable, str(path)]


@pytest.mark.parametrize(
    "body, said",
    [
        ("sys.exit(3)", "exit code 3"),
        ("sys.stderr.write('out of memory\\n'); sys.exit(1)", "out of memory"),
        ("import os; os.kill(os.getpid(), 11)", "ended (exit code -11)"),
        ("print('Segmentation fault', flush=True)", "printed rubbish"),
        ("print('[1, 2]', flush=True)", "printed rubbish"),
        ("[print('still computing', flush=True) for _ in range(200)]", "no answer in 100 lines"),
        ("print('{}', flush=True)", "printed rubbish: '{}"),
        ("print(json.dumps({'id': json.loads(line)['id'], 'out': 5}), flush=True)", "not an object"),
        ("print(json.dumps({'id': json.loads(line)['id'], 'error': 'no idea'}), flush=True)", "no idea"),
        ("print(json.dumps({'id': json.loads(line)['id'], 'out': {'F_N': float('nan')}}), flush=True)", "not a finite"),
        ("time.sleep(60)", "no answer within"),
        ("print(9 * '[' * 1000, flush=True)", "rubbish"),
        ("while True: print('x' * 100_000)", "no answer in 100 lines"),
        ("sys.stdout.write('[' + '[],' * 6_000_000); sys.stdout.flush()", "without an end of line"),
        ("while True: sys.stderr.write('x' * 100_000)", "no answer within"),
        (
            "print(json.dumps({'id': json.loads(line)['id'], 'error': chr(27) + '[2J' + chr(0xd800)}), flush=True)",
            "[2J",
        ),
    ],
)
def test_what_a_program_does_in_place_of_answering_is_told(tmp_path, body, said):
    backend = Executable(program(tmp_path, body), small=2.0, long=2.0)
    try:
        v = verdict(judge(backend, ["L1"]))
    finally:
        backend.close()
    assert not v.passed
    assert any(said in c.note for c in v.findings.failures), {c.note for c in v.findings.failures}
    # a terminal and a file can take the words, whatever the program said
    assert all(c.note.isprintable() for c in v.findings.failures)
    terminal.text(v).encode()
    ElementTree.fromstring(junit(v))


def test_a_program_that_dies_at_one_question_is_started_again(tmp_path):
    # It dies at the second question and answers all others: one failure, not all that follow.
    body = """
        q = json.loads(line)
        if q["id"] == "q2":
            sys.exit(1)
        print(json.dumps({"id": q["id"], "out": {"F_N": 0.0}}), flush=True)
    """
    backend = Executable(program(tmp_path, body), small=5.0)
    assert backend._run({"cmd": "run", "id": "q1", "piece": "contact_law", "in": {}}, 5.0) == {"F_N": 0.0}
    with pytest.raises(Misbehaved):
        backend._run({"cmd": "run", "id": "q2", "piece": "contact_law", "in": {}}, 5.0)
    assert backend._run({"cmd": "run", "id": "q3", "piece": "contact_law", "in": {}}, 5.0) == {"F_N": 0.0}
    backend.close()


def test_who_does_not_start_a_second_time_is_not_waited_for_at_every_question(tmp_path, monkeypatch):
    """It ends at its first question and hangs when it is started again: waited for three times a piece, no more."""
    mark = tmp_path / "mark"
    path = tmp_path / "once.py"
    path.write_text(
        "import pathlib, sys, time\n"
        f"mark = pathlib.Path({str(mark)!r})\n"
        "if mark.exists(): time.sleep(60)\n"
        "mark.touch()\n"
        "sys.stdin.readline()\n"
        """print('{"protocol":1,"capabilities":["contact_law"]}', flush=True)\n"""
        "sys.stdin.readline()\n"
    )
    monkeypatch.setattr(executable, "START", 20.0)  # the first start may be slow
    backend = Executable([sys.executable, str(path)], small=5.0)
    monkeypatch.setattr(executable, "START", 0.5)
    begun = time.monotonic()
    findings = judge(backend, ["L1"])
    # about a hundred questions to contact_law, of which three are waited for
    assert time.monotonic() - begun < 30
    assert sum("no answer within" in c.note for c in findings.failures) > 0
    assert sum("not asked any more" in c.note for c in findings.failures) > 50


@pytest.mark.parametrize("facts", ['"capabilities":5', '"capabilities":"rotate"', '"name":["x"],"precision":{}'])
def test_strange_facts_are_no_harm(tmp_path, facts):
    path = tmp_path / "strange.py"
    path.write_text(f"import sys\nsys.stdin.readline()\nprint('{{\"protocol\":1,{facts}}}', flush=True)\ninput()\n")
    backend = Executable([sys.executable, str(path)])
    try:
        assert not judge(backend, ["L1"]).checks
    finally:
        backend.close()


def test_who_is_silent_three_times_is_not_asked_again(tmp_path):
    backend = Executable(program(tmp_path, "time.sleep(60)"), small=0.2)
    notes = []
    for i in range(5):
        with pytest.raises(Misbehaved) as told:
            backend._run({"cmd": "run", "id": str(i), "piece": "contact_law", "in": {}}, 0.2)
        notes.append(str(told.value))
    assert sum("no answer" in n for n in notes) == 3 and sum("not asked any more" in n for n in notes) == 2


def test_what_a_program_has_started_is_ended_with_it(tmp_path):
    # A shell that waits for a child, as around mpirun: the child holds the pipes.
    path = tmp_path / "wrapper.sh"
    lines = ["read l", f"echo '{ONLY_RUNS}'", "read l", "sleep 300 & echo $! > child", "wait"]
    path.write_text("\n".join(lines))
    begin = time.monotonic()
    backend = Executable(["sh", "-c", f"cd {tmp_path} && . ./wrapper.sh"], small=0.5)
    v = verdict(judge(backend, ["L5s"]), backend)
    backend.close()
    assert time.monotonic() - begin < 20
    assert v.rule is None and "no answer within 0.5 s" in v.check.note and not v.neighbours
    child = int((tmp_path / "child").read_text())
    deadline = time.monotonic() + 5
    while running(child) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not running(child)


def test_who_is_interrupted_leaves_no_program_behind(tmp_path, monkeypatch):
    from rockref.commands import conform
    from rockref.conformance.judge import findings as judging

    backend = Executable(program(tmp_path, "time.sleep(300)"))
    child = backend.process.pid

    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(judging, "judge", interrupted)
    with pytest.raises(KeyboardInterrupt):
        conform._judge(backend, ["L1"], None, False, None, 1, {})
    assert not running(child)


def running(pid):
    """Whether a process is there and not only waits to be buried."""
    stat = Path(f"/proc/{pid}/stat")
    return stat.exists() and stat.read_text().rpartition(")")[2].split()[0] != "Z"


def test_short_runs_are_given_the_time_of_small_questions(tmp_path):
    backend = Executable(program(tmp_path, "time.sleep(60)"), small=0.3, long=60.0)
    begin = time.monotonic()
    with pytest.raises(Misbehaved, match="no answer within 0.3 s"):
        backend.simulate(problem_of(vectors.layer("L5s")[0].inputs))
    backend.close()
    assert time.monotonic() - begin < 20


def test_one_missing_answer_speaks_of_no_rule(tmp_path):
    body = """
        from rockref.conformance.backends.json_lines import answer, line as written
        from rockref.conformance.backends.law import NumpyEngine
        q = json.loads(line)
        print(written(answer(NumpyEngine(), q) if q["id"] != "q1" else {"id": "?"}), end="", flush=True)
    """
    text = "\n".join(program_text(body)).replace('["contact_law"]', '["simulate"]')
    (tmp_path / "odd.py").write_text(text)
    backend = Executable([sys.executable, str(tmp_path / "odd.py")])
    v = verdict(judge(backend, ["L5s"]))
    backend.close()
    assert v.status == "FAIL" and v.rule is None and "answer that is missing" in v.says


@pytest.mark.parametrize("command", [["./no_such_program"], [sys.executable, "-c", "print('hello')"], ["true"]])
def test_what_does_not_start_is_unusable(command):
    with pytest.raises(InputError, match="E-BACKEND"):
        Executable(command)


def test_another_protocol_is_refused_and_its_program_ended(monkeypatch):
    ended = []
    monkeypatch.setattr(executable, "_end_group", lambda process: (ended.append(process), process.kill()))
    with pytest.raises(InputError, match="protocol 2"):
        Executable([sys.executable, "-c", "input(); print('{\"protocol\": 2}', flush=True); input()"])
    assert len(ended) == 1 and ended[0].wait(10) != 0


def test_a_banner_and_other_chatter_are_passed_over_with_a_remark(tmp_path):
    path = tmp_path / "chatty.py"
    text = """
        print("Welcome to the simulator", flush=True)
        from rockref.conformance.backends.json_lines import serve
        from rockref.conformance.backends.law import NumpyEngine
        serve(NumpyEngine())
    """
    path.write_text(textwrap.dedent(text))
    backend = Executable([sys.executable, str(path)])
    findings = judge(backend, ["L0"])
    backend.close()
    assert not findings.failures and any("Welcome" in r for r in findings.remarks)


def test_the_tutorial_in_python_is_a_program_too():
    example = Path(__file__).resolve().parents[4] / "examples/backend_numpy.py"
    backend = Executable([sys.executable, str(example)])
    findings = judge(backend, ["L0", "L1", "L2", "L3"])
    backend.close()
    assert len(findings.checks) > 300 and not findings.failures


def test_where_nothing_is_answered_no_rule_is_blamed(tmp_path):
    backend = Executable(program(tmp_path, "print(json.dumps({'id': json.loads(line)['id'], 'out': {}}), flush=True)"))
    v = verdict(judge(backend, ["L1"]))
    backend.close()
    assert v.status == "FAIL" and v.rule is None and "No question was answered" in v.says


def ended(words):
    """The exit code of a command."""
    with pytest.raises(SystemExit) as end:
        cli.main(words)
    return end.value.code


def test_a_program_may_have_options_of_its_own(tmp_path, capsys):
    law = "from rockref.conformance import NumpyEngine, serve; "
    asked = ["conform", "exe", "--layers", "L7", sys.executable, "-W", "ignore", "-c", law + "serve(NumpyEngine())"]
    assert ended(asked) == 0
    assert "PASS" in capsys.readouterr().out
    # Ours may stand behind the program too, as long as it has had none of its own.
    assert ended(["conform", "exe", sys.executable, "--layers", "L7", "-c", law + "serve(NumpyEngine())"]) == 0
    assert "layers L7" in capsys.readouterr().out


OWN = {"--quick", "--timeout", "--output", "-o", "--json"}


@pytest.mark.parametrize(
    "words, found",
    [
        ("exe ./mine --quick", "exe ./mine --quick"),
        ("exe ./mine --timeout=60 -o out", "exe ./mine --timeout=60 -o out"),
        ("--quick exe python3 -u mine.py --json", "--quick exe python3 -- -u mine.py --json"),
        ("exe --quick python3 -u mine.py", "exe --quick python3 -- -u mine.py"),
        ("exe ./mine -- --quick -u", "exe ./mine -- --quick -u"),
        ("exe ./mine --quik", "exe ./mine --quik"),  # a slip: the parser says so
        ("exe ./mine --depth=3", "exe ./mine -- --depth=3"),
        ("numpy --nonsense", "numpy --nonsense"),
    ],
)
def test_words_from_the_first_strange_option_on_are_the_programs(words, found):
    assert " ".join(parted(words.split(), OWN)) == found


def test_a_slip_in_an_option_of_ours_is_told(capsys):
    assert ended(["conform", "exe", "./mine", "--quik"]) == 2
    assert "--quik" in capsys.readouterr().err
