"""All checks of a release record, in their order: what each looks at, on what evidence, and what follows.

The table of checks in the documentation is made from `OTHERS` and `CHECKS`, and from the docstrings of the functions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.measure.checks import channels, release, start, uprights
from rockref.measure.checks.bursts import check_bursts
from rockref.measure.checks.copies import note_copies
from rockref.measure.checks.held import check_dropouts, check_hold
from rockref.measure.checks.repeated import check_repeats
from rockref.measure.checks.sensor import sensor_faults
from rockref.measure.checks.toss_axes import check_axes
from rockref.measure.checks.wraps import check_wraps
from rockref.measure.reading.timebase import check_order, regular_samples
from rockref.measure.records.notice import Notice
from rockref.measure.signals.signal import Signal
from rockref.model.errors import InputError


@dataclass(frozen=True)
class Check:
    """One check of a signal: `look` returns remarks or raises a refusal; what it looks for, and on what evidence."""

    look: Callable[..., Any]
    subject: str
    evidence: str


#: The checks of what is left once faults of the logger are out, in the order in which they are made.
CHECKS = (
    Check(release.check_length, "length", "time of the last sample beside that of the first impact; number of samples"),
    Check(release.check_alive, "dead channel", "all values of a channel are equal"),
    Check(release.check_release, "start of time", "mean rates up to half of the first swing beside the largest"),
    Check(release.check_first_swing, "unit, axis, sign", "peak and angle of the first swing beside Housner's block"),
    Check(release.check_rest, "motion at the release", "mean rates of the first twentieth of the swing"),
    Check(start.check_start, "start of time", "where the arc of the first swing begins"),
    Check(release.check_first_impact, "size, tilt", "time of the first main impact beside Housner's block"),
    Check(release.check_turned, "scale, tilt", "what the rates add up to until the first main impact beside the tilt"),
    Check(uprights.check_uprights, "lost rows", "angle of each arc between main impacts; leaps far from upright"),
    Check(channels.check_axes, "exchanged Y and Z", "changes over 2 ms times sqrt(R/g), noise taken off"),
    Check(channels.check_flat_tops, "saturation", "time near the largest value beside the slope of the swing"),
    Check(channels.check_range, "saturation", "samples at the stated range"),
    Check(channels.check_one_unit, "unit", "noise of a channel 57 times that of the other two, or a 57th"),
    Check(channels.check_smooth, "rows averaged or drawn", "what neighbours share of noise no larger than stated"),
    Check(channels.check_noise, "noise", "what cubics leave of calm stretches beside the data sheet"),
)


@dataclass(frozen=True, eq=False)
class Checked:
    """A record that was checked: times t (N,) s, rates crv (N, 3) rad/s, rows that were drawn straight, remarks."""

    t: np.ndarray
    crv: np.ndarray
    drawn: tuple[int, ...]
    notices: list[Notice]


def checked(signal: Signal) -> Checked:
    """Check a record: faults of the logger first, then the rest, of one release.

    What follows a fall or another setting up is left out (W-OVERTURNED, W-SET-UP). Raises InputError: those of the
    checks.
    """
    check_wraps(signal)
    release.check_unit(signal)
    held = check_hold(signal)
    check_repeats(signal)
    crv, drawn, notices = check_bursts(signal)
    signal = replace(signal, crv=crv)
    notices += held or check_dropouts(signal, release.inside_the_tipping_angle(signal))
    signal, left_out = _of_one_release(signal)
    notices += left_out
    for check in CHECKS:
        notices += check.look(signal)
    rows = tuple(int(row) for row in np.flatnonzero(drawn[: len(signal.t)]))
    return Checked(signal.t, signal.crv, rows, notices)


def _of_one_release(signal: Signal) -> tuple[Signal, list[Notice]]:
    """Return a signal up to where the block falls over or somebody sets it up again, and the remark on it."""
    notices = []
    stands = release.samples_before_a_fall(signal)
    if stands < len(signal.t):
        what = f"the block falls over at {signal.t[stands]:.2f} s"
        notices.append(Notice("W-OVERTURNED", signal.path, what, "What follows is left out."))
        signal = replace(signal, t=signal.t[:stands], crv=signal.crv[:stands].copy())
    stands, when = start.samples_before_setting_up(signal)
    if stands < len(signal.t):
        what = f"the block rests tilted at {when:.2f} s: somebody caught it, or set it up again"
        if signal.t[stands - 1] < release.length_needed(signal):
            raise InputError("E-SHORT", signal.path, what, "Let the block rock until it stands by itself.")
        notices.append(Notice("W-SET-UP", signal.path, what, "What follows the last impact before is left out."))
        signal = replace(signal, t=signal.t[:stands], crv=signal.crv[:stands].copy())
    return signal, notices


#: What is looked at before and after these: the time column, faults of the logger, and all runs together.
OTHERS = (
    Check(check_order, "order of the rows", "time stamps that go back or are equal; values of such rows"),
    Check(
        regular_samples,
        "sample rate, holes, jitter",
        "rows over duration; steps of the stamps that stay; whether rates follow the stamps",
    ),
    Check(check_wraps, "numbers that wrap", "leaps of one size from one end of the range to the other"),
    Check(release.check_unit, "unit", "size of the rates beside Housner's block"),
    Check(check_hold, "values that are held", "how often all channels repeat at once beside noise and resolution"),
    Check(check_repeats, "numbers that stand twice", "five equal rows of changing rates; equal columns that move"),
    Check(check_bursts, "bursts", "leaps out and back within nine samples beside the first swing's rate"),
    Check(check_dropouts, "channels that stand still", "chance of repeats beside stated noise and resolution"),
    Check(checked, "fall", "release tilt less the integral of wx beside the tipping angle"),
    Check(checked, "set up again", "rest for a tenth of a second where the rates add up to a tilt"),
    Check(note_copies, "copies", "equal numbers of two runs, or numbers rounded from the other's"),
    Check(sensor_faults, "sensor", "means from impact to impact; shocks of three channels; phase of 50 and 60 Hz"),
    Check(check_axes, "axes and order of tosses", "fall in free flight; corners under the board; faces at rest"),
)
