"""Fits side by side: in order, with the same bits, and over at once where one fails."""

import threading
import time
from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit.beside import Stopped, side_by_side
from rockref.discover.fit.search import Setup, early
from rockref.discover.threads import on_threads, threads_left
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment


def setup_of(workers, log=lambda line: None):
    return Setup(None, (), None, workers=workers, log=log)


@pytest.mark.parametrize("workers", [1, 2, 7])
def test_answers_come_in_the_order_of_the_questions(workers):
    """The first question waits for the last one wherever there are threads enough."""
    last = threading.Event()

    def square(setup, k):
        if k == 0 and workers > 4:
            assert last.wait(10)
        if k == 4:
            last.set()
        return k * k

    assert side_by_side(setup_of(workers), square, range(5)) == [0, 1, 4, 9, 16]


@pytest.mark.parametrize("items, workers, threads", [(9, 4, 4), (2, 4, 2), (9, 1, 1), (0, 4, 1)])
def test_alone_there_is_a_thread_for_each_worker(items, workers, threads):
    assert threads_left(items, workers) == threads


def test_who_works_beside_others_has_the_threads_that_they_leave():
    """Two of three workers are at work: each may take the third one too. Alone at the end, one has all three."""
    both, alone, left = threading.Barrier(2, timeout=10), threading.Event(), {}

    def job(setup, k):
        both.wait()
        left[k, "beside"] = threads_left(9, 3)
        both.wait()
        if k == 0:
            assert alone.wait(10)
            until = time.monotonic() + 10
            while threads_left(9, 3) < 3 and time.monotonic() < until:  # its thread may not be free yet
                pass
            left[k, "alone"] = threads_left(9, 3)
            # The work that it hands on is done while it waits.
            left[k, "handed on"] = side_by_side(setup_of(3), lambda setup, i: threads_left(9, 3), [1])
        else:
            alone.set()

    side_by_side(setup_of(2), job, [0, 1])
    assert left == {(0, "beside"): 2, (1, "beside"): 2, (0, "alone"): 3, (0, "handed on"): [3]}
    assert threads_left(9, 3) == 3


def test_who_waits_for_others_hears_at_once_that_one_has_failed():
    """The first works until it is told to stop; the second fails meanwhile."""
    stop = threading.Event()

    def job(k):
        if k:
            raise ValueError("no fit")
        assert stop.wait(10)

    with pytest.raises(ValueError, match="no fit"):
        on_threads(job, [0, 1], 2, failed=stop.set)


def test_after_a_failure_all_threads_are_free_again():
    def job(setup, k):
        raise ValueError("no fit")

    with pytest.raises(ValueError, match="no fit"):
        side_by_side(setup_of(2), job, [0, 1])
    assert threads_left(9, 3) == 3


def test_no_question_no_answer():
    assert side_by_side(setup_of(2), lambda setup, k: k, []) == []


def test_what_is_logged_arrives_from_every_thread():
    heard = []
    side_by_side(setup_of(2, heard.append), lambda setup, k: setup.log(str(k)), range(6))
    assert sorted(heard) == ["0", "1", "2", "3", "4", "5"]


def test_where_one_fails_the_others_end_at_their_next_line():
    """Without an end the second would log until the test is killed."""
    ended, begun = [], threading.Event()

    def job(setup, k):
        if k == 0:
            assert begun.wait(10)
            raise ValueError("no fit")
        try:
            while True:
                setup.log("still here")
                begun.set()
        except Stopped:
            ended.append(k)
            raise

    with pytest.raises(ValueError, match="no fit"):
        side_by_side(setup_of(2), job, [0, 1])
    assert ended == [1]


def test_two_threads_find_what_one_finds():
    """A fit on short windows with both its starts, its jumps, and the columns of its Jacobians, to the last bit."""
    truth = Model.table_3_1().replace(effects=(parse("mass_eccentricity:x=0.002"),))
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    found = []
    for workers in (1, 2):
        setup = Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=workers)
        z = np.zeros(len(setup.parameters()))
        z[0] = 0.5
        found.append(early(replace(setup, seed=3), (), z, 4)[1])
    assert np.array_equal(found[0].z, found[1].z) and np.array_equal(found[0].loss, found[1].loss)
