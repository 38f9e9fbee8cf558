"""Many evaluations on any `concurrent.futures.Executor`: here, in processes, or on a Dask cluster.

A chunk that is lost with its worker is computed again, and so is one whose worker hangs. The results do not depend on
who computed them, nor in what pieces: each chromosome is evaluated by itself.
"""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from typing import Any

from rockref.model.errors import InputError

#: How often a lost piece is tried again before the campaign gives up; decided.
ATTEMPTS = 3
#: Seconds without any piece done after which workers hang: at first, and later as many times the longest such time so
#: far, and no less than LEAST. Decided: a piece takes seconds with the compiled engine, an hour with NumPy.
AT_FIRST, TIMES, LEAST = 4 * 3600.0, 10.0, 60.0


class Hanging(Exception):
    """No piece was done for so long that none will be."""


class Campaign:
    """Calls a function on the pieces of a list, in order, on an executor that it makes anew where it breaks.

    make : gives an executor, or None to compute here;  workers : pieces at a time.
    """

    def __init__(self, make: Callable[[], Executor | None], workers: int):
        self.make, self.workers = make, workers
        #: Threads for what is computed in this process, between the pieces.
        self.threads = min(workers, os.cpu_count() or 1)
        self.executor = make()
        #: The longest time until a piece was done so far [s].
        self.longest: float | None = None

    @property
    def patience(self) -> float:
        """Return seconds without any piece done after which the workers are taken to hang."""
        return AT_FIRST if self.longest is None else max(LEAST, TIMES * self.longest)

    def __call__(self, function: Callable[..., Sequence], shared: tuple, items: Sequence) -> list:
        """Return the concatenated results of `function(*shared, piece)` over pieces of `items`, in the order of the
        items."""
        pieces = [list(p) for p in split(items, self.workers)]
        executor = self.executor
        if executor is None:
            return [result for piece in pieces for result in function(*shared, piece)]
        done: dict[int, Sequence] = {}
        for attempt in range(ATTEMPTS):
            jobs: dict[int, Future] = {}
            try:
                # One by one: a worker that died since the last call is noticed here.
                for i in (i for i in range(len(pieces)) if i not in done):
                    jobs[i] = executor.submit(function, *shared, pieces[i])
                for job in self._as_they_end(jobs.values()):
                    job.result()
                done |= {i: job.result() for i, job in jobs.items()}
                break
            except (BrokenProcessPool, Hanging) as e:
                # A worker was killed, or hangs: what is done stays done, the rest goes to new ones.
                done |= {i: job.result() for i, job in jobs.items() if _has_result(job)}
                self.executor = executor = self._anew(e, attempt)
        return [result for i in range(len(pieces)) for result in done[i]]

    def as_done(self, function: Callable[..., Sequence], shared: tuple, items: Sequence) -> Iterator[tuple[int, Any]]:
        """Yield (index, result) of each item, `function(*shared, [item])[0]`, as it is done: no worker waits for
        another."""
        left = list(range(len(items)))
        if self.executor is None:
            for i in left:
                yield i, function(*shared, [items[i]])[0]
            return
        for attempt in range(ATTEMPTS):
            try:
                jobs = {self.executor.submit(function, *shared, [items[i]]): i for i in left}
                for job in self._as_they_end(jobs):
                    result = job.result()[0]
                    left.remove(jobs[job])
                    yield jobs[job], result
                return
            except (BrokenProcessPool, Hanging) as e:
                # As above: what is done has been handed out, the rest goes to new workers.
                self.executor = self._anew(e, attempt)

    def _as_they_end(self, jobs: Iterable[Future]) -> Iterator[Future]:
        """Yield the jobs as they are done. Raises Hanging where none is done in time."""
        left, started = set(jobs), time.monotonic()
        while left:
            done, left = wait(left, self.patience, FIRST_COMPLETED)
            if not done:
                raise Hanging
            self.longest, started = max(self.longest or 0.0, time.monotonic() - started), time.monotonic()
            yield from done

    def _anew(self, error: Exception, attempt: int) -> Executor:
        """Return other workers in place of those that died or hang. Raises InputError (E-WORKERS) after some
        attempts."""
        for process in list((getattr(self.executor, "_processes", None) or {}).values()):
            process.kill()  # what hangs does not end by itself
        if attempt == ATTEMPTS - 1:
            what = "did not end" if isinstance(error, Hanging) else "died"
            cure = "Look at the memory and the limits of this machine; --workers 1 computes in one process."
            raise InputError("E-WORKERS", "--workers", f"a worker {what}, {ATTEMPTS} times", cure) from error
        self.close()
        executor = self.make()
        assert executor is not None
        return executor

    def close(self) -> None:
        """Let the workers go."""
        if self.executor is not None:
            self.executor.shutdown(wait=True, cancel_futures=True)


def _has_result(job: Future) -> bool:
    return job.done() and not job.cancelled() and job.exception() is None


def split(items: Sequence, pieces: int) -> list[Sequence]:
    """Return `items` in at most `pieces` pieces whose lengths differ by one at most."""
    n = max(1, min(pieces, len(items)))
    edges = [round(i * len(items) / n) for i in range(n + 1)]
    return [items[a:b] for a, b in zip(edges[:-1], edges[1:], strict=True)]


@contextmanager
def campaign(
    workers: int | None = None, dask: str | None = None, executor: Executor | None = None
) -> Iterator[Campaign]:
    """Open a campaign on `workers` local processes (1: in this one; None: one a core), on the Dask cluster at address
    `dask`, or on an executor of the caller's, which is left open.

    Raises InputError: E-WORKERS, for a number below one; E-DASK, where the extra is missing or the cluster does not
    answer.
    """
    if executor is not None:
        yield Campaign(lambda: executor, workers or os.cpu_count() or 1)
        return
    if dask is not None:
        with _cluster(dask) as made:
            yield made
        return
    n = (os.cpu_count() or 1) if workers is None else workers
    if n < 1:
        raise InputError("E-WORKERS", "--workers", f"is {n}", "Give one or more.")
    made = Campaign((lambda: None) if n == 1 else (lambda: _processes(n)), n)
    try:
        yield made
    finally:
        made.close()


def _processes(n: int) -> ProcessPoolExecutor:
    # Fresh processes: a forked one would inherit threads of numba and BLAS in an unknown state.
    return ProcessPoolExecutor(n, mp_context=get_context("spawn"), initializer=_as_a_worker)


def _as_a_worker() -> None:
    """Begin as a worker: Ctrl-C, which a terminal sends to all, ends it without a word (the parent has the word).

    Where a shell has it ignored, as in the background, parent and workers go on.
    """
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, lambda number, frame: os._exit(130))
    _end_with_parent()


def _end_with_parent() -> None:
    """Let this worker end when the process that made it is killed; without this it would wait for work for ever."""
    parent = parent_process()
    if parent is None:
        return

    def wait() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait, daemon=True).start()


@contextmanager
def _cluster(address: str) -> Iterator[Campaign]:
    try:
        from dask.distributed import Client
    except ImportError as e:
        cure = "pip install 'rockref[distributed]'"
        raise InputError("E-DASK", "--dask", "the extra `distributed` is not installed", cure) from e
    try:
        client: Any = Client(address, timeout="20s", set_as_default=False)
    except (OSError, ValueError) as e:
        raise InputError("E-DASK", f"--dask {address}", f"does not answer ({e})", "Start the scheduler first.") from e
    try:
        yield Campaign(client.get_executor, max(1, len(client.scheduler_info()["workers"])))
    finally:
        client.close()
