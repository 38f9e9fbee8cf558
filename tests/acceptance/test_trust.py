"""What rockref does not do: reach a network, run or unpickle what data says, write elsewhere than it was told."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import rockref
from tests.shipped import ROOT

EXPERIMENT = str(ROOT / "data/experiments/mystery-02")
#: The command line in a process that ends at once where something reaches for a network.
ALONE = (sys.executable, "-c", """
import os, sys
def hook(event, arguments):
    if event.startswith("socket.") and event != "socket.__new__" or event.startswith(("urllib.", "ftplib.", "http.")):
        os.write(2, f"NETWORK {event} {arguments}".encode())
        os._exit(77)
sys.addaudithook(hook)
from rockref.cli import main
main()
""")  # fmt: skip


def alone(folder: Path, *words: str) -> subprocess.CompletedProcess:
    return subprocess.run((*ALONE, *words), cwd=folder, capture_output=True, text=True)


@pytest.mark.parametrize(
    "words",
    [
        ("simulate", "--duration", "0.1", "-o", "response.csv"),
        ("conform", "numpy", "--layers", "L0,L1", "--html", "page.html"),
        ("effects", "quadratic_drag"),
        pytest.param(("compare", EXPERIMENT, "--report", "page"), marks=pytest.mark.slow),
        pytest.param(("conform", "numpy", "--quick"), marks=pytest.mark.slow),
        pytest.param(("fit", EXPERIMENT, "-o", "model.toml"), marks=pytest.mark.slow),
    ],
    ids=lambda words: words[0],
)
def test_no_network_at_run_time(tmp_path, words):
    done = alone(tmp_path, *words)
    assert done.returncode in (0, 1), done.stderr


def test_who_reaches_for_a_network_is_seen():
    code = ALONE[2].replace("from rockref.cli import main\nmain()", "import socket\nsocket.create_connection(('', 9))")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 77 and "NETWORK socket." in done.stderr


#: Names whose call makes objects or runs code out of text, and where they are: our own modules, a user's effect and his
#: backend, which he has named.
RUNS = {"eval", "exec", "compile", "exec_module", "__import__", "import_module", "Unpickler", "allow_pickle"}
MAY = {
    ("rockref/cli.py", "import_module"),
    ("rockref/effects/user.py", "exec_module"),
    ("rockref/conformance/backends/load.py", "exec_module"),
    ("rockref/conformance/backends/load.py", "import_module"),
    # Names that stand in the package's own text: its verbs and doors, and its adapters of engines.
    ("rockref/__init__.py", "import_module"),
    ("rockref/conformance/__init__.py", "import_module"),
    ("rockref/conformance/reports/page.py", "import_module"),
    ("rockref/conformance/physics/adapter.py", "import_module"),
}
#: Modules by which data could become objects, or reach a network.
MODULES = {"pickle", "cPickle", "dill", "marshal", "shelve", "yaml", "socket", "urllib.request", "http", "requests"}


def names_called(tree: ast.AST) -> set[str]:
    """Names that are called without a point, or as the last part; attributes that are arguments by name."""
    found = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            bare = node.func.id if isinstance(node.func, ast.Name) else getattr(node.func, "attr", "")
            # re.compile, jit.compile and the like are methods of their modules
            found.add(bare if isinstance(node.func, ast.Name) or bare != "compile" else "")
            found |= {word.arg or "" for word in node.keywords}
    return found


def test_no_text_is_run_but_what_a_user_names():
    seen = set()
    for path in sorted((ROOT / "rockref").rglob("*.py")):
        tree, name = ast.parse(path.read_text(encoding="utf-8")), path.relative_to(ROOT).as_posix()
        seen |= {(name, word) for word in names_called(tree) & RUNS}
        for node in ast.walk(tree):
            modules = [a.name for a in node.names] if isinstance(node, ast.Import) else []
            modules += [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            assert not MODULES & set(modules), f"{name} imports {modules}"
    assert seen == MAY


def test_the_law_is_simulated_without_a_folder_to_write_to(tmp_path, monkeypatch):
    """Nothing is written where nobody asked for a file."""
    monkeypatch.chdir(tmp_path)
    rockref.simulate(rockref.Model.table_3_1(), duration=1e-3, output_rate=1000.0, engine="numpy")
    assert not list(tmp_path.iterdir())
