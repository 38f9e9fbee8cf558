"""Wide central differences: they see across the roughness of the objective that stops a derivative."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rockref.discover.fit.objective import mean_loss, smoothed
from rockref.discover.fit.problem import FitProblem
from rockref.discover.fit.spikes import whitened
from rockref.discover.fit.stages import Stage, fineness
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.listening.listener import Job, Listener

#: Half width of a difference in prior deviations, the part of it that is tried next where the objective rises more than
#: bearable, and the least width; decided: a quarter of what is expected is seen by every number.
WIDEST, NARROWER, NARROWEST = 0.25, 0.25, 0.004
#: Factor by which the mean loss may rise at the ends of a difference.
BEARABLE = 2.5


@dataclass
class Residuals:
    """Innovations of a problem at one stage; keeps the widths of differences by the names of numbers."""

    problem: FitProblem
    stage: Stage
    widths: dict[str, float] = field(default_factory=dict)

    @property
    def listener(self) -> Listener:
        """Return the records as the stage hears them."""
        whole, most = self.problem.listener, self.stage.rate
        return whole if most is None else whole.thinned(most)

    @property
    def count(self) -> int:
        """Return how many innovations there are, smoothing included (its white noise counts as fewer)."""
        listener = self.listener
        horizon = self.stage.horizon
        N = listener.N if horizon is None else min(listener.N, int(horizon * listener.gyro.sample_rate) + 1)
        thinned = max(1, round(self.stage.smoothing * listener.gyro.sample_rate))
        return int(3 * np.ceil(listener.valid[:, :N].sum(axis=1) / thinned).sum())

    def of(self, jobs: Sequence[Job], fine: float) -> np.ndarray:
        """Return innovations (J, R, n, 3) of jobs, smoothed and in inflated noise widths."""
        problem, stage, listener = self.problem, self.stage, self.listener
        predicted = listener.predict(jobs, stage.memory(problem.time_scale, fine), stage.horizon)
        found = problem.spikes.get(stage.name)
        r = listener.innovations(predicted, stage.jitter)
        r = r if found is None else whitened(r, found)
        return smoothed(r, stage.smoothing * listener.gyro.sample_rate) / stage.inflation

    def at(self, parameters: Sequence[Parameter], points: Sequence[np.ndarray]) -> np.ndarray:
        """Return innovations (J, R, n, 3) at several z of the same numbers."""
        jobs = [self.problem.job(parameters, z) for z in points]
        return self.of(jobs, self.fineness(parameters, points[0]))

    def coarsely_at(self, parameters: Sequence[Parameter], points: Sequence[np.ndarray]) -> np.ndarray:
        """Return innovations (J, R, n, 3) as `at`, by steps that are not as fine as the records ask for.

        Enough for slopes: what steps change of innovations is alike at both ends of a difference.
        """
        jobs = [self.problem.job(parameters, z) for z in points]
        return self.of(jobs, self.by_stiffness(parameters, points[0]))

    def fineness(self, parameters: Sequence[Parameter], z: np.ndarray) -> float:
        """Return the factor on the number of steps that the stiffness at z, and the records, ask for."""
        return self.by_stiffness(parameters, z) * self.problem.finer.get(self.stage.name, 1.0)

    def by_stiffness(self, parameters: Sequence[Parameter], z: np.ndarray) -> float:
        """Return the factor on the number of steps that the stiffness at z asks for."""
        found = [p.value(float(value)) for p, value in zip(parameters, z, strict=True) if p.name == "K_N"]
        stiffness = found[0] if found else self.problem.base.parameters.K_N
        return fineness(stiffness, self.problem.base.mass)


def jacobian(
    residuals: Residuals, parameters: Sequence[Parameter], z: np.ndarray, r: np.ndarray, absent: int = 0
) -> np.ndarray:
    """Return d r / d z, (G, R, n, 3), at z (G,), where the innovations are r (R, n, 3).

    The last `absent` numbers are those of effects that the model does not have. Such as only shape one have no row, nor
    have the forms of laws at a stage that holds them.

    Numbers of one kind that belong to one run each are moved at once: each moves its own run alone. One-sided numbers
    at the value at which they are absent are moved to their own side.
    """
    kinds: dict[str, list[int]] = {}
    for k, p in enumerate(parameters):
        if p.form and residuals.stage.holds_forms:
            continue
        if k < len(parameters) - absent or p.typical > 0 or p.run is not None:
            kinds.setdefault(p.kind if p.run is not None else p.name, []).append(k)
    found = np.zeros((len(parameters), *r.shape))
    level, fine = mean_loss(r), residuals.fineness(parameters, z)
    waiting = list(kinds)
    while waiting:
        jobs, ends = [], []
        for kind in waiting:
            members = kinds[kind]
            width = residuals.widths.get(kind, WIDEST)
            for end in ends_of(parameters, z, members, width):
                jobs.append(residuals.problem.job(parameters, end, owners(parameters, members)))
                ends.append((kind, end))
        moved = residuals.of(jobs, fine)
        again = []
        for kind in waiting:
            members, at = kinds[kind], [k for k, (name, _) in enumerate(ends) if name == kind]
            own = owners(parameters, members)
            rows = slice(None) if own is None else own
            narrow = any(mean_loss(moved[k][rows]) > BEARABLE * max(mean_loss(r[rows]), 0.1 * level) for k in at)
            width = residuals.widths.get(kind, WIDEST)
            if narrow and width > NARROWEST:
                residuals.widths[kind] = width * NARROWER
                again.append(kind)
                continue
            fill(found, parameters, members, z, r, [(ends[k][1], moved[k]) for k in at])
        waiting = again
    return found


def owners(parameters: Sequence[Parameter], members: Sequence[int]) -> list[int] | None:
    """Return the runs to which these numbers belong; None for all."""
    runs = [parameters[k].run for k in members]
    return None if runs[0] is None else [int(i) for i in runs if i is not None]


def ends_of(parameters: Sequence[Parameter], z: np.ndarray, members: Sequence[int], width: float) -> list[np.ndarray]:
    """Return the z at both ends of a difference of these numbers; z itself stands for an end beyond a limit."""
    found = []
    for sign in (1.0, -1.0):
        end = z.copy()
        for k in members:
            p = parameters[k]
            end[k] = min(max(z[k] + sign * width, p.least), p.most)
        if not np.array_equal(end, z):
            found.append(end)
    return found


def fill(found: np.ndarray, parameters, members, z, r, ends: list[tuple[np.ndarray, np.ndarray]]) -> None:
    """Fill the rows of these numbers from the innovations at the ends of their difference."""
    for k in members:
        run = parameters[k].run
        rows = slice(None) if run is None else run
        if len(ends) == 2:
            (up, r_up), (down, r_down) = ends
            length = up[k] - down[k]
            change = r_up[rows] - r_down[rows]
        elif ends:
            ((end, r_end),) = ends
            length, change = end[k] - z[k], r_end[rows] - r[rows]
        else:
            continue
        if length:
            found[k][rows] = change / length
