"""Predictions beside tests on a shake table: scores of probabilities, distances of distributions, ceilings of repeats.

What is fitted to tests is fitted to those of other motions than the one it predicts; intervals are those of resampled
motions.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any, NamedTuple

import numpy as np

from rockref.api import Model
from rockref.model.errors import InputError
from rockref.model.response import OVERTURNED
from rockref.shake.ensemble import AFTER, Ensemble, run_ensemble, shares_that_fell
from rockref.shake.experiment import MAXIMA, ShakenExperiment
from rockref.shake.statistics.bands import dkw_half_width
from rockref.shake.statistics.distances import energy_distance, exchange_test, kolmogorov_smirnov
from rockref.shake.statistics.held_out import held_out_choice, held_out_regression
from rockref.shake.statistics.resampling import mean_over_motions, paired_difference
from rockref.shake.statistics.scores import Repeats, brier_scores, hits, log_losses, repeats

#: The prediction that knows no block: what a model has to beat.
BAR = "regression on PGA and PGV/PGA"
CHOICE = "the best of these on other motions"
#: decided: the share of falls of a test is then known to 0.11 where it is one half; less than tests tell.
RUNS = 20


class Sample(NamedTuple):
    """Maxima (m,) of one quantity, the motion (m,) of each, and which run of its test it is (m,)."""

    values: np.ndarray
    motion: np.ndarray
    run: np.ndarray


@dataclass(frozen=True, eq=False)
class ShakenComparison:
    """What predictions say beside what was measured.

    probabilities : (n,) of falling in each test, by name of the prediction, the bar first where there is one
    maxima : by quantity and name, ``measured`` first
    """

    experiment: ShakenExperiment
    probabilities: dict[str, np.ndarray]
    maxima: dict[str, dict[str, Sample]]
    ceiling: Repeats | None
    how: dict[str, Any]

    def scores(self) -> list[dict[str, Any]]:
        """Return of each prediction log loss [nat], Brier score and accuracy with their intervals.

        ``more`` is the log loss less that of the first prediction, on the same tests; None for the first.
        """
        e, found = self.experiment, []
        first: np.ndarray | None = None
        for name, p in self.probabilities.items():
            assert e.fell is not None
            losses = log_losses(p, e.fell)
            more = None if first is None else asdict(paired_difference(losses, first, e.motion))
            first = losses if first is None else first
            row = {"log_loss": losses, "brier": brier_scores(p, e.fell), "accuracy": hits(p, e.fell)}
            means = {key: asdict(mean_over_motions(values, e.motion)) for key, values in row.items()}
            found.append({"name": name, **means, "more": more})
        return found

    def distances(self, draws: int = 999) -> list[dict[str, Any]]:
        """Return how far the maxima of each prediction lie from the measured ones.

        ``ks`` is the largest difference of the distribution functions, ``band`` what it stays below where both sides
        are independent runs of one distribution. ``p_value`` is that of the energy distance between the tests and one
        run of each test, whole motions exchanged: sides of unlike size cannot be exchanged, since the distance falls
        with the size.  draws : random exchanges.
        """
        found = []
        for quantity, samples in self.maxima.items():
            x, of_x, _ = samples["measured"]
            for name, (y, of_y, run) in samples.items():
                if name == "measured":
                    continue
                test = exchange_test(x, y[run == 0], of_x, of_y[run == 0], draws=draws)
                row = {"quantity": quantity, "unit": MAXIMA[quantity], "name": name, "tests": len(x), "runs": len(y)}
                row |= {"ks": kolmogorov_smirnov(x, y), "band": dkw_half_width(len(x)) + dkw_half_width(len(y))}
                found.append(row | {"energy_distance": energy_distance(x, y), "p_value": test.p_value})
        return found

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as plain values."""
        e = self.experiment
        ceiling = None if self.ceiling is None else {**asdict(self.ceiling), **self.ceiling.floors()}
        return {
            "schema": "rockref.compare.shaken/1", "experiment": e.name, "sha256": e.digest, "tests": len(e.motion),
            "motions": len(np.unique(e.motion)), "fell": None if e.fell is None else int(e.fell.sum()),
            "predictions": self.scores(), "maxima": self.distances(), "repeats": ceiling, **self.how,
            "notices": [str(notice) for notice in e.notices],
        }  # fmt: skip


def compare_shaken(
    experiment: ShakenExperiment,
    models: Sequence[Model] = (),
    names: Sequence[str] = (),
    *,
    runs: int = RUNS,
    step: float = 1e-5,
    after: float = AFTER,
    seed: int = 0,
    workers: int | None = None,
    say: Callable[[str], None] = lambda text: None,
) -> ShakenComparison:
    """Put models, stated probabilities and a regression beside tests on a shake table.

    runs : of each test and model, over what the experiment says is unknown;  step, after [s], seed: of `Ensemble`

    Raises InputError: E-MOTIONS for tests of one motion only, E-RECORD where models are given without records, and as
    runs do.
    """
    if len(np.unique(experiment.motion)) < 2:
        cure = "Shake with several motions: one says nothing about others. Name them in the column motion."
        raise InputError("E-MOTIONS", experiment.name, "has tests of one motion only", cure)
    of_models = {}
    for name, model in zip(names, models, strict=True):
        say(f"{name}: {runs} runs of {len(experiment.motion)} tests")
        of_models[name] = _runs_of(experiment, model, runs, step, after, seed, workers)
    how = {"runs_a_test": runs, "step_s": step, "after_s": after, "seed": seed} if models else {}
    return ShakenComparison(
        experiment,
        _probabilities(experiment, of_models, runs),
        _maxima(experiment, of_models, runs),
        _ceiling(experiment),
        how,
    )


def _runs_of(
    experiment: ShakenExperiment, model: Model, runs: int, step: float, after: float, seed: int, workers: int | None
) -> list[dict[str, Any]]:
    """Return the rows of the runs of one model: test 0, 1, ..., n - 1, 0, 1, ..."""
    if experiment.motions is None:
        cure = "Give the records of the motions, or the model's probabilities in a column p_NAME."
        raise InputError("E-RECORD", experiment.name, "has no column record, and models need motions", cure)
    ensemble = Ensemble(model, experiment.motions, (1.0,), experiment.draws, step, after, seed)
    return run_ensemble(ensemble, runs * len(experiment.motions), workers)


def _probabilities(
    experiment: ShakenExperiment, of_models: dict[str, list[dict[str, Any]]], runs: int
) -> dict[str, np.ndarray]:
    fell, found = experiment.fell, dict[str, np.ndarray]()
    if fell is None:
        return found
    if experiment.sizes is not None:
        pga, pgv = experiment.sizes.T
        features = np.log(np.column_stack([pga, pgv / pga]))
        # One shape of motion has one PGV/PGA.
        vary = np.ptp(features, axis=0) > 1e-9
        found[BAR if vary.all() else "regression on PGA"] = held_out_regression(
            features[:, vary], fell, experiment.motion
        )
    found |= experiment.stated
    # Jeffreys' prior of a share: half a run more on either side.
    own = {k: (runs * shares_that_fell(rows, len(fell)) + 0.5) / (runs + 1) for k, rows in of_models.items()}
    if len(own) > 1:
        found |= own
        own = {CHOICE: held_out_choice(np.column_stack(list(own.values())), fell, experiment.motion)[0]}
    return found | own


def _maxima(
    experiment: ShakenExperiment, of_models: dict[str, list[dict[str, Any]]], runs: int
) -> dict[str, dict[str, Sample]]:
    """Return the maxima, measured and of runs. A fall counts as a tilt of 45 degrees; slide and twist are of stands."""
    n = len(experiment.motion)
    fell = np.zeros(n) if experiment.fell is None else experiment.fell
    found = {}
    for quantity, values in experiment.maxima.items():
        samples = {"measured": _sample(quantity, values, fell, experiment.motion, n)}
        for name, rows in of_models.items():
            column = np.array([row[f"{quantity}_{MAXIMA[quantity]}"] for row in rows], float)
            ended = np.array([row["fell"] for row in rows], float)
            samples[name] = _sample(quantity, column, ended, np.tile(experiment.motion, runs), n)
        # A distance needs both sides, of the run that is exchanged too.
        if len(samples["measured"].values):
            found[quantity] = {name: sample for name, sample in samples.items() if (sample.run == 0).any()}
    return found


def _sample(quantity: str, values: np.ndarray, fell: np.ndarray, motion: np.ndarray, tests: int) -> Sample:
    # A block that falls goes through 45 degrees, where runs end; how far it slides then is no maximum of a motion.
    values = np.where(fell == 1.0, OVERTURNED if quantity == "tilt" else np.nan, values)
    there = np.isfinite(values)
    return Sample(values[there], motion[there], np.flatnonzero(there) // tests)


def _ceiling(experiment: ShakenExperiment) -> Repeats | None:
    if experiment.fell is None or experiment.sizes is None:
        return None
    try:
        return repeats(experiment.motion, experiment.sizes[:, 0], experiment.fell)
    except InputError as e:
        if e.code != "E-REPEATS":
            raise
        return None
