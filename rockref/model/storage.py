"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path

from rockref.model.errors import InputError


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
