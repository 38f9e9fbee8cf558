"""A campaign as proposed from its logs: units, axes, tilts, sides, hold-out, noise; what is stated goes before it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from rockref.measure.checks.datasheet import BANDWIDTH_SHARE
from rockref.measure.importing.axes import ALONE, Axes, find_axes, other_way_up
from rockref.measure.importing.channels import find_channels
from rockref.measure.importing.layout import read_log
from rockref.measure.importing.motion import STANDING, Motion, find_motion
from rockref.measure.importing.recording import recording
from rockref.measure.importing.units import RATE_UNITS, rate_unit
from rockref.measure.records.notice import Notice
from rockref.measure.signals.noise import noise_floor, smallest_step
from rockref.model.errors import InputError

# decided: tilts within one standing wire's uncertainty are meant to be the same one: 1 mm in 0.67 m.
SAME_TILT = 1.5e-3
# The scale of a gyroscope on a chip is good to 3 % at 25 degrees Celsius (InvenSense PS-MPU-6000A-00, revision 3.4,
# section 6.1, sensitivity scale factor tolerance), and so is a tilt that its rates add up to. decided: 1 mm of wire,
# which is 0.0014 rad.
SCALE_ERROR, WIRE = 0.03, 1.4e-3
# decided: two stated and measured tilts that differ by a twentieth are two tilts.
TILT_AGREES = 0.05
# The zero of a gyroscope on a chip wanders by 8 degrees an hour (Analog Devices ADIS16470, table 1, in-run bias
# stability); warmed by one kelvin it moves by 0.05 deg/s (STMicroelectronics LSM6DS3, DocID026899, table 3).
WANDER, WARMED = math.radians(8.0) / 3600.0, math.radians(0.05)
# decided: one run in four is held out.
HELD_OUT = 4


@dataclass(frozen=True)
class Choices:
    """What the experimenter states; None or empty is measured or proposed.

    Attributes: ``mass`` kg, ``width``, ``height`` m; ``tilts`` rad and ``turned``, ``holdout`` by run; ``tilt`` rad of
    all runs; ``axes`` as ``("y", "-x", "z")``; ``columns``; ``unit`` of the rates; ``rate``, ``bandwidth`` Hz;
    ``baseline``.
    """

    mass: float
    width: float
    height: float
    tilt: float | None = None
    tilts: Mapping[str, float] = field(default_factory=dict)
    turned: tuple[str, ...] | None = None
    holdout: tuple[str, ...] | None = None
    axes: tuple[str, str, str] | None = None
    columns: tuple[str, ...] = ()
    unit: str | None = None
    rate: float | None = None
    bandwidth: float | None = None
    baseline: str = "eight_points"


@dataclass(frozen=True, eq=False)
class ImportedRun:
    """One run, in the block's axes: times from the release, those before it negative.

    Attributes: ``id``; ``source``; ``use``; ``tilt`` rad; ``measured`` rad, the tilt that the rates add up to;
    ``turned``; ``t`` (N,) s from the release; ``crv`` (N, 3) rad/s; ``release`` s on the log's clock; ``standing`` s;
    ``impact`` s from the release; ``logger``, ``layout`` in words.
    """

    id: str
    source: str
    use: str
    tilt: float
    measured: float
    turned: bool
    t: np.ndarray = field(repr=False)
    crv: np.ndarray = field(repr=False)
    release: float
    standing: float
    impact: float
    logger: str
    layout: str

    @property
    def rows(self) -> np.ndarray:
        """Return which samples (N,) come after the release."""
        return self.t >= -1e-9


@dataclass(frozen=True, eq=False)
class Campaign:
    """An experiment as it is proposed.

    Attributes: ``choices``; ``runs``; ``unit`` of the rates in the logs; ``axes`` and ``axes_words``; ``rate``,
    ``bandwidth`` Hz; ``noise``, ``resolution``, ``zero_uncertainty`` rad/s; ``tilt_uncertainty`` rad;
    ``tilts_measured``; ``notices``.
    """

    choices: Choices
    runs: tuple[ImportedRun, ...]
    unit: str
    axes: Axes
    axes_words: str
    rate: float
    bandwidth: float
    noise: float
    resolution: float
    zero_uncertainty: float
    tilt_uncertainty: float
    tilts_measured: bool
    notices: tuple[Notice, ...]


def import_logs(paths: Sequence[Path], choices: Choices, progress: Callable[[float], None] | None = None) -> Campaign:
    """Return the experiment that the logs at `paths` show, in that order: runs 01, 02, ...

    1. Read each log: delimiter, decimal mark, header, channels, clock.
    2. Find the release and the first swing of each.
    3. Tell the unit of the rates, and which axis is which.
    4. Sum the rates to the tilt of each release; runs that swing the other way are turned.
    5. Hold out one run in four; measure noise and resolution while the block stands.

    `progress` is called with the share of the logs that are read. Raises InputError: those of the steps, E-FILE without
    any log.
    """
    if not paths:
        raise InputError("E-FILE", "the logs", "none is named", "Name the files of the logger.")
    motions = []
    for path in paths:
        log = read_log(path)
        one = recording(log, find_channels(log, choices.columns), choices.rate)
        motions.append(find_motion(one, choices.width, choices.height))
        if progress is not None:
            progress(len(motions) / len(paths))
    ids = [f"{number:02d}" for number in range(1, len(paths) + 1)]
    stated = _stated_turns(ids, paths, choices)
    axes = stated_axes(choices.axes) if choices.axes else find_axes(motions, stated)
    first = motions[0].recording
    unit = rate_unit(
        choices.unit or first.channels.rate_unit,
        [m.gauge for m in motions],
        all(m.recording.whole for m in motions),
        first.source,
    )
    rate = round_rate(float(np.median([m.recording.rate for m in motions])))
    bandwidth = choices.bandwidth or BANDWIDTH_SHARE * rate
    runs = [
        _run(id, motion, axes, RATE_UNITS[unit], bandwidth, told)
        for id, motion, told in zip(ids, motions, stated, strict=True)
    ]
    runs, tilts_measured = _with_tilts(runs, paths, choices)
    runs = _with_uses(runs, paths, choices)
    noise, resolution = _noise(runs, motions, RATE_UNITS[unit])
    largest = max(run.tilt for run in runs)
    return Campaign(
        choices,
        tuple(runs),
        unit,
        axes,
        axes.spoken(first.channels.chip),
        rate,
        bandwidth,
        noise,
        resolution,
        _zero_uncertainty(runs, noise, rate),
        max(WIRE, SCALE_ERROR * largest) if tilts_measured else WIRE,
        tilts_measured,
        tuple(n for m in motions for n in m.recording.notices) + tuple(_remarks(runs, motions, axes, choices)),
    )


def round_rate(rate: float) -> float:
    """Return a measured sample rate [Hz] as a data sheet would state it, where it is one part in a thousand from it."""
    # decided: makers state two figures, or a power of two.
    figures = 10.0 ** (math.floor(math.log10(rate)) - 1)
    return next(
        (nice for nice in (round(rate / figures) * figures, float(round(rate))) if abs(nice / rate - 1.0) < 1e-3), rate
    )


def stated_axes(words: Sequence[str]) -> Axes:
    """Return axes given as three of x, y, z with signs, for X, Y, Z. Raises InputError E-AXES if they are no turn."""
    cure = "Give the chip's axis along X, Y and Z of the block, as --axes y,-x,z."
    bare = [word.strip().lower().lstrip("+-") for word in words]
    if sorted(bare) != ["x", "y", "z"]:
        raise InputError("E-AXES", "--axes", f"{','.join(words)} are not x, y, z in some order", cure)
    places = tuple("xyz".index(word) for word in bare)
    signs = tuple(-1 if word.strip().startswith("-") else 1 for word in words)
    if round(float(np.linalg.det(np.eye(3)[list(places)] * np.array(signs)[:, None]))) != 1:
        raise InputError("E-AXES", "--axes", f"{','.join(words)} are a mirrored chip, which there is not", cure)
    return Axes((places[0], places[1], places[2]), (signs[0], signs[1], signs[2]), "as stated", True)


def _stated_turns(ids: Sequence[str], paths: Sequence[Path], choices: Choices) -> list[bool | None]:
    if choices.turned is None:
        return [None] * len(ids)
    wanted = _places(choices.turned, ids, paths, "--turned")
    return [k in wanted for k in range(len(ids))]


def _places(words: Sequence[str], ids: Sequence[str], paths: Sequence[Path], where: str) -> set[int]:
    """Return the places of runs named by id or by file."""
    found = set()
    for word in words:
        matches = [
            k
            for k, (id, path) in enumerate(zip(ids, paths, strict=True))
            if word in (id, id.lstrip("0"), path.name, path.stem, str(path))
        ]
        if len(matches) != 1:
            known = ", ".join(f"{id} ({path.name})" for id, path in zip(ids, paths, strict=True))
            raise InputError("E-RUN", where, f"{word} names {len(matches)} runs", f"There are {known}.")
        found.add(matches[0])
    return found


def _run(id: str, motion: Motion, axes: Axes, worth: float, bandwidth: float, told: bool | None) -> ImportedRun:
    """Return a run in the block's axes, cut at its release, with the tilt that its rates add up to."""
    one = motion.recording
    # A second-order low-pass of this bandwidth shows slow motion sqrt(2)/(2 pi f) later, of a model too.
    delay = math.sqrt(2.0) / (2.0 * math.pi * bandwidth) if motion.release > one.t[0] else 0.0
    release = motion.release - delay
    crv = axes.body(one.chip - motion.bias) * worth
    angle = motion.angle * axes.signs[0] * worth
    return ImportedRun(
        id,
        one.source,
        "fit",
        abs(angle),
        abs(angle),
        angle < 0.0 if told is None else told,
        one.t - release,
        crv,
        release,
        motion.standing,
        motion.impact - release,
        one.channels.logger,
        one.log.layout,
    )


def _with_tilts(runs: list[ImportedRun], paths: Sequence[Path], choices: Choices) -> tuple[list[ImportedRun], bool]:
    """Return the runs with their tilts: as stated, or as measured, those alike taken together; and whether all are."""
    ids = [run.id for run in runs]
    stated = {k: tilt for word, tilt in choices.tilts.items() for k in _places([word], ids, paths, "--tilt")}
    groups = _alike([run.measured for run in runs])
    out = []
    for k, run in enumerate(runs):
        mean = float(np.mean([runs[i].measured for i in groups[k]]))
        out.append(replace(run, tilt=stated.get(k, choices.tilt if choices.tilt is not None else round(mean, 4))))
    return out, choices.tilt is None and not stated


def _alike(tilts: Sequence[float]) -> list[list[int]]:
    """Return for each tilt the places of those that are the same one: no step between neighbours beyond a wire's."""
    order = np.argsort(tilts)
    groups: list[list[int]] = []
    for k in order:
        if groups and abs(tilts[k] - np.mean([tilts[i] for i in groups[-1]])) < SAME_TILT:
            groups[-1].append(int(k))
        else:
            groups.append([int(k)])
    return [next(group for group in groups if k in group) for k in range(len(tilts))]


def _with_uses(runs: list[ImportedRun], paths: Sequence[Path], choices: Choices) -> list[ImportedRun]:
    ids = [run.id for run in runs]
    held = hold_out(runs) if choices.holdout is None else _places(choices.holdout, ids, paths, "--holdout")
    return [replace(run, use="holdout" if k in held else "fit") for k, run in enumerate(runs)]


def hold_out(runs: Sequence[ImportedRun]) -> set[int]:
    """Return the places of one run in four: first a tilt between others, then the last of the most repeated release.

    A tilt between others asks of a model what no fit run shows, and asks nothing beyond them. No release loses its only
    run otherwise.
    """
    wanted = max(1, round(len(runs) / HELD_OUT)) if len(runs) > 1 else 0
    held: set[int] = set()
    while len(held) < wanted:
        left = [k for k in range(len(runs)) if k not in held]
        groups: dict[tuple[bool, float], list[int]] = {}
        for k in left:
            groups.setdefault((runs[k].turned, runs[k].tilt), []).append(k)
        between = [
            k
            for (turned, tilt), members in groups.items()
            for k in members[-1:]
            if any(runs[i].tilt < tilt for i in left if runs[i].turned == turned)
            and any(runs[i].tilt > tilt for i in left if runs[i].turned == turned)
        ]
        repeated = max(reversed(groups.values()), key=len)
        held.add(between[-1] if between and not held else repeated[-1])
    return held


def _noise(runs: Sequence[ImportedRun], motions: Sequence[Motion], worth: float) -> tuple[float, float]:
    """Return noise and resolution [rad/s]: the scatter while the block stands, the step between values."""
    standing = [m.noise * worth for m in motions if m.standing > 0.0]
    sigmas = standing or [noise_floor(run.t[run.rows], run.crv[run.rows]).sigma for run in runs]
    steps = [smallest_step(m.recording.chip) * worth for m in motions]
    return float(np.mean(sigmas)), float(np.median(steps))


def _zero_uncertainty(runs: Sequence[ImportedRun], noise: float, rate: float) -> float:
    """Return how uncertain [rad/s] the zero is that was taken off: noise of its mean, and what it wanders."""
    shortest = min(min(run.standing, STANDING) for run in runs)
    return math.hypot(noise / math.sqrt(rate * shortest), WANDER) if shortest > 0.0 else WARMED


def _remarks(runs: Sequence[ImportedRun], motions: Sequence[Motion], axes: Axes, choices: Choices) -> list[Notice]:
    """Return what an experimenter has to know of the proposals."""
    notices = []
    for run, motion in zip(runs, motions, strict=True):
        if motion.standing <= 0.0:
            what = "the block is not seen to stand before its release, so that the gyroscope's zero is not measured"
            notices.append(Notice("W-ZERO", run.source, what, "Record it standing, for a second before the release."))
        if abs(run.tilt / run.measured - 1.0) > TILT_AGREES:
            what = f"a tilt of {run.tilt:.4g} rad is stated, and the rates add up to {run.measured:.4g} rad"
            notices.append(Notice("W-TILT-OFF", run.source, what, "Check the tilt, its unit, and that of the rates."))
    if not axes.up_known:
        up = axes.spoken("xyz").split("Z = ")[1]
        what = f"no accelerometer says which way is up; {up} of the chip is assumed to point up"
        cure = f"If it points down, add --axes={','.join(other_way_up(axes))}."
        notices.append(Notice("W-UP", "the axes", what, cure))
    if math.cos(axes.askew) < ALONE:
        what = f"the rocking axis lies {math.degrees(axes.askew):.0f} degrees from the chip's axis"
        notices.append(Notice("W-ASKEW", "the axes", what, "Mount the chip along the block's edges."))
    return notices
