"""All effects at once: fitted together, then taken away one after the other, the least needed first.

What is missing hides what else is missing: a small effect gains nothing while a large one is absent, and one that is
alone in a model takes over what others would explain better. On the way down both are plain: with all the rest in the
model, an effect that is not needed costs nothing to leave out.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rockref.discover.plan import cosines
from rockref.discover.tosses import descent
from rockref.discover.tosses.body import cut
from rockref.discover.tosses.first_guess import guessed
from rockref.discover.tosses.fit import HORIZONS, TossFit, downhill
from rockref.discover.verdict.detection import eliminated
from rockref.measure.tosses.flight import Poses

#: Frames over which the joint fit looks, one stage after the other, and most iterations of each: the first impact, the
#: second, the third, all that moves. Decided by trial on the public fit tosses: the error of whole tosses alone has too
#: many valleys for fifty numbers. The first stage comes twice: it sets the frames of camera and plate and the weights;
#: from then on the fit begins once more at what is measured (there, 40 frames end at 1.41 so and at 1.47 without it).
STAGES = ((25, 8), (25, 6), (40, 6), (60, 6), (HORIZONS[-1], 12))
#: Share of the objective that one number more gains by luck, times the number of tosses: an effect that gains less for
#: each of its numbers is not needed. Decided: a thousandth of the objective of 222 tosses, by which the
#: public ones are diagnosed, and less than the half of a toss that chance gives a number where a toss is one error.
LUCK = 0.222
#: Most iterations after an effect was taken away; one that gains no more ends them.
AFTER = 2
#: Effects whose absence is tried at every step down: those that the slopes say are needed least.
TRIED = 3
#: Trust in steep frames and dampings of the move of the others that makes up for an absent effect.
STEEP, DAMPING = (3.0, 15.0), (1e-3, 1e-1)


@dataclass(frozen=True)
class Stair:
    """A fitted model on the way down; objectives have the weights of the way's first model.

    costs : by how much the objective rises without an effect, the others having moved; of the effects that were tried.
    confusion : how alike every two effects are to these tosses, see `alike`; of the first model of a way down.
    """

    fit: TossFit
    z: np.ndarray
    objective: float
    costs: dict[str, float] = field(default_factory=dict)
    confusion: dict[str, dict[str, float]] = field(default_factory=dict)

    def own(self, effect: str) -> np.ndarray:
        """Return which numbers are those of an effect."""
        return np.array([i for i, p in enumerate(self.fit.parameters) if p.name.startswith(effect + ".")])


def all_together(
    last: Stair,
    candidates: Sequence[str],
    guesses: dict[str, float],
    stages: Sequence[tuple[int, int]] = STAGES,
) -> Stair:
    """Return all candidates on top of a model, fitted together; they begin at what is measured without a contact
    model."""
    fit = replace(last.fit, effects=(*last.fit.effects, *candidates))
    z = np.concatenate([last.z, np.zeros(len(fit.parameters) - len(last.z))])
    objective = np.inf
    for stage, (frames, iterations) in enumerate(stages):
        for id in candidates if stage < 2 else ():
            z = guessed(z, fit.parameters, id, guesses)
        z, objective = fit.run(z, iterations, (frames,))
    return absent_left_out(Stair(fit, z, objective), candidates)


def absent_left_out(stair: Stair, candidates: Sequence[str]) -> Stair:
    """Return the same model without those candidates of which every number ended where its effect is absent."""
    absent = [id for id in candidates if not stair.z[stair.own(id)].any()]
    kept = np.setdiff1d(np.arange(len(stair.z)), [i for id in absent for i in stair.own(id)])
    fit = replace(stair.fit, effects=tuple(id for id in stair.fit.effects if id not in absent))
    return Stair(fit, stair.z[kept], stair.objective)


def way_down(full: Stair, keep: Sequence[str], say: Callable[[str], None]) -> list[Stair]:
    """Return the models from the one of which every effect is needed to the one that has only the effects in `keep`.

    The least needed effect leaves first; what it is worth is its cost, less what luck gives to as many numbers. The
    costs and the confusion that the first model comes with are those of all the effects of `full`.
    """
    poses = cut(full.fit.poses, HORIZONS[-1])
    weight = full.fit.frame_weights(full.z, poses)
    stair = replace(full, objective=full.fit.objective(full.z, full.fit.residual(full.z, poses), weight))
    stairs: list[Stair] = []
    confusion: dict[str, dict[str, float]] = {}
    while True:
        going = [id for id in stair.fit.effects if id not in keep]
        if not going:
            stairs.append(stair)
            first = needed(stairs)
            stairs[first] = replace(stairs[first], costs=stairs[0].costs, confusion=confusion)
            return way_up(stairs[first:], poses, weight)
        slopes = stair.fit.slopes(stair.z, poses, weight)
        confusion = confusion or alike(stair, slopes)
        # At the first step all are tried: what each is worth beside all the others.
        likely = going if not stairs else sorted(going, key=lambda id: _worth(stair, id, slopes))[:TRIED]
        without = {id: taken_away(stair, id, slopes, poses, weight) for id in likely}
        stair = replace(stair, costs={id: s.objective - stair.objective for id, s in without.items()})
        stairs.append(stair)
        share = luck(stair) * stair.objective
        least = min(without, key=lambda id: stair.costs[id] - share * len(stair.own(id)))
        say(f"  without {least}: {stair.objective:.3f} -> {without[least].objective:.3f}")
        stair = settled(without[least], poses, weight)


def alike(stair: Stair, slopes: descent.Slopes) -> dict[str, dict[str, float]]:
    """Return cosines of every two effects, linearised at a model that has them all, the law's own numbers fitted along.

    Near one: these tosses cannot tell the two apart. The same measure as `rockref.discover.verdict.detection` has.
    """
    ids = stair.fit.effects
    H, _ = slopes.normal_equations(stair.z, STEEP[-1])
    own = [stair.own(id) for id in ids]
    numbers = np.concatenate(own) if own else np.zeros(0, int)
    law = np.setdiff1d(np.arange(len(stair.z)), numbers)
    order = np.concatenate([law, numbers])
    S = eliminated(H[np.ix_(order, order)], len(law))
    ends = np.cumsum([0, *map(len, own)])
    table = np.round(cosines((S + S.T) / 2, [np.arange(a, b) for a, b in itertools.pairwise(ends)]), 3).tolist()
    return {a: dict(zip(ids, row, strict=True)) for a, row in zip(ids, table, strict=True)}


def needed(stairs: Sequence[Stair]) -> int:
    """Return which model of a way down to take: the least objective where every number has paid for its luck."""
    share = luck(stairs[0]) * stairs[0].objective
    return int(np.argmin([s.objective + share * len(s.z) for s in stairs]))


def luck(stair: Stair) -> float:
    """Return share of the objective that one number more gains by luck: the fewer tosses, the more."""
    return LUCK / len(stair.fit.poses.frames)


def taken_away(stair: Stair, effect: str, slopes: descent.Slopes, poses: Poses, weight: np.ndarray) -> Stair:
    """Return the model without an effect; the other numbers make up for it as far as the slopes tell."""
    fit = replace(stair.fit, effects=tuple(id for id in stair.fit.effects if id != effect))
    gone = stair.own(effect)
    others = np.setdiff1d(np.arange(len(stair.z)), gone)
    low, high = descent.limits(fit.parameters)
    value = descent.guarded(lambda trial: fit.objective(trial, fit.residual(trial, poses), weight))
    trials = [stair.z[others]]
    for steep in STEEP:
        H, g = slopes.normal_equations(stair.z, steep)
        A, b = H[np.ix_(others, others)], g[others] - H[np.ix_(others, gone)] @ stair.z[gone]
        for damping in DAMPING:
            step = -np.linalg.solve(A + damping * np.diag(np.diag(A)), b)
            trials.append(np.clip(stair.z[others] + step, low, high))
    ends = [value(trial) for trial in trials]
    best = int(np.argmin(ends))
    return Stair(fit, trials[best], ends[best])


def settled(stair: Stair, poses: Poses, weight: np.ndarray) -> Stair:
    """Return the model after some iterations more."""
    z, objective = downhill(stair.fit, stair.z, stair.objective, poses, weight, AFTER)
    return replace(stair, z=z, objective=objective)


def way_up(stairs: Sequence[Stair], poses: Poses, weight: np.ndarray) -> list[Stair]:
    """Return same models in the same order, none worse than one with fewer effects: such a one is fitted from there."""
    found = [stairs[-1]]
    for stair in stairs[-2::-1]:
        below = found[-1]
        if below.objective < stair.objective:
            known = {p.name for p in below.fit.parameters}
            z = np.zeros(len(stair.z))
            z[[p.name in known for p in stair.fit.parameters]] = below.z
            stair = settled(replace(stair, z=z, objective=below.objective), poses, weight)
        found.append(stair)
    return found[::-1]


def _worth(stair: Stair, effect: str, slopes: descent.Slopes) -> float:
    """Return what the slopes say that an effect lowers the objective."""
    H, _ = slopes.normal_equations(stair.z, STEEP[-1])
    gone = stair.own(effect)
    covariance = np.linalg.inv(H)[np.ix_(gone, gone)]
    return float(stair.z[gone] @ np.linalg.solve(covariance, stair.z[gone])) / 2
