"""The command line: exit codes, errors on one line, help with an example, quick to start."""

import runpy
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest
import typer

from rockref import __version__, cli, commands
from rockref.model.errors import InputError, NumericalError
from tests.command import run


@pytest.fixture
def command_that(monkeypatch):
    """Make `rockref act` the only command; it raises what the test hands over."""

    def install(error):
        def act() -> None:
            raise error

        module = ModuleType("rockref.commands.act")
        module.act = act
        monkeypatch.setitem(sys.modules, "rockref.commands.act", module)
        monkeypatch.setattr(commands, "COMMANDS", {"act": "act.act"})

    return install


def all_commands():
    return sorted(typer.main.get_command(cli.application()).commands.items())


def test_version(capsys):
    code, out, _ = run(capsys, "--version")
    assert code == 0
    assert out.split()[0] == "rockref" and out.split()[1][0].isdigit()


@pytest.mark.parametrize("kind", [InputError, NumericalError])
def test_our_errors_end_with_2_and_one_line(capsys, command_that, kind):
    command_that(kind("E-UNIT", "run01.csv, column wx", "unknown unit 'grad'", "Use deg_s or rad_s."))
    code, out, err = run(capsys, "act")
    assert (code, out) == (2, "")
    assert err == "rockref: run01.csv, column wx: unknown unit 'grad'. Use deg_s or rad_s. [E-UNIT]\n"


def test_interrupt_ends_with_130(capsys, command_that):
    command_that(KeyboardInterrupt())
    code, out, err = run(capsys, "act")
    assert (code, out) == (130, "") and err.startswith("rockref: interrupted") and "start it again" in err


@pytest.mark.parametrize(
    "arguments, words",
    [
        (["blind", "make", "folder"], "Finished cases"),
        (["--version"], "start it again"),
        (["diagnose", "folder"], "start it again"),
    ],
)
def test_an_interrupt_says_what_goes_on_from_where(arguments, words):
    assert words in cli.kept_of(arguments)


def test_the_help_says_whole_sentences(capsys):
    code, out, _ = run(capsys, "--help")
    assert code == 0 and "..." not in out.split("Commands:")[1]
    assert "what it could not tell." in " ".join(out.split())


def test_the_help_of_a_command_names_its_arguments_without_types_of_python(capsys):
    _, out, _ = run(capsys, "new", "--help")
    assert "FOLDER  The experiment folder" in out and "<" not in out and "LOGS......" not in out


def test_errors_of_the_system_name_the_file(capsys, command_that):
    command_that(PermissionError(13, "Permission denied", "out.csv"))
    code, _, err = run(capsys, "act")
    assert code == 2
    assert err.startswith("rockref: out.csv: Permission denied") and "Traceback" not in err


def test_faults_of_ours_keep_their_traceback(command_that):
    command_that(ZeroDivisionError())
    with pytest.raises(ZeroDivisionError):
        cli.main(["act"])


def test_the_package_runs_as_a_module():
    done = subprocess.run([sys.executable, "-m", "rockref", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"rockref {__version__}\n"


def test_the_module_runs_nothing_where_it_is_only_imported(capsys, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["python", "no_such_command"])
    runpy.run_module("rockref.__main__", run_name="imported")
    assert capsys.readouterr() == ("", "")
    with pytest.raises(SystemExit) as end:
        runpy.run_module("rockref.__main__", run_name="__main__")
    assert end.value.code == 2 and "no_such_command" in capsys.readouterr().err


def test_unknown_command_ends_with_2_and_suggests(capsys):
    code, _, err = run(capsys, "docto")
    assert code == 2
    assert "doctor" in err


def test_listed_module_that_is_missing_is_an_error(monkeypatch):
    monkeypatch.setattr(commands, "COMMANDS", {"no": "no_such_command.no"})
    with pytest.raises(ModuleNotFoundError):
        cli.application()


def test_every_module_of_the_folder_is_listed():
    folder = Path(commands.__file__).parent
    assert {path.stem for path in folder.glob("[!_]*.py")} == {
        place.split(".")[0] for place in commands.COMMANDS.values()
    }


@pytest.mark.parametrize("name, command", all_commands())
def test_help_shows_an_example(name, command):
    text = command.get_help(command.make_context(name, [], resilient_parsing=True))
    assert "Example" in text
    assert f"rockref {name}" in text.partition("Example")[2]


def test_help_loads_nothing_heavy():
    # What makes a command line slow to answer is what it imports; the list holds every library that takes a tenth of a
    # second or more.
    script = (
        "import sys\n"
        "from rockref.cli import main\n"
        "try:\n    main(['--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numba', 'scipy', 'pandas', 'matplotlib', 'jinja2', 'dask'} & set(sys.modules)\n"
        "print('heavy:', sorted(heavy), file=sys.stderr)\n"
    )
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "heavy: []" in ended.stderr


def leaves(command, words=()):
    """Every command that does something, with the words that lead to it."""
    if hasattr(command, "commands"):
        return [leaf for name, inner in command.commands.items() for leaf in leaves(inner, (*words, name))]
    return [(words, command)]


LEAST = {"seed": 0, "workers": 1, "examples": 1}
COUNTS = [
    (words, option, LEAST[option.name])
    for words, command in leaves(typer.main.get_command(cli.application()))
    for option in command.params
    if option.name in LEAST
]


@pytest.mark.parametrize("words, option, least", COUNTS, ids=lambda x: " ".join(x) if isinstance(x, tuple) else None)
def test_counts_below_the_least_are_refused_before_the_work(capsys, words, option, least):
    """A negative seed ended a diagnosis in a traceback, half a minute later."""
    code, out, err = run(capsys, *words, option.opts[0], str(least - 1))
    assert (code, out) == (2, "")
    assert option.opts[0] in err and f"greater than or equal to {least}" in err


def test_every_search_has_such_counts():
    assert {"diagnose", "fit", "add", "identify", "sensitivity", "plan"} <= {words[0] for words, *_ in COUNTS}


@pytest.mark.parametrize("words", [("fit",), ("diagnose",), ("add", "quadratic_drag")], ids=lambda words: words[0])
def test_a_model_too_stiff_for_the_steps_of_a_fit_is_refused_before_the_work(capsys, tmp_path, words):
    """K_N in the wrong unit: the fit began where nothing can be computed, and went on from there for minutes."""
    stiff = tmp_path / "stiff.toml"
    stiff.write_text("[parameters]\nK_N_N_m = 6e11\n", encoding="utf-8")
    code, out, err = run(capsys, *words, str(tmp_path), "--model", str(stiff))
    assert (code, out) == (2, "")
    assert f"{stiff}: step: 1e-05 s is too large for the stiffest contact" in err and "[E-STEP]" in err


@pytest.mark.parametrize(
    "words",
    [
        ("identify", "nowhere", "--population", "99999999999"),
        ("sensitivity", "-o", "nowhere", "--trials", "99999999999"),
    ],
    ids=" ".join,
)
def test_counts_that_fill_the_memory_are_refused(capsys, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *words)
    assert (code, out) == (2, "") and words[-2] in err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "words",
    [
        ("compare", ""),
        ("fit", ""),
        ("diagnose", " "),
        ("add", "", "gyro_scale"),
        ("identify", ""),
        ("identify", "experiment", "-o", ""),
        ("sensitivity", "-o", ""),
        ("demo", "--out", ""),
        ("blind", "make", "", "--seed", "1"),
        ("blind", "score", ""),
        ("reproduce", ""),
        ("reproduce", "source", ""),
        ("import", "contactnets", "", "-o", "tosses"),
        ("simulate", ""),
        ("plan", "--model", " "),
        ("diagnose", "nowhere", "--model", ""),
        ("add", "nowhere", "gyro_scale", "--model", ""),
    ],
    ids=" ".join,
)
def test_an_empty_name_is_not_the_current_folder(capsys, tmp_path, monkeypatch, words):
    """A variable that a script did not set would put its files, or look for them, wherever it runs."""
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *words)
    assert (code, out) == (2, "") and "is empty" in err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "words, what",
    [
        (("simulate", "--effect", "plate_pose"), "poses of tosses"),
        (("plan", "--effect", "tag_frame"), "poses of tosses"),
        (("plan", "--effect", "gyro_scale", "--effect", "gyro_scale"), "given twice"),
        (("add", "data/experiments/mystery-08", "plate_pose"), "poses of tosses"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else value,
)
def test_an_effect_that_records_of_a_gyroscope_cannot_show_is_refused(capsys, monkeypatch, words, what):
    """It would have been fitted, or planned for, and have done nothing."""
    monkeypatch.chdir(Path(__file__).resolve().parents[2])
    code, out, err = run(capsys, *words)
    assert (code, out) == (2, "") and what in err and "[E-EFFECT]" in err


@pytest.mark.parametrize(
    "words, code",
    [
        (("conform", "numpy", "--layers", "L0", "--timeout", "-5"), "E-RANGE"),
        (("conform", "numpy", "--layers", "L0", "--timeout", "nan"), "E-RANGE"),
        (("conform", "numpy", "--layers", " , "), "E-LAYER"),
        (("conform", "numpy", "--layers", "L0", "--junit", "folder"), "E-WRITE"),
        (("conform", "numpy", "--layers", "L0", "--html", "nowhere/page.html"), "E-WRITE"),
        (("conform", "zoo", "--quick", "--output", "nowhere/zoo.md"), "E-WRITE"),
        (("effects", "gyro_scale", "--picture", "nowhere/scale.png"), "E-WRITE"),
        (("demo", "--engine", "gpu"), "E-ENGINE"),
        (("diagnose", "nowhere", "-o", "a.toml", "--save-model", "folder/../a.toml"), "E-WRITE"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else value,
)
def test_what_cannot_end_well_is_refused_before_the_work(capsys, tmp_path, monkeypatch, words, code):
    """A link to a folder in the place of a file was replaced, and words before an error looked like a result."""
    (tmp_path / "real").mkdir()
    (tmp_path / "folder").symlink_to("real")
    monkeypatch.chdir(tmp_path)
    status, out, err = run(capsys, *words)
    assert (status, out) == (2, "") and f"[{code}]" in err
    assert (tmp_path / "folder").is_symlink() and sorted(p.name for p in tmp_path.iterdir()) == ["folder", "real"]
