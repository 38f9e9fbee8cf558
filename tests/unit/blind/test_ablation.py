"""The parts of the discoverer that are taken away: what is left is what the program says is left."""

import sys

import numpy as np
import pytest

from rockref.discover.fit import search
from rockref.measure.experiment import load_experiment
from rockref.measure.impacts import main_impacts
from tests.shipped import CONTROL, ROOT

sys.path.insert(0, str(ROOT / "benchmarks"))
import ablation


def test_without_windows_a_run_is_one_piece_to_its_second_main_impact():
    runs = load_experiment(CONTROL).fit_runs()[:2]
    setup = search.Setup(load_experiment(CONTROL), runs, ablation.baseline_model(load_experiment(CONTROL)))
    with ablation.in_one_piece():
        whole = search.windows(setup, search.SHORT)
    assert whole.B == 2 and np.all(whole.start == 0)
    second = [main_impacts(run.t, run.crv).times[1] for run in runs]
    # A sample is a millisecond.
    assert whole.stop / whole.rate == pytest.approx(np.array(second) + ablation.AFTER, abs=1e-3)
    assert search.windows(setup, search.SHORT).B > 50, "and afterwards runs are cut again"


def test_without_varied_runs_one_release_is_left_and_one_of_its_runs_is_held_out(monkeypatch):
    def kept(folder):
        found = load_experiment(folder)
        assert {(run.release_tilt, run.block_turned) for run in found.runs} == {(0.117, 0)}
        assert [run.id for run in found.fit_runs()] == ["01", "02"]
        assert [run.id for run in found.holdout_runs()] == ["03"]

        class Verdict:
            def to_dict(self):
                return {"verdict": "none", "effects": []}

        return Verdict()

    monkeypatch.setattr(ablation, "diagnose", kept)
    assert ablation.no_varied_runs(CONTROL)["verdict"] == "none"


def test_the_table_counts_each_way_by_itself():
    control = {"kind": "control", "false_name": False, "wrong_name": False}
    quiet, loud = control | {"false_alarm": False}, control | {"false_alarm": True, "wrong_name": True}
    lines = ablation.table({"whole": [quiet, quiet], "less": [quiet, loud]})
    assert lines[0] == "| score | whole | less |"
    assert lines[2] == "| controls: false alarms | 0 of 2 | 1 of 2 |"
    assert lines[4] == "| all: wrong name | 0 of 2 | 1 of 2 |"


def test_a_folder_without_diagnosed_cases_is_refused(tmp_path, capsys):
    assert ablation.main([str(tmp_path)]) == 2
    assert "no diagnosed case" in capsys.readouterr().err
