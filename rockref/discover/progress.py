"""How far a long computation is: stages as data. `rockref.commands._progress` draws them; a caller may, too."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

#: Seconds from which the time left is said in minutes (decided), and the step to which it is rounded below.
MINUTE, ROUNDED = 90.0, 5.0
#: Share of the time that lies behind before the rest is foretold (decided: what is done once, as compiling, may take
#: longer than a short first stage).
FORETELLS = 0.1


@dataclass(frozen=True)
class StageReport:
    """One report on a long computation.

    step, of : number of the stage and of all (0: nobody knows);  name : in words;  best : the best hypothesis so far
    seconds_left : of all stages, None where nothing is known
    line : of the optimiser within the stage, empty where the stage itself is reported
    """

    step: int
    of: int
    name: str
    best: str = ""
    seconds_left: float | None = None
    line: str = ""

    @property
    def key(self) -> tuple[int, str]:
        """Return what tells one stage from the next."""
        return self.step, self.name

    def __str__(self) -> str:
        return self.line or in_words(self, self.seconds_left)


def in_words(report: StageReport, seconds_left: float | None) -> str:
    """Return a stage in a line, counted where there are several: "3/6 comparing 31 effects · about 40 s left"."""
    said = [f"{report.step}/{report.of} {report.name}" if report.of > 1 else report.name]
    if report.best:
        said.append(f"best so far: {report.best}")
    if seconds_left is not None and seconds_left > 0:
        said.append(time_left(seconds_left))
    return " · ".join(said)


def time_left(seconds: float) -> str:
    """Return the time left in words, rounded as an estimate is."""
    if seconds >= MINUTE:
        return f"about {seconds / 60:.0f} min left"
    return f"about {max(ROUNDED, ROUNDED * round(seconds / ROUNDED)):.0f} s left"


class StageCounter:
    """Counts the stages of one computation and foretells the time left from the share of each.

    Parameters
    ----------
    stages : of each stage its key and its share of the time where all are needed; a stage may be passed over
    report : called with every stage and every line of the optimiser;  clock : seconds
    """

    def __init__(
        self,
        stages: Mapping[str, float],
        report: Callable[[StageReport], None] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ):
        self.shares, self.report, self.clock = dict(stages), report, clock
        self.keys = list(stages)
        self.at, self.name, self.best = -1, "", ""
        self.started = self.began = clock()
        self.passed = 0.0  # share of the stages that are behind

    def begin(self, key: str, name: str = "", best: str = "") -> None:
        """Begin a stage; one that lies behind, or that this computation does not have, goes on within the present one.

        name : in words, by default the key;  best : the best hypothesis so far.
        """
        self.best = best or self.best
        if key not in self.shares or self.keys.index(key) < self.at:
            return
        if self.keys.index(key) > self.at:
            self.passed += self.shares[self.keys[self.at]] if self.at >= 0 else 0.0
            self.at, self.began = self.keys.index(key), self.clock()
        elif (name or key) == self.name:
            return
        self.name = name or key
        self._send()

    def say(self, line: str) -> None:
        """Report a line of the optimiser."""
        self._send(line)

    def note(self, best: str) -> None:
        """Report the best hypothesis so far, where it is another one."""
        if best != self.best:
            self.best = best
            self._send()

    def seconds_left(self) -> float | None:
        """Return the seconds that the present stage and those that follow will take; None while little is behind."""
        if self.passed < FORETELLS * sum(self.shares.values()):
            return None
        rate = (self.began - self.started) / self.passed
        here = self.shares[self.keys[self.at]] * rate - (self.clock() - self.began)
        return max(here, 0.0) + rate * sum(self.shares[key] for key in self.keys[self.at + 1 :])

    def _send(self, line: str = "") -> None:
        if self.report is not None:
            self.report(StageReport(self.at + 1, len(self.keys), self.name, self.best, self.seconds_left(), line))
