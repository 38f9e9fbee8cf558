"""What the README and the documentation tell a reader to type is typed here."""

import itertools
import json
import os
import re
import shlex
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from rockref import cli
from tests.shipped import ROOT

#: Pages that `make docs` makes of tables and code; they may be there or not.
MADE = ("review.md", "blind_history.md", "errors.md", "figures.md", "zoo.md")
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted(p for p in (ROOT / "docs").rglob("*.md") if "_build" not in p.parts and p.name not in MADE),
]
#: Examples that a test of this file runs, and where the others are run.
ALONE = ("compare_models", "judge_a_backend", "overview_picture")
ELSEWHERE = {
    "find_a_missing_effect": "docs/tutorial/find_a_missing_effect.md",
    "backend_numpy": "tests/unit/conformance/judge/test_findings.py",
    "my_effect": "docs/howto/own_effect.md",
    "own_experiment": "docs/howto/own_experiment.md",
    "review_the_physics": "docs/tutorial/review_the_physics.md",
}
#: Commands that search or fit take minutes each; `make` targets and installations are the test run itself.
SLOW = {"fit", "diagnose", "add", "identify", "sensitivity", "plan", "blind", "compare", "reproduce", "demo"}
SHELLS = ("sh", "bash", "console")
JUDGE = ROOT / "docs/tutorial/judge_your_backend.md"
OWN_EXPERIMENT = ROOT / "docs/howto/own_experiment.md"


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def fenced(page):
    """The fenced blocks of a page in order: language and contents, without their indentation."""
    found = re.findall(r"^( *)```(\w+)[^\n]*\n(.*?)^ *```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)
    return [(kind, re.sub(rf"^{indent}", "", text, flags=re.MULTILINE)) for indent, kind, text in found]


def blocks(page, languages):
    """Contents of the fenced blocks of a page in one of the languages."""
    return [text for kind, text in fenced(page) if kind in languages]


def commands_in(block):
    """The commands in a shell block: of a console block the lines with a prompt."""
    block = block.replace("\\\n", " ")
    lines = [line.removeprefix("$ ") for line in block.splitlines() if line.startswith("$ ")] or block.splitlines()
    return [words for line in lines if (words := shlex.split(line.replace(".venv/bin/", ""), comments=True))]


def commands_of(page):
    """The commands in the shell blocks of a page."""
    return [words for block in blocks(page, SHELLS) for words in commands_in(block)]


def too_long(page):
    """Commands that a page shows and nobody waits for: those in blocks of plain text."""
    lines = [line for block in blocks(page, ("text",)) for line in block.splitlines()]
    return [shlex.split(line, comments=True) for line in lines if re.match(r"rockref [a-z]", line)]


def mentioned(page):
    """`rockref ...` in running text that is whole: options and names, no capitals that stand for something."""
    text = re.sub(r"^ *```.*?^ *```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    for span in re.findall(r"`(rockref [^`\n]+)`", text):
        if not re.search(r"\b[A-Z]{3,}\b|[|…<>{}]|\.\.\.", span):
            yield shlex.split(span)


EVERY = [(page, words) for page in PAGES for words in commands_of(page) + too_long(page)]
MENTIONED = [(page, words) for page in PAGES for words in mentioned(page)]


def labelled(pairs):
    return [pytest.param(page, words, id=f"{name_of(page)}: {' '.join(words)}") for page, words in pairs]


def parses(words):
    """Make the command line understand these words, without running anything; it raises what it does not."""
    words = list(itertools.takewhile(lambda word: word not in (">", "<", "|"), words))
    group = typer_command()
    context = group.make_context("rockref", words)
    name, command, rest = group.resolve_command(context, [*context._protected_args, *context.args])
    command.make_context(name, rest, parent=context)


@cache
def typer_command():
    import typer.main

    return typer.main.get_command(cli.application())


def test_there_is_something_to_type():
    assert len(EVERY) > 20
    assert len(MENTIONED) > 5


@pytest.mark.parametrize("page, words", labelled(EVERY + MENTIONED))
def test_commands_and_options_are_there(page, words, capsys):
    """Every command, also those that take too long to be run."""
    if words[0] == "make":
        targets = re.findall(r"^([a-z-]+):.*##", (ROOT / "Makefile").read_text(), re.MULTILINE)
        assert all(target in targets for target in words[1:] if "=" not in target)
    if words[0] == "rockref":
        try:
            parses(words[1:])
        except Exception as e:
            # --help and --version end the command line with Exit; in running text a command may stand without arguments
            fine = ("Exit",) if (page, words) in EVERY else ("Exit", "MissingParameter")
            assert type(e).__name__ in fine, getattr(e, "message", e)


def typed(words, folder, **more):
    if {"<", ">", "|"} & set(words):
        words = ["sh", "-c", " ".join(w if w in ("<", ">", "|") else shlex.quote(w) for w in words)]
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"PATH": path, "MPLBACKEND": "Agg", "COLUMNS": "110"}
    return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, timeout=1800, **more)


@pytest.fixture
def place(tmp_path):
    """A folder that looks like a checkout to the commands of the pages."""
    for name in ("data", "examples", "README.md", "pyproject.toml"):
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


def runnable(page):
    return [words for words in commands_of(page) if words[0] == "rockref"]


def is_slow(page):
    """Minutes for a page that searches, fits, judges, or runs an own effect in NumPy; others stay in `make test`."""
    if page == OWN_EXPERIMENT:  # two seconds of four short runs
        return False
    return any(words[1] in SLOW | {"conform"} or ".py:" in " ".join(words) for words in runnable(page))


def pages_that(have, slow):
    """Parameters: the pages that have something, marked slow where they are."""
    marks = [pytest.mark.slow]
    return [pytest.param(page, id=name_of(page), marks=marks if slow(page) else []) for page in PAGES if have(page)]


def followed(words):
    """Commands that are typed: of rockref, the compiler, what it makes, the examples, and a backend's tests."""
    own = words[0] in ("rockref", "cc") or words[0].startswith("./")
    return own or words[:1] == ["python"] or words[:2] == ["pytest", "--rockref-backend"]


def is_program(block):
    """Python that can be run as it stands, and not the change of a line that a page asks for."""
    return re.match(r"(import|from) ", block) is not None


def follow(page, place):
    """Type what the page says, in its order; where it shows what is printed, those lines have to be there."""
    said = None
    for kind, block in fenced(page):
        if kind == "text" and said is not None and page != JUDGE:  # whose reader edits a file: below
            assert [line for line in block.splitlines() if line != "..." and line.strip() not in said] == []
        said = None
        if kind == "python" and is_program(block):
            run_program(block, place)
        for words in filter(followed, commands_in(block) if kind in SHELLS else []):
            done = typed(words, place)
            # 1: what was asked about falls short, which is an answer; 2 would be a command that the page has wrong
            refused = "[E-" in next_text(page, block)
            assert done.returncode in ((2,) if refused else (0, 1)), (words, done.stderr[-2000:])
            assert "Traceback" not in done.stderr, words
            said = [line.strip() for line in (done.stdout + done.stderr).splitlines()]


def next_text(page, block):
    """The block of plain text that follows a block, empty where another kind does."""
    every = fenced(page)
    at = [text for _, text in every].index(block) + 1
    return every[at][1] if at < len(every) and every[at][0] == "text" else ""


def run_program(program, place):
    done = typed([sys.executable, "-W", "error::DeprecationWarning:__main__", "-c", program], place)
    assert done.returncode == 0, (program, done.stderr[-2000:])


@pytest.mark.parametrize("page", pages_that(runnable, is_slow))
def test_commands_of_a_page_in_their_order(page, place):
    """Each page is followed as a reader would, from a folder beside the data."""
    follow(page, place)


def edited(path, line):
    """Make the change of the page in the file: another return line in the function that is named."""
    function = re.search(r"In `mine.py`, in `(\w+)`", JUDGE.read_text(encoding="utf-8"))[1]
    old, new = path.read_text(), line.rstrip("\n")
    changed = re.sub(rf"(def {function}\(.*?\n)    return [^\n]*", lambda m: m[1] + new, old, count=1, flags=re.DOTALL)
    assert changed != old
    path.write_text(changed)


@pytest.mark.slow
def test_the_page_of_the_judge_says_what_the_judge_says(place):
    """All but the long runs, with the change that the page asks for: who passes, who fails, and with which rule."""
    verdicts, told = [], ""
    for kind, block in fenced(JUDGE):
        if kind == "python":
            edited(place / "mine.py", block)
        for words in filter(followed, commands_in(block) if kind in SHELLS else []):
            if words[1:] == ["conform", "mine.py:Backend"]:
                continue
            done = typed(words, place)
            if words[0] == "pytest":
                assert done.returncode == 1, words  # the mistake of the page is still there
            elif words[0] == "rockref" and words[2] not in ("example", "export"):
                verdicts.append((done.returncode, done.stdout.splitlines()[-1].split(" (not")[0].split(" (quick")[0]))
                told = told or (done.stdout if done.returncode else "")
            else:
                assert done.returncode == 0, (words, done.stderr[-2000:])
    fine, wrong = (0, "PASS"), (1, "FAIL (T3)")
    assert verdicts == [fine, fine, wrong, fine, wrong, fine]
    shown = next(block for kind, block in fenced(JUDGE) if kind == "text").splitlines()
    assert [line for line in shown if line != "..." and line not in told.splitlines()] == []


@pytest.mark.slow
def test_the_sentences_of_the_tutorial_are_those_of_the_command(place):
    """What is quoted on the page is printed, word for word, of one of the experiments that it names."""
    page = (ROOT / "docs/tutorial/where_does_it_fail.md").read_text(encoding="utf-8")
    quoted = [" ".join(q.replace("\n> ", " ").split()) for q in re.findall(r"^> (.*(?:\n> .*)*)", page, re.MULTILINE)]
    done = [typed(["rockref", "compare", f"data/experiments/mystery-{n}"], place) for n in ("03", "04", "05")]
    said = " ".join(" ".join(d.stdout.split()) for d in done)
    assert len(quoted) > 3
    assert [sentence for sentence in quoted if sentence not in said] == []


def programs(page):
    """Programs of the pages that have no commands, or too slow ones."""
    alone = page.name == "README.md" or not runnable(page)
    return [block for block in blocks(page, ("python",)) if is_program(block)] if alone else []


@pytest.mark.parametrize("page", pages_that(programs, lambda page: page.name != "README.md"))
def test_python_of_a_page(page, place):
    for program in programs(page):
        run_program(program, place)


@pytest.mark.slow
@pytest.mark.parametrize("name", ALONE)
def test_examples_that_no_page_types(name, place):
    """They assert what they show."""
    done = typed([sys.executable, f"examples/{name}.py"], place)
    assert done.returncode == 0, done.stderr[-2000:]


def test_every_example_is_run_by_a_test():
    assert {path.stem for path in (ROOT / "examples").glob("*.py")} == {*ALONE, *ELSEWHERE}
    for name, where in ELSEWHERE.items():
        assert f"examples/{name}.py" in (ROOT / where).read_text(encoding="utf-8")


def test_the_dialogue_of_the_page_is_that_of_the_program(place):
    """Questions stand at the margin, the answers of the tutorial in C are set in."""
    (dialogue,) = blocks(ROOT / "docs/howto/own_backend.md", ("none",))
    questions = "".join(line + "\n" for line in dialogue.splitlines() if not line.startswith(" "))
    answers = [json.loads(line) for line in dialogue.splitlines() if line.startswith(" ")]
    for words in (["rockref", "conform", "example", "c", "-o", "mine.c"], ["cc", "-o", "mine", "mine.c", "-lm"]):
        assert typed(words, place).returncode == 0
    done = typed(["./mine"], place, input=questions)
    assert [json.loads(line) for line in done.stdout.splitlines()] == answers


@pytest.mark.parametrize("command", ["simulate", "compare", "diagnose", "fit", "add", "conform", "identify", "effects"])
def test_examples_of_the_help_are_understood(command, capsys):
    with pytest.raises(SystemExit):
        cli.main([command, "--help"])
    # an example may go on on the next line
    text = capsys.readouterr().out.split("Example")[1].split("Arguments:")[0].split("Options:")[0]
    lines = [line.strip() for line in text.splitlines() if line.strip().startswith("rockref ")]
    assert lines
    for line in lines:
        try:
            parses(shlex.split(line)[1:])
        except Exception as e:
            assert type(e).__name__ == "Exit", (line, getattr(e, "message", e))
