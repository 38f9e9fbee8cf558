"""The folder of a report: whether it can be used, before the work; made, after it."""

from __future__ import annotations

import os
from pathlib import Path

from rockref.model.errors import InputError


def made_folder(path: Path) -> Path:
    """Make the folder if it is not there and return it. Raises InputError E-WRITE where that cannot be."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as e:
        raise InputError("E-WRITE", str(path), f"cannot be made a folder ({e.strerror})", "Name another folder.") from e
    return path


def usable_folder(path: Path | None) -> Path | None:
    """Return the folder, which is made when something is written into it; the check is for before the work.

    None where no folder is wanted. Raises InputError E-WRITE where it cannot be made or written to.
    """
    if path is None:
        return None
    there = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not there.is_dir():
        raise InputError("E-WRITE", str(path), f"{there} is not a folder", "Name another folder.")
    if not os.access(there, os.W_OK | os.X_OK):
        raise InputError("E-WRITE", str(path), f"{there} must not be written to", "Name another folder.")
    return path
