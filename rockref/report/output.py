"""The files of a report: the page and the figures, in one folder."""

from __future__ import annotations

import os
from pathlib import Path

from rockref.discover.compare.models import Comparison
from rockref.model.errors import InputError
from rockref.report.comparison_page import comparison_page
from rockref.report.figures import write_figures


def made_folder(path: Path) -> Path:
    """Make the folder if it is not there and return it. Raises InputError E-WRITE where that cannot be."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as e:
        raise InputError("E-WRITE", str(path), f"cannot be made a folder ({e.strerror})", "Name another folder.") from e
    return path


def usable_folder(path: Path) -> Path:
    """Return the folder, which is made when something is written into it; the check is for before the work.

    Raises InputError E-WRITE where it cannot be made or written to.
    """
    there = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not there.is_dir():
        raise InputError("E-WRITE", str(path), f"{there} is not a folder", "Name another folder.")
    if not os.access(there, os.W_OK | os.X_OK):
        raise InputError("E-WRITE", str(path), f"{there} must not be written to", "Name another folder.")
    return path


def write_report(c: Comparison, folder: Path) -> list[Path]:
    """Write ``index.html`` and the figures of the first run; return the paths, page first. Raises InputError.

    The folder is made if it is not there.
    """
    drawn = comparison_page(c)
    page = drawn.write(made_folder(folder) / "index.html")
    return [page, *write_figures(c, folder)]
