"""K-NET and KiK-net: counts with a scale factor, read by obspy where it is installed (extra `records`)."""

from __future__ import annotations

import numpy as np

from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError
from rockref.shake.records.channel import Channel, direction_of, positive_step

# decided: K-NET keeps 15 s before the trigger; the first five of them show the offset of the sensor and no motion.
QUIET = 5.0


def is_knet(lines: list[str]) -> bool:
    """Return whether the header has the keys of this format."""
    return any(line.startswith("Scale Factor") for line in lines[:17])


def read_knet(lines: list[str], path: str) -> list[Channel]:
    """Return the one component of a K-NET file, less the mean of its first seconds.

    obspy leaves counts in its data and puts m/s2 a count beside them. Raises InputError E-RECORD-OBSPY where obspy is
    not installed, E-RECORD-KIND where it cannot read the file, E-RECORD-STEP.
    """
    try:
        import obspy
    except ImportError:
        cure = 'Install it: pip install "rockref[records]".'
        raise InputError(
            "E-RECORD-OBSPY", path, "K-NET files are read by obspy, which is not installed", cure
        ) from None
    try:
        trace = obspy.read(path, format="KNET")[0]
    # obspy raises many kinds, some of them bare.
    except Exception as error:
        what = f"obspy cannot read it ({type(error).__name__}: {error})"
        raise InputError("E-RECORD-KIND", path, what, "Get the file again.") from None
    dt = positive_step(float(trace.stats.delta), path)
    a = np.asarray(trace.data, float) * float(trace.stats.calib)
    offset = float(a[: max(1, round(QUIET / dt))].mean())
    what = f"the mean of the first {QUIET:g} s, {offset:.4g} m/s2, is the sensor's offset"
    notice = Notice("W-RECORD-MEAN", path, what, "It was subtracted.")
    channel = str(trace.stats.channel).rstrip("0123456789")
    return [Channel(path, a - offset, dt, direction_of(channel), float(trace.stats.starttime.timestamp), (notice,))]
