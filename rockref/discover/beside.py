"""Fits that do not need each other, on as many threads as there are workers: the same numbers, sooner."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from threading import Event
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from rockref.discover.search import Setup

Item = TypeVar("Item")
Found = TypeVar("Found")


class Stopped(Exception):
    """A thread was told to end."""


def side_by_side(setup: Setup, do: Callable[[Setup, Item], Found], items: Iterable[Item]) -> list[Found]:
    """[do(setup, item) for item in items], on threads; what is logged comes as it happens.

    Each thread spends most of its time in compiled code and in NumPy, which let the others go on. Where one fails, or
    the user stops the program, the others end at their next line of the log.
    """
    items, stop = list(items), Event()
    threads = min(len(items), setup.workers or os.cpu_count() or 1)
    if threads < 2:
        return [do(setup, item) for item in items]

    def log(line: str) -> None:
        if stop.is_set():
            raise Stopped
        setup.log(line)

    with ThreadPoolExecutor(threads) as pool:
        try:
            own = replace(setup, log=log)
            return list(pool.map(lambda item: do(own, item), items))
        except BaseException:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)
            raise
