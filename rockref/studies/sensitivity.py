"""How the response depends on the time step, on the last digit of the parameters, and on the release angle.

The source's empirical sensitivity analysis: Fig. 3.5 (three time steps), Fig. 3.6 (+-0.5 of the last significant
digit of eleven parameters at random, the release angle kept), Fig. 3.7 (release angle +-0.08 degrees, 1 mm of wire),
and the significant digits of Table 3.1, by the definition printed there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rockref.api import Model
from rockref.identify.candidates import OUTPUT_RATE, STEP, rates
from rockref.measure.signals.impacts import main_impacts
from rockref.model.errors import InputError
from rockref.model.parameters import GENES_12, TABLE_3_1, chromosome_12, from_chromosome_12
from rockref.model.simulate import check
from rockref.studies.agreement import common_horizon, difference
from rockref.studies.predictability import check_impacts

#: Time steps [s]. Fig. 3.5 has three; the excerpt states 1e-5 and 3e-6 s, the finer ones are decided.
STEPS = (1e-5, 3e-6, 1e-6, 3e-7)
#: 1 mm of wire at the top of the block [rad].
RELEASE_ERROR = float(np.radians(0.08))
#: A change is significant where it exceeds this share of the response, RMS up to the second main impact,
#: about the transverse or longitudinal axis. Decided: the horizon's tenth.
SIGNIFICANT = 0.1
#: Shares of the motion at which responses are said to part; decided: what one sees, and what one would call another
#: motion.
SHARES = (0.1, 0.5)


@dataclass(frozen=True, eq=False)
class Family:
    """Responses that should be alike: labels; t (N,) [s]; crv (R, N, 3) [rad/s], the first being the reference;
    horizons (2, 3) [s], until when all agree with it to a tenth and to a half of the motion, by axis; impacts, the main
    impacts of each [s]."""

    labels: tuple[str, ...]
    t: np.ndarray
    crv: np.ndarray
    horizons: np.ndarray
    impacts: tuple[np.ndarray, ...]


def family(labels: Sequence[str], crv: np.ndarray, align: bool = False) -> Family:
    """Return responses (R, N, 3) [rad/s] at the output rate, compared with the first; with `align` shifted in time, for
    the comparison only, so that their first main impacts coincide."""
    t = np.arange(crv.shape[1]) / OUTPUT_RATE
    impacts = tuple(main_impacts(t, c).times for c in crv)
    compared = list(crv)
    if align:
        shifts = [i[0] - impacts[0][0] for i in impacts]
        compared = [_shifted(t, c, s) for s, c in zip(shifts, crv, strict=True)]
    horizons = np.array([common_horizon(t, compared, share) for share in SHARES])
    return Family(tuple(labels), t, crv, horizons, impacts)


def _shifted(t: np.ndarray, crv: np.ndarray, shift: float) -> np.ndarray:
    return np.stack([np.interp(t + shift, t, crv[:, k]) for k in range(3)], axis=-1)


def varied(model: Model) -> tuple[str, ...]:
    """Return the parameters that are varied: of the twelve, those that act in this model.

    Raises InputError (E-MOOT) where only the release angle does.
    """
    names = model.acting_parameters()
    if names == ("theta_0",):
        what = "states the properties of its points: no parameter of Table 3.1 but theta_0 acts in it"
        raise InputError("E-MOOT", "model", what, "Give a model on eight points without [properties].")
    return names


def time_steps(
    model: Model, steps: Sequence[float] = STEPS, duration: float = 6.0, workers: int | None = None
) -> Family:
    """Return Fig. 3.5: the same release with several time steps [s], the finest first.

    Raises InputError: E-STEP for one, or for one that is too large; E-RANGE, E-RATE for what is no step.
    """
    if len(steps) < 2:
        raise InputError("E-STEP", "--step", "is there once: nothing to compare it with", "Give two at least.")
    ordered = sorted(steps)
    problems = [model.problem(duration, h, OUTPUT_RATE) for h in ordered]
    for problem in problems:
        check(problem)
    crv = [rates([problem], workers)[0] for problem in problems]
    n = min(len(c) for c in crv)
    return family([f"{h:.0e} s" for h in ordered], np.array([c[:n] for c in crv]))


def last_digits(
    model: Model, seed: int = 0, trials: int = 10, duration: float = 6.0, step: float = STEP, workers: int | None = None
) -> Family:
    """Return Fig. 3.6: eleven parameters off by +-0.5 of their last digit each, at random, theta_0 kept."""
    rng, genes = np.random.default_rng(seed), chromosome_12(model.parameters)
    half = np.array([0.5 * given.precision for given in TABLE_3_1.values()])
    half[GENES_12.index("theta_0")] = 0.0
    changed = [genes, *(genes + half * rng.choice([-1.0, 1.0], len(genes)) for _ in range(trials))]
    models = [model.replace(parameters=from_chromosome_12(g)) for g in changed]
    crv = rates([m.problem(duration, step, OUTPUT_RATE) for m in models], workers)
    return family(["as stated", *(f"trial {i + 1}" for i in range(trials))], crv)


def release_angle(
    model: Model, error: float = RELEASE_ERROR, duration: float = 6.0, step: float = STEP, workers: int | None = None
) -> Family:
    """Return Fig. 3.7: released at theta_0 and at theta_0 +- `error` [rad]; compared from the first main impact of each
    on."""
    tilt = model.parameters.theta_0
    tilts = (tilt, tilt - error, tilt + error)
    crv = rates([model.problem(duration, step, OUTPUT_RATE, theta_0=x) for x in tilts], workers)
    return family([f"{x:.4f} rad" for x in tilts], crv, align=True)


@dataclass(frozen=True)
class Digits:
    """Significant digits of one parameter: name, value, stated number, found number; change of the response when the
    value is off by half of the last digit, for the found and for the stated number."""

    name: str
    value: float
    stated: int
    found: int
    change: float
    change_stated: float


def significant_digits(
    model: Model,
    threshold: float = SIGNIFICANT,
    step: float = STEP,
    workers: int | None = None,
    most: int = 6,
    duration: float = 1.6,
) -> list[Digits]:
    """Return the column of Table 3.1: the fewest digits at which rounding one parameter no longer changes the response.

    A value with d digits may be off by half of the last. The response has not changed where the RMS of the
    difference up to the second main impact is below `threshold` of that of the response, about both the transverse and
    the longitudinal axis, for either sign and for all finer digits. What does not act in the model, or is zero,
    has no row.  duration [s] : within which the second main impact is looked for.

    Raises InputError (E-IMPACTS) where it is not there.
    """
    genes = chromosome_12(model.parameters)
    base_run = rates([model.problem(duration, step, OUTPUT_RATE)], workers)[0]
    t = np.arange(len(base_run)) / OUTPUT_RATE
    impacts = main_impacts(t, base_run).times
    check_impacts(impacts, duration)
    until = float(impacts[1])
    acting = [i for i in (GENES_12.index(name) for name in varied(model)) if genes[i] != 0]
    trials = [(i, d, sign) for i in acting for d in range(1, most + 1) for sign in (-1, 1)]
    problems, possible = [], []
    for i, d, sign in trials:
        g = genes.copy()
        g[i] += sign * 0.5 * unit_of_digit(genes[i], d)
        try:
            problems.append(model.replace(parameters=from_chromosome_12(g)).problem(until + 0.01, step, OUTPUT_RATE))
            possible.append((i, d, sign))
        except InputError:  # a tilt beyond the tipping angle: that digit is needed
            continue
    crv = rates(problems, workers)
    t, base = t[: crv.shape[1]], base_run[: crv.shape[1]]
    changes = np.zeros((len(genes), most))
    for i, d, _ in set(trials) - set(possible):
        changes[i, d - 1] = np.inf
    for (i, d, _), run in zip(possible, crv, strict=True):
        changes[i, d - 1] = max(changes[i, d - 1], float(difference(t, base, run, until)[1:].max()))
    table = []
    for i in acting:
        name, given = GENES_12[i], TABLE_3_1[GENES_12[i]]
        change = changes[i]
        worst = np.maximum.accumulate(change[::-1])[::-1]
        enough = np.flatnonzero(worst < threshold)
        found = int(enough[0]) + 1 if len(enough) else most + 1
        stated = stated_digits(given.value, given.precision)
        last = float(change[min(found, most) - 1])
        table.append(Digits(name, float(genes[i]), stated, found, last, float(change[stated - 1])))
    return table


def unit_of_digit(value: float, d: int) -> float:
    """Return one unit of the d-th significant digit of a value: 0.1170, 4 -> 0.0001."""
    return 10.0 ** (int(np.floor(np.log10(abs(value)) + 1e-12)) - d + 1)


def stated_digits(value: float, precision: float) -> int:
    """Return significant digits of a value printed with this precision: 0.1170, 0.0001 -> 4."""
    return round(np.floor(np.log10(abs(value)) + 1e-12) - np.log10(precision)) + 1
