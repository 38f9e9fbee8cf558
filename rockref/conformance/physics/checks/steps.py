"""What must not matter: the direction of the swing, and the step."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.checks.rocking import soft
from rockref.conformance.physics.finding import Finding, percent
from rockref.conformance.physics.theory import quarter_period
from rockref.conformance.physics.trial import Trial

#: Rounding in double precision, increased over three impacts.
SYMMETRY = 1e-6
#: Turns about z [deg] and signs of the tilt, beside the swing itself.
CASES = {"mirrored": (0.0, -1), "turned by 90 deg": (90.0, 1), "turned by 37 deg": (37.0, 1)}
APEXES = 4  # the start and three more


def symmetry(trial: Trial) -> Finding:
    """Compare the amplitudes of swings to the other side and in turned directions; a difference is a remark."""
    alpha = trial.theory.alpha
    first = trial.swing.amplitudes()[:APEXES]
    if len(first) < 2:
        return Finding("symmetry", "not judged", "no second apex", "0", "", "the block does not rock on")
    worst, where, span = 0.0, "", (float(first[-1]), float(first[-1]))
    for name, (about, sign) in CASES.items():
        other = trial.released(sign * 0.5 * alpha, 2.5, np.radians(about)).amplitudes()[:APEXES]
        n = min(len(first), len(other))
        off = float(np.max(np.abs(other[:n] / first[:n] - 1)))
        if len(first) != len(other) or off > worst:
            worst, where = off, name
        if len(other) == len(first):
            span = min(span[0], float(other[-1])), max(span[1], float(other[-1]))
    measured = f"amplitudes differ by {worst:.1g}"
    numbers = {"off": worst, "low": span[0] / alpha, "high": span[1] / alpha}
    if worst <= SYMMETRY:
        return Finding("symmetry", "pass", measured, "0", f"{SYMMETRY:g}", numbers=numbers)
    between = f", {numbers['low']:.3f} to {numbers['high']:.3f} of alpha after three impacts" if worst > 1e-3 else ""
    seen = f"the amplitudes depend on the direction by {worst:.1g} of themselves{between} (most where {where})"
    return Finding("symmetry", "remark", measured, "0", f"{SYMMETRY:g}", seen, numbers=numbers)


#: Differences below this share of the time are converged (decided: half the bar of the quarter period is 1e-3).
CONVERGED = 1e-4
#: A ratio of successive differences of 2 is first order, 4 second order; 0.3 and 0.6 for the next order (decided).
ORDERS = ((2.0, 0.3), (4.0, 0.6))


def half_step(trial: Trial) -> Finding:
    """Check that the quarter period converges when the step is halved, twice."""
    alpha, p = trial.theory.alpha, trial.theory.p
    T = quarter_period(0.5 * alpha, alpha, p)
    if trial.is_soft:
        return soft(trial, "half step", "")
    off = [trial.released(0.5 * alpha, 1.2 * T, finer=k).upright() / T - 1 for k in (1, 2, 4)]
    first, second = off[0] - off[1], off[1] - off[2]
    measured = ", ".join(percent(a) for a in off)
    numbers = {"first": first, "second": second}
    done = abs(first) <= CONVERGED and abs(second) <= CONVERGED
    ratio = abs(first / second) if second else float("inf")
    if done or any(abs(ratio - order) <= width for order, width in ORDERS):
        return Finding("half step", "pass", measured, "halves, or < 1e-4", numbers=numbers)
    if not ratio > 1 and abs(second) > 1e-3:
        seen = "the quarter swing changes more with the second halving of the step than with the first"
        return Finding("half step", "fail", measured, "halves, or < 1e-4", "", seen, "step", numbers)
    seen = f"two halvings of the step change the quarter swing in the ratio {ratio:.2g}"
    return Finding("half step", "remark", measured, "halves, or < 1e-4", "", seen, numbers=numbers)
