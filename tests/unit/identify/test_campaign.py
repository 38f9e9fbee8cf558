"""Campaigns: the same results from any executor, in order, and nothing lost with a worker."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from rockref.identify.campaign import campaign, split
from rockref.model.errors import InputError
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


def test_a_cluster_that_does_not_answer_is_named():
    pytest.importorskip("distributed")
    with pytest.raises(InputError) as error, campaign(dask="tcp://127.0.0.1:1"):
        pass
    assert error.value.code == "E-DASK"
