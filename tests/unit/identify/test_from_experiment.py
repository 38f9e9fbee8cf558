"""An identification from an experiment folder: killed and resumed it has the same record; holdouts are in the table."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rockref.identify.from_experiment import answered, question
from rockref.identify.polish import Effort
from rockref.identify.search import Settings
from rockref.jobs.campaign import campaign
from rockref.model.errors import InputError
from tests.shipped import two_runs

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def control(tmp_path_factory):
    """A fit run and a holdout run of the control experiment."""
    return two_runs(tmp_path_factory.mktemp("two"))


@pytest.mark.slow
def test_killed_and_resumed_gives_the_same_record(control, tmp_path):
    pytest.importorskip("numba")

    def command(folder):
        folder.mkdir(exist_ok=True)
        return [sys.executable, "-m", "tests.unit.identify.short_identification", str(control), str(folder)]

    whole = subprocess.run(command(tmp_path / "a"), cwd=ROOT, capture_output=True, text=True, check=True).stdout
    checkpoint = tmp_path / "b" / "search.json"
    process = subprocess.Popen(command(tmp_path / "b"), cwd=ROOT, stdout=subprocess.DEVNULL)
    while process.poll() is None and not (checkpoint.exists() and '"cost"' in checkpoint.read_text()):
        time.sleep(0.02)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    assert 1 <= len(json.loads(checkpoint.read_text())["costs"]) < 12, "it was killed on the way"
    again = subprocess.run(command(tmp_path / "b"), cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert again == whole
    record = json.loads(again)
    assert [r["use"] for r in record["runs"]] == ["fit", "holdout"]
    assert record["seed"] == 3 and record["versions"]["cmaes"] and len(record["inputs"]) >= 2


@pytest.mark.slow
def test_the_number_of_workers_changes_no_bit(control, tmp_path, monkeypatch):
    """In this process and in three: checkpoints, record, model; search, least squares, a round on signals."""
    pytest.importorskip("numba")
    monkeypatch.setattr("rockref.identify.identification.ROUND_GENERATIONS", 2)
    ends = []
    for workers in (1, 3):
        folder = tmp_path / str(workers)
        folder.mkdir()
        effort = Effort(windows=(), steps=1, moves=0)
        with campaign(workers) as work:
            record, model = answered(question(control), Settings(5, 2, seed=5), work, folder, effort=effort, rounds=1)
        model.save(folder / "model.toml")
        ends.append(json.dumps(record).encode() + b"".join(p.read_bytes() for p in sorted(folder.iterdir())))
        assert {p.name for p in folder.iterdir()} == {"model.toml", "search.json", "signals_1.json"}
    assert ends[0] == ends[1]


def test_release_angles_are_counted_from_the_stated_tilt(control, tmp_path):
    """Of an experiment that is not released at the angle of Table 3.1, too: there the search had gone astray."""
    folder = tmp_path / "other_tilt"
    shutil.copytree(control, folder)
    toml = folder / "experiment.toml"
    toml.write_text(toml.read_text().replace("release_tilt_rad = 0.117", "release_tilt_rad = 0.116"))
    asked = question(folder)
    assert asked.chosen[0].tilt == 0.116 == asked.space.model.parameters.theta_0
    assert asked.space.values(np.full(12, 0.5))[-1] == pytest.approx(0.116)


def test_a_number_of_genes_that_is_not_known_is_refused(control):
    with pytest.raises(InputError) as error:
        question(control, genes=13)
    assert error.value.code == "E-KEY" and error.value.where == "--genes"
