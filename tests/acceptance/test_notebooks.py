"""The notebooks: scripts in the percent format, which run from top to bottom and become notebooks by jupytext."""

import subprocess
import sys

import pytest

from tests.shipped import ROOT

NOTEBOOKS = sorted((ROOT / "examples/notebooks").glob("*.py"))


def test_there_is_one_for_each_reader():
    assert [path.stem for path in NOTEBOOKS] == ["backend_author", "experimenter", "reviewer"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_script_becomes_a_notebook(path):
    jupytext = pytest.importorskip("jupytext")
    cells = jupytext.read(path).cells
    assert cells[0].cell_type == "markdown" and cells[0].source.startswith("# ")
    assert sum(cell.cell_type == "code" for cell in cells) >= 4
    # A cell that only shows something ends in an expression, which a script would not print.
    assert all(cell.source.strip() for cell in cells)


@pytest.mark.slow
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_from_top_to_bottom(path):
    pytest.importorskip("numba")  # the law in NumPy would take minutes for the releases in it
    done = subprocess.run([sys.executable, path], cwd=path.parent, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
