"""The evolutionary search: covariance matrix adaptation, with a checkpoint every generation.

The optimiser is `cmaes` (N. Hansen, The CMA evolution strategy: a tutorial, arXiv:1604.00772). Its random numbers are
seeded from (seed, generation) before each generation, and a checkpoint holds the costs of all chromosomes so far:
resuming asks and tells through the stored generations, which gives the optimiser's state to the last bit without
reading its inside. So an interrupted search that is resumed has the same end as one that was not.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.jobs.campaign import Campaign
from rockref.model.errors import InputError
from rockref.model.storage import write_text

SCHEMA = "rockref-search-1"


@dataclass(frozen=True)
class Settings:
    """How to search. The source: 250 generations of 40 chromosomes (about 10 000 simulations).

    sigma : first spread in parts of the ranges; decided: a quarter, so that the first generations see the whole range.
    mean : where the first generation is centred, in parts of the ranges; by default in the middle.
    """

    population: int = 40
    generations: int = 250
    seed: int = 0
    sigma: float = 0.25
    mean: tuple[float, ...] | None = None


@dataclass(eq=False)
class History:
    """What every generation brought: costs (g, population), best u so far (g, G), its cost (g,), means (g, G)."""

    costs: list[list[float]] = field(default_factory=list)
    best: list[list[float]] = field(default_factory=list)
    best_cost: list[float] = field(default_factory=list)
    means: list[list[float]] = field(default_factory=list)
    restarts: list[int] = field(default_factory=list)

    def add(self, costs: Sequence[float], u: np.ndarray, cost: float, strategy: _Strategy) -> None:
        """Note a generation."""
        self.costs.append(list(costs))
        self.best.append([float(x) for x in u])
        self.best_cost.append(float(cost))
        self.means.append([float(x) for x in strategy.mean])
        self.restarts = list(strategy.restarts)


@dataclass(frozen=True, eq=False)
class Found:
    """The end of a search: u (G,) in [0, 1], its cost, and the history."""

    u: np.ndarray
    cost: float
    history: History


@dataclass(frozen=True)
class Progress:
    """What a generation reports: number done and wanted, cost and chromosome of the best so far, seconds left."""

    generation: int
    generations: int
    cost: float
    u: np.ndarray
    seconds_left: float


def search(
    cost: Callable[..., Sequence[float]],
    shared: tuple,
    size: int,
    settings: Settings,
    campaign: Campaign,
    identity: dict[str, Any] | None = None,
    checkpoint: Path | None = None,
    resume: bool = False,
    report: Callable[[Progress], None] | None = None,
) -> Found:
    """Look for the u (size,) in [0, 1] of least cost.

    cost : called as `cost(*shared, chromosomes)`, chromosomes (B, size); gives B numbers.
    identity : what the search is (`fingerprint`);  checkpoint : JSON file written whole after every generation; with
    `resume` the search goes on from it, to the same end as without interruption, bit for bit.

    Raises InputError: E-RESUME, where the checkpoint belongs to another search; E-FILE, where it cannot be read.
    """
    identity = {
        **(identity or {}),
        "schema": SCHEMA,
        "settings": asdict(settings),
        "size": size,
        "versions": versions(),
    }
    stored = _read(checkpoint, identity) if resume and checkpoint is not None and checkpoint.exists() else []
    strategy, history, start = _Strategy(size, settings), History(), time.monotonic()
    best_u, best_cost = strategy.mean, np.inf
    for g in range(settings.generations):
        chromosomes = strategy.ask(g)
        costs = stored[g] if g < len(stored) else [float(c) for c in campaign(cost, shared, list(chromosomes))]
        strategy.tell(chromosomes, costs)
        leader = int(np.argmin(costs))
        if costs[leader] < best_cost:
            best_u, best_cost = chromosomes[leader], costs[leader]
        history.add(costs, best_u, best_cost, strategy)
        if checkpoint is not None and g >= len(stored):
            _write(checkpoint, identity, history)
        if report is not None:
            done = max(1, g + 1 - len(stored))
            left = (time.monotonic() - start) / done * (settings.generations - g - 1)
            report(Progress(g + 1, settings.generations, best_cost, best_u, left))
    return Found(best_u, best_cost, history)


class _Strategy:
    """The optimiser with its generations seeded one by one; begins anew, elsewhere, where it has converged."""

    def __init__(self, size: int, settings: Settings):
        self.size, self.settings = size, settings
        self.restarts: list[int] = []
        self.optimiser = self._made(np.full(size, 0.5) if settings.mean is None else np.array(settings.mean))

    def _made(self, mean: np.ndarray):
        from cmaes import CMA

        box = np.array([[0.0, 1.0]] * self.size)
        return CMA(mean, self.settings.sigma, bounds=box, population_size=self.settings.population, seed=0)

    @property
    def mean(self) -> np.ndarray:
        return self.optimiser.mean

    def ask(self, generation: int) -> np.ndarray:
        if self.optimiser.should_stop():
            self.restarts.append(generation)
            self.optimiser = self._made(_random(self.settings.seed, generation, 1).uniform(0.2, 0.8, self.size))
        self.optimiser.reseed_rng(int(_random(self.settings.seed, generation, 0).integers(2**32)))
        return np.array([self.optimiser.ask() for _ in range(self.settings.population)])

    def tell(self, chromosomes: np.ndarray, costs: Sequence[float]) -> None:
        self.optimiser.tell(list(zip(chromosomes, costs, strict=True)))


def _random(seed: int, generation: int, purpose: int) -> np.random.Generator:
    return np.random.default_rng([seed, generation, purpose])


def versions() -> dict[str, str | None]:
    """Return versions of what a search computes with."""
    from importlib.metadata import PackageNotFoundError, version

    found: dict[str, str | None] = {}
    for name in ("rockref", "numpy", "scipy", "numba", "cmaes"):
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            found[name] = None
    return found


def _write(path: Path, identity: dict[str, Any], history: History) -> None:
    best = {"u": history.best[-1], "cost": history.best_cost[-1]}
    write_text(path, json.dumps({"search": identity, "costs": history.costs, "best": best}))


def _read(path: Path, identity: dict[str, Any]) -> list[list[float]]:
    try:
        stored = json.loads(path.read_text(encoding="utf-8"))
        other, costs = stored["search"], stored["costs"]
        if not (isinstance(other, dict) and isinstance(costs, list)):
            raise TypeError("other types than are written")
    except (OSError, ValueError, KeyError, TypeError) as e:
        raise InputError("E-FILE", str(path), f"is no checkpoint of a search ({e})", "Start without --resume.") from e
    mine = json.loads(json.dumps(identity))
    if other != mine:
        keys = [k for k in mine if other.get(k) != mine[k]]
        cure = "Resume with the same experiment, settings and versions, or start without --resume."
        raise InputError("E-RESUME", str(path), f"belongs to another search ({', '.join(keys)} differ)", cure)
    return costs
