"""The next run that would tell two effects apart: offered, simulated, and compared with repeating what was measured.

Every offered run is linearised as a measured one is (:mod:`rockref.discover.plan`). What it says about the shared
parameters is added to what the runs at hand say; then the leading effect, at the size that was found, is set against
each of its rivals, everything else free. The offer that tells the leader from its nearest rival best is the answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rockref.api import Model
from rockref.discover.fit.problem import FitProblem
from rockref.discover.hypotheses.candidates import LEFT_OUT
from rockref.discover.hypotheses.law import law_parameters
from rockref.discover.plan import Release, alternatives, says, switches_of
from rockref.discover.verdict.detection import eliminated
from rockref.effects import catalogue
from rockref.measure.experiment import TILT_UNCERTAINTY

#: Mass that an experimenter would add, as a share of the block's (decided: two discs of a barbell on 54 kg).
ADDED = 0.25


@dataclass(frozen=True)
class Offer:
    """A run that could be made: its release, the mass added, the effects that are taken away for it."""

    release: Release
    added: float = 0.0
    without: tuple[str, ...] = ()

    def __str__(self) -> str:
        turned = "turned by half a turn" if self.release.turned else "as it stands"
        loaded = f", {self.added:.0%} more mass spread evenly" if self.added else ""
        freed = ", the cable taken off" if "cable_restraint" in self.without else ""
        return f"the block {turned}, released at {self.release.tilt:.4g} rad{loaded}{freed}"


def offers(releases: Sequence[Release], members: Sequence[str]) -> list[Offer]:
    """Return three tilts from either side; more mass; and the cable off, where a cable is among the members."""
    found = [Offer(release) for release in alternatives(releases)]
    largest = found[0].release
    found += [Offer(release, added=ADDED) for release in (largest, replace(largest, turned=True))]
    if "cable_restraint" in members:
        found += [Offer(release, without=("cable_restraint",)) for release in (largest, replace(largest, turned=True))]
    return found


def apart(H: np.ndarray, blocks: Sequence[np.ndarray], size: np.ndarray) -> float:
    """Return log-likelihood units by which the first effect, at `size`, is told from its nearest rival.

    H (C, C): information about the numbers of all members, everything else eliminated; blocks: whose number is whose.
    Half the squared part of the first effect that no amount of a rival makes up for.
    """
    first, least = blocks[0], np.inf
    for rival in blocks[1:]:
        H_rr = H[np.ix_(rival, rival)] + 1e-9 * np.eye(len(rival))
        H_fr = H[np.ix_(first, rival)]
        left = H[np.ix_(first, first)] - H_fr @ np.linalg.solve(H_rr, H_fr.T)
        least = min(least, float(size @ left @ size) / 2)
    return least


def separating_run(problem: FitProblem, model: Model, members: Sequence[str], size: np.ndarray, end: float) -> str:
    """Return the offered run that tells the members of a class apart best, in a sentence; "" where none can be had.

    model : the baseline as fitted; members : the leading effect first; size : of its switches [prior deviations]
    end : seconds used of each run, for the source's block.
    """
    if any(id in LEFT_OUT for id in members):
        return ""
    effects = [catalogue.find(id) for id in members]
    uncertainty = problem.experiment.tilt_uncertainty or TILT_UNCERTAINTY
    shared = len(law_parameters(model))
    ends = np.cumsum([0, *(len(switches_of(kind, model)) for kind in effects)])
    blocks = [np.arange(a, b) for a, b in zip(ends, ends[1:], strict=False)]

    def information(offer: Offer) -> np.ndarray:
        block = replace(model, origin={}).replace(mass=model.mass * (1 + offer.added))
        workers = problem.listener.workers
        H = says(block, offer.release, effects, problem.listener.gyro, uncertainty, workers=workers, duration=end)
        for id in offer.without:
            own = shared + blocks[members.index(id)]
            H[own, :] = H[:, own] = 0.0
        return H

    def told(H: np.ndarray) -> float:
        return apart(eliminated(H + np.eye(len(H)), shared), blocks, size)

    done = [Release(round(r.release_tilt or 0.0, 4), bool(r.block_turned)) for r in problem.runs]
    known = {release: information(Offer(release)) for release in sorted(set(done))}
    now = np.sum([known[release] for release in done], axis=0)
    again = max(told(now + H) for H in known.values()) - told(now)
    gains = {offer: told(now + information(offer)) - told(now) for offer in offers(done, members)}
    best = max(gains, key=lambda offer: gains[offer])
    return (
        f"To tell {members[0]} from {' and '.join(members[1:])}: {best}. By simulation this run adds "
        f"{gains[best]:.0f} units of the log-likelihood; repeating one that was made adds {again:.0f}."
    )
