"""All checks of a release record, in their order: what each looks at, on what evidence, and what follows.

The table of checks in the documentation is made from `CHECKS`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from rockref.measure import channels, checks
from rockref.measure.bursts import check_bursts
from rockref.measure.held import check_dropouts, check_hold
from rockref.measure.notice import Notice
from rockref.measure.signal import Signal
from rockref.measure.wraps import check_wraps


@dataclass(frozen=True)
class Check:
    """One check of a signal: `look` returns remarks or raises a refusal; what it looks for, and on what evidence."""

    look: Callable[[Signal], list[Notice]]
    subject: str
    evidence: str


#: The checks of what is left once faults of the logger are out, in the order in which they are made.
CHECKS = (
    Check(checks.check_length, "length", "time of the last sample beside that of the first impact; number of samples"),
    Check(checks.check_alive, "dead channel", "all values of a channel are equal"),
    Check(checks.check_release, "start of time", "mean rates up to half of the first swing beside the largest"),
    Check(checks.check_first_swing, "unit, axis, sign", "peak and angle of the first swing beside Housner's block"),
    Check(checks.check_rest, "motion at the release", "mean rates of the first twentieth of the swing"),
    Check(checks.check_first_impact, "size, tilt", "time of the first main impact beside Housner's block"),
    Check(channels.check_axes, "exchanged Y and Z", "changes over 2 ms times sqrt(R/g), noise taken off"),
    Check(channels.check_flat_tops, "saturation", "time near the largest value beside the slope of the swing"),
    Check(channels.check_range, "saturation", "samples at the stated range"),
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
    """Check a record: faults of the logger first, then what follows a fall is left out, then the rest.

    Raises InputError: E-WRAP, E-SPIKE, E-DROPOUT, E-HOLD, and those of `CHECKS`.
    """
    check_wraps(signal)
    checks.check_unit(signal)
    held = check_hold(signal)
    crv, drawn, notices = check_bursts(signal)
    signal = replace(signal, crv=crv)
    notices += held or check_dropouts(signal, checks.inside_the_tipping_angle(signal))
    stands = checks.samples_before_a_fall(signal)
    if stands < len(signal.t):
        what = f"the block falls over at {signal.t[stands]:.2f} s"
        notices.append(Notice("W-OVERTURNED", signal.path, what, "What follows is left out."))
        signal = replace(signal, t=signal.t[:stands], crv=crv[:stands].copy())
    for check in CHECKS:
        notices += check.look(signal)
    rows = tuple(int(row) for row in np.flatnonzero(drawn[:stands]))
    return Checked(signal.t, signal.crv, rows, notices)
