"""The generator of the blind test shares no code with what it tests: by its text, and by what it loads."""

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import rockref.discover.blind as blind

FOLDER = Path(blind.__file__).parent
OWN = "rockref.discover.blind."
#: Everything that makes an experiment folder.
GENERATOR = (
    "compiled", "slots", "contact", "loads", "kernel", "world", "posture", "recorder", "drawing", "hidden_contact",
    "hidden", "outsiders", "generator", "plan",
)  # fmt: skip
ALLOWED = {"numpy", "numba"} | set(sys.stdlib_module_names)


def imports(path: Path) -> set[str]:
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, "a relative import hides where it goes"
            module = node.module or ""
            names |= {f"{module}.{alias.name}" if module + "." == OWN else module for alias in node.names}
    return names


@pytest.mark.parametrize("name", GENERATOR)
def test_a_file_of_the_generator_imports_numpy_numba_and_its_neighbours_only(name):
    for found in imports(FOLDER / f"{name}.py"):
        if found.startswith(OWN):
            assert found.removeprefix(OWN) in GENERATOR
        else:
            assert found.partition(".")[0] in ALLOWED


def test_the_generator_is_all_that_making_a_case_needs():
    # making.py makes the cases; of this folder it may reach the generator, and what seals.
    reached = {f.removeprefix(OWN) for f in imports(FOLDER / "making.py") if f.startswith(OWN)}
    assert reached <= {"generator", "plan", "sealing"}


def test_no_other_file_of_the_folder_touches_the_engines():
    for path in FOLDER.glob("*.py"):
        assert not any(f.startswith("rockref.engines") for f in imports(path)), path.name


def test_it_runs_where_nothing_else_of_the_package_can_be_loaded(tmp_path):
    code = f"""
import importlib.abc, sys, types
for name, folder in (("", "nowhere"), (".discover", "nowhere"), (".discover.blind", {str(FOLDER)!r})):
    module = types.ModuleType("rockref" + name)
    module.__path__ = [folder]
    sys.modules["rockref" + name] = module
class Wall(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name.startswith("rockref.") and not name.startswith("rockref.discover.blind"):
            raise AssertionError(name)
sys.meta_path.insert(0, Wall())
from rockref.discover.blind import compiled
compiled.COMPILED = False  # as Python: the test is of what is loaded, not of speed
from rockref.discover.blind.generator import RUNS, make_case
truth = make_case({str(tmp_path / "case")!r}, ["gyro_scale", "rotor"], 3, runs=RUNS[:1], seconds=0.01)
assert [e["id"] for e in truth["effects"]] == ["gyro_scale", "rotor"]
print(*sorted(m for m in sys.modules if m.startswith("rockref")))
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert set(done.stdout.split()) - {"rockref", "rockref.discover", OWN[:-1]} <= {OWN + name for name in GENERATOR}
    assert (tmp_path / "case" / "run01.csv.gz").exists()
