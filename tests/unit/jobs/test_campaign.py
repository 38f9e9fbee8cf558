"""Campaigns: the same results from any executor, in order, and nothing lost with a worker."""

import os
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from rockref.identify.candidates import feature_costs
from rockref.identify.genes import space_12
from rockref.identify.search import Settings, search
from rockref.jobs import campaign as campaigns
from rockref.jobs.campaign import campaign, split
from rockref.model.errors import InputError
from tests.shipped import ROOT
from tests.unit.identify import analytic

ITEMS = list(np.random.default_rng(0).random((11, 3)))
WANTED = analytic.bowl(0.3, ITEMS)


@pytest.mark.parametrize("pieces", [1, 2, 3, 11, 50])
def test_split_keeps_order_and_balance(pieces):
    parts = split(list(range(11)), pieces)
    assert [x for p in parts for x in p] == list(range(11))
    sizes = [len(p) for p in parts]
    assert max(sizes) - min(sizes) <= 1 and len(parts) == min(pieces, 11)


def test_here_and_in_processes():
    for workers in (1, 2):
        with campaign(workers) as work:
            assert work(analytic.bowl, (0.3,), ITEMS) == WANTED


def test_an_executor_of_the_caller_is_used_and_left_open():
    with ThreadPoolExecutor(3) as pool:
        with campaign(3, executor=pool) as work:
            assert work(analytic.bowl, (0.3,), ITEMS) == WANTED
        assert pool.submit(lambda: 1).result() == 1


def test_a_killed_process_loses_nothing(tmp_path):
    with campaign(2) as work:
        assert work(analytic.bowl_whose_worker_dies_once, (str(tmp_path / "mark"),), ITEMS) == WANTED
    assert (tmp_path / "mark").exists()


def test_a_process_that_is_killed_between_two_calls_loses_nothing():
    with campaign(2) as work:
        assert work(analytic.bowl, (0.3,), ITEMS) == WANTED
        pool = work.executor
        for pid in list(pool._processes):
            os.kill(pid, signal.SIGKILL)
        patience = time.monotonic() + 30
        while not pool._broken and time.monotonic() < patience:
            time.sleep(0.01)
        assert work(analytic.bowl, (0.3,), ITEMS) == WANTED


def test_a_process_that_hangs_is_ended_and_loses_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(campaigns, "AT_FIRST", 20.0)
    monkeypatch.setattr(campaigns, "LEAST", 5.0)
    monkeypatch.setattr(campaigns, "TIMES", 2.0)
    with campaign(2) as work:
        assert work(analytic.bowl, (0.3,), ITEMS) == WANTED
        hung = list(work.executor._processes)
        assert work(analytic.bowl_whose_worker_hangs, (str(tmp_path / "mark"),), ITEMS) == WANTED
        assert not [pid for pid in hung if _runs(pid)]
        found = work.as_done(analytic.bowl_whose_worker_hangs, (str(tmp_path / "again"),), ITEMS)
        assert sorted(found) == list(enumerate(WANTED))
    assert (tmp_path / "mark").exists() and (tmp_path / "again").exists()


def test_workers_that_hang_always_are_told_and_ended(monkeypatch):
    monkeypatch.setattr(campaigns, "AT_FIRST", 2.0)
    with campaign(2) as work:
        with pytest.raises(InputError, match="did not end, 3 times") as error:
            work(analytic.bowl_whose_worker_hangs, ("",), ITEMS)
        assert error.value.code == "E-WORKERS"


def test_patience_is_ten_times_the_longest_wait_so_far():
    with campaign(1) as work:
        assert work.patience == 4 * 3600
        for longest, patience in ((0.1, 60), (6, 60), (60, 600)):
            work.longest = longest
            assert work.patience == patience


def test_items_are_handed_out_as_they_are_done(tmp_path):
    """A long item does not keep a worker waiting that has the short ones; a killed worker loses nothing."""
    pauses = [2.0, 0.0, 0.0, 0.0]
    with campaign(1) as here, campaign(2) as two:
        assert list(here.as_done(analytic.bowl, (0.3,), ITEMS)) == list(enumerate(WANTED))
        list(two.as_done(analytic.pause, (), [0.0, 0.0]))
        assert [i for i, _ in two.as_done(analytic.pause, (), pauses)][-1] == 0
        found = two.as_done(analytic.bowl_whose_worker_dies_once, (str(tmp_path / "mark"),), ITEMS)
        assert sorted(found) == list(enumerate(WANTED))
    assert (tmp_path / "mark").exists()


def test_workers_end_when_the_process_that_made_them_is_killed():
    code = (
        "import os, signal\n"
        "from rockref.jobs.campaign import campaign\n"
        "from tests.unit.identify import analytic\n"
        "if __name__ == '__main__':\n"
        "    with campaign(2) as work:\n"
        "        work(analytic.bowl, (0.3,), [[0.1], [0.2]])\n"
        "        print(*work.executor._processes, flush=True)\n"
        "        os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, stdout=subprocess.PIPE, text=True, timeout=120)
    pids = [int(pid) for pid in done.stdout.split()]
    assert len(pids) == 2
    patience = time.monotonic() + 30
    while any(map(_runs, pids)) and time.monotonic() < patience:
        time.sleep(0.05)
    assert not [pid for pid in pids if _runs(pid)]


def _runs(pid: int) -> bool:
    """Whether a process is there and is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.slow
def test_dask_cluster_with_a_worker_killed_in_the_middle(tmp_path):
    """A real cluster of two worker processes; one is killed while it computes."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        campaign(dask=cluster.scheduler_address) as work,
    ):
        assert work(analytic.bowl, (0.3,), ITEMS) == WANTED
        assert work(analytic.bowl_whose_worker_dies_once, (str(tmp_path / "mark"),), ITEMS) == WANTED


def test_a_number_of_workers_below_one_is_refused():
    with pytest.raises(InputError) as error, campaign(0):
        pass
    assert error.value.code == "E-WORKERS"


@pytest.mark.slow
def test_a_cluster_that_does_not_answer_is_named():
    pytest.importorskip("distributed")
    with pytest.raises(InputError) as error, campaign(dask="tcp://127.0.0.1:1"):
        pass
    assert error.value.code == "E-DASK"


@pytest.mark.slow
def test_a_search_on_a_cluster_ends_as_one_here(table_3_1, twin):
    """Simulated costs, the same bits: in this process, in two others, on a cluster that loses a worker on the way."""
    distributed = pytest.importorskip("distributed")
    shared, how = (space_12(table_3_1), [twin]), Settings(6, 3, seed=4)

    def end(work, report=None):
        found = search(feature_costs, shared, 12, how, work, report=report)
        return found.u.tolist(), found.history.costs

    with campaign(1) as here, campaign(2) as processes:
        wanted = end(here)
        assert end(processes) == wanted
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        campaign(dask=cluster.scheduler_address) as work,
    ):
        pids = [w.pid for w in cluster.workers.values()]

        def lose_a_worker(progress):
            if progress.generation == 1:
                os.kill(pids[0], signal.SIGKILL)

        assert end(work, lose_a_worker) == wanted


def test_an_address_is_asked_of_the_cluster_and_nothing_is_started_here(monkeypatch):
    made = campaigns.Campaign(lambda: None, 7)

    @contextmanager
    def cluster(address):
        assert address == "tcp://far:8786"
        yield made

    monkeypatch.setattr(campaigns, "_cluster", cluster)
    monkeypatch.setattr(campaigns, "_processes", lambda n: pytest.fail("processes of this machine"))
    with campaign(2, dask="tcp://far:8786") as work:
        assert work is made


def test_what_no_process_made_waits_for_no_end_of_one():
    """Threads of an executor of the caller's are in a process that has no parent among ours."""
    before = threading.active_count()
    campaigns._end_with_parent()
    assert threading.active_count() == before
