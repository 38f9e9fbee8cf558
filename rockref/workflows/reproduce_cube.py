"""`rockref reproduce cube`: measured tosses compared, diagnosed and explained, on one page."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rockref.discover.diagnosis_record import plain
from rockref.discover.tosses.compare import compare
from rockref.discover.tosses.diagnose import diagnose
from rockref.jobs.folder_lock import alone_in
from rockref.measure.records.toss import Tosses
from rockref.measure.tosses.load import load_tosses
from rockref.model.storage import write_bytes, write_text
from rockref.report.html.page import Page
from rockref.report.output import made_folder, usable_folder
from rockref.report.terminal import toss_text
from rockref.report.views.toss_page import add_diagnosis, add_stretches, staircase_picture, stretches_picture

#: Where the tosses are if no folder is named.
VARIABLE = "ROCKREF_CUBE_TOSSES"


def reproduce_cube(folder: Path, data: Path | None, quick: bool, say: Callable[[str], None]) -> Path:
    """Make the page in `folder` from the tosses in `data` (default: the folder that ROCKREF_CUBE_TOSSES names).

    quick : one candidate, next to no iterations.

    Raises InputError: E-FOLDER, where no tosses are named; E-WRITE, before the work, for a folder that cannot be
    written to; E-BUSY.
    """
    path = data or named_folder()
    usable_folder(folder)
    tosses = load_tosses(path)
    for notice in tosses.notices:
        say(str(notice))
    with alone_in(made_folder(folder)):
        return _made(tosses, folder, quick, say)


def _made(tosses: Tosses, folder: Path, quick: bool, say: Callable[[str], None]) -> Path:
    """Return the same in a folder that is there, of this process alone."""
    say("stated values")
    before = compare(tosses).to_dict()
    only: dict[str, Any] = {"candidates": ("mass_eccentricity",), "stages": ((25, 2), (120, 2))} if quick else {}
    found = diagnose(tosses, progress=say, **only)
    record = found.to_dict()
    say("where the explained model fails")
    after = compare(tosses, [found.model], ["explained"]).to_dict()
    for name, kept in (("diagnosis", record), ("comparison", {"before": before, "after": after})):
        write_text(folder / f"{name}.json", json.dumps(plain(kept), indent=1, allow_nan=False) + "\n")
    found.model.save(folder / "model.toml")
    write_bytes(folder / "staircase.png", staircase_picture(record))
    page = Page("Tosses of a cube, explained", record["sentence"])
    page.add_section("Stated values", "The plain law with what the data's authors state, beside published simulators.")
    page.add_table(toss_text.errors_table(before))
    add_diagnosis(page, record)
    page.add_section("Where the error grows", "Before, and with the effects that were found; held-out tosses.")
    failing = [r for part in (before, after) for r in part["rows"] if (r["start"], r["use"]) == ("flight", "holdout")]
    add_stretches(page, failing)
    write_bytes(folder / "stretches.png", stretches_picture(failing))
    page.add_provenance({"tosses": len(tosses.tosses), "copies set aside": len(tosses.copies), "sha256": tosses.sha256})
    return page.write_into(folder)


def named_folder() -> Path:
    """Return the folder of tosses that the environment names. Raises InputError E-FOLDER."""
    import os

    from rockref.model.errors import InputError

    named = os.environ.get(VARIABLE)
    if not named:
        raise InputError(
            "E-FOLDER", VARIABLE, "is not set, and no --data was given",
            "Clone github.com/DAIRLab/contact-nets and run `rockref import contactnets CLONE -o tosses`.",
        )  # fmt: skip
    return Path(named)
