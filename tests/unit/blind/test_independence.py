"""The blind test's simulator shares no code with what it tests: by its text, and by what it loads."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import rockref.blind as blind

FOLDER = Path(blind.__file__).parent
OWN = "rockref.blind."
#: Everything that makes an experiment folder: the simulator, and of the cases what draws and writes one.
DRAWING = ("blocks", "drawing", "faulty", "generator", "hidden", "hidden_contact", "unlisted", "plan", "scaling")
SIMULATOR = tuple(sorted(path.stem for path in (FOLDER / "simulator").glob("*.py")))
ALLOWED = {"numpy", "numba"} | set(sys.stdlib_module_names)


def imports(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "a relative import hides where it goes"
            module = node.module or ""
            names |= {f"{module}.{alias.name}" if module.count(".") == 2 else module for alias in node.names}
    return names


def assert_imports_only(path: Path, neighbours: set[str]) -> None:
    for found in imports(path):
        if found.startswith("rockref"):
            assert found in neighbours, f"{path.name} imports {found}"
        else:
            assert found.partition(".")[0] in ALLOWED


@pytest.mark.parametrize("name", SIMULATOR)
def test_the_simulator_imports_numpy_numba_and_its_folder_only(name):
    assert_imports_only(FOLDER / "simulator" / f"{name}.py", {f"{OWN}simulator.{n}" for n in SIMULATOR})


@pytest.mark.parametrize("name", DRAWING)
def test_drawing_a_case_needs_the_simulator_and_its_neighbours_only(name):
    own = {f"{OWN}simulator.{n}" for n in SIMULATOR} | {f"{OWN}cases.{n}" for n in DRAWING}
    assert_imports_only(FOLDER / "cases" / f"{name}.py", own)


def test_nothing_of_the_folder_touches_the_engines():
    for path in FOLDER.rglob("*.py"):
        assert not any(f.startswith("rockref.engines") for f in imports(path)), path.name


def test_it_runs_where_nothing_else_of_the_package_can_be_loaded(tmp_path):
    code = f"""
import importlib.abc, sys, types
for name, folder in (("", "nowhere"), (".blind", {str(FOLDER)!r})):
    module = types.ModuleType("rockref" + name)
    module.__path__ = [folder]
    sys.modules["rockref" + name] = module
class Wall(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.startswith("rockref.") and not name.startswith("rockref.blind"):
            raise AssertionError(name)
sys.meta_path.insert(0, Wall())
from rockref.blind.simulator import compiled
compiled.COMPILED = False  # as Python: the test is of what is loaded, not of speed
from rockref.blind.cases.blocks import RUNS
from rockref.blind.cases.generator import make_case
truth = make_case({str(tmp_path / "case")!r}, ["gyro_scale", "rotor"], 3, runs=RUNS[:1], seconds=0.01)
assert [e["id"] for e in truth["effects"]] == ["gyro_scale", "rotor"]
print(*sorted(m for m in sys.modules if m.startswith("rockref")))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    loaded = {name for name in done.stdout.split() if name.count(".") == 3}
    assert loaded <= {f"{OWN}simulator.{n}" for n in SIMULATOR} | {f"{OWN}cases.{n}" for n in DRAWING}
    assert (tmp_path / "case" / "run01.csv.gz").exists()
