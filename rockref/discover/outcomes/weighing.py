"""From likelihoods at several sizes to evidence: the size of each candidate, its weight, what held-out motions say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rockref.discover.evidence.evidence import Evidence, HypothesisEvidence, Number
from rockref.discover.fit.objective import WHITE
from rockref.discover.outcomes.candidates import CANDIDATES, Candidate
from rockref.discover.outcomes.likelihood import Likelihood, quantities, there
from rockref.shake.experiment import ShakenExperiment

#: Nats that count as one. Decided: falls and the maxima of a test come from one run, and a likelihood that is estimated
#: from few runs is itself off by some tenths of a nat a test.
TEMPERATURE = 3.0
#: One motion in so many is held out.
HELD_OUT = 4
#: The name of the held-out motions in the evidence.
HELD = "held-out motions"


@dataclass(frozen=True, eq=False)
class Profile:
    """A candidate at its sizes: z (k,) in typical sizes, zero among them, and the likelihood at each."""

    candidate: Candidate
    z: np.ndarray
    at: tuple[Likelihood, ...]

    def sums(self, part: str, tests: np.ndarray, z: Any) -> np.ndarray:
        """Return the sums over some tests of one part of the likelihood, (q, ...), at sizes z.

        Between the sizes it is a cubic spline, which a parabola, the form near its peak, passes through unchanged.
        """
        from scipy.interpolate import CubicSpline

        known = np.array([getattr(one, part)[:, tests].sum(axis=1) for one in self.at])
        return np.moveaxis(CubicSpline(self.z, known, axis=0)(z), -1, 0)


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


def weighed(profile: Profile, tests: np.ndarray) -> Weighed:
    """Return the size of a candidate. The eigenvalue makes Laplace's formula give the integral over all sizes.

    The prior is normal with a deviation of one typical size, and one-sided where the effect has one sign only.
    """
    z = np.linspace(profile.z[0], profile.z[-1], 801)
    log_p = profile.sums("measured", tests, z).sum(axis=0)
    k = int(np.argmax(log_p - 0.5 * z * z))
    prior = np.exp(-0.5 * z * z)
    weight = prior / prior.sum() * np.exp((log_p - log_p.max()) / TEMPERATURE)
    integral = log_p.max() / TEMPERATURE + np.log(weight.sum())
    occam = integral - (log_p[k] - 0.5 * z[k] ** 2) / TEMPERATURE
    share = np.cumsum(weight) / weight.sum()
    low, high = (float(z[min(int(np.searchsorted(share, q)), len(z) - 1)]) for q in (0.05, 0.95))
    eigenvalue = 1.0 + TEMPERATURE * max(float(np.expm1(-2.0 * occam)), 0.0)
    return Weighed(float(z[k]), low, high, float(log_p[k]), eigenvalue)


def evidence_of(experiment: ShakenExperiment, null: Likelihood, profiles: list[Profile]) -> Evidence:
    """Return the evidence of the baseline and of every candidate.

    A loss is in nats an outcome: WHITE where outcomes are as probable as runs of the most probable model itself are.
    """
    held, names = held_out(experiment), quantities(experiment)
    counts = there(names, experiment)
    nothing = Profile(CANDIDATES[0], np.array([-1.0, 0.0, 1.0]), (null, null, null))
    fits = [(nothing, Weighed(0.0, 0.0, 0.0, float(null.measured[:, ~held].sum()), 1.0))]
    fits += [(profile, weighed(profile, ~held)) for profile in profiles]
    top, w = max(fits, key=lambda pair: pair[1].log_p - 0.5 * pair[1].z ** 2)
    expected = {part: top.sums("expected", tests, w.z) for part, tests in (("fit", ~held), ("held", held))}
    size = np.maximum(counts[:, ~held].sum(axis=1), 1)
    hypotheses = []
    for profile, found in fits:
        said = _hypothesis(profile, found, expected["fit"], ~held, size)
        if held.any():
            excess = expected["held"].sum() - profile.sums("measured", held, found.z).sum()
            said.held_out = {HELD: float(WHITE + excess / counts[:, held].sum())}
        hypotheses.append(said if profile is not nothing else _without_effect(said))
    nearest = top.at[int(np.argmin(np.abs(top.z - w.z)))]
    by_quantity = np.sqrt(nearest.variance[:, ~held].sum(axis=1)) / size
    signature = {
        "temperature": TEMPERATURE, "quantities": list(names), "largest_standard_error": float(by_quantity.max()),
        "standard_error": float(np.sqrt(nearest.variance_of_all[~held].sum()) / size.sum()),
    }  # fmt: skip
    held_samples = {HELD: int(counts[:, held].sum())} if held.any() else {}
    return Evidence(experiment.name, experiment.digest, int(size.sum()), held_samples, hypotheses, signature=signature)


def _hypothesis(
    profile: Profile, found: Weighed, expected: np.ndarray, tests: np.ndarray, size: np.ndarray
) -> HypothesisEvidence:
    excess, c = expected - profile.sums("measured", tests, found.z), profile.candidate
    value, low, high = (size * c.typical for size in (found.z, found.low, found.high))
    number = Number(value, low, high, c.unit, found.z, found.z)
    return HypothesisEvidence(
        effects=(c.id,),
        objective=0.5 * found.z**2 - found.log_p,
        eigenvalues=[found.eigenvalue],
        loss=float(WHITE + excess.sum() / size.sum()),
        loss_by_run_and_axis={"outcomes": (WHITE + excess / size).tolist()},
        blocks={},
        farthest=0.0,
        numbers={f"{c.id}.{c.key}": number},
    )


def _without_effect(said: HypothesisEvidence) -> HypothesisEvidence:
    said.effects, said.numbers, said.eigenvalues = (), {}, []
    return said
