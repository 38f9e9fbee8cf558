"""Models beside measured runs: how far off, in which units, from when on, and with which feet on the plate."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.discover.compare.band import Departure, band, departure
from rockref.discover.compare.features import (
    EnvelopeDifference,
    Features,
    ImpactPair,
    Losses,
    SpectrumDifference,
    envelope_differences,
    features,
    impact_pairs,
    losses,
    spectrum_differences,
)
from rockref.discover.compare.stretches import StretchError, noise_of, stretch_errors
from rockref.discover.progress import StageReport
from rockref.measure.prediction import STEP, Prediction, gyro_of, predict
from rockref.measure.records.release import Experiment, Run
from rockref.measure.signals.impacts import main_impacts
from rockref.measure.signals.ledger import rocking_block
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.repeatability import Repeatability, repeat_groups, repeatability
from rockref.model.errors import InputError, NumericalError
from rockref.model.problem import GRAVITY

# decided: an envelope narrower than this many noise widths is noise.
ENVELOPE_SIGMAS = 3.0


@dataclass(frozen=True, eq=False)
class MeasuredRun:
    """What is known of one run before any model.

    Attributes: ``run``; ``noise`` (3,) rad/s; ``features``; ``repeats``, the repeatability that serves as its yardstick
    (None where no run was repeated); ``borrowed``, whether it comes from repeats of another release.
    """

    run: Run
    noise: np.ndarray
    features: Features
    repeats: Repeatability | None = field(repr=False)
    borrowed: bool

    @property
    def first_impact(self) -> float:
        """Return time of the first main impact, s; infinite if there is none."""
        times = self.features.impacts.times
        return float(times[0]) if len(times) else float("inf")


@dataclass(frozen=True, eq=False)
class RunComparison:
    """One model beside one run.

    Attributes
    ----------
    run : str
    stated, aligned : Prediction
        What the model would have recorded, let go at the stated tilt; and at the tilt, within its stated uncertainty,
        that brings its first main impact closest to the measured one.
    tilt_offset : float
        The tilt of ``aligned`` minus that of ``stated``, rad.
    shift : float
        By how much, s, ``aligned`` is then moved from the first main impact on, so that these coincide (positive: it
        was early). Up to the first main impact both are counted from the release.
    features : Features
        Of ``aligned``, on its own clock.
    modelled : (N, 3) float64
        Rates of ``aligned``, moved, at the instants of the run, rad/s; NaN beyond the simulation.
    errors : tuple of StretchError
    impacts : tuple of ImpactPair
    losses_measured, losses_model : Losses
        Over the impacts that both have.
    envelopes, spectra : tuples
        Differences between the first two main impacts.
    leaves_band : Departure or None
    overturned : bool
        Whether the modelled block fell over.
    """

    run: str
    stated: Prediction
    aligned: Prediction
    tilt_offset: float
    shift: float
    features: Features = field(repr=False)
    modelled: np.ndarray = field(repr=False)
    errors: tuple[StretchError, ...]
    impacts: tuple[ImpactPair, ...]
    losses_measured: Losses
    losses_model: Losses
    envelopes: tuple[EnvelopeDifference, ...]
    spectra: tuple[SpectrumDifference, ...]
    leaves_band: Departure | None
    overturned: bool

    def error(self, stretch: str, axis: str) -> StretchError | None:
        """Return the error of one stretch and axis, or None where the run has no such stretch."""
        return next((e for e in self.errors if (e.stretch, e.axis) == (stretch, axis)), None)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Several models beside one experiment.

    Attributes: ``experiment``; ``names`` and ``models`` in the order given; ``measured``, a MeasuredRun for every run;
    ``results[m][r]``, a RunComparison; ``engine``; ``step`` s; ``seconds`` of computing.
    """

    experiment: Experiment
    names: tuple[str, ...]
    models: tuple[Model, ...] = field(repr=False)
    measured: tuple[MeasuredRun, ...] = field(repr=False)
    results: tuple[tuple[RunComparison, ...], ...] = field(repr=False)
    engine: str
    step: float
    seconds: float

    def of(self, use: str | None = None) -> tuple[int, ...]:
        """Return the places of the runs of one use (``fit``, ``holdout``), or of all."""
        return tuple(k for k, m in enumerate(self.measured) if use is None or m.run.use == use)

    def rms(self, model: int, stretch: str, axis: str | None = None, use: str | None = None) -> float:
        """Return the RMS of an error over runs (without `axis`, over the axes too), rad/s; NaN if none."""
        values = [
            e.rms
            for k in self.of(use)
            for e in self.results[model][k].errors
            if e.stretch == stretch and axis in (None, e.axis)
        ]
        return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")

    def noise(self, axis: int | None = None) -> float:
        """Return the noise floor, rad/s: the RMS over runs (and over the three axes without `axis`)."""
        square = np.mean([m.noise**2 for m in self.measured], axis=0)
        return float(np.sqrt(np.mean(square) if axis is None else square[axis]))

    def holds_to_second_impact(self) -> bool:
        """Return whether every model keeps within the band of every run up to its second main impact."""
        for results in self.results:
            for m, r in zip(self.measured, results, strict=True):
                times = m.features.impacts.times
                end = float(times[1]) if len(times) > 1 else float("inf")
                if r.overturned or (r.leaves_band is not None and r.leaves_band.time < end):
                    return False
        return True


def baseline_model(experiment: Experiment, model: Model | None = None) -> Model:
    """Return the model from which the experimenter starts, with the block of the file: the one that he gives, or Table
    3.1 on eight or four points.

    Its own release tilt, which no run of the experiment uses, is that of the first run where the block is so slender
    that it would fall over from it.
    """
    kind = Model.four_points if experiment.baseline == "four_points" else Model.table_3_1
    model = (model or kind()).replace(
        mass=experiment.mass, width=experiment.width, depth=experiment.width, height=experiment.height
    )
    tilt = next((run.release_tilt for run in experiment.runs if run.release_tilt is not None), None)
    if tilt is not None and model.parameters.theta_0 >= math.atan2(experiment.width, experiment.height):
        model = model.replace(theta_0=tilt)
    return model


def compare(
    experiment: Experiment,
    models: Sequence[Model],
    names: Sequence[str] | None = None,
    *,
    engine: str = "auto",
    step: float = STEP,
    releases: Mapping[str, Mapping[str, Any]] | None = None,
    progress: Callable[[StageReport], None] | None = None,
) -> Comparison:
    """Compare models with every loaded run of an experiment, fit and holdout alike: there is no verdict here.

    Parameters
    ----------
    experiment : loaded by :func:`rockref.measure.load_experiment`.
    models : one or more; `names` are what they are called in tables ("model 1", ... by default).
    engine : "auto", "numpy" or "numba".
    step : of the simulation, s.
    releases : by run id, values that replace the stated release (``theta_0``, ``out_of_plane``, rad).
    progress : called with a stage for each model, and with the seconds left within it.

    Raises
    ------
    InputError
        E-KIND (no releases), E-MODELS (none, or two of one name), E-RUN, and those of the simulation.
    NumericalError
        where a run of a model loses its numbers.
    """
    began = time.perf_counter()
    gyro = gyro_of(experiment)
    names = tuple(names or (f"model {k}" for k in range(1, len(models) + 1)))
    _check_names(names, models)
    runs = [run for run in experiment.runs if run.loaded]
    if not runs:
        raise InputError("E-RUN", f"{experiment.path}", "no run was loaded", "Load the runs of one use at least.")
    measured = measured_runs(experiment, runs)
    results = []
    for number, (name, model) in enumerate(zip(names, models, strict=True)):
        said = f"simulating {len(runs)} run{'s' if len(runs) > 1 else ''} with {name}"
        half = [_part(progress, said, 2 * number + k, 2 * len(models), began) for k in (0, 1)]
        given = dict(releases or {})
        with _named(name, step):
            stated = predict(model, runs, gyro, engine=engine, releases=given, step=step, progress=half[0])
            offsets = [
                0.0 if m.run.id in given else tilt_offset(m, p, experiment)
                for m, p in zip(measured, stated, strict=True)
            ]
            aligned = _predict_again(model, runs, stated, offsets, gyro, engine=engine, step=step, progress=half[1])
        rows = zip(measured, stated, aligned, offsets, strict=True)
        results.append(tuple(_one(*row, experiment) for row in rows))
    return Comparison(
        experiment=experiment,
        names=names,
        models=tuple(models),
        measured=measured,
        results=tuple(results),
        engine=engine,
        step=step,
        seconds=time.perf_counter() - began,
    )


@contextmanager
def _named(name: str, step: float) -> Iterator[None]:
    """Say of which model an error is; who compares chooses the model, not the step."""
    try:
        yield
    except (InputError, NumericalError) as error:
        if error.code == "E-ENGINE":
            raise
        cure = error.cure
        if error.code == "E-STEP":
            cure = f"Releases are computed in steps of {step:g} s: check the unit of the stiffness and the damping."
        raise type(error)(error.code, f"model {name}: {error.where}", error.what, cure) from error


def _check_names(names: tuple[str, ...], models: Sequence[Model]) -> None:
    if not models:
        raise InputError("E-MODELS", "argument models", "is empty", "Give one model at least.")
    if len(names) != len(models) or len(set(names)) != len(names):
        what = f"{len(models)} models, names {', '.join(names)}"
        raise InputError("E-MODELS", "argument names", what, "Give every model a name of its own.")


def _part(
    progress: Callable[[StageReport], None] | None, name: str, number: int, count: int, began: float
) -> Callable[[float], None] | None:
    """Return what takes the share of half a model that is done, and reports the model as a stage."""
    if progress is None:
        return None

    def report(share: float) -> None:
        done = (number + share) / count
        left = (time.perf_counter() - began) * (1 - done) / done if done > 0 else None
        progress(StageReport(number // 2 + 1, count // 2, name, seconds_left=left))

    report(0.0)
    return report


def measured_runs(experiment: Experiment, runs: Sequence[Run]) -> tuple[MeasuredRun, ...]:
    """Return what is known of loaded runs before any model. Runs without repeats borrow the yardstick of those with."""
    gyro = gyro_of(experiment)
    block = rocking_block(experiment.mass, experiment.width, experiment.height)
    groups = {}
    for group in repeat_groups(runs):
        pairs = [(run.t, run.crv) for run in group if run.t is not None and run.crv is not None]
        groups[(group[0].release_tilt, group[0].block_turned)] = repeatability(pairs)
    # decided: where several releases were repeated, the first of the file is lent to the others.
    lent = next(iter(groups.values()), None)
    found = []
    for run in runs:
        assert run.t is not None and run.crv is not None
        noise = noise_of(noise_floor(run.t, run.crv).sigma, gyro)
        own = groups.get((run.release_tilt, run.block_turned))
        seen = features(run.t, run.crv, block, noise)
        found.append(MeasuredRun(run, noise, seen, lent if own is None else own, own is None and lent is not None))
    return tuple(found)


def tilt_offset(m: MeasuredRun, stated: Prediction, experiment: Experiment) -> float:
    """Return by how much, rad, the release tilt has to change for the first main impact to come when it was measured.

    At most by the stated uncertainty of the tilt; from the time that Housner's block needs (linear in the angle).
    """
    run, uncertainty = m.run, experiment.tilt_uncertainty
    assert run.t is not None and run.release_tilt is not None
    modelled = main_impacts(run.t, stated.at(run.t)).times
    if not uncertainty or not len(modelled) or not np.isfinite(m.first_impact):
        return 0.0
    slope = impact_time_per_tilt(run.release_tilt, experiment.width, experiment.height)
    return float(np.clip((m.first_impact - modelled[0]) / slope, -uncertainty, uncertainty))


def impact_time_per_tilt(tilt: float, width: float, height: float) -> float:
    """Return how much later, s/rad, the first main impact comes for a larger tilt (rad); width, height in m.

    The derivative of cosh(p T) = alpha/(alpha - tilt), p^2 = 3g/(4R) (Housner 1963).
    """
    radius, alpha = 0.5 * math.hypot(width, height), math.atan2(width, height)
    ratio = alpha / (alpha - tilt)
    return ratio / ((alpha - tilt) * math.sqrt(0.75 * GRAVITY / radius * (ratio * ratio - 1.0)))


def _predict_again(model, runs, stated, offsets, gyro, *, engine, step, progress) -> list[Prediction]:
    """Return the predictions at the corrected tilts; those without a correction as they are."""
    moved = [k for k, offset in enumerate(offsets) if offset != 0.0]
    releases = {runs[k].id: {"theta_0": runs[k].release_tilt + offsets[k]} for k in moved}
    anew = predict(
        model, [runs[k] for k in moved], gyro, engine=engine, releases=releases, step=step, progress=progress
    )
    found = list(stated)
    for k, prediction in zip(moved, anew, strict=True):
        found[k] = prediction
    return found


def _one(
    m: MeasuredRun, stated: Prediction, aligned: Prediction, offset: float, experiment: Experiment
) -> RunComparison:
    run = m.run
    assert run.t is not None and run.crv is not None
    block = rocking_block(experiment.mass, experiment.width, experiment.height)
    on_clock = stated.at(run.t)
    at_stated = features(run.t, on_clock, block, m.noise)
    seen = at_stated if aligned is stated else features(run.t, aligned.at(run.t), block, m.noise)
    both = len(m.features.impacts) and len(seen.impacts)
    shift = float(m.features.impacts.times[0] - seen.impacts.times[0]) if both else 0.0
    moved = aligned.at(np.where(run.t < m.first_impact, run.t, run.t - shift))
    limits = band(run.t, m.first_impact, m.noise, m.repeats)
    pairs = impact_pairs(m.features, at_stated, seen, shift)
    return RunComparison(
        run=run.id,
        stated=stated,
        aligned=aligned,
        tilt_offset=offset,
        shift=shift,
        features=seen,
        modelled=moved,
        errors=stretch_errors(run.t, run.crv, moved, on_clock, m.features.impacts, m.noise, m.repeats),
        impacts=pairs,
        losses_measured=losses(m.features.ledger, len(pairs)),
        losses_model=losses(seen.ledger, len(pairs)),
        envelopes=envelope_differences(m.features, seen, ENVELOPE_SIGMAS * m.noise[1:]),
        spectra=spectrum_differences(m.features, seen),
        leaves_band=departure(run.t, moved - run.crv, limits, aligned.response, shift, m.features.impacts.times),
        overturned=stated.response.overturned or aligned.response.overturned,
    )
