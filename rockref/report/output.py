"""The files of a report: the page and the figures, in one folder."""

from __future__ import annotations

from pathlib import Path

from rockref.discover.compare import Comparison
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


def write_report(c: Comparison, folder: Path) -> list[Path]:
    """Write ``index.html`` and the figures of the first run; return the paths, page first. Raises InputError."""
    page = comparison_page(c).write(folder / "index.html")
    return [page, *write_figures(c, folder)]
