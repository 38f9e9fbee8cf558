"""Fits that do not need each other, on as many threads as there are workers: the same numbers, sooner."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from threading import Event, Lock
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rockref.discover.search import Setup

Item = TypeVar("Item")
Found = TypeVar("Found")


class Stopped(Exception):
    """A thread was told to end."""


class Crew:
    """How many threads are at work: one, and those that it has others do its work, while it waits for them."""

    def __init__(self) -> None:
        self.at_work, self._lock = 1, Lock()

    @contextmanager
    def more(self, by: int) -> Iterator[None]:
        """So many more (or fewer) are at work meanwhile."""
        with self._lock:
            self.at_work += by
        try:
            yield
        finally:
            with self._lock:
                self.at_work -= by


_crew = Crew()


def threads_left(items: int, workers: int | None) -> int:
    """Threads for so many items: as many as there are workers (default: all cores) less those that others have."""
    return max(1, min(items, (workers or os.cpu_count() or 1) + 1 - _crew.at_work))


def on_threads(
    do: Callable[[Item], Found], items: Sequence[Item], threads: int, failed: Callable[[], None] = lambda: None
) -> list[Found]:
    """[do(item) for item in items] on so many threads; failed : called at once where one fails."""

    def done(item: Item) -> Found:
        with _crew.more(1):
            return do(item)

    with ThreadPoolExecutor(threads) as pool, _crew.more(-1):
        try:
            return list(pool.map(done, items))
        except BaseException:
            failed()
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def side_by_side(setup: Setup, do: Callable[[Setup, Item], Found], items: Iterable[Item]) -> list[Found]:
    """[do(setup, item) for item in items], on threads; what is logged comes as it happens.

    Each thread spends most of its time in compiled code and in NumPy, which let the others go on. Where one fails, or
    the user stops the program, the others end at their next line of the log.
    """
    items, stop = list(items), Event()
    threads = threads_left(len(items), setup.workers)
    if threads < 2:
        return [do(setup, item) for item in items]

    def log(line: str) -> None:
        if stop.is_set():
            raise Stopped
        setup.log(line)

    own = replace(setup, log=log)
    return on_threads(lambda item: do(own, item), items, threads, failed=stop.set)
