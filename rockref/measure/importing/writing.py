"""A campaign as an experiment folder: a commented ``experiment.toml``, and a table a run; whole or not at all."""

from __future__ import annotations

import math
import os
import shutil
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np

from rockref.measure.experiment import load_experiment
from rockref.measure.importing.campaign import Campaign, ImportedRun
from rockref.measure.importing.units import SPOKEN
from rockref.measure.reading.columns import DEGREE
from rockref.measure.records.notice import Notice
from rockref.measure.records.release import Experiment
from rockref.model.errors import InputError

HEADER = "t_s,wx_deg_s,wy_deg_s,wz_deg_s"


def write_campaign(
    campaign: Campaign, folder: Path, more: Callable[[Experiment, Path], None] | None = None
) -> tuple[Experiment, Campaign, tuple[Notice, ...]]:
    """Write the experiment folder, read it back, and return the experiment, the campaign and remarks.

    A run that the reader refuses is left out, with a remark that says why. `more` may write files beside. Raises
    InputError: E-FOLDER where the folder holds files; the refusal itself, where no run is left.
    """
    check_vacant(folder)
    folder.parent.mkdir(parents=True, exist_ok=True)
    place = Path(tempfile.mkdtemp(prefix=f".{folder.name}.", dir=folder.parent))
    try:
        campaign, left_out = _usable(campaign, place, folder)
        if more is not None:
            more(load_experiment(place), place)
        place.chmod(0o777 & ~_umask())
        if folder.exists():
            folder.rmdir()
        os.replace(place, folder)
    except BaseException:
        shutil.rmtree(place, ignore_errors=True)
        raise
    return load_experiment(folder), campaign, left_out


def check_vacant(folder: Path) -> None:
    """Refuse a folder that holds files (E-FOLDER)."""
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise InputError("E-FOLDER", str(folder), "is there and not empty", "Name a new folder.")


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _usable(campaign: Campaign, place: Path, folder: Path) -> tuple[Campaign, tuple[Notice, ...]]:
    """Write the files of a campaign without the runs that the reader refuses."""
    left_out: list[Notice] = []
    while True:
        _write_files(campaign, place, folder.name)
        try:
            load_experiment(place)
            return campaign, tuple(left_out)
        except InputError as error:
            refused = next((run for run in campaign.runs if f"{place / _file(run)}" in error.where), None)
            rest = tuple(run for run in campaign.runs if run is not refused)
            if refused is None or not any(run.use == "fit" for run in rest):
                where = error.where.replace(str(place), str(folder))
                source = f" ({refused.source})" if refused is not None else ""
                raise InputError(error.code, where + source, error.what, error.cure) from None
            cure = f"The run is left out. {error.cure} [{error.code}]"
            left_out.append(Notice("W-LEFT-OUT", refused.source, error.what, cure))
            (place / _file(refused)).unlink()
            campaign = replace(campaign, runs=rest)


def _file(run: ImportedRun) -> str:
    return f"run{run.id}.csv"


def _write_files(campaign: Campaign, place: Path, name: str) -> None:
    for run in campaign.runs:
        rows = np.column_stack([run.t, run.crv / DEGREE])[run.rows]
        np.savetxt(place / _file(run), rows, "%.7f,%.8g,%.8g,%.8g", header=HEADER, comments="")
    (place / "experiment.toml").write_text(experiment_toml(campaign, name), encoding="utf-8")


def experiment_toml(campaign: Campaign, name: str) -> str:
    """Return the text of ``experiment.toml``: every number with where it comes from."""
    c, choices = campaign, campaign.choices
    measured = (
        "measured while the block stood" if any(run.standing > 0.0 for run in c.runs) else "measured in calm stretches"
    )
    gyro = [
        f"sample_rate_hz = {c.rate:.10g}  # from the time stamps",
        f"noise_deg_s = {c.noise / DEGREE:.4g}  # {measured}",
        f"bandwidth_hz = {c.bandwidth:.6g}  # "
        + ("stated" if choices.bandwidth else "not known: three tenths of the sample rate; the data sheet says better"),
        f"resolution_deg_s = {c.resolution / DEGREE:.6g}  # the step between values; 0 where there is none",
    ]
    if any(run.standing > 0.0 for run in c.runs):
        why = "of the zero that was taken off: noise of its mean while the block stood, and what it wanders"
    else:
        why = "of the zero: nobody measured it, as the block does not stand before its release"
    gyro.append(f"zero_uncertainty_deg_s = {c.zero_uncertainty / DEGREE:.2g}  # {why}")
    tilts = "measured: what the rates add up to until the block stands" if c.tilts_measured else "stated"
    head = f"""# Made by `rockref new`. Every line may be changed; `rockref compare` says what does not fit.
name = "{_safe(name)}"
kind = "release"
baseline = "{choices.baseline}"

[block]
mass_kg = {choices.mass:.10g}
width_m = {choices.width:.10g}
height_m = {choices.height:.10g}

[release]
# Tilts are {tilts}.
tilt_uncertainty_rad = {c.tilt_uncertainty:.4g}

[gyro]
# The logs are in {SPOKEN.get(c.unit, c.unit)}. Axes: {c.axes_words} ({c.axes.reason}).
"""
    return head + "\n".join(gyro) + "\n" + "".join(_run_lines(run) for run in c.runs)


def _run_lines(run: ImportedRun) -> str:
    source = "".join(ch if ch.isprintable() else "?" for ch in Path(run.source).name)
    return f"""
[[run]]
id = "{run.id}"
file = "{_file(run)}"  # from {source}, release at {run.release:.4f} s ({run.logger}; {run.layout})
use = "{run.use}"
release_tilt_rad = {run.tilt:.6g}  # {math.degrees(run.tilt):.3f} degrees; the rates add up to {run.measured:.4f} rad
block_turned_deg = {180 if run.turned else 0}
"""


def _safe(name: str) -> str:
    """Return a name that may be part of a file name."""
    safe = "".join(ch if ch.isascii() and (ch.isalnum() or ch in "_.-") else "_" for ch in name)[:64].lstrip("_.-")
    return safe or "experiment"
