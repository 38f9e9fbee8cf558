"""The gyroscope's data sheet where ``experiment.toml`` leaves it open: measured in a record, or a stated default."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rockref.measure.reading.columns import DEGREE, RATES
from rockref.measure.reading.table import read_table
from rockref.measure.records.notice import Notice
from rockref.measure.signals.noise import noise_floor, smallest_step

# decided: a digital low-pass lies at a fifth to a half of the sample rate (MPU-6050: 188 Hz at 1 kHz, PS-MPU-6000A-00,
# section 4; LSM6DS3: ODR/2 to ODR/4, DocID026899, table 69).
BANDWIDTH_SHARE = 0.3


def completed(
    stated: Mapping[str, float | None], first: Path, source: str
) -> tuple[dict[str, float | None], list[Notice]]:
    """Return the data sheet with noise, resolution and bandwidth, and remarks on what was not stated.

    `stated` are its keys in SI, None where absent; `first` is the table of the first fit run, whose calm stretches give
    the noise [rad/s] and whose values the step between them. Raises InputError: those of ``read_table``, E-SIGNAL.
    """
    sheet, notices = dict(stated), list[Notice]()
    where = f"{source}, [gyro]"
    if sheet["noise"] is None or sheet["resolution"] is None:
        table = read_table(first, ("t", *RATES))
        crv = np.stack([table.columns[name] for name in RATES], axis=-1)
        if sheet["noise"] is None:
            sheet["noise"] = noise = float(noise_floor(table.columns["t"], crv).sigma.mean())
            what = f"noise_deg_s is not stated; {noise / DEGREE:.3g} deg/s was measured in {first.name}"
            notices.append(Notice("W-DEFAULT", where, what, "State it where a data sheet says it."))
        if sheet["resolution"] is None:
            sheet["resolution"] = float(np.median(smallest_step(crv)))
    if sheet["bandwidth"] is None:
        assert sheet["sample_rate"] is not None
        sheet["bandwidth"] = bandwidth = BANDWIDTH_SHARE * sheet["sample_rate"]
        what = f"bandwidth_hz is not stated; {bandwidth:.4g} Hz is taken, three tenths of the sample rate"
        notices.append(Notice("W-DEFAULT", where, what, "State it as the data sheet says it."))
    return sheet, notices
