"""What a campaign could show before it is made: detection limits, confusion, and the run that helps most.

Runs are simulated, seen through the gyroscope, cut into windows and linearised exactly as measured ones are. What a
run says about shared parameters and candidates adds up, so repeats and further runs cost nothing once each release is
known.
"""

from __future__ import annotations

import math
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.api import Model, simulate
from rockref.discover import window_rules as rules
from rockref.discover.fit.baseline import baseline_parameters
from rockref.discover.fit.information import eliminated, information, own_parameters
from rockref.discover.fit.least_squares import Fit
from rockref.discover.fit.search import MIDDLE
from rockref.discover.hypotheses.candidates import FORMS, LEFT_OUT, SHAPES, is_inverse, kinds, parameters_of, value_of
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.looking.screen import PROBE
from rockref.discover.windows.series import Cut, Series, refinement, series
from rockref.effects.base import Effect
from rockref.measure.experiment import TILT_UNCERTAINTY, Experiment, Gyro, Run
from rockref.measure.gyroscope import record
from rockref.measure.impacts import main_impacts
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError

#: The gyroscope of a plan without an experiment: that of the shipped experiments.
GYRO = Gyro(sample_rate=1000.0, noise=0.05 / DEGREES, bandwidth=300.0, resolution=0.01 / DEGREES)
#: Seconds of each run that are simulated and used; decided: what the diagnosis uses.
DURATION = 3.0
#: Finite differences over a whole run are smaller by this factor; decided: what is a small change over a window is
#: a large one after fifteen times as long.
FINE = 0.1
#: Cosines above which two effects are not told apart; decided: a tenth of either is then left for itself.
CONFUSED = 0.95
#: An effect counts as seen when its gain reaches what the diagnosis demands.
NEEDED_Z = math.sqrt(2 * rules.DETECTED)
#: Releases that are offered as the next run, as factors on the largest tilt of the plan.
FURTHER_TILTS = (1.0, 0.85, 0.7)


@dataclass(frozen=True, order=True)
class Release:
    """One release: tilt [rad], and whether the block is turned by half a turn."""

    tilt: float
    turned: bool = False

    def __str__(self) -> str:
        return f"{self.tilt:g}{'t' if self.turned else ''}"


def releases_from(text: str) -> list[Release]:
    """Releases from words: "0.117x3,0.098,0.117t" is three at 0.117 rad, one at 0.098, one with the block turned.

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


@dataclass(frozen=True)
class Says:
    """What one release says: information H (S + C, S + C) about shared numbers and candidates, own tilt eliminated."""

    release: Release
    H: np.ndarray


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
        """Pairs of effects that these runs do not tell apart, worst first."""
        pairs = [
            (a, b, float(self.cosines[i, j]))
            for i, a in enumerate(self.effects)
            for j, b in enumerate(self.effects)
            if j > i and self.cosines[i, j] > CONFUSED
        ]
        return sorted(pairs, key=lambda pair: -pair[2])

    def undetectable(self) -> list[str]:
        """Effects that even three times their typical size does not show."""
        return [id for id in self.effects if self.sizes[id] > 3.0]

    def score(self) -> float:
        """Mean logarithm of the limits in typical sizes: smaller is better."""
        return float(np.mean(np.log([min(max(self.sizes[id], 1e-6), 1e6) for id in self.effects])))


@dataclass
class Plan:
    """The outlook of the runs, of as many repeats and as many varied ones, and what each further run would bring."""

    model: Model
    outlook: Outlook
    repeats: Outlook
    varied: Outlook
    unbroken_repeats: Outlook
    unbroken_varied: Outlook
    further: list[dict[str, Any]]
    seconds: float

    def to_dict(self) -> dict[str, Any]:
        """Plain numbers and words."""
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
        """Cosines between effects by their ids."""
        o = self.outlook
        rows = np.round(o.cosines, 4).tolist()
        return {a: dict(zip(o.effects, row, strict=True)) for a, row in zip(o.effects, rows, strict=True)}

    def comparison(self) -> dict[str, Any]:
        """Limits of as many repeats of one release and of as many varied ones, and their ratio.

        By restarted windows, and from release to the second main impact without a restart.
        """
        ratio = {id: self.repeats.sizes[id] / self.varied.sizes[id] for id in self.varied.effects}
        whole = {id: self.unbroken_repeats.sizes[id] / self.unbroken_varied.sizes[id] for id in self.varied.effects}
        return {
            "repeats": [str(r) for r in self.repeats.runs],
            "varied": [str(r) for r in self.varied.runs],
            "ratio_of_limits": ratio,
            "median_ratio": float(np.median(list(ratio.values()))),
            "without_restarts": {
                "ratio_of_limits": whole,
                "median_ratio": float(np.median(list(whole.values()))),
                "confused_pairs": [len(self.unbroken_repeats.confused()), len(self.unbroken_varied.confused())],
            },
            "confused_pairs": [len(self.repeats.confused()), len(self.varied.confused())],
        }


def switches_of(kind: type[Effect], finer: float = 1.0) -> tuple[Parameter, ...]:
    """The numbers of an effect that bring it in, with a step that shows laws which do nothing at zero."""
    return tuple(
        replace(p, step=finer * PROBE) for p in parameters_of(kind, 1) if tuple(p.name.split(".")) not in SHAPES | FORMS
    )


def recorded(model: Model, release: Release, gyro: Gyro, seed: int, duration: float) -> Run:
    """One simulated run as the gyroscope would record it, noise included."""
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
    """A simulated run as an experiment."""
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
    restarted: bool = True,
) -> Says:
    """Simulate one release, linearise its windows about the truth, eliminate their starts and the run's tilt."""
    run = recorded(model, release, gyro, seed, duration)
    experiment = campaign(model, run, gyro, tilt_uncertainty)
    own = baseline_parameters(model, 1, tilt_uncertainty)
    if restarted:
        windows = series(experiment, (run,), *MIDDLE, duration, refine=refinement(model), workers=workers)
    else:
        windows = unbroken(experiment, run, refinement(model), workers)
        # Over a second and a half a per cent of a stiffness is no small change any more.
        own = tuple(replace(p, step=FINE * p.step) for p in own)
    fit = Fit(windows, model, own)
    point = fit.relax_states(fit.begin(), 2) if restarted else fit.begin()
    wide = Fit(windows, model, (*own, *(p for kind in effects for p in switches_of(kind, 1.0 if restarted else FINE))))
    found = information(fit, point, wide, np.zeros(len(wide.parameters)), weighted=False)
    H, _ = eliminated(found.H[0], found.g[0], own_parameters(wide.parameters), wide.prior)
    return Says(release, H)


def unbroken(experiment: Experiment, run: Run, refine: int, workers: int | None) -> Series:
    """One window from the release to shortly before the second main impact: nothing is restarted."""
    assert run.t is not None and run.crv is not None and experiment.gyro is not None
    times = main_impacts(run.t, run.crv).times
    end = float(times[1]) - 0.02 if len(times) > 1 else float(run.t[-1])
    cut = Cut(np.array([0]), np.array([int(end * experiment.gyro.sample_rate)]))
    return Series(experiment, (run,), (cut,), refine, workers)


def outlook(
    model: Model, known: dict[Release, Says], runs: Sequence[Release], effects: Sequence[type[Effect]]
) -> Outlook:
    """Add up what the runs say, eliminate the shared nuisances, and read limits and cosines off what is left."""
    shared = baseline_parameters(model, 0, TILT_UNCERTAINTY)
    parameters = (*shared, *(p for kind in effects for p in switches_of(kind)))
    H = sum(count * known[release].H for release, count in Counter(runs).items())
    nuisance = np.arange(len(parameters)) < len(shared)
    prior = np.array([p.prior for p in parameters])
    S, _ = eliminated(np.asarray(H), np.zeros(len(parameters)), nuisance, prior)
    S = 0.5 * (S + S.T) / rules.INTERVAL**2
    limits, sizes, blocks, at = {}, {}, [], 0
    for kind in effects:
        own = switches_of(kind)
        block = np.arange(at, at + len(own))
        at += len(own)
        blocks.append(block)
        z = NEEDED_Z / np.sqrt(np.maximum(np.diag(S)[block], 1e-12))
        for p, size in zip(own, z, strict=True):
            limits[p.name] = {"limit": amplitude(p, float(size)), "unit": p.unit, "in_typical_sizes": float(size)}
        sizes[kind.id] = float(z.max())
    return Outlook(tuple(runs), tuple(k.id for k in effects), limits, sizes, cosines(S, blocks))


def amplitude(p: Parameter, size: float) -> float:
    """How far a number is from its absence at this size; the number itself where it is absent at infinity or rigid."""
    if p.name == "compliant_support.frequency" or is_inverse(p.name):
        return value_of(p, size)
    return abs(p.value(size) - p.value(0.0))


def cosines(S: np.ndarray, blocks: Sequence[np.ndarray]) -> np.ndarray:
    """How alike effects are, (E, E) in 0 to 1: the mean canonical cosine over the numbers of the smaller effect.

    S (C, C): information about the numbers of all effects, everything else eliminated; blocks: whose number is whose.
    """
    size = np.sqrt(np.maximum(np.diag(S), 1e-300))
    S = S / np.outer(size, size)  # units of the numbers must not decide what counts as zero
    roots = []
    for b in blocks:
        value, vector = np.linalg.eigh(S[np.ix_(b, b)])
        if not value.max() > 0.0:  # it changes nothing here, and is like nothing
            roots.append(np.zeros_like(vector))
            continue
        value = np.maximum(value, 1e-9 * value.max())
        roots.append(vector / np.sqrt(value) @ vector.T)
    found = np.eye(len(blocks))
    for i, a in enumerate(blocks):
        for j in range(i):
            b = blocks[j]
            c = np.linalg.svd(roots[i] @ S[np.ix_(a, b)] @ roots[j], compute_uv=False)
            found[i, j] = found[j, i] = float(np.clip(c.mean(), 0.0, 1.0))
    return found


def alternatives(runs: Sequence[Release]) -> list[Release]:
    """The releases that are offered as the next run: three tilts, from either side."""
    largest = max(r.tilt for r in runs)
    return [Release(round(largest * f, 4), turned) for f in FURTHER_TILTS for turned in (False, True)]


def plan(
    model: Model,
    runs: Sequence[Release],
    effects: Sequence[str] | None = None,
    gyro: Gyro = GYRO,
    tilt_uncertainty: float = TILT_UNCERTAINTY,
    seed: int = 0,
    workers: int | None = None,
    duration: float = DURATION,
    progress: Callable[[str], None] | None = None,
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

    begun = time.perf_counter()
    say = progress or (lambda line: None)
    if not runs:
        raise InputError("E-RUNS", "argument runs", "is empty", "Plan one release at least.")
    has = {e.id for e in model.effects}
    chosen = kinds(model.points, (*LEFT_OUT, *has)) if effects is None else catalogue.of_releases(effects)
    if any(kind.id == "base_vibration" for kind in chosen):
        what = "base_vibration has a phase of its own in every run, and no derivative foretells it"
        raise InputError("E-EFFECT", "argument effects", what, "Leave it out.")
    wanted = alternatives(runs)
    every = sorted({*runs, *wanted})
    known, whole = {}, {}
    for k, release in enumerate(every):
        say(f"release {release} ({k + 1} of {len(every)})")
        given = (model, release, chosen, gyro, tilt_uncertainty, seed + k, duration, workers)
        known[release], whole[release] = says(*given), says(*given, restarted=False)
    now = outlook(model, known, runs, chosen)
    repeats, varied = against(runs, wanted)
    return Plan(
        model=model,
        outlook=now,
        repeats=outlook(model, known, repeats, chosen),
        varied=outlook(model, known, varied, chosen),
        unbroken_repeats=outlook(model, whole, repeats, chosen),
        unbroken_varied=outlook(model, whole, varied, chosen),
        further=further(model, known, runs, wanted, chosen, now),
        seconds=time.perf_counter() - begun,
    )


def against(runs: Sequence[Release], wanted: Sequence[Release]) -> tuple[list[Release], list[Release]]:
    """As many repeats of the first release, and as many varied ones, as there are runs (three at least)."""
    n = max(len(runs), 3)
    order = [wanted[k] for k in (0, 3, 4, 1, 2, 5)]
    return [wanted[0]] * n, [order[k % len(order)] for k in range(n)]


def further(
    model: Model, known: dict[Release, Says], runs: Sequence[Release], wanted: Sequence[Release], chosen, now: Outlook
) -> list[dict[str, Any]]:
    """What one more run would bring, best first: by which factor limits fall (mean), how many pairs come apart."""
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
