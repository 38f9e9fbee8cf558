"""An experiment of releases or tosses as plain data: gyroscope, runs, what was noticed about them."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from rockref.measure.records.notice import Notice, shown
from rockref.model.errors import InputError
from rockref.model.shown import Shown

#: What a run is for: fits see the ones, verdicts are held against the others.
FIT, HOLDOUT = "fit", "holdout"


@dataclass(frozen=True)
class Gyro:
    """The data sheet of the gyroscope.

    Attributes: ``sample_rate`` Hz; ``noise`` rad/s, standard deviation of a sample; ``bandwidth`` Hz, -3 dB of the
    second-order low-pass; ``resolution`` rad/s; ``range`` rad/s, the largest rate it can show, or None;
    ``zero_uncertainty`` rad/s, standard deviation of what is left of its zero in each run.
    """

    sample_rate: float
    noise: float
    bandwidth: float
    resolution: float
    range: float | None = None
    zero_uncertainty: float = 0.0


@dataclass(frozen=True, eq=False)
class Run:
    """One measured run.

    Attributes
    ----------
    id, file : name of the run, and of its file inside the folder
    use : ``fit`` or ``holdout``
    release_tilt : stated tilt at the release, rad (None for a toss)
    block_turned : turn of the block about the vertical, rad: 0 or pi
    t : (N,) time from the release, s. None if the file was not opened.
    crv : (N, 3) body rates about X (main), Y (transverse), Z (longitudinal), rad/s. None if unopened or not measured.
    pose : (N, 7) x, y, z in m and qw, qx, qy, qz (body to plate), where the file has them
    filled : rows that were missing and have been filled in by interpolation
    sha256 : digest of the file on disk; None if it was not opened
    """

    id: str
    file: str
    use: str
    release_tilt: float | None
    block_turned: float
    t: np.ndarray | None = field(default=None, repr=False)
    crv: np.ndarray | None = field(default=None, repr=False)
    pose: np.ndarray | None = field(default=None, repr=False)
    filled: tuple[int, ...] = field(default=(), repr=False)
    sha256: str | None = field(default=None, repr=False)

    @property
    def loaded(self) -> bool:
        """Return whether the file of the run was opened."""
        return self.t is not None


@dataclass(frozen=True)
class SensorFault:
    """One fault of the sensor in one run, or in all (then `run` is empty).

    Attributes: ``kind`` (``zero``, ``lag``, ``hum``); ``run``; ``axis`` 0 to 2; ``size``: change of the zero in rad/s,
    lag in s, amplitude of the hum in rad/s; ``place``: time of the change in s, or frequency of the hum in Hz, or 0.
    """

    kind: str
    run: str
    axis: int
    size: float
    place: float = 0.0


@dataclass(frozen=True, eq=False, repr=False)
class Experiment(Shown):
    """An experiment folder.

    Attributes: ``path``; ``name``; ``kind`` (``release`` or ``toss``); ``baseline`` (``eight_points`` or
    ``four_points``); ``mass`` kg; ``width``, ``height`` m; ``tilt_uncertainty`` rad or None; ``gyro`` or None;
    ``runs`` in the order of the file; ``notices``; ``toml_sha256``;
    ``sensor_faults``, what is no motion of the block: zeros that shift, late channels, hum.
    ``prior``: ranges of the law's numbers that fits stay in, by name (SI), where they are stated.
    """

    path: Path
    name: str
    kind: str
    baseline: str
    mass: float
    width: float
    height: float
    tilt_uncertainty: float | None
    gyro: Gyro | None
    runs: tuple[Run, ...]
    notices: tuple[Notice, ...] = field(default=(), repr=False)
    toml_sha256: str = field(default="", repr=False)
    sensor_faults: tuple[SensorFault, ...] = field(default=(), repr=False)
    prior: dict[str, tuple[float, float]] = field(default_factory=dict, repr=False)

    def facts(self) -> dict[str, str]:
        """Return name, block, runs, gyroscope and remarks, in words."""
        uses = f"{len(self.runs)} ({len(self.fit_runs())} fit, {len(self.holdout_runs())} holdout)"
        found = {"name": self.name, "kind": self.kind, "mass": f"{self.mass:g} kg"}
        found |= {"sides": f"{self.width:g} x {self.height:g} m", "runs": uses}
        found |= {} if self.gyro is None else {"gyroscope": f"{self.gyro.sample_rate:g} Hz"}
        return found | ({"remarks": str(len(self.notices))} if self.notices else {})

    def fit_runs(self) -> tuple[Run, ...]:
        """Return the runs that may be fitted."""
        return tuple(run for run in self.runs if run.use == FIT)

    def holdout_runs(self) -> tuple[Run, ...]:
        """Return the runs that are kept for the verdict."""
        return tuple(run for run in self.runs if run.use == HOLDOUT)

    def run(self, id: str) -> Run:
        """Return the run with this id. Raises InputError E-RUN if there is none."""
        for run in self.runs:
            if run.id == id:
                return run
        known = ", ".join(run.id for run in self.runs)
        raise InputError("E-RUN", f"{self.path}", f"there is no run {shown(id)}", f"There are {known}.")

    @property
    def digests(self) -> dict[str, str]:
        """Return SHA-256 of every file that was opened, by name."""
        return {"experiment.toml": self.toml_sha256} | {r.file: r.sha256 for r in self.runs if r.sha256 is not None}

    @property
    def digest(self) -> str:
        """Return one SHA-256 over the names and digests of the files that were opened."""
        lines = "".join(f"{name} {digest}\n" for name, digest in sorted(self.digests.items()))
        return hashlib.sha256(lines.encode()).hexdigest()
