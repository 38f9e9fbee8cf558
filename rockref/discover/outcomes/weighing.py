"""From likelihoods at several sizes to evidence: the size of each candidate, its weight, what held-out motions say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, Number
from rockref.discover.fit.objective import WHITE
from rockref.discover.outcomes.candidates import Candidate
from rockref.discover.outcomes.likelihood import Likelihood, quantities, there
from rockref.shake.experiment import ShakenExperiment

#: Nats that count as one. Where nothing is hidden no candidate gains more than 1.3 nats counted singly (two sets of 48
#: tests, eight runs of each); decided: twice that, since falls and maxima of a test come from one run.
TEMPERATURE = 2.0
#: Nats below the best size by which a size loses half its weight in the curve; decided: some standard errors.
FAR = 10.0
#: One motion in so many is held out.
HELD_OUT = 4
#: The name of the held-out motions in the evidence.
HELD = "held-out motions"


@dataclass(frozen=True, eq=False)
class Profile:
    """A candidate at its sizes: z (k,) in typical sizes, without zero, and the likelihood at each."""

    candidate: Candidate
    z: np.ndarray
    at: tuple[Likelihood, ...]


@dataclass(frozen=True, eq=False)
class Curves:
    """The likelihood over the size of every candidate: parabolas that share their value at zero, the baseline.

    Few runs estimate each likelihood with an error of some nats, and the largest of many would be an error. So one
    least-squares fit goes through all sizes of all candidates; one at which the outcomes are by `FAR` nats less
    probable than at the best size counts half.
    """

    null: Likelihood
    profiles: tuple[Profile, ...]

    def sums(self, part: str, tests: np.ndarray, k: int | None, z: Any) -> np.ndarray:
        """Return the sums over some tests of one part of the likelihood, (q, ...), of candidate k at sizes z."""
        rows = [(self.null, 0, 0.0), *((one, c, x) for c, p in enumerate(self.profiles)
                                       for one, x in zip(p.at, p.z, strict=True))]  # fmt: skip
        known = np.array([getattr(one, part)[:, tests].sum(axis=1) for one, _, _ in rows])
        level = np.array([one.measured[:, tests].sum() for one, _, _ in rows])
        root = 1.0 / np.sqrt(1.0 + ((level.max() - level) / FAR) ** 2)[:, None]
        design = np.zeros((len(rows), 1 + 2 * len(self.profiles)))
        design[:, 0] = 1.0
        for row, (_, c, x) in zip(design, rows, strict=True):
            row[1 + 2 * c : 3 + 2 * c] = x, x * x
        found = np.linalg.lstsq(root * design, root * known, rcond=None)[0]
        zero, b, a = (found[0], 0 * found[0], 0 * found[0]) if k is None else found[[0, 1 + 2 * k, 2 + 2 * k]]
        sizes = np.asarray(z)[..., None]
        return np.moveaxis(zero + sizes * b + sizes**2 * a, -1, 0)


class Weighed(NamedTuple):
    """A candidate's most probable size with its 90 % interval [typical sizes], log probability and eigenvalue there."""

    z: float
    low: float
    high: float
    log_p: float
    eigenvalue: float


def held_out(experiment: ShakenExperiment) -> np.ndarray:
    """Return which tests (n,) are held out: those of every fourth motion; none where there are fewer than four."""
    return np.isin(experiment.motion, np.unique(experiment.motion)[HELD_OUT - 1 :: HELD_OUT])


def weighed(curves: Curves, k: int, tests: np.ndarray) -> Weighed:
    """Return the size of candidate k. The eigenvalue makes Laplace's formula give the integral over all sizes.

    The prior is normal with a deviation of one typical size, and one-sided where the effect has one sign only.
    """
    ends = curves.profiles[k].z
    z = np.linspace(min(0.0, ends[0]), max(0.0, ends[-1]), 801)
    log_p = curves.sums("measured", tests, k, z).sum(axis=0)
    at = int(np.argmax(log_p - 0.5 * z * z))
    prior = np.exp(-0.5 * z * z)
    weight = prior / prior.sum() * np.exp((log_p - log_p.max()) / TEMPERATURE)
    integral = log_p.max() / TEMPERATURE + np.log(weight.sum())
    occam = integral - (log_p[at] - 0.5 * z[at] ** 2) / TEMPERATURE
    share = np.cumsum(weight) / weight.sum()
    low, high = (float(z[min(int(np.searchsorted(share, q)), len(z) - 1)]) for q in (0.05, 0.95))
    eigenvalue = 1.0 + TEMPERATURE * max(float(np.expm1(-2.0 * occam)), 0.0)
    return Weighed(float(z[at]), low, high, float(log_p[at]), eigenvalue)


def evidence_of(experiment: ShakenExperiment, null: Likelihood, profiles: list[Profile]) -> Evidence:
    """Return the evidence of the baseline and of every candidate.

    A loss is in nats an outcome: WHITE where outcomes are as probable as runs of the most probable model itself are.
    """
    held, names = held_out(experiment), quantities(experiment)
    counts, curves = there(names, experiment), Curves(null, tuple(profiles))
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
