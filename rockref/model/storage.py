"""Files that appear whole or not at all; and files of strangers, of which no more is read than was asked for."""

from __future__ import annotations

import gzip
import io
import os
import stat
import tempfile
import zlib
from collections.abc import Iterable
from pathlib import Path

from rockref.model.errors import InputError

#: Bytes that are unpacked at a time.
_CHUNK = 2**20


def write_pieces(path: str | os.PathLike, pieces: Iterable[bytes]) -> None:
    """Write a file beside its place, flush it to the disk, and rename it; an interrupted write leaves the old file.

    The pieces are asked for one after the other, so that a long file need not be in memory.

    Raises
    ------
    InputError
        E-WRITE, where the folder is missing, read-only or full.
    """
    path = Path(path)
    temporary = None
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as f:
            temporary = f.name
            f.writelines(pieces)
            f.flush()
            os.fsync(f.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except OSError as e:
        raise InputError(
            "E-WRITE", str(path), f"cannot be written ({e.strerror})", "Check the folder and its space."
        ) from e
    finally:
        if temporary is not None and os.path.exists(temporary):
            os.unlink(temporary)


def write_bytes(path: str | os.PathLike, data: bytes) -> None:
    """Write a file whole or not at all. Raises InputError (E-WRITE)."""
    write_pieces(path, (data,))


def write_text(path: str | os.PathLike, text: str) -> None:
    """Write a UTF-8 text file whole or not at all. Raises InputError (E-WRITE)."""
    write_bytes(path, text.encode())


def read_bytes(path: str | os.PathLike, limit: int) -> bytes:
    """Return the bytes of a regular file of at most `limit` bytes. Raises InputError: E-FILE, E-SIZE."""
    cure = "Check the name and the permissions."
    try:
        # O_NONBLOCK: opening a pipe must not wait for a writer; fstat looks at what was opened, not at the name.
        descriptor = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError("E-FILE", str(path), f"cannot be opened ({reason})", cure) from None
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise InputError("E-FILE", str(path), "is not a regular file", "Name a file that holds the data.")
    with os.fdopen(descriptor, "rb") as stream:
        try:
            data = stream.read(limit + 1)
        except OSError as error:
            raise InputError("E-FILE", str(path), f"cannot be read ({error.strerror})", cure) from None
    if len(data) > limit:
        raise too_large(path, limit)
    return data


def too_large(path: str | os.PathLike, limit: int) -> InputError:
    """Return the error for a file, or what is packed in it, of more than `limit` bytes (E-SIZE)."""
    what = f"more than {limit // 2**20} MiB" if limit >= 2**20 else f"more than {limit} bytes"
    return InputError("E-SIZE", str(path), f"holds {what}", "Cut the file to what belongs to it.")


def unpacked(packed: bytes, path: str | os.PathLike, limit: int) -> bytes:
    """Return what a gzip stream holds, at most `limit` bytes of it: a bomb is noticed before it is in memory.

    Raises InputError: E-SIZE; E-GZIP, where the stream is cut off or damaged.
    """
    pieces: list[bytes] = []
    size = 0
    try:
        with gzip.GzipFile(fileobj=io.BytesIO(packed)) as stream:
            # read1: what comes before a cut is handed out, and counted; read would lose it.
            while piece := stream.read1(_CHUNK):
                size += len(piece)
                if size > limit:
                    raise too_large(path, limit)
                pieces.append(piece)
    except EOFError:
        raise InputError(
            "E-GZIP", str(path), f"the gzip stream is cut off after {size} bytes of text", "Copy the file again."
        ) from None
    except (OSError, zlib.error) as error:
        raise InputError("E-GZIP", str(path), f"the gzip stream is damaged ({error})", "Copy the file again.") from None
    return b"".join(pieces)
