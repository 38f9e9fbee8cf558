"""The vectors as tests of somebody's own suite: what is collected, and what is said of what cannot be used."""

import subprocess
import sys
from pathlib import Path

import pytest

from rockref.conformance import pytest_plugin, vectors
from rockref.conformance.law_backend import NumpyEngine

EXAMPLE = Path(__file__).resolve().parents[3] / "examples/backend_numpy.py"


def suite(folder, *options):
    """A run of pytest in an empty folder."""
    words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--color=no", *options]
    return subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300)


def test_what_cannot_be_used_is_said_in_one_line(tmp_path):
    for option, said in (
        (f"--rockref-backend={EXAMPLE}:Nobody", "E-BACKEND"),
        ("--rockref-profile=float65", "E-PROFILE"),
        ("--rockref-layers=L9", "E-LAYER"),
    ):
        done = suite(tmp_path, f"--rockref-backend={EXAMPLE}:Backend", option)
        assert done.returncode == pytest.ExitCode.USAGE_ERROR and said in done.stderr, done.stdout + done.stderr
        assert "INTERNALERROR" not in done.stdout + done.stderr


def test_a_backend_without_runs_is_unusable(tmp_path):
    (tmp_path / "none.py").write_text("class Backend:\n    pass\n")
    done = suite(tmp_path, "--rockref-backend=none.py:Backend")
    assert done.returncode == pytest.ExitCode.USAGE_ERROR and "simulate" in done.stderr


def test_every_layer_has_its_tests():
    law = NumpyEngine()
    runs = [name for _, name, _ in pytest_plugin.asked(law, "L5", "float64")]
    assert tuple(runs) == vectors.window_names() + vectors.trajectory_names()
    assert tuple(n for _, n, _ in pytest_plugin.asked(law, "L5", "scheme")) == vectors.trajectory_names()
    assert len(pytest_plugin.asked(law, "L6", "float64")) == 8 and len(pytest_plugin.asked(law, "LE", "float64")) > 20
    only = type("Only", (), {"simulate": law.simulate})()
    assert pytest_plugin.asked(only, "L4", "float64")[0][1].endswith("-run")
    assert pytest_plugin.asked(only, "L4", "scheme") == [] == pytest_plugin.asked(only, "LE", "float64")


def test_properties_and_precision_of_the_backend(tmp_path):
    (tmp_path / "mine.py").write_text(
        "from rockref.conformance.law_backend import NumpyEngine\n"
        "import numpy as np\n"
        "class Single(NumpyEngine):\n"
        "    def __init__(self):\n"
        "        super().__init__(np.float32)\n"
        "class Pulls(NumpyEngine):\n"
        "    def contact_law(self, **q):\n"
        "        return super().contact_law(**q) | {'F_N': -1.0}\n"
        "    def effect(self, problem, effect, parameters):\n"
        "        return None\n"
    )
    done = suite(tmp_path, "--rockref-backend=mine.py:Single", "--rockref-layers=L0,L2")
    assert done.returncode == 0, done.stdout
    done = suite(tmp_path, "--rockref-backend=mine.py:Pulls", "--rockref-layers=L6,LE", "-rfs")
    assert "never pulls" in done.stdout and "2 failed" in done.stdout, done.stdout
    assert "is not claimed" in done.stdout
