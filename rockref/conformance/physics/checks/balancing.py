"""At the limit: the load that topples a block, and a block that stands on its edge."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.checks.rocking import soft
from rockref.conformance.physics.finding import Finding, judged
from rockref.conformance.physics.scene import Gravity
from rockref.conformance.physics.theory import growth_time, toppling_load
from rockref.conformance.physics.trial import BLOCK, G, Trial, crossing

#: Loads are fractions of g b / h. Fine steps of a quarter of a percent, two seconds each: an excess of one step grows
#: by exp(2 p) = 2000 in that time. Coarse ones before, as a jump overshoots.
FINE, HELD = 0.0025, 2.0  # 1, s
COARSE, BRIEF = 0.05, 0.25  # 1, s
#: The first step above the limit topples: up to one step late, and one more where it exceeds the limit by a hair.
LOW, HIGH = -0.003, 0.006
#: Decided: contact that takes up to a twentieth of the base away is told; more makes another block.
PATCH = 0.05


def loads(around: float) -> np.ndarray:
    """Return the loads: coarse up to 0.03 below the expected limit, fine to 0.02 above."""
    return np.concatenate([np.arange(0, around - 0.03, COARSE), np.arange(-0.03, 0.02 + FINE / 2, FINE) + around])


def toppling(trial: Trial) -> Finding:
    """Check the steady acceleration that topples the block, raised inside one run.

    A restart from a settled pose would drop the contact's memory.
    """
    b, h, alpha = trial.theory.b, trial.theory.h, trial.theory.alpha
    limit = toppling_load(max(trial.rest.sink, 0.0), b, h)
    steps = loads(1.0)
    holds = np.where(np.diff(steps, append=2.0) > 2 * FINE, BRIEF, HELD)
    ends = 1.0 + np.cumsum(holds)
    schedule: Gravity = [(0.0, (0.0, 0.0, -G))]
    schedule += [(float(t - d), (float(G * b / h * a), 0.0, -G)) for t, d, a in zip(ends, holds, steps, strict=True)]
    motion = trial.engine.run(BLOCK, trial.rest.start, ends, schedule)
    fallen = np.flatnonzero(np.arccos(np.clip(motion.R[:, 2, 2], -1, 1)) > 0.5 * alpha)
    reference, bar = f"{limit:.4f} g b / h", f"{LOW:+.3f}, {HIGH:+.3f}"
    if not len(fallen):
        if trial.is_soft:
            return soft(trial, "toppling", f"stands at {steps[-1]:.3f}", reference)
        seen = f"the block does not topple at {steps[-1]:.3f} of the load that lifts its edge"
        return judged("toppling", False, "never", reference, bar, seen, "sleep", {"load": float("inf")})
    load = float(steps[fallen[0]])
    off = load - limit
    if trial.is_soft:
        return soft(trial, "toppling", f"{load:.4f}", reference)
    numbers = {"load": load, "limit": limit}
    if LOW <= off <= HIGH:
        return Finding("toppling", "pass", f"{load:.4f}", reference, bar, numbers=numbers)
    if off > HIGH:
        seen = f"the block topples {100 * off:.2g} % too late"
        return Finding("toppling", "fail", f"{load:.4f}", reference, bar, seen, "sleep", numbers)
    # Where contact spreads over a patch or several points, its law moves the pivot inwards: another base, no fault.
    seen = f"the block topples {-100 * off:.2g} % too early, as one with a base of {2 * b * (1 + off):.3f} m would"
    verdict = "remark" if off > -PATCH else "fail"
    return Finding("toppling", verdict, f"{load:.4f}", reference, bar, seen, "pivot", numbers)


#: Deviation from the balance angle over alpha: sunk and rounded edges move it by less; at rest engines keep poses to
#: a tenth of it.
OFF = 1e-3
WAIT = 3.0  # s: the deviation grows by exp(3 p), 9e4
#: Between these deviations over alpha the growth is read.
FROM, TO = 0.02, 0.1
#: A step's error in two crossings 0.42 s apart is a quarter of it.
GROWTH = 0.005
#: Decided: no drag or gravity that passed the checks of free motion changes the growth by so much.
STALE = 0.05


def balance(trial: Trial) -> Finding:
    """Check that a block on its edge falls back below the balance angle and over above it, at the rate p."""
    alpha, p = trial.theory.alpha, trial.theory.p
    T = growth_time(FROM * alpha, TO * alpha, OFF * alpha, p)
    numbers, seen, cause = {}, [], ""
    for name, side in (("below", -1), ("above", 1)):
        swing = trial.released(alpha * (1 + side * OFF), WAIT)
        away = side * (swing.tilt / alpha - 1)
        first, last = crossing(swing.t, away, FROM), crossing(swing.t, away, TO)
        numbers[name] = T / (last - first) - 1
        if np.max(away) < TO:
            stays = np.min(away) > -FROM
            end = "stays there" if stays else "falls to the other side"
            seen.append(f"a block on its edge, {100 * OFF:.2g} % {name} the balance angle, {end}")
            cause = cause or ("sleep" if stays else "pivot")
        elif abs(numbers[name]) > GROWTH:
            slower = numbers[name] < 0
            change = f"{abs(100 * numbers[name]):.2g} % {'slower' if slower else 'faster'}"
            seen.append(f"{name} the balance angle the fall grows {change}")
            cause = cause or ("stale" if abs(numbers[name]) > STALE else "damping" if slower else "gravity")
    measured = ", ".join(
        f"{name} {'no' if np.isnan(off) else f'p {100 * off:+.2g} %'}" for name, off in numbers.items()
    )
    if trial.is_soft:
        return soft(trial, "balance on an edge", measured, f"p = {p:.4f} /s")
    return judged("balance on an edge", not seen, measured, f"right side, p = {p:.4f} /s", f"{100 * GROWTH:g} % of p",
                  "; ".join(seen), cause, numbers)  # fmt: skip
