"""A release can be made: wheel and source archive install in an empty environment and pass the judge."""

import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

import rockref
from tests.unit.test_house import ROOT, project_files

pytestmark = pytest.mark.slow


def run(*words, folder, code=0):
    # An empty environment hears of no other place to import from.
    env = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    done = subprocess.run([str(w) for w in words], cwd=folder, capture_output=True, text=True, timeout=1800, env=env)
    assert done.returncode == code, (words, done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """`make dist` in a copy of the project, with the environment that is there; returns wheel and source archive."""
    copy = tmp_path_factory.mktemp("project")
    for path in project_files():
        target = copy / path.relative_to(ROOT)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(path, target)
    venv = Path(sys.executable).parents[1]
    run("make", "dist", f"VENV={venv}", "-o", venv / ".stamp", folder=copy)
    (wheel,), (archive,) = (copy / "dist").glob("*.whl"), (copy / "dist").glob("*.tar.gz")
    return wheel, archive


@pytest.fixture(scope="module")
def empty(tmp_path_factory):
    """An environment with nothing in it."""
    folder = tmp_path_factory.mktemp("empty")
    run(sys.executable, "-m", "venv", folder / "venv", folder=folder)
    return folder


def test_what_is_inside(made):
    wheel, archive = made
    inside = zipfile.ZipFile(wheel).namelist()
    for name in ("rockref/py.typed", "rockref/conformance/vectors/v1/MANIFEST.json", "rockref/model/contact.py"):
        assert name in inside
    assert all(name.startswith(("rockref/", "rockref-")) for name in inside)
    names = {name.split("/", 1)[1] for name in tarfile.open(archive).getnames() if "/" in name}
    for name in ("Makefile", "README.md", "CITATION.cff", "tests/conftest.py", "docs/conf.py"):
        assert name in names


@pytest.mark.parametrize("kind", ["wheel", "archive"])
def test_installs_in_an_empty_environment_and_passes_the_judge(made, empty, kind):
    pip = (empty / "venv/bin/python", "-m", "pip", "install", "-qq", "--disable-pip-version-check", "--force-reinstall")
    # the second time only rockref itself is to be replaced
    again = ("--no-deps",) if kind == "archive" else ()
    run(*pip, *again, made[kind == "archive"], folder=empty)
    rock = empty / "venv/bin/rockref"
    assert run(rock, "--version", folder=empty).strip() == f"rockref {rockref.__version__}"
    assert "PASS" in run(rock, "conform", "numpy", "--quick", folder=empty)
    # without the extra `fast` there is no numba, and the law does it
    loaded = run(empty / "venv/bin/python", "-c", "import rockref; print(rockref.__file__)", folder=empty)
    assert str(empty) in loaded
