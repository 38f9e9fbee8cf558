"""One file with everything in it: the page, its programs, the law in WebAssembly, and the pack of numbers."""

from __future__ import annotations

import json
import os
from importlib import resources
from pathlib import Path
from typing import Any

from rockref.api import Model
from rockref.lab.pack import pack
from rockref.measure.records.release import Experiment
from rockref.model.errors import InputError
from rockref.model.storage import write_bytes

#: Decided: a page that opens at once, from a folder or in a mail.
MAX_BYTES = 2_000_000
#: Programs of the worker and of the page, in the order in which they are read.
WORKER = ("engine.js", "fit.js", "rank.js", "hidden.js", "worker.js")
SCRIPT = (
    "record.js", "state.js", "problem.js", "scene.js", "errors.js", "panel.js", "curves.js", "link.js", "search.js",
    "own.js", "wire.js", "main.js",
)  # fmt: skip


def asset(name: str) -> str:
    """Return the text of a file of the page."""
    return (resources.files("rockref.lab") / "page" / name).read_text(encoding="utf-8")


def vendored(name: str) -> str:
    """Return the text of a file of others, which travels with the package."""
    return (resources.files("rockref.report.html") / "vendor" / name).read_text(encoding="utf-8")


def as_json(value: Any) -> str:
    """Return JSON that cannot end the script element that holds it."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def html(model: Model, experiment: Experiment | None = None) -> str:
    """Return the page of a model and, where there is one, of an experiment. Raises InputError E-KIND, E-LAB."""
    import jinja2

    numbers = pack(model, experiment)
    environment = jinja2.Environment(loader=jinja2.FunctionLoader(asset), autoescape=True)
    # The licence travels with the code.
    plots = f"/*\n{vendored('uPlot.LICENSE')}*/\n{vendored('uPlot.iife.min.js')}"
    title = "The rocking block" if experiment is None else f"The rocking block: {experiment.name}"
    return environment.get_template("index.html.j2").render(
        title=title,
        version=numbers["version"],
        style=vendored("uPlot.min.css") + asset("style.css"),
        pack=as_json(numbers),
        worker="\n".join(map(asset, WORKER)),
        script="\n".join([plots, *map(asset, SCRIPT)]),
    )


def write_page(path: str | os.PathLike[str], model: Model, experiment: Experiment | None = None) -> Path:
    """Write the page, whole or not at all, and return its path.

    Raises InputError: those of `html`; E-WRITE; E-PAGE-SIZE above 2 MB, before anything is written.
    """
    data = html(model, experiment).encode()
    if len(data) > MAX_BYTES:
        what = f"the page would have {len(data) / 1e6:.1f} MB, more than {MAX_BYTES / 1e6:g}"
        raise InputError("E-PAGE-SIZE", str(path), what, "Show an experiment of fewer or shorter runs.")
    write_bytes(path, data)
    return Path(path)
