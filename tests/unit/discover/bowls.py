"""Fits that are bowls: the moves of a diagnosis are tried on them at no cost."""

from dataclasses import dataclass, field
from types import SimpleNamespace

import numpy as np

from rockref.discover.fit.families import Family
from rockref.discover.fit.least_squares import Point
from rockref.discover.fit.search import Setup
from rockref.discover.hypotheses.counted import Parameter

WINDOWS, SAMPLES = 40, 60
#: What fits that are no fits need of a setup: one after the other.
ALONE = Setup(None, (), None, workers=1)


def series(shift: int = 0):
    """Forty windows of sixty samples, of which the first four do not count; with `shift` all cuts but the first and the
    last stand elsewhere."""
    cuts = np.arange(WINDOWS + 1) * SAMPLES
    cuts[1:-1] += shift
    length = np.diff(cuts)
    count, run_of = 3 * (length - 4), np.zeros(WINDOWS)
    found = SimpleNamespace(start=cuts[:-1], stop=cuts[1:], length=length, count=count, run_of=run_of, rate=1000.0)
    found.twin = lambda: found
    return found


@dataclass
class Bowl:
    """A fit whose loss is a bowl about `bottom`; each iteration goes half of the way down, or stays where it is."""

    bottom: np.ndarray
    floor: float = 1.0
    stuck: bool = False
    series: SimpleNamespace = field(default_factory=series)
    iterations: int = 0
    averaged: int = 1

    @property
    def parameters(self):
        names = ["K_N", "rolling_resistance.lever", "quadratic_drag.c"][: len(self.bottom)]
        return tuple(Parameter(n, lambda model, value: model, 0.0, 1.0) for n in names)

    def point(self, z, corrections):
        mean = self.floor + float(np.sum((np.asarray(z) - self.bottom) ** 2))
        return Point(np.array(z, float), corrections, 0.5 * mean * self.series.count, 0.0), None

    def twin(self, log):
        return self

    def relax_states(self, point):
        return point

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        if self.stuck:
            return point
        z = point.z + (self.bottom - point.z) * (1 - 0.5**iterations)
        return self.point(z, point.corrections)[0]


def family(effects, bowl, z):
    return Family(effects, bowl, bowl.point(z, np.zeros((WINDOWS, 5)))[0])
