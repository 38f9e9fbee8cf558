"""From likelihoods at several sizes to evidence: the size of each candidate, its weight, what held-out motions say."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, Number
from rockref.discover.fit.objective import WHITE
from rockref.discover.outcomes.candidates import Candidate
from rockref.discover.outcomes.curves import Curves, Profile
from rockref.discover.outcomes.likelihood import Likelihood, quantities, there
from rockref.shake.experiment import ShakenExperiment

#: Nats that count as one. Where nothing is hidden no candidate gains more than 1.3 nats counted singly (two sets of 48
#: tests, eight runs of each); decided: twice that, since falls and maxima of a test come from one run.
TEMPERATURE = 2.0
#: Share of the posterior in an interval.
SHARE = 0.9
#: One motion in so many is held out.
HELD_OUT = 4
#: The name of the held-out motions in the evidence.
HELD = "held-out motions"


class Weighed(NamedTuple):
    """A candidate's most probable size with its 90 % interval [typical sizes], log probability and eigenvalue there.

    open : the interval ends where no larger size was run
    """

    z: float
    low: float
    high: float
    log_p: float
    eigenvalue: float
    open: bool = False


def held_out(experiment: ShakenExperiment) -> np.ndarray:
    """Return which tests (n,) are held out: those of every fourth motion; none where there are fewer than four."""
    return np.isin(experiment.motion, np.unique(experiment.motion)[HELD_OUT - 1 :: HELD_OUT])


def weighed(curves: Curves, k: int, tests: np.ndarray) -> Weighed:
    """Return the size of candidate k: the mode of its posterior at `TEMPERATURE`, and the 90 % that are densest.

    The prior is normal with a deviation of one typical size, and one-sided where the effect has one sign only. The
    eigenvalue makes Laplace's formula give the integral over all sizes.
    """
    z = np.linspace(*curves.reach(k), 801)
    log_p = curves.sums("measured", tests, k, z).sum(axis=0)
    sides = 1.0 if curves.profiles[k].candidate.signed else 2.0
    log_density = log_p / TEMPERATURE - 0.5 * z * z + np.log(sides / np.sqrt(2.0 * np.pi))
    at = int(np.argmax(log_density))
    density = np.exp(log_density - log_density[at])
    integral = log_density[at] + np.log(np.trapezoid(density, z))
    occam = integral - (log_p[at] - 0.5 * z[at] ** 2) / TEMPERATURE
    eigenvalue = 1.0 + TEMPERATURE * max(float(np.expm1(-2.0 * occam)), 0.0)
    low, high, is_open = interval(z, density, curves.tried(k).z)
    return Weighed(float(z[at]), low, high, float(log_p[at]), eigenvalue, is_open)


def interval(z: np.ndarray, density: np.ndarray, tried: np.ndarray) -> tuple[float, float, bool]:
    """Return the densest 90 % of a posterior on a grid z, and whether it ends with the sizes that were tried.

    It reaches half the spacing of the sizes about the mode to either side: what is between two sizes was not seen.
    """
    at = int(np.argmax(density))
    order = np.argsort(-density)
    enough = int(np.searchsorted(np.cumsum(density[order]), SHARE * density.sum())) + 1
    inside = z[order[:enough]]
    above = int(np.clip(np.searchsorted(tried, z[at]), 1, len(tried) - 1))
    half = 0.5 * (tried[above] - tried[above - 1])
    low, high = max(min(inside.min(), z[at] - half), tried[0]), min(max(inside.max(), z[at] + half), tried[-1])
    step = z[1] - z[0]
    ends = (tried[0] < 0.0 and low <= tried[0] + step) or high >= tried[-1] - step
    return float(low), float(high), bool(ends)


def evidence_of(experiment: ShakenExperiment, null: Likelihood, profiles: list[Profile]) -> Evidence:
    """Return the evidence of the baseline and of every candidate.

    A loss is in nats an outcome: WHITE where outcomes are as probable as runs of the most probable model itself are.
    """
    held, names = held_out(experiment), quantities(experiment)
    counts, curves = there(names, experiment), Curves(null, tuple(profiles), ~held)
    baseline = Weighed(0.0, 0.0, 0.0, float(curves.sums("measured", ~held, None, 0.0).sum()), 1.0)
    fits = [(None, baseline), *((k, weighed(curves, k, ~held)) for k in range(len(profiles)))]
    top, w = max(fits, key=lambda pair: pair[1].log_p - 0.5 * pair[1].z ** 2)
    expected = {part: curves.sums("expected", tests, top, w.z) for part, tests in (("fit", ~held), ("held", held))}
    size = np.maximum(counts[:, ~held].sum(axis=1), 1)
    hypotheses = []
    for k, found in fits:
        excess = expected["fit"] - curves.sums("measured", ~held, k, found.z)
        said = _hypothesis(None if k is None else profiles[k].candidate, found, excess, size)
        if held.any():
            less = expected["held"].sum() - curves.sums("measured", held, k, found.z).sum()
            said.held_out = {HELD: float(WHITE + less / counts[:, held].sum())}
        hypotheses.append(said)
    by_quantity = np.sqrt(null.variance[:, ~held].sum(axis=1)) / size
    signature = {
        "temperature": TEMPERATURE, "quantities": list(names), "largest_standard_error": float(by_quantity.max()),
        "standard_error": float(np.sqrt(null.variance_of_all[~held].sum()) / size.sum()),
        "open_ends": [profiles[k].candidate.id for k, one in fits if k is not None and one.open],
    }  # fmt: skip
    held_samples = {HELD: int(counts[:, held].sum())} if held.any() else {}
    return Evidence(experiment.name, experiment.digest, int(size.sum()), held_samples, hypotheses, signature=signature)


def _hypothesis(c: Candidate | None, found: Weighed, excess: np.ndarray, size: np.ndarray) -> HypothesisEvidence:
    """Return the hypothesis of a candidate (None: the baseline) that lacks nats (q,) on `size` outcomes (q,)."""
    said = HypothesisEvidence(
        effects=(),
        objective=0.5 * found.z**2 - found.log_p,
        eigenvalues=[],
        loss=float(WHITE + excess.sum() / size.sum()),
        loss_by_run_and_axis={"outcomes": (WHITE + excess / size).tolist()},
        floor_by_run_and_axis={"outcomes": [WHITE] * len(size)},
        blocks={},
        farthest=0.0,
    )
    if c is not None:
        value, low, high = (size * c.typical for size in (found.z, found.low, found.high))
        said.effects, said.eigenvalues = (c.id,), [found.eigenvalue]
        said.numbers = {f"{c.id}.{c.key}": Number(value, low, high, c.unit, found.z, found.z)}
    return said
