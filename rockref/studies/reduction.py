"""From 54 genes to 12: which genes of the best chromosomes evolve together, generation by generation.

The source followed the best chromosomes of the 54-gene search and found the reduction (3.7) to (3.9): stiffness
common to all points, damping by one ratio for the inner and one for the outer points, the same in both directions.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.identify.candidates import feature_costs
from rockref.identify.genes import RANGES, Space, space_54
from rockref.identify.identification import fingerprint
from rockref.identify.search import Found, Settings, search
from rockref.identify.target import Target
from rockref.jobs.campaign import Campaign

#: What the reduction says should be one number, by the names of the 54 genes: pattern of point, property.
GROUPS: dict[str, tuple[str, tuple[str, ...]]] = {
    "K_N of all points (3.7)": ("", ("K_N",)),
    "K_T of all points (3.7)": ("", ("K_T",)),
    "beta of outer points, both directions (3.8, 3.9)": ("ext", ("C_N", "C_T")),
    "beta of inner points, both directions (3.8, 3.9)": ("int", ("C_N", "C_T")),
    "mu of outer points": ("ext", ("mu_0", "mu")),
    "mu of inner points": ("int", ("mu_0", "mu")),
}


@dataclass(frozen=True, eq=False)
class Together:
    """How a group of genes evolved: genes; correlation, mean between the members' ways; spread, of their last values in
    parts of the range; chance, spread of as many numbers drawn anywhere in the range."""

    group: str
    genes: tuple[str, ...]
    correlation: float
    others: float
    spread: float
    chance: float

    @property
    def comes_out(self) -> bool:
        """Return whether the search itself made the members one: they end within half the spread that chance would
        give, and move together more than with the rest."""
        return bool(self.spread < 0.5 * self.chance and self.correlation > self.others + 0.1)


def ways(space: Space, found: Found, mass: float) -> tuple[tuple[str, ...], np.ndarray]:
    """Return names and ways (generations, genes) of the best chromosomes in [0, 1], with damping as ratio beta
    (3.8)."""
    u = np.array(found.history.best)
    names = list(space.names)
    values = space.values(u)
    for i, name in enumerate(names):
        if " C_" in name:
            K = values[:, names.index(name.replace(" C_", " K_"))]
            beta = values[:, i] / (2 * np.sqrt(K * mass))
            low, high = RANGES["beta_int"]  # that of both ratios
            u[:, i] = np.log(beta / low) / np.log(high / low)
    return tuple(names), u


def evolve_together(space: Space, found: Found, mass: float) -> tuple[tuple[str, ...], np.ndarray]:
    """Return names and correlation (G, G) of the genes' ways, from generation to generation; genes that never move have
    0."""
    names, u = ways(space, found, mass)
    # Changes, not values: two genes that drift steadily for their own reasons would look alike.
    steps = np.diff(u, axis=0)
    steps = steps[np.any(steps != 0, axis=1)]
    if len(steps) < 3:
        return names, np.eye(len(names))
    centred = steps - steps.mean(axis=0)
    size = np.sqrt(np.sum(np.square(centred), axis=0))
    size = np.where(size > 0, size, np.inf)
    return names, centred.T @ centred / np.outer(size, size)


def groups(space: Space, found: Found, mass: float) -> list[Together]:
    """Return how far the groups of the source's reduction came out of a 54-gene search."""
    names, correlation = evolve_together(space, found, mass)
    last = ways(space, found, mass)[1][-1]
    table = []
    for group, (side, properties) in GROUPS.items():
        inside = [i for i, n in enumerate(names) if " " in n and side in n and n.split(" ")[1] in properties]
        outside = [i for i in range(len(names)) if i not in inside]
        block = correlation[np.ix_(inside, inside)]
        pairs = block[np.triu_indices(len(inside), 1)]
        rest = np.abs(correlation[np.ix_(inside, outside)])
        # Standard deviation of numbers drawn evenly from [0, 1].
        chance = float(1 / np.sqrt(12.0))
        member_names = tuple(names[i] for i in inside)
        table.append(
            Together(
                group,
                member_names,
                float(pairs.mean()),
                float(rest.mean()),
                float(np.std(last[inside], ddof=1)),
                chance,
            )
        )
    return table


def reduction_study(
    target: Target, settings: Settings, work: Campaign, checkpoint: Path | None = None
) -> dict[str, Any]:
    """Search the 54 genes for `target` and say whether the reduction comes out.

    Returns, for JSON: simulations, cost; genes; ways (generations, 54) of the best chromosomes in parts of the ranges,
    damping as ratio; correlation (54, 54) of their changes; groups, as `Together`, with `comes_out`.
    """
    model = Model.table_3_1()
    space = space_54(model, target.tilt)
    found = search(
        feature_costs, (space, [target]), len(space.genes), settings, work, fingerprint(space, [target]), checkpoint,
        resume=True,
    )  # fmt: skip
    names, way = ways(space, found, model.mass)
    _, correlation = evolve_together(space, found, model.mass)
    return {
        "simulations": sum(map(len, found.history.costs)),
        "cost": found.cost,
        "best_cost_by_generation": found.history.best_cost,
        "genes": list(names),
        "ways": np.round(way, 4).tolist(),
        "correlation": np.round(correlation, 3).tolist(),
        "groups": [asdict(g) | {"comes_out": g.comes_out} for g in groups(space, found, model.mass)],
    }
