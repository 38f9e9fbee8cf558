"""The search finds the bottom, ends the same after any interruption, and refuses another search's checkpoint."""

import json
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from rockref.identify.search import Settings, search
from rockref.jobs.campaign import campaign
from rockref.model.errors import InputError
from tests.unit.identify import analytic

ROOT = Path(__file__).parents[3]


@pytest.fixture
def here():
    with campaign(1) as work:
        yield work


def test_finds_the_bottom_and_keeps_the_way(here):
    end = search(analytic.bowl, (0.3,), 5, Settings(12, 60, seed=1), here)
    np.testing.assert_allclose(end.u, 0.3, atol=1e-3)
    costs = np.array(end.history.best_cost)
    assert len(costs) == 60 and np.all(np.diff(costs) <= 0), "the best so far never gets worse"
    assert end.cost == costs[-1] == analytic.bowl(0.3, [end.u])[0]
    assert np.all((np.array(end.history.best) >= 0) & (np.array(end.history.best) <= 1))


def test_seeds_give_other_ways(here):
    ends = [search(analytic.bowl, (0.3,), 3, Settings(8, 5, seed=s), here).u for s in (1, 1, 2)]
    np.testing.assert_array_equal(ends[0], ends[1])
    assert not np.array_equal(ends[0], ends[2])


def test_begins_anew_where_it_has_converged(here):
    end = search(analytic.bowl, (0.3,), 2, Settings(8, 150, seed=0), here)
    assert end.history.restarts, "150 generations in two dimensions converge more than once"
    after = end.history.means[end.history.restarts[0]]
    assert np.linalg.norm(np.array(after) - 0.3) > 0.01, "the new start is elsewhere"


@pytest.mark.parametrize("cut", [1, 7, 19])
def test_resumed_ends_as_if_never_interrupted(here, tmp_path, cut):
    whole = search(analytic.bowl, (0.3,), 4, Settings(8, 20, seed=3), here)
    path = tmp_path / "checkpoint.json"

    class Interrupted(Exception):
        pass

    def stop(p):
        if p.generation == cut:
            raise Interrupted

    with pytest.raises(Interrupted):
        search(analytic.bowl, (0.3,), 4, Settings(8, 20, seed=3), here, {"a": 1}, path, report=stop)
    assert len(json.loads(path.read_text())["costs"]) == cut
    again = search(analytic.bowl, (0.3,), 4, Settings(8, 20, seed=3), here, {"a": 1}, path, resume=True)
    np.testing.assert_array_equal(whole.u, again.u)
    assert whole.history.costs == again.history.costs and whole.history.means == again.history.means


def test_killed_at_any_moment_and_resumed_ends_the_same(tmp_path):
    """kill -9 while a generation is computed or written; what is on disk is always whole."""
    command = [sys.executable, "-m", "tests.unit.identify.analytic", str(tmp_path), "0.02"]
    checkpoint, kills = tmp_path / "checkpoint.json", 0

    def evaluated():
        return len(json.loads(checkpoint.read_text())["costs"]) if checkpoint.exists() else 0

    # However fast the machine is: somewhere in the generation after the one that was seen to be written.
    for wait in (0.0, 0.013, 0.031):
        before = evaluated()
        process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL)
        while process.poll() is None and evaluated() == before:
            time.sleep(0.005)
        time.sleep(wait)
        kills += process.poll() is None
        process.kill()
        process.wait()
        assert evaluated() >= before
    end = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert kills >= 1
    fresh = tmp_path / "fresh"
    fresh.mkdir()
    command[3:] = [str(fresh), "0"]
    assert subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout == end


def test_another_search_s_checkpoint_is_refused(here, tmp_path):
    path = tmp_path / "checkpoint.json"
    search(analytic.bowl, (0.3,), 3, Settings(8, 2, seed=1), here, {"targets": "a"}, path)
    with pytest.raises(InputError) as error:
        search(analytic.bowl, (0.3,), 3, Settings(8, 2, seed=1), here, {"targets": "b"}, path, resume=True)
    assert error.value.code == "E-RESUME" and "targets" in error.value.what
    with pytest.raises(InputError) as error:
        search(analytic.bowl, (0.3,), 3, Settings(8, 3, seed=1), here, {"targets": "a"}, path, resume=True)
    assert "settings" in error.value.what


@pytest.mark.parametrize(
    "text", ["", "{}", '{"search": 1', "[1, 2]", '{"search": "a", "costs": []}', '{"search": {}, "costs": 1}']
)
def test_a_broken_checkpoint_is_named(here, tmp_path, text):
    path = tmp_path / "checkpoint.json"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        search(analytic.bowl, (0.3,), 3, Settings(8, 2), here, {}, path, resume=True)
    assert error.value.code == "E-FILE" and str(path) in error.value.where


def test_progress_says_what_a_person_wants_to_know(here):
    seen = []
    search(analytic.bowl, (0.3,), 2, Settings(8, 4), here, report=seen.append)
    assert [p.generation for p in seen] == [1, 2, 3, 4] and seen[-1].generations == 4
    assert seen[-1].seconds_left == 0.0 and seen[0].seconds_left >= 0.0
    assert seen[-1].cost == analytic.bowl(0.3, [seen[-1].u])[0]
