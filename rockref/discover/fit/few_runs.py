"""A problem with few of its runs: enough to look for a law, at a fraction of the time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit.problem import FitProblem
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.listening.listener import Listener
from rockref.measure.records.release import Run


class FewRuns:
    """The two runs of a problem that differ most, as a problem of their own, and the way back (decided: like releases
    of one block tell its law twice).

    chosen : indices of its runs in the whole problem
    """

    def __init__(self, whole: FitProblem):
        self.whole, self.chosen = whole, unlike(whole.runs)
        listener = whole.listener
        runs = [listener.runs[i] for i in self.chosen]
        part = Listener(whole.experiment, runs, listener.end, listener.workers, whole=listener)
        part.sigma = listener.sigma[list(self.chosen)]
        self.problem = replace(whole, listener=part, _known={})

    def taken(self, effects: Sequence[str], z: np.ndarray) -> np.ndarray:
        """Return the numbers of these runs out of those of all."""
        known = {p.name: k for k, p in enumerate(self.whole.parameters(effects))}
        return np.array([z[known[self._name(p)]] for p in self.problem.parameters(effects)])

    def start(self, h: FittedModel) -> FittedModel:
        """Return a hypothesis of the whole problem, to be fitted to these runs."""
        return FittedModel(h.effects, self.taken(h.effects, h.z))

    def put(self, effects: Sequence[str], own: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Return the numbers z of all runs with those of these runs."""
        known = {self._name(p): at for p, at in zip(self.problem.parameters(effects), own, strict=True)}
        return np.array([known.get(p.name, at) for p, at in zip(self.whole.parameters(effects), z, strict=True)])

    def _name(self, p: Parameter) -> str:
        """Return the name that a number of this problem has in the whole one."""
        return p.name if p.run is None else f"{p.kind}[{self.chosen[p.run]}]"


def unlike(runs: Sequence[Run]) -> tuple[int, ...]:
    """Return the first run, and the one whose release differs most from it: turned, or from another tilt."""
    if len(runs) < 2:
        return (0,)

    def far(i: int) -> tuple[bool, float]:
        tilts = [float(run.release_tilt or 0.0) for run in (runs[0], runs[i])]
        return bool(runs[i].block_turned) != bool(runs[0].block_turned), abs(tilts[1] - tilts[0])

    return 0, max(range(1, len(runs)), key=far)
