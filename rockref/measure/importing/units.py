"""Units of a log: written in its names, or told by the physics of the first swing and by the sample rate."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rockref.measure.reading.columns import DEGREE
from rockref.model.errors import InputError


@dataclass(frozen=True)
class UnitNames:
    """How a unit is written in a column's name, and what it is worth in SI."""

    units: Mapping[str, float]
    written: Mapping[str, re.Pattern[str]]

    def unit_in(self, name: str) -> str | None:
        """Return the unit that a name in small letters carries, or None."""
        return next((unit for unit, pattern in self.written.items() if pattern.search(name)), None)

    def without_unit(self, name: str) -> str:
        """Return the name without its unit."""
        for pattern in self.written.values():
            name = pattern.sub("", name)
        return name


def _written(**patterns: str) -> dict[str, re.Pattern[str]]:
    return {unit: re.compile(pattern, re.IGNORECASE) for unit, pattern in patterns.items()}


_ENDS = r"[\s)\]]*$"
RATE_NAMES = UnitNames(
    {"mrad_s": 1e-3, "mdeg_s": 1e-3 * DEGREE, "rad_s": 1.0, "deg_s": DEGREE},
    _written(
        mrad_s=rf"[\s_(\[/]*\bmrad[\s_/.]*(s|sec)(\^?-1)?{_ENDS}",
        mdeg_s=rf"[\s_(\[/]*(mdps|mdeg[\s_/]*s(ec)?){_ENDS}",
        rad_s=rf"[\s_(\[/]*(rad(ians?)?[\s_/.]*(s|sec|second)(\^?-1)?|rps){_ENDS}",
        deg_s=rf"[\s_(\[/]*(dps|(deg(rees?)?|°|º)[\s_/.]*(s|sec|second)(\^?-1)?){_ENDS}",
    ),
)
TIME_NAMES = UnitNames(
    {"ms": 1e-3, "us": 1e-6, "ns": 1e-9, "s": 1.0},
    _written(
        ms=r"(^|[\s_(\[/])(ms|msec|milliseconds?|millis)\b|millis",
        us=r"(^|[\s_(\[/])(us|µs|μs|usec|microseconds?|micros)\b|micros",
        ns=r"(^|[\s_(\[/])(ns|nanoseconds?|nanos)\b|nanos",
        s=r"(^|[\s_(\[/])(s|sec|secs|seconds?)\b|seconds",
    ),
)
# Counts a deg/s: MPU-6050 data sheet (PS-MPU-6000A-00), section 6.1, and LSM6DS3 data sheet (DocID026899), table 3, as
# the inverse of mdps a count.
COUNTS = {
    "131 counts a deg/s": 131.0,
    "65.5 counts a deg/s": 65.5,
    "32.8 counts a deg/s": 32.8,
    "16.4 counts a deg/s": 16.4,
    "8.75 mdeg/s a count": 1e3 / 8.75,
    "17.5 mdeg/s a count": 1e3 / 17.5,
    "35 mdeg/s a count": 1e3 / 35.0,
    "70 mdeg/s a count": 1e3 / 70.0,
}
#: What a number may be worth [rad/s].
RATE_UNITS: dict[str, float] = dict(RATE_NAMES.units) | {name: DEGREE / n for name, n in COUNTS.items()}
SPOKEN = {"rad_s": "rad/s", "deg_s": "deg/s", "mrad_s": "mrad/s", "mdeg_s": "mdeg/s"}
# decided: the angle of the first swing, from its time, is good to a twentieth where the sides are; the scales of common
# chips lie 14 % apart.
GAUGE_ERROR = 0.07
# decided: a name that is wrong by less than this is a gyroscope's scale, or other sides; the least mistake is 57.
NAME_ERROR = 3.0
# decided: slower, and an impact falls between two samples; faster, and no gyroscope that is sold samples so.
SLOWEST, FASTEST = 20.0, 10_000.0


def rate_unit(stated: str | None, gauge: Sequence[float], whole: bool, where: str) -> str:
    """Return the unit of the rates: the stated one, or the one that the first swing needs.

    `gauge` holds, for each run, the rad/s that one unit of its numbers must be worth (see ``motion``); `whole`, whether
    all are whole numbers. Raises InputError E-UNIT where no unit fits, or another than the stated one.
    """
    worth = float(np.median(gauge))
    if stated is not None:
        off = RATE_UNITS[stated] / worth
        if 1.0 / NAME_ERROR < off < NAME_ERROR:
            return stated
        better = _nearest(worth, RATE_NAMES.units)
        what = f"the names say {SPOKEN.get(stated, stated)}, and the first swing is {off:.3g} times what a block turns"
        cure = f"Check width, height and the unit: --unit {better} would fit."
        raise InputError("E-UNIT", where, what, cure)
    units = RATE_UNITS if whole else RATE_NAMES.units
    name = _nearest(worth, units)
    if abs(math.log(units[name] / worth)) < (GAUGE_ERROR if whole else math.log(NAME_ERROR)):
        return name
    what = f"the first swing asks for {worth / DEGREE:.4g} deg/s for one unit of the rates, which is no common scale"
    raise InputError(
        "E-UNIT",
        where,
        what,
        f"Check width and height; state it (--unit {' or '.join(RATE_NAMES.units)}), or write it in one of these.",
    )


def _nearest(worth: float, units: Mapping[str, float]) -> str:
    return min(units, key=lambda name: abs(math.log(units[name] / worth)))


def time_tick(step: float, ticks: Sequence[float], where: str) -> float:
    """Return what one count of a time column is worth [s], of steps `step` counts long.

    `ticks` are those that its name allows; without any, the usual ones are tried. Raises InputError E-RATE where none
    gives a sample rate that a gyroscope has.
    """
    possible = [
        tick for tick in (ticks or tuple(TIME_NAMES.units.values())) if SLOWEST <= 1.0 / (step * tick) <= FASTEST
    ]
    if possible:
        return possible[0]
    what = f"the time column steps by {step:.4g}, which makes no sample rate between {SLOWEST:g} and {FASTEST:g} Hz"
    raise InputError("E-RATE", where, what, "Check the time column, or state the sample rate: --rate 1000.")
