"""How probable the outcomes of tests are under runs of a model: falls, and the maxima of what stood."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.discover.outcomes.candidates import Setting
from rockref.shake.ensemble import Ensemble, run_ensemble
from rockref.shake.experiment import MAXIMA, ShakenExperiment

#: What a maximum is not resolved below [rad, m]: decided, three hundredths of a degree, a tenth of a millimetre.
FLOOR = {"tilt": 5e-4, "slide": 1e-4, "twist": 5e-4}
#: Runs that the scatter common to all tests counts for beside a test's own; decided: few runs say little of a scatter.
COMMON = 4.0
FELL = "fell"


@dataclass(frozen=True, eq=False)
class Likelihood:
    """Of each test: the logarithm of the probability of its outcomes [nat], what runs of the model itself would have.

    measured, expected, variance : (q, n), by quantity and test; zero where a test has no such outcome
    variance_of_all : (n,) of the sum over the quantities, whose outcomes depend on one another
    """

    measured: np.ndarray
    expected: np.ndarray
    variance: np.ndarray
    variance_of_all: np.ndarray


def quantities(experiment: ShakenExperiment) -> tuple[str, ...]:
    """Return the outcomes that tests of an experiment state."""
    return (*((FELL,) if experiment.fell is not None else ()), *experiment.maxima)


def simulated(
    setting: Setting, runs: int, step: float, after: float, seed: int, workers: int | None
) -> dict[str, np.ndarray]:
    """Return the outcomes (runs, n) of so many runs of every test, by quantity.

    The draws of a run depend on the seed and its number alone, so two settings are compared under the same draws.
    Raises InputError as runs do (E-STAND).
    """
    n = len(setting.motions)
    ensemble = Ensemble(setting.model, setting.motions, (1.0,), setting.draws, step, after, seed)
    rows = run_ensemble(ensemble, runs * n, workers)
    columns = {FELL: FELL} | {quantity: f"{quantity}_{unit}" for quantity, unit in MAXIMA.items()}
    return {name: np.array([row[key] for row in rows], float).reshape(runs, n) for name, key in columns.items()}


def likelihood(experiment: ShakenExperiment, outcomes: dict[str, np.ndarray]) -> Likelihood:
    """Return how probable the tests are, and each run of a test beside the others of that test."""
    names, runs = quantities(experiment), len(outcomes[FELL])
    given = {FELL: falls(experiment), **experiment.maxima}
    measured = log_probabilities(names, given, outcomes)
    own = []
    for j in range(runs):
        one = {key: values[j] for key, values in outcomes.items()}
        others = {key: np.delete(values, j, axis=0) for key, values in outcomes.items()}
        own.append(np.where(there(names, experiment), log_probabilities(names, one, others), 0.0))
    return Likelihood(measured, np.mean(own, axis=0), np.var(own, axis=0), np.var(np.sum(own, axis=1), axis=0))


def there(names: tuple[str, ...], experiment: ShakenExperiment) -> np.ndarray:
    """Return whether a test has an outcome of each quantity (q, n), as a test that fell would have had."""
    fell = falls(experiment)
    measured = {FELL: np.ones(len(fell), bool)} | {k: np.isfinite(x) for k, x in experiment.maxima.items()}
    return np.array([measured[k] | (fell == 1.0) for k in names])


def falls(experiment: ShakenExperiment) -> np.ndarray:
    """Return which tests fell (n,), 0 or 1; none where that is not stated."""
    return np.zeros(len(experiment.motion)) if experiment.fell is None else experiment.fell


def log_probabilities(
    names: tuple[str, ...], given: dict[str, np.ndarray], outcomes: dict[str, np.ndarray]
) -> np.ndarray:
    """Return the logarithm of the probability (q, n) of given outcomes (n,) under runs (runs, n) of the same tests."""
    runs = len(outcomes[FELL])
    # Jeffreys' prior of a share: half a run more on either side.
    p = (outcomes[FELL].sum(axis=0) + 0.5) / (runs + 1.0)
    found = []
    for name in names:
        if name == FELL:
            found.append(np.where(given[FELL] == 1.0, np.log(p), np.log1p(-p)))
            continue
        x = np.log(np.maximum(given[name], FLOOR[name]))
        y = np.log(np.maximum(outcomes[name], FLOOR[name]))
        density = log_density(x, y, outcomes[FELL] == 0.0)
        found.append(np.where((given[FELL] == 0.0) & np.isfinite(x), density, 0.0))
    return np.array(found)


def log_density(x: np.ndarray, y: np.ndarray, counted: np.ndarray) -> np.ndarray:
    """Return the log density (n,) of x (n,) where runs have given y (runs, n), those that are counted.

    What a normal law with unknown mean and variance predicts is Student's t. The variance of a test is joined with one
    that all tests share; a test without a counted run has the mean and the scatter of all.
    """
    from scipy.stats import t

    number = counted.sum(axis=0)
    if not number.any():
        return np.zeros(len(x))
    z = np.where(counted, y, 0.0)
    mean = z.sum(axis=0) / np.maximum(number, 1)
    squares = np.where(counted, (y - mean) ** 2, 0.0).sum(axis=0)
    # The least scatter is that of a value known to some hundredths; a sum of zeros has none.
    common = max(squares.sum() / max(float(np.maximum(number - 1, 0).sum()), 1.0), 1e-4)
    freedom = np.maximum(number - 1, 0) + COMMON
    variance = (squares + COMMON * common) / freedom * (1.0 + 1.0 / np.maximum(number, 1))
    centre, spread = y[counted].mean(), y[counted].var() + common
    alone = number == 0
    scale = np.sqrt(np.where(alone, spread, variance))
    return t.logpdf(x, freedom, np.where(alone, centre, mean), scale)
