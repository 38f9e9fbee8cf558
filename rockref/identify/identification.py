"""The whole identification: evolutionary search on the features, least squares on the signals, again where stuck."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.identify.candidates import STEP, evaluate, feature_costs
from rockref.identify.cost import Terms
from rockref.identify.genes import Space
from rockref.identify.polish import FLOOR, Effort, Polished, polish
from rockref.identify.search import Found, Progress, Settings, search
from rockref.identify.target import Target
from rockref.identify.unknowns import Unknowns, signal_costs
from rockref.jobs.campaign import Campaign

#: Rounds of search on the signals where the polish ends above the floor, their generations, and their first spread.
#: Decided: landings in a wrong order are a tenth of a range away, and forty generations are enough to tell.
ROUNDS, ROUND_GENERATIONS, ROUND_SIGMA = 3, 60, 0.08


@dataclass(frozen=True, eq=False)
class Identified:
    """The end of an identification: what the search found (with its terms for each target), what the least squares made
    of it, and how many rounds of search on the signals that took."""

    space: Space
    found: Found
    terms: list[Terms | None]
    polished: Polished
    rounds: int

    @property
    def at_floor(self) -> bool:
        """Return whether the residual is the noise."""
        return self.polished.at_floor


def identify(
    space: Space,
    search_targets: Sequence[Target],
    targets: Sequence[Target],
    settings: Settings,
    campaign: Campaign,
    folder: Path | None = None,
    resume: bool = False,
    report: Callable[[str, Progress], None] | None = None,
    rounds: int = ROUNDS,
    step: float = STEP,
    effort: Effort = Effort(),  # noqa: B008 - frozen
) -> Identified:
    """Search on `search_targets`, then least squares on `targets`.

    folder : where checkpoints are written, one a stage;  resume : go on from them;  report : (stage, progress).
    rounds : at most so many further searches, on the signals, where the least squares end above the noise floor.
    effort : of the least squares.

    Raises InputError (E-RESUME, E-FILE) as `rockref.identify.search.search`.
    """

    def stage(name: str, cost, shared: tuple, size: int, how: Settings, identity: dict[str, Any]) -> Found:
        path = None if folder is None else folder / f"{name}.json"
        say = None if report is None else (lambda p: report(name, p))
        return search(cost, shared, size, how, campaign, identity, path, resume, say)

    found = stage(
        "search", feature_costs, (space, search_targets), len(space.genes), settings, fingerprint(space, search_targets)
    )
    terms = evaluate(space, search_targets, found.u[None])[0][1]
    best, made = polish(space, targets, found.u, step, campaign.threads, effort=effort), 0
    unknowns = Unknowns(space, targets)
    while best.chi2 >= FLOOR and made < rounds:
        made += 1
        how = replace(
            settings, seed=settings.seed + 1000 * made, generations=ROUND_GENERATIONS, sigma=ROUND_SIGMA,
            mean=tuple(map(float, best.z)),
        )  # fmt: skip
        identity = fingerprint(space, targets) | {"round": made, "step": step}
        more = stage(f"signals_{made}", signal_costs, (space, targets, step), len(unknowns.names), how, identity)
        again = polish(space, targets, more.u, step, campaign.threads, z=True, effort=replace(effort, windows=()))
        best = again if again.chi2 < best.chi2 else best
    return Identified(space, found, terms, best, made)


def fingerprint(space: Space, targets: Sequence[Target]) -> dict[str, Any]:
    """Return what is searched and against what: genes, block, digests of the targets."""
    return {
        "kind": space.kind,
        "genes": [asdict(gene) for gene in space.genes],
        "block": {k: getattr(space.model, k) for k in ("mass", "width", "depth", "height", "g", "points")},
        "theta_0": space.model.parameters.theta_0,
        "targets": [{"name": t.name, "tilt": t.tilt, "turned": t.turned, "sha256": digest(t)} for t in targets],
    }


def digest(target: Target) -> str:
    """Return SHA-256 of a target's times and rates."""
    return hashlib.sha256(
        np.ascontiguousarray(target.t).tobytes() + np.ascontiguousarray(target.crv).tobytes()
    ).hexdigest()
