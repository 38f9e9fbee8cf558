"""The twin experiment: what made a simulated record comes back, or it is said why not.

The reference is made with a tenth of the step and the noise of a gyroscope, so that the fit does not meet its own
errors; the search knows nothing of what made it but the release angle within the wire's 0.08 degrees.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.identify.genes import chromosome, space_12
from rockref.identify.identifiability import identifiability
from rockref.identify.identification import identify
from rockref.identify.polish import Effort
from rockref.identify.refine import JUDGED_STEP
from rockref.identify.search import Settings
from rockref.identify.target import twin
from rockref.identify.unknowns import Unknowns, signal_costs
from rockref.jobs.campaign import Campaign, campaign
from rockref.model.parameters import TABLE_3_1

#: Step of the reference [s]: a tenth of that of the fit; decided: what nature does is nearer to none than to half.
REFERENCE_STEP = 1e-6
#: Seeds of the table; decided.
SEEDS = (1, 2, 3, 4, 5, 6, 7, 8)
#: What the least squares of one seed may do; decided: eight seeds in six minutes on two cores.
EFFORT = Effort(moves=1, walks=3)


def twin_experiments(
    model: Model, seeds: Sequence[int], settings: Settings, work: Campaign, effort: Effort = EFFORT
) -> Iterator[tuple[int, dict[str, Any]]]:
    """Return one row a seed (`twin_experiment`), with its index, as it is done; the seeds are spread over the
    workers."""
    return work.as_done(_several, (model, settings, effort), list(seeds))


def _several(model: Model, settings: Settings, effort: Effort, seeds: Sequence[int]) -> list[dict[str, Any]]:
    return [twin_experiment(model, seed, settings, effort) for seed in seeds]


def twin_experiment(model: Model, seed: int, settings: Settings, effort: Effort = EFFORT) -> dict[str, Any]:
    """Identify `model` (of Table 3.1's kind) from a record that it made itself with the noise of `seed`.

    Returns, for JSON: seed; cost after the search; chi2 after the least squares and of the truth; at_floor; and by
    parameter: error and standard error in units of the last digit of Table 3.1, and whether the data determine it;
    trade_offs : pairs with their correlation;  weakest : the combination that the data see least.
    """
    from dataclasses import replace

    reference = twin(model, REFERENCE_STEP, seed)
    space = space_12(model)
    with campaign(1) as here:
        end = identify(space, [reference], [reference], replace(settings, seed=seed), here, rounds=0, effort=effort)
    known = identifiability(space, [reference], end.polished)
    truth = chromosome(space, model.parameters)
    at_truth = Unknowns(space, [reference]).z(truth)
    precision = np.array([given.precision for given in TABLE_3_1.values()])
    off = (space.values(end.polished.u) - space.values(truth)) / precision
    spread = {name.split(" of ")[0]: value for name, value in known.digits().items()}
    determined = {name.split(" of ")[0]: value for name, value in known.determined().items()}
    return {
        "seed": seed,
        "cost": end.found.cost,
        "chi2": end.polished.chi2,
        "chi2_of_the_truth": signal_costs(space, [reference], JUDGED_STEP, [at_truth])[0],
        "at_floor": end.at_floor,
        "parameters": {
            name: {"off": float(off[i]), "error": spread[name], "determined": determined[name]}
            for i, name in enumerate(space.names)
        },
        "trade_offs": [[a.split(" of ")[0], b.split(" of ")[0], r] for a, b, r in known.pairs],
        "weakest": {name.split(" of ")[0]: value for name, value in known.weakest.items()},
    }
