"""Ctrl-C, as a terminal sends it: what a command says was kept is there, and what it names goes on from it."""

import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.shipped import ROOT

EXPERIMENT = str(ROOT / "data/experiments/mystery-08")
ROCKREF = str(Path(sys.executable).with_name("rockref"))


def interrupted(folder, after, *words):
    """Exit code and standard error of a command that is interrupted when it says `after`."""
    process = subprocess.Popen(
        (ROCKREF, *words), cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
        start_new_session=True, env={**os.environ, "ROCKREF_CACHE": str(folder / "kept")},
        # A shell has its background jobs ignore Ctrl-C, and children inherit that.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )  # fmt: skip
    said = ""
    for line in process.stderr:
        said += line
        if after in line:
            os.killpg(process.pid, signal.SIGINT)
            break
    said += process.communicate(timeout=120)[1]
    assert "Traceback" not in said, said
    return process.returncode, said


@pytest.mark.parametrize(
    "after, words",
    [
        ("simulating", ("compare", EXPERIMENT, "--engine", "numpy", "--report", "page")),
        ("1/7 simulating", ("plan", "--runs", "0.117x2,0.09", "-e", "gyro_scale", "-o", "plan.json")),
    ],
)
def test_what_keeps_nothing_says_so_and_leaves_no_file(tmp_path, after, words):
    code, said = interrupted(tmp_path, after, *words)
    assert code == 130 and "nothing is kept" in said and list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_fit_starts_from_what_an_interrupted_diagnosis_has_kept(tmp_path):
    code, said = interrupted(tmp_path, "4/7", "diagnose", EXPERIMENT, "--report", "page")
    assert code == 130 and "without --fresh, goes on with the search after stage S2" in said
    (kept,) = (tmp_path / "kept").glob("*.json")
    fits = len(json.loads(kept.read_text())["fits"])
    assert f"Kept: {fits} fit" in said and not (tmp_path / "page").exists()
    code, said = interrupted(tmp_path, "going on after stage S2", "diagnose", EXPERIMENT, "-v")
    assert code == 130
    code, said = interrupted(tmp_path, "from what was found before", "fit", EXPERIMENT, "-v")
    assert code == 130 and "The same command, without --fresh, starts from what was kept." in said
