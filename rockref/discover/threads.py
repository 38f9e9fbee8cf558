"""Threads for work that does not depend on each other: as many as are free, never more than there are workers."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from contextlib import contextmanager
from threading import Lock
from typing import TypeVar

Item = TypeVar("Item")
Found = TypeVar("Found")


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let linear algebra run on one thread: its small products wait on all cores for each other, where blocks move."""
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield


class Crew:
    """How many threads are at work: one, and those that it has others do its work, while it waits for them."""

    def __init__(self) -> None:
        self.at_work, self._lock = 1, Lock()

    @contextmanager
    def more(self, by: int) -> Iterator[None]:
        """Count so many more (or fewer) at work meanwhile."""
        with self._lock:
            self.at_work += by
        try:
            yield
        finally:
            with self._lock:
                self.at_work -= by


_crew = Crew()


def threads_left(items: int, workers: int | None) -> int:
    """Return threads for so many items: as many as there are workers (default: all cores) less those that others
    have."""
    return max(1, min(items, (workers or os.cpu_count() or 1) + 1 - _crew.at_work))


def on_threads(do: Callable[[Item], Found], items: Sequence[Item], threads: int) -> list[Found]:
    """Return [do(item) for item in items] on so many threads; on this one, where one is enough."""

    def done(item: Item) -> Found:
        with _crew.more(1):
            return do(item)

    if threads == 1:
        return [do(item) for item in items]
    with ThreadPoolExecutor(threads) as pool, _crew.more(-1):
        futures = [pool.submit(done, item) for item in items]
        try:
            over, waiting = wait(futures, return_when=FIRST_EXCEPTION)
            if waiting:  # for those that are over one has failed, and says so
                futures = [future for future in futures if future in over]
            return [future.result() for future in futures]
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
