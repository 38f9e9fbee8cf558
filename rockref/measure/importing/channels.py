"""Which columns of a log are the time, the rates and the accelerations, and in which units: presets and names."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from rockref.measure.importing.layout import Log
from rockref.measure.importing.units import RATE_NAMES, TIME_NAMES
from rockref.measure.records.notice import shown
from rockref.model.errors import InputError

Three = tuple[int, int, int]


@dataclass(frozen=True)
class Preset:
    """The export of a common logger, known by its header.

    Attributes: ``logger``; ``time``, names of the time column, the best first; ``rates``, of x, y, z; ``rate_unit``,
    None where the physics has to tell it; ``time_ticks`` s, what a count of the time column may be.
    """

    logger: str
    time: tuple[str, ...]
    rates: tuple[str, str, str]
    rate_unit: str | None
    time_ticks: tuple[float, ...] = ()
    accelerations: tuple[str, str, str] | None = None


#: Names are compared in small letters. Sources: phyphox.org/wiki "Data export" ("Time (s)", "Gyroscope x (rad/s)");
#: github.com/tszheichoi/awesome-sensor-logger, README (time in ns, seconds_elapsed, columns z, y, x, rad/s);
#: MT Manager User Manual, Movella (ASCII export: SampleTimeFine counts 100 us, Gyr in rad/s), and DOT User Manual (CSV:
#: SampleTimeFine in us, Gyr in deg/s), so that both units stay open; github.com/jrowberg/i2cdevlib, MPU6050_raw (rows
#: "a/g:" ax ay az gx gy gz in counts of the chip).
PRESETS = (
    Preset(
        "phyphox",
        ("time (s)",),
        ("gyroscope x (rad/s)", "gyroscope y (rad/s)", "gyroscope z (rad/s)"),
        "rad_s",
        (1.0,),
        ("acceleration x (m/s^2)", "acceleration y (m/s^2)", "acceleration z (m/s^2)"),
    ),
    Preset("Sensor Logger", ("seconds_elapsed",), ("x", "y", "z"), "rad_s", (1.0,)),
    Preset("Xsens", ("sampletimefine",), ("gyr_x", "gyr_y", "gyr_z"), None, (1e-4, 1e-6), ("acc_x", "acc_y", "acc_z")),
)
MPU_TAG = "a/g:"
_AXES = ("x", "y", "z")
_GYRO = re.compile(r"gyr|angular|ang_?vel|rotation|omega|(^|[^a-z])[wgr][xyz]($|[^a-z])")
_ACCELERATION = re.compile(r"acc|(^|[^a-z])a[xyz]($|[^a-z])")
_NOT_RATES = re.compile(r"bias|temp|mag|uncal|grav|orient|quat")
_TIME = re.compile(r"^t$|^t[ _(\[/]|time|elapsed|millis|micros|timestamp|zeit|^ms$|^us$|^s$")


@dataclass(frozen=True)
class Channels:
    """The columns of a log that are used.

    Attributes: ``logger``, the preset's name or ``"columns by name"``; ``time`` or None; ``rates``; ``accelerations``
    or None; ``rate_unit`` or None; ``ticks`` s, what a count of time may be, empty where the sample rate has to tell.
    """

    logger: str
    time: int | None
    rates: Three
    accelerations: Three | None
    rate_unit: str | None
    ticks: tuple[float, ...]
    chip: tuple[str, str, str]


def find_channels(log: Log, columns: Sequence[str] = ()) -> Channels:
    """Return the channels of a log: those named in `columns` (time, x, y, z), of a preset, or found by their names.

    Raises InputError: E-HEADER, E-COLUMN-MISSING, E-COLUMN-TWICE.
    """
    if columns:
        return _stated(log, columns)
    if not log.names:
        if any(set(words) == {MPU_TAG} for words in log.words.values()) and log.values.shape[1] >= 7:
            return Channels("MPU6050_raw", None, (4, 5, 6), (1, 2, 3), None, (), ("gx", "gy", "gz"))
        cure = "Name time and rates by their places, as --columns 1,5,6,7, or export with a header."
        raise InputError("E-HEADER", log.source, "no line names the columns", cure)
    names = [name.lower() for name in log.names]
    for preset in PRESETS:
        found = _of_preset(preset, names, log)
        if found is not None:
            return found
    return _by_name(log, names)


def _of_preset(preset: Preset, names: list[str], log: Log) -> Channels | None:
    time = next((names.index(name) for name in preset.time if name in names), None)
    if any(name not in names for name in preset.rates) or (time is None and preset.logger != "Xsens"):
        return None
    accelerations = None
    if preset.accelerations is not None and all(name in names for name in preset.accelerations):
        accelerations = _three(names.index(name) for name in preset.accelerations)
    rates = _three(names.index(name) for name in preset.rates)
    return Channels(preset.logger, time, rates, accelerations, preset.rate_unit, preset.time_ticks, _chip(log, rates))


def _by_name(log: Log, names: list[str]) -> Channels:
    """Return the channels that their names tell: a gyroscope's x, y, z, and a time."""
    times = [i for i, name in enumerate(names) if _TIME.search(name) and _axis(name) is None]
    # In another language than English the unit alone says that a column is a rate.
    gyro = _triple(names, _GYRO.search, log) or _triple(names, RATE_NAMES.unit_in, log)
    if gyro is None:
        cure = f"Name time and rates, as --columns {_proposal(names, times)}: by their places or by the header's words."
        what = f"no three rates are found among {shown(', '.join(log.names), 120)}"
        raise InputError("E-COLUMN-MISSING", f"{log.source}, line {log.header_line}", what, cure)
    time = times[0] if times else None
    unit = RATE_NAMES.unit_in(names[gyro[0]])
    tick = TIME_NAMES.unit_in(names[time]) if time is not None else None
    ticks = () if tick is None else (TIME_NAMES.units[tick],)
    return Channels(
        "columns by name", time, gyro, _triple(names, _ACCELERATION.search, log, False), unit, ticks, _chip(log, gyro)
    )


def _proposal(names: list[str], times: list[int]) -> str:
    """Return what --columns may be: the places of a time and three rates where units tell them, else an example."""
    rates = [i for i, name in enumerate(names) if RATE_NAMES.unit_in(name) and i not in times]
    if len(rates) != 3:
        return "t,gx,gy,gz"
    return ",".join(str(i + 1) for i in [*times[:1], *rates])


def _triple(names: list[str], is_kind: Callable[[str], object], log: Log, strict: bool = True) -> Three | None:
    """Return the columns of one kind that end with x, y and z, or None where one is missing."""
    return _three_of(names, is_kind, _axis, log, strict) or _three_of(names, is_kind, _axis_inside, log, strict)


def _three_of(
    names: list[str], is_kind: Callable[[str], object], axis_of: Callable[[str], str | None], log: Log, strict: bool
) -> Three | None:
    places: dict[str, int] = {}
    for i, name in enumerate(names):
        axis = axis_of(name)
        if axis is None or not is_kind(name) or _NOT_RATES.search(name):
            continue
        if axis in places:
            if not strict:
                return None
            what = f"{log.names[places[axis]]} and {log.names[i]} may both be the rate about {axis}"
            cure = "Say which, as --columns t,gx,gy,gz."
            raise InputError("E-COLUMN-TWICE", f"{log.source}, line {log.header_line}", what, cure)
        places[axis] = i
    return _three(places[axis] for axis in _AXES) if len(places) == 3 else None


def _axis(name: str) -> str | None:
    """Return the axis that a name ends with, its unit left out: x, y or z."""
    bare = re.sub(r"[(\[/].*", "", RATE_NAMES.without_unit(name)).strip(" _-.")
    return bare[-1] if bare and bare[-1] in _AXES else None


def _axis_inside(name: str) -> str | None:
    """Return the axis that stands before a unit or another word, as in acc_x_m_s2: x, y or z."""
    found = re.findall(r"(?:^|[ _\-.a-z])([xyz])(?=[ _\-.]|$)", name)
    return found[-1] if found else None


def _stated(log: Log, columns: Sequence[str]) -> Channels:
    if len(columns) not in (3, 4):
        cure = "Give four: time, x, y, z; or three where --rate states the sample rate."
        raise InputError("E-COLUMN-MISSING", "--columns", f"names {len(columns)} columns", cure)
    places = [_place(word.strip(), log) for word in columns]
    time = places[0] if len(places) == 4 else None
    rates = _three(places[-3:])
    name = log.names[rates[0]].lower() if log.names else ""
    tick = TIME_NAMES.unit_in(log.names[time].lower()) if log.names and time is not None else None
    ticks = () if tick is None else (TIME_NAMES.units[tick],)
    return Channels("columns as stated", time, rates, None, RATE_NAMES.unit_in(name), ticks, _chip(log, rates))


def _place(word: str, log: Log) -> int:
    names = [name.lower() for name in log.names]
    if word.lower() in names:
        return names.index(word.lower())
    if word.isdecimal() and 1 <= int(word) <= log.values.shape[1]:
        return int(word) - 1
    having = [i for i, name in enumerate(names) if word.lower() in re.findall(r"\w+", name)]
    if len(having) == 1:
        return having[0]
    known = ", ".join(log.names) or f"places 1 to {log.values.shape[1]}"
    raise InputError(
        "E-COLUMN-MISSING", f"{log.source}, --columns", f"{shown(word)} is no column", f"There are {known}."
    )


def _chip(log: Log, rates: Three) -> tuple[str, str, str]:
    """Return the names of the three rates for messages, without their units."""
    if not log.names:
        return ("x", "y", "z")
    bare = [re.sub(r"\s*[(\[/].*", "", RATE_NAMES.without_unit(log.names[i])) or log.names[i] for i in rates]
    return bare[0], bare[1], bare[2]


def _three(values) -> Three:
    x, y, z = values
    return int(x), int(y), int(z)
