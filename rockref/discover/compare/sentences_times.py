"""Sentences about instants: when the model leaves the band, the first swing, the first two main impacts."""

from __future__ import annotations

import math

import numpy as np

from rockref.discover.compare.finding import Finding, finding, listed
from rockref.discover.compare.models import Comparison, impact_time_per_tilt
from rockref.discover.compare.stretches import AXES, STRETCH_WORDS

# decided: "agrees to the noise": at most this many noise widths in the RMS; 1 is a perfect model, and 500
# samples of white noise scatter by 3 %.
TO_NOISE = 1.2
# decided: a swing is called as long as the block's within two standard deviations of repeated runs, or a sample.
SWING_SPREADS, LEAST_SWING = 2.0, 1e-3

BEFORE = STRETCH_WORDS["before"].capitalize()
BETWEEN = "From the first to the second main impact"


def overturned(c: Comparison, model: int) -> list[Finding]:
    """Return which runs of the model fall over."""
    runs = [r.run for r in c.results[model] if r.overturned]
    if not runs:
        return []
    return finding(c, model, "overturned", f"The modelled block falls over in run {listed(runs)}.", runs=runs)


def leaves_band(c: Comparison, model: int) -> list[Finding]:
    """Return when the model can first be told from another run."""
    results, total = c.results[model], len(c.measured)
    gone = [(r.leaves_band, r.run) for r in results if r.leaves_band is not None]
    yardstick = "noise and run-to-run spread" if any(m.repeats for m in c.measured) else "noise"
    if not gone:
        text = f"The model stays within the band of {yardstick} in all {total} runs, to the end of the record."
        return finding(c, model, "leaves_band", text, runs=0)
    first, run = min(gone, key=lambda g: g[0].time)
    touching = listed([name for name, _ in first.points]) or "no point"
    verb = "touch" if len(first.points) > 1 else "touches"
    text = (
        f"The model leaves the band of {yardstick} in {len(gone)} of {total} runs, first in run {run} at "
        f"{first.time:.3f} s ({_since(first.after_impact)}), about the {first.axis} axis, "
        f"while {touching} {verb}."
    )
    return finding(
        c,
        model,
        "leaves_band",
        text,
        runs=len(gone),
        run=run,
        time=first.time,
        axis=first.axis,
        points=list(first.points),
    )


def _since(after: float | None) -> str:
    if after is None:
        return "before the first main impact"
    return f"{1e3 * after:.0f} ms after a main impact of the run"


def first_impact(c: Comparison, model: int) -> list[Finding]:
    """Return whether the release explains the time of the first main impact."""
    errors = [r.impacts[0].error for r in c.results[model] if r.impacts and math.isfinite(r.impacts[0].error)]
    if not errors:
        return []
    allowed = _tilt_allows(c)
    low, high = min(errors), max(errors)
    size = max(abs(low), abs(high))
    span = f"{1e3 * low:+.1f} to {1e3 * high:+.1f} ms (plus: the model is late)"
    if allowed is None:
        text = f"The first main impact is off by {span}."
    elif size <= allowed:
        text = (
            f"The first main impact is off by {span}; the stated uncertainty of the release tilt explains up to "
            f"{1e3 * allowed:.0f} ms."
        )
    else:
        text = (
            f"The first main impact is off by {span}, more than the {1e3 * allowed:.0f} ms that the stated uncertainty "
            "of the release tilt explains."
        )
    return finding(c, model, "first_impact", text, low=low, high=high, allowed=allowed)


def _tilt_allows(c: Comparison) -> float | None:
    """Return by how much, s, the first impact may move with the tilt's stated uncertainty."""
    e = c.experiment
    if not e.tilt_uncertainty:
        return None
    tilts = [m.run.release_tilt for m in c.measured if m.run.release_tilt is not None]
    return e.tilt_uncertainty * max(impact_time_per_tilt(tilt, e.width, e.height) for tilt in tilts)


def to_second_impact(c: Comparison, model: int) -> list[Finding]:
    """Return the time from the first to the second main impact, with the block as it is and turned."""
    sides: dict[bool, list[float]] = {False: [], True: []}
    swings = []
    for m, r in zip(c.measured, c.results[model], strict=True):
        if len(r.impacts) > 1:
            sides[abs(m.run.block_turned) > 1.0].append(r.impacts[1].aligned_error)
            swings.append(r.impacts[1].measured - r.impacts[0].measured)
    if not swings:
        return []
    spread = _spread_of_swing(c)
    known = f"; repeated runs scatter by {1e3 * spread:.1f} ms" if spread is not None else ""
    means = {turned: float(np.mean(values)) for turned, values in sides.items() if values}
    size = max(map(abs, means.values()))
    if size <= max(SWING_SPREADS * (spread or 0.0), LEAST_SWING):
        text = f"{BETWEEN} the model takes as long as the block, to {1e3 * size:.1f} ms{known}."
    elif len(means) == 2 and means[False] * means[True] < 0.0:
        text = (
            f"{BETWEEN} the model takes {_longer(means[False])}, but with the block turned by "
            f"180 degrees {_longer(means[True])}{known}."
        )
    else:
        mean = float(np.mean(sides[False] + sides[True]))
        text = f"{BETWEEN} the model takes {_longer(mean)} ({100 * abs(mean) / float(np.mean(swings)):.1f} %){known}."
    named = {"turned" if turned else "as_is": mean for turned, mean in means.items()}
    return finding(c, model, "to_second_impact", text, spread=spread, **named)


def _longer(error: float) -> str:
    return f"{1e3 * abs(error):.1f} ms {'longer' if error > 0.0 else 'less'}"


def _spread_of_swing(c: Comparison) -> float | None:
    for m in c.measured:
        if m.repeats is not None and m.repeats.impacts.shape[1] > 1:
            return float(m.repeats.impacts[:, 1].std(ddof=1))
    return None


def before_impact(c: Comparison, model: int) -> list[Finding]:
    """Return whether the first swing, before any impact, is right already."""
    noisy = {axis: _in_noise(c, model, "before", axis) for axis in AXES}
    known = {axis: value for axis, value in noisy.items() if value is not None}
    if not known:
        return []
    off = {axis: value for axis, value in known.items() if value > TO_NOISE}
    if not off:
        text = f"{BEFORE} the model agrees with all three rates to the noise."
    else:
        worst = ", ".join(f"{value:.1f} about the {axis} axis" for axis, value in off.items())
        text = f"{BEFORE} the model is off by (in noise widths, 1 is a perfect model): {worst}."
    return finding(c, model, "before_impact", text, **known)


def _in_noise(c: Comparison, model: int, stretch: str, axis: str) -> float | None:
    values = [
        e.in_noise for r in c.results[model] if (e := r.error(stretch, axis)) is not None and e.in_noise is not None
    ]
    return float(np.sqrt(np.mean(np.square(values)))) if values else None
