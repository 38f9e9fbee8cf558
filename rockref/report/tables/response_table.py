"""A simulated response as a table file: the columns of `Response.to_frame`, contacts as 0 and 1."""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rockref.effects.catalogue import measured
from rockref.model.errors import InputError
from rockref.model.response import OVERTURNED, Response
from rockref.model.storage import write_pieces

#: Rows that are text at the same time; decided: a quarter of a megabyte of it.
ROWS_A_PIECE = 250

#: The window of zlib, 2^15, with gzip's head and tail around it.
GZIP = 15 + 16


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
    """Return the response with the rates that the gyroscope shows, with the sensor effects of its problem, in place of
    W."""
    return replace(response, W=measured(response.problem.effects, response.t, response.W))


def write_response(response: Response, path: Path) -> dict[str, Any]:
    """Write the response of one block, whole or not at all, and return path, rows, columns and digest of the file.

    Body rates are those that the gyroscope shows, with the sensor effects of the problem. Numbers are written so that
    reading them gives the same doubles. Raises InputError (E-PATH, E-WRITE).
    """
    check_name(path)
    columns = as_measured(response).columns()
    pieces, digest = csv_pieces(columns), hashlib.sha256()
    if path.name.endswith(".gz"):
        pieces = packed(pieces)
    write_pieces(path, seen_by(digest, pieces))
    return {"path": str(path), "rows": len(response.t), "columns": len(columns), "sha256": digest.hexdigest()}


def packed(pieces: Iterable[bytes]) -> Iterator[bytes]:
    """Yield the pieces as a gzip stream; no name and no time inside: the same run gives the same file."""
    packer = zlib.compressobj(6, wbits=GZIP)
    for piece in pieces:
        yield packer.compress(piece)
    yield packer.flush()


def seen_by(digest: Any, pieces: Iterable[bytes]) -> Iterator[bytes]:
    """Yield the pieces as they are, each of them added to the digest."""
    for piece in pieces:
        digest.update(piece)
        yield piece


def csv_pieces(columns: dict[str, np.ndarray]) -> Iterator[bytes]:
    """Yield the text of a table, columns (rows,) by name, in pieces of some rows: what pandas would write, byte for
    byte, in a fifth of its memory. Switches are 0 and 1."""
    yield (",".join(columns) + "\n").encode("ascii")
    values = [a.astype(np.int8) if a.dtype == bool else a for a in columns.values()]
    for first in range(0, len(values[0]), ROWS_A_PIECE):
        texts = [[repr(v) for v in a[first : first + ROWS_A_PIECE].tolist()] for a in values]
        yield "".join(",".join(row) + "\n" for row in zip(*texts, strict=True)).encode("ascii")
