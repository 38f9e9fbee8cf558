"""A simulated response as a table file: the columns of `Response.to_frame`, contacts as 0 and 1."""

from __future__ import annotations

import gzip
import hashlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.effects.catalogue import measured
from rockref.model.errors import InputError
from rockref.model.response import OVERTURNED, Response
from rockref.model.storage import write_bytes


def check_name(path: Path) -> None:
    """Refuse a name that is no table, or a folder that is not there, before anything is computed (E-PATH)."""
    if not path.name.endswith((".csv", ".csv.gz")):
        raise InputError(
            "E-PATH", str(path), "is not the name of a .csv or .csv.gz file", "Write, say, -o response.csv."
        )
    if not path.parent.is_dir():
        raise InputError("E-PATH", str(path), f"there is no folder {path.parent}", "Make the folder, or name another.")


def overturned_at(response: Response) -> float | None:
    """Return when the block first leans by more than 45 degrees, s, or None."""
    fallen = np.flatnonzero(response.Lambda[:, 2, 2] < np.cos(OVERTURNED))
    return float(response.t[fallen[0]]) if len(fallen) else None


def as_measured(response: Response) -> Response:
    """The response with the rates that the gyroscope shows, with the sensor effects of its problem, in place of W."""
    return replace(response, W=measured(response.problem.effects, response.t, response.W))


def write_response(response: Response, path: Path) -> dict[str, Any]:
    """Write the response of one block, whole or not at all, and return path, rows, columns and digest of the file.

    Body rates are those that the gyroscope shows, with the sensor effects of the problem. Numbers are written so that
    reading them gives the same doubles. Raises InputError (E-PATH, E-WRITE).
    """
    check_name(path)
    frame = as_measured(response).to_frame()
    switches = [name for name in frame if frame[name].dtype == bool]
    frame[switches] = frame[switches].astype("int8")
    data = frame.to_csv(index=False, lineterminator="\n").encode("ascii")
    if path.name.endswith(".gz"):
        # No name and no time inside: the same run gives the same file.
        data = gzip.compress(data, compresslevel=6, mtime=0)
    write_bytes(path, data)
    digest = hashlib.sha256(data).hexdigest()
    return {"path": str(path), "rows": len(frame), "columns": len(frame.columns), "sha256": digest}
