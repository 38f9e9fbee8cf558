"""What a campaign could show before it is made: detection limits, confusion, and the run that helps most.

Runs are simulated, seen through the gyroscope, and linearised exactly as measured ones are: by a model that listens to
them. What a run says about shared parameters and candidates adds up, so repeats and further runs cost nothing once each
release is known.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model, simulate
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.problem import END, fit_problem
from rockref.discover.fit.stages import F, time_scale
from rockref.discover.fit.whitening import whiten
from rockref.discover.hypotheses.candidates import LEFT_OUT, kinds
from rockref.discover.hypotheses.effects import effect_parameters
from rockref.discover.hypotheses.law import law_parameters
from rockref.discover.hypotheses.parameter import Parameter
from rockref.discover.progress import StageCounter, StageReport
from rockref.discover.threads import one_blas_thread
from rockref.discover.verdict.calibration import calibration
from rockref.discover.verdict.detection import cosines, eliminated, limit
from rockref.effects.base import Effect
from rockref.effects.natural import natural_units
from rockref.effects.scale import to_scale
from rockref.measure.experiment import TILT_UNCERTAINTY
from rockref.measure.gyroscope import record
from rockref.measure.records.release import Experiment, Gyro, Run
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError

#: The gyroscope of a plan without an experiment: that of the shipped experiments.
GYRO = Gyro(sample_rate=1000.0, noise=0.05 / DEGREES, bandwidth=300.0, resolution=0.01 / DEGREES)
#: Seconds of each run that are simulated and used; decided: what the diagnosis uses.
DURATION = END
#: Cosines above which two effects are not told apart; decided: a tenth of either is then left for itself.
CONFUSED = 0.95
#: Releases that are offered as the next run, as factors on the largest tilt of the plan.
FURTHER_TILTS = (1.0, 0.85, 0.7)


@dataclass(frozen=True, order=True)
class Release:
    """One release: tilt [rad], and whether the block is turned by half a turn."""

    tilt: float
    turned: bool = False

    def __str__(self) -> str:
        return f"{self.tilt:g}{'t' if self.turned else ''}"


#: By release: information (S + C, S + C) about the numbers that all runs share and those of candidates.
Information = dict[Release, np.ndarray]


def releases_from(text: str) -> list[Release]:
    """Return releases from words: "0.117x3,0.098,0.117t" is three at 0.117 rad, one at 0.098, one with the block
    turned.

    Raises InputError (E-RUNS).
    """
    found: list[Release] = []
    for word in filter(None, (w.strip() for w in text.split(","))):
        head, _, times = word.partition("x")
        turned = head.endswith("t")
        try:
            tilt, count = float(head.rstrip("t")), int(times or 1)
        except ValueError as e:
            cure = "Write tilts in rad with commas between: 0.117x3,0.098,0.117t."
            raise InputError("E-RUNS", "--runs", f"{word!r} is no release", cure) from e
        if not (0.005 <= tilt <= 0.5 and 1 <= count <= 100):
            raise InputError("E-RUNS", "--runs", f"{word!r} is out of range", "Tilts of 0.005 to 0.5 rad, x1 to x100.")
        found += [Release(tilt, turned)] * count
    if not found:
        raise InputError("E-RUNS", "--runs", "is empty", "Write tilts in rad: 0.117x3,0.098,0.117t.")
    return found


@dataclass
class Outlook:
    """What a campaign could show.

    `limits`: smallest amplitude seen, per number of an effect, in its own unit; `sizes`: the same in typical sizes (the
    least favourable number of the effect's); `cosines` (E, E) between effects after everything else is fitted.
    """

    runs: tuple[Release, ...]
    effects: tuple[str, ...]
    limits: dict[str, dict[str, Any]]
    sizes: dict[str, float]
    cosines: np.ndarray = field(repr=False)

    def confused(self) -> list[tuple[str, str, float]]:
        """Return pairs of effects that these runs do not tell apart, worst first."""
        pairs = [
            (a, b, float(self.cosines[i, j]))
            for i, a in enumerate(self.effects)
            for j, b in enumerate(self.effects)
            if j > i and self.cosines[i, j] > CONFUSED
        ]
        return sorted(pairs, key=lambda pair: -pair[2])

    def undetectable(self) -> list[str]:
        """Return the effects that even three times their typical size does not show."""
        return [id for id in self.effects if self.sizes[id] > 3.0]

    def score(self) -> float:
        """Return mean logarithm of the limits in typical sizes: smaller is better."""
        return float(np.mean(np.log([min(max(self.sizes[id], 1e-6), 1e6) for id in self.effects])))


@dataclass
class Plan:
    """The outlook of the runs, of as many repeats and as many varied ones, and what each further run would bring."""

    model: Model
    outlook: Outlook
    repeats: Outlook
    varied: Outlook
    further: list[dict[str, Any]]
    seconds: float

    def to_dict(self) -> dict[str, Any]:
        """Return plain numbers and words."""
        from rockref import __version__

        o = self.outlook
        return {
            "runs": [str(r) for r in o.runs],
            "limits": o.limits,
            "limits_in_typical_sizes": o.sizes,
            "undetectable": o.undetectable(),
            "confused": [{"effects": [a, b], "cosine": round(c, 4)} for a, b, c in o.confused()],
            "cosines": self.cosines(),
            "further_runs": self.further,
            "repeats_against_varied": self.comparison(),
            "seconds": round(self.seconds, 1),
            "versions": {"rockref": __version__, "numpy": np.__version__},
        }  # fmt: skip

    def cosines(self) -> dict[str, dict[str, float]]:
        """Return cosines between effects by their ids."""
        o = self.outlook
        rows = np.round(o.cosines, 4).tolist()
        return {a: dict(zip(o.effects, row, strict=True)) for a, row in zip(o.effects, rows, strict=True)}

    def comparison(self) -> dict[str, Any]:
        """Return limits of as many repeats of one release and of as many varied ones, and their ratio."""
        ratio = {id: self.repeats.sizes[id] / self.varied.sizes[id] for id in self.varied.effects}
        return {
            "repeats": [str(r) for r in self.repeats.runs],
            "varied": [str(r) for r in self.varied.runs],
            "ratio_of_limits": ratio,
            "median_ratio": float(np.median(list(ratio.values()))),
            "confused_pairs": [len(self.repeats.confused()), len(self.varied.confused())],
        }


def switches_of(kind: type[Effect], model: Model) -> tuple[Parameter, ...]:
    """Return the numbers of an effect that bring it in, on the block of a model."""
    return tuple(
        p for p in effect_parameters(kind.id, 1, units=natural_units(model)) if p.typical > 0 and p.run is None
    )


def recorded(model: Model, release: Release, gyro: Gyro, seed: int, duration: float) -> Run:
    """Return one simulated run as the gyroscope would record it, noise included."""
    response = simulate(
        model, duration=duration, output_rate=4000.0, engine="auto", theta_0=release.tilt, turned=release.turned
    )
    t, crv = record(response.t, response.W, gyro, np.random.default_rng(seed), model.active_effects())
    return Run(
        id=str(release),
        file="",
        use="fit",
        release_tilt=release.tilt,
        block_turned=math.pi * release.turned,
        t=t,
        crv=crv,
    )


def campaign(model: Model, run: Run, gyro: Gyro, tilt_uncertainty: float) -> Experiment:
    """Return a simulated run as an experiment."""
    return Experiment(
        path=Path("plan"), name="plan", kind="release",
        baseline="four_points" if model.points == "four_points" else "eight_points",
        mass=model.mass, width=model.width, height=model.height,
        tilt_uncertainty=tilt_uncertainty, gyro=gyro, runs=(run,),
    )  # fmt: skip


def says(
    model: Model,
    release: Release,
    effects: Sequence[type[Effect]],
    gyro: Gyro = GYRO,
    tilt_uncertainty: float = TILT_UNCERTAINTY,
    seed: int = 0,
    duration: float = DURATION,
    workers: int | None = None,
) -> np.ndarray:
    """Simulate one release, linearise a listening model about the truth, eliminate the run's tilt and roll."""
    run = recorded(model, release, gyro, seed, duration * time_scale(model))
    experiment = campaign(model, run, gyro, tilt_uncertainty)
    problem = fit_problem(experiment, (run,), model, duration, workers)
    fitter = Fitter(problem)
    own = problem.parameters(problem.carried)
    truth = FittedModel(problem.carried, np.array([true_z(p, model) for p in own]))
    numbers = [p for kind in effects for p in switches_of(kind, model)]
    whiten(fitter, truth, F)
    H, _ = fitter.linearise(fitter.evaluate(truth, F), F, numbers)
    shared = [k for k, p in enumerate((*own, *numbers)) if p.run is None and (not p.effect or k >= len(own))]
    rest = [k for k in range(len(H)) if k not in shared]
    order = np.array([*rest, *shared])
    return eliminated(H[np.ix_(order, order)], len(rest)) - np.eye(len(shared))


def true_z(p: Parameter, model: Model) -> float:
    """Return the z of a number in a model; a release is as it is stated."""
    if p.run is not None:
        return 0.0
    if p.effect:
        return effect_z(p, model)
    if p.name == "K_T":
        return p.z_of(model.parameters.K_T / model.parameters.K_N)
    if p.name.startswith("delta_long_"):
        return p.z_of(model.parameters.delta_long[int(p.name[-1]) - 1])
    return p.z_of(getattr(model.parameters, p.name))


def effect_z(p: Parameter, model: Model) -> float:
    """Return the z of a number of an effect that a model has."""
    effect = next(e for e in model.effects if e.id == p.effect)
    key = p.name.partition(".")[2]
    return p.z_of(to_scale(type(effect), key, float(getattr(effect, key))))


def outlook(model: Model, known: Information, runs: Sequence[Release], effects: Sequence[type[Effect]]) -> Outlook:
    """Add up what the runs say, eliminate the shared nuisances, and read limits and cosines off what is left."""
    shared, c = law_parameters(model), calibration()
    H = np.asarray(sum(count * known[release] for release, count in Counter(runs).items()))
    S = eliminated(H + np.eye(len(H)), len(shared))
    limits, sizes, blocks, at = {}, {}, [], 0
    for kind in effects:
        own = switches_of(kind, model)
        block = np.arange(at, at + len(own))
        at += len(own)
        blocks.append(block)
        found = [limit(p, float(S[k, k]), c) for p, k in zip(own, block, strict=True)]
        for p, entry in zip(own, found, strict=True):
            limits[p.name] = {"limit": entry["value"], **{k: v for k, v in entry.items() if k != "value"}}
        sizes[kind.id] = max(entry["in_typical_sizes"] for entry in found)
    return Outlook(tuple(runs), tuple(k.id for k in effects), limits, sizes, cosines(S, blocks))


def alternatives(runs: Sequence[Release]) -> list[Release]:
    """Return the releases that are offered as the next run: three tilts, from either side."""
    largest = max(r.tilt for r in runs)
    return [Release(round(largest * f, 4), turned) for f in FURTHER_TILTS for turned in (False, True)]


@one_blas_thread()
def plan(
    model: Model,
    runs: Sequence[Release],
    effects: Sequence[str] | None = None,
    gyro: Gyro = GYRO,
    tilt_uncertainty: float = TILT_UNCERTAINTY,
    seed: int = 0,
    workers: int | None = None,
    duration: float = DURATION,
    progress: Callable[[StageReport], None] | None = None,
) -> Plan:
    """Foretell what a campaign of releases could show.

    Parameters
    ----------
    model : of the block; runs : planned releases; effects : candidates by id or file.py:Class (None: the catalogue,
    without a shaking base and a clipped record); gyro, tilt_uncertainty : of the campaign; duration : seconds used of
    each run.

    Raises
    ------
    InputError
        E-EFFECT, E-RUNS.
    """
    from rockref.effects import catalogue

    started = time.perf_counter()
    if not runs:
        raise InputError("E-RUNS", "argument runs", "is empty", "Plan one release at least.")
    has = {e.id for e in model.effects}
    chosen = kinds(model.points, (*LEFT_OUT, *has)) if effects is None else catalogue.of_releases(effects)
    if unseen := [kind.id for kind in chosen if kind.id in LEFT_OUT]:
        what = f"no small step foretells {unseen[0]}: it has a phase of its own in every run, or cuts samples"
        raise InputError("E-EFFECT", "argument effects", what, "Leave it out.")
    wanted = alternatives(runs)
    every = sorted({*runs, *wanted})
    known, counter = {}, StageCounter({str(release): 1.0 for release in every}, progress)
    for k, release in enumerate(every):
        counter.begin(str(release), f"simulating the release {release} rad")
        known[release] = says(model, release, chosen, gyro, tilt_uncertainty, seed + k, duration, workers)
    now = outlook(model, known, runs, chosen)
    repeats, varied = against(runs, wanted)
    return Plan(
        model=model,
        outlook=now,
        repeats=outlook(model, known, repeats, chosen),
        varied=outlook(model, known, varied, chosen),
        further=further(model, known, runs, wanted, chosen, now),
        seconds=time.perf_counter() - started,
    )


def against(runs: Sequence[Release], wanted: Sequence[Release]) -> tuple[list[Release], list[Release]]:
    """Return as many repeats of the first release, and as many varied ones, as there are runs (three at least)."""
    n = max(len(runs), 3)
    order = [wanted[k] for k in (0, 3, 4, 1, 2, 5)]
    return [wanted[0]] * n, [order[k % len(order)] for k in range(n)]


def further(
    model: Model, known: Information, runs: Sequence[Release], wanted: Sequence[Release],
    chosen: Sequence[type[Effect]], now: Outlook,
) -> list[dict[str, Any]]:  # fmt: skip
    """Return what one more run would bring, best first: by which factor limits fall (mean), how many pairs come
    apart."""
    found = []
    for release in wanted:
        then = outlook(model, known, [*runs, release], chosen)
        gains = {id: now.sizes[id] / then.sizes[id] for id in now.effects}
        most = max(gains, key=lambda id: gains[id])
        found.append(
            {
                "run": str(release),
                "repeat": release in runs,
                "limits_fall_by": round(math.exp(now.score() - then.score()), 3),
                "helps_most": most,
                "its_limit_falls_by": round(gains[most], 3),
                "confused_pairs": len(then.confused()),
            }
        )
    return sorted(found, key=lambda f: -float(f["limits_fall_by"]))
