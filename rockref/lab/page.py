"""One file with everything in it: the page, its programs, the law in WebAssembly, and the pack of numbers."""

from __future__ import annotations

import os
from importlib import resources
from pathlib import Path

from rockref.api import Model
from rockref.lab.pack import pack
from rockref.measure.records.release import Experiment
from rockref.model.errors import InputError
from rockref.model.storage import write_bytes
from rockref.report.html import inline
from rockref.report.html.inline import MAX_BYTES

#: Programs of the worker and of the page, in the order in which they are read.
WORKER = ("engine.js", "fit.js", "rank.js", "hidden.js", "worker.js")
SCRIPT = (
    "record.js", "state.js", "problem.js", "scene.js", "errors.js", "panel.js", "curves.js", "link.js", "search.js",
    "own.js", "wire.js", "main.js",
)  # fmt: skip


def asset(name: str) -> str:
    """Return the text of a file of the page."""
    return (resources.files("rockref.lab") / "page" / name).read_text(encoding="utf-8")


def html(model: Model, experiment: Experiment | None = None) -> str:
    """Return the page of a model and, where there is one, of an experiment. Raises InputError E-KIND, E-LAB."""
    import jinja2

    numbers = pack(model, experiment)
    environment = jinja2.Environment(loader=jinja2.FunctionLoader(asset), autoescape=True)
    title = "The rocking block" if experiment is None else f"The rocking block: {experiment.name}"
    return environment.get_template("index.html.j2").render(
        title=title,
        version=numbers["version"],
        style=inline.vendored("uPlot.min.css") + asset("style.css"),
        pack=inline.as_json(numbers),
        worker="\n".join(map(asset, WORKER)),
        script="\n".join([inline.plots(), inline.asset("block.js"), *map(asset, SCRIPT)]),
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
