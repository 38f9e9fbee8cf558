"""How a speed is measured: several times, best and median, by the clock on the wall."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from typing import NamedTuple


class Speed(NamedTuple):
    """Block-steps a second: of the best repetition, disturbed least by other work on the machine, and of the median."""

    best: float
    median: float


def speed(run: Callable[[], object], steps: int, repeat: int = 5, at_most: float = 8.0) -> Speed:
    """Call `run`, which makes `steps` block-steps, `repeat` times or until `at_most` seconds are over."""
    seconds: list[float] = []
    while len(seconds) < repeat and sum(seconds) < at_most:
        start = time.perf_counter()
        run()
        seconds.append(time.perf_counter() - start)
    return Speed(steps / min(seconds), steps / statistics.median(seconds))
