"""Fits that do not need each other, on as many threads as there are workers: the same numbers, sooner."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import replace
from threading import Event
from typing import TYPE_CHECKING, TypeVar

from rockref.discover.threads import on_threads, threads_left

if TYPE_CHECKING:
    from rockref.discover.fit.search import Setup

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
    threads = threads_left(len(items), setup.workers)
    if threads < 2:
        return [do(setup, item) for item in items]

    def log(line: str) -> None:
        if stop.is_set():
            raise Stopped
        setup.log(line)

    own = replace(setup, log=log)
    return on_threads(lambda item: do(own, item), items, threads, failed=stop.set)
