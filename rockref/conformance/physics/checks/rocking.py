"""Free rocking: the time of a quarter swing, the energy of the apexes, the ratio of rates at an impact."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.finding import Finding, judged, percent
from rockref.conformance.physics.theory import impact_ratio, quarter_period
from rockref.conformance.physics.trial import SOFT, Trial

#: The start's pose, set by hand and not by a wire, moves the quarter period by up to a tenth of a percent.
PERIOD = 0.002
#: A first-order integrator is late or early by half a step.
STEPS = 0.6


def soft(trial: Trial, check: str, measured: str, reference: str = "") -> Finding:
    """Return the answer where the contact is too soft to judge."""
    seen = (
        f"the block sinks by {1e3 * trial.rest.sink:.2g} mm, {trial.softness:.2g} of b alpha: too soft to judge "
        f"(above {SOFT:g}); ask again with stiffer contact"
    )
    return Finding(check, "not judged", measured, reference, "", seen, "soft", {"softness": trial.softness})


def period(trial: Trial) -> Finding:
    """Check the time from rest at half the slenderness to the upright pose."""
    alpha, p = trial.theory.alpha, trial.theory.p
    T = quarter_period(0.5 * alpha, alpha, p)
    t = trial.swing.upright()
    off, bar = t / T - 1, PERIOD + STEPS * trial.engine.step / T + min(trial.softness, SOFT)
    measured, reference = f"{percent(off)}, sunk {trial.softness:.2g} of b alpha", f"{T:.5f} s"
    if trial.is_soft:
        return soft(trial, "rocking period", measured, reference)
    seen, cause = "", ""
    if not np.isfinite(t):
        seen, cause = "the tilted block does not rock back", "sleep"
    elif abs(off) > bar:
        seen = f"the quarter swing takes {abs(100 * off):.2g} % {'longer' if off > 0 else 'less'} than on a sharp edge"
        # A pivot further inside lowers the restoring moment: slower. An edge that is held before it lands: faster.
        cause = "pivot" if off > 0 else "early"
    return judged("rocking period", not seen, measured, reference, percent(bar)[1:], seen, cause, {"off": off})


#: What an apex may lie above another one: a thousandth (decided). A parabola through three rows a millisecond apart
#: finds an apex to 1e-6 of itself, single precision to 1e-5; a swing of the right settings loses a tenth.
APEX = 1e-3
#: Decided: a settled block that is faster still vibrates; sound engines tremble with half of it at most.
VIBRATING = 1e-3  # m/s


def energy(trial: Trial) -> Finding:
    """Check that no apex lies above the last one, and that no apex has more energy than the start.

    The start is set by hand: the spring of its edge may hold the weight times the sink too much. Later apexes are free
    motion, and allow for the error of an apex alone. A contact without damping stores what an impact takes as
    vibration, and a later impact may give it back: a rise is not judged where the settled block vibrates.
    """
    swing, sink = trial.swing, max(trial.rest.sink, 0.0)
    sizes = swing.amplitudes()
    if len(sizes) < 2:
        return Finding("apex energy", "not judged", "no second apex", "falling", "", "the block does not rock on")
    heights = swing.motion.x[swing.apexes(), 2]
    scale = trial.theory.R * (np.cos(0.5 * trial.theory.alpha) - np.cos(trial.theory.alpha))
    gain, allowed = float(np.max((heights - heights[0]) / scale)), APEX + sink / scale
    rises = sizes[1:] / sizes[:-1]
    text = ", ".join(f"{a / trial.theory.alpha:.3f}" for a in sizes[:4])
    seen = ""
    if gain > allowed:
        seen = f"an apex lies {100 * gain:.2g} % of the first one's energy above the start (apexes {text} of alpha)"
    elif rises[0] > 1 + allowed or np.any(rises[1:] > 1 + APEX):
        seen = f"an apex lies above the last one (apexes {text} of alpha)"
    cause = "few_contacts" if seen and trial.is_soft else "energy"
    bar = f"{allowed:.2g} of the first apex's energy; {APEX:g} of an apex, from the second on"
    facts = (f"apexes {text} of alpha", "falling", bar)
    numbers = {"gain": gain, "rise": float(np.max(rises))}
    if seen and trial.rest.speed > VIBRATING:
        seen += f"; the settled block vibrates with {1e3 * trial.rest.speed:.2g} mm/s, from which a swing may gain"
        return Finding("apex energy", "not judged", *facts, seen, "rattling", numbers)
    return judged("apex energy", not seen, *facts, seen, cause, numbers)


#: Rounding of two amplitudes, each good to a thousandth.
RATIO = 5e-3


def ratio(trial: Trial) -> Finding:
    """State the ratio of rates at the first impact; more than 1 is a fault, less is the engine's contact law."""
    sizes, alpha = trial.swing.amplitudes(), trial.theory.alpha
    housner = f"{trial.theory.ratio:.3f} (Housner)"
    if len(sizes) < 2:
        return Finding("impact ratio", "not judged", "no second apex", housner, "", "the block does not rock on")
    found = impact_ratio(sizes[0], sizes[1], alpha)
    numbers = {"ratio": found, "housner": trial.theory.ratio}
    seen = f"the block leaves the impact with {100 * (found - 1):.2g} % more than the rate it came with"
    if found > 1 + RATIO:
        cause = "few_contacts" if trial.is_soft else "energy"
        return Finding("impact ratio", "fail", f"{found:.3f}", housner, "at most 1", seen, cause, numbers)
    return Finding("impact ratio", "pass", f"{found:.3f}", housner, "at most 1", "", "", numbers)
