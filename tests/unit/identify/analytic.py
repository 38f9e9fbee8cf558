"""Costs that need no simulation, for tests of the search and of campaigns; importable by worker processes."""

import os
import signal
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np


def alone(*names: str) -> SimpleNamespace:
    """Unknowns of these names, each moved by itself for the slopes."""
    return SimpleNamespace(names=names, moves=[[(i, slice(None))] for i in range(len(names))])


def bowl(centre: float, chromosomes) -> list[float]:
    """A quadratic bowl with its bottom at (centre, ..., centre), a hundred times steeper along the first axis."""
    steep = np.ones(len(chromosomes[0]))
    steep[0] = 100.0
    return [float(np.sum(steep * np.square(np.asarray(u) - centre))) for u in chromosomes]


def bowl_whose_worker_dies_once(mark: str, chromosomes) -> list[float]:
    """The bowl; the first worker that comes here is killed as the system would kill it."""
    try:
        with open(mark, "x"):
            pass
    except FileExistsError:
        return bowl(0.3, chromosomes)
    os.kill(os.getpid(), signal.SIGKILL)
    raise AssertionError("a killed process does not go on")


def bowl_whose_worker_hangs(mark: str, chromosomes) -> list[float]:
    """The bowl; the first worker that comes here does not come back. Without a mark nobody does."""
    try:
        with open(mark or os.devnull, "x" if mark else "r"):
            pass
    except FileExistsError:
        return bowl(0.3, chromosomes)
    time.sleep(600)
    raise AssertionError("nobody waits for so long")


def slow_bowl(seconds: float, chromosomes) -> list[float]:
    """The bowl, with a pause, so that a search can be interrupted in the middle."""
    time.sleep(seconds)
    return bowl(0.3, chromosomes)


def pause(seconds) -> list[float]:
    """Sleep so long for each item."""
    for each in seconds:
        time.sleep(each)
    return list(seconds)


def main() -> None:
    """Search with checkpoints in the folder given, resuming what is there, and print the end in hexadecimal."""
    from rockref.identify.search import Settings, search
    from rockref.jobs.campaign import campaign

    folder, pause = Path(sys.argv[1]), float(sys.argv[2])
    with campaign(1) as work:
        end = search(slow_bowl, (pause,), 3, Settings(8, 12, seed=5), work, {}, folder / "checkpoint.json", resume=True)
    print(end.cost.hex(), *(float(x).hex() for x in end.u))


if __name__ == "__main__":
    main()
