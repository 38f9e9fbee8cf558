"""What fits and diagnoses of an experiment have found, kept for the commands that follow.

One JSON file an experiment in the user's cache folder. Its name is a digest of the data, of the version and of the
source of the program: what was changed in between is fitted anew.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from rockref import __version__
from rockref.api import Model
from rockref.discover.diagnosis_record import plain
from rockref.discover.fit.fitter import FittedModel
from rockref.discover.fit.problem import FitProblem
from rockref.discover.fit.stages import S1, S2, S3, F, Stage
from rockref.effects import catalogue
from rockref.measure.records.notice import Notice
from rockref.measure.records.release import Experiment
from rockref.model.errors import InputError
from rockref.model.storage import read_bytes, write_text

#: Version of the stored form.
FORMAT = 1
#: Stages by name, from the shortest memory to the longest.
STAGES = {stage.name: stage for stage in (S1, S2, S3, F)}
#: Experiments that are kept, and the largest file that is read [bytes]; decided: some 20 MB in all, and a file holds
#: less than 1 MB.
MOST, LARGEST = 200, 2**24
#: Folders of the program on which a fit depends.
SOURCES = ("model", "effects", "engines", "measure", "discover")


def cache_folder() -> Path:
    """Return the folder of kept fits: ROCKREF_CACHE, or `rockref` in the cache folder of the user's system."""
    if given := os.environ.get("ROCKREF_CACHE"):
        return Path(given)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "rockref"


@cache
def program_digest() -> str:
    """Return a SHA-256 of the version and of the source on which a fit depends."""
    root, h = Path(__file__).parents[1], hashlib.sha256(__version__.encode())
    for folder in SOURCES:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".py", ".toml"):
                h.update(path.relative_to(root).as_posix().encode() + b"\0" + path.read_bytes())
    return h.hexdigest()


@dataclass
class FitStore:
    """Fits by set of effects, the state of a search, and diagnoses of one experiment.

    fresh : what an earlier command has kept is left aside.  on_disk : whether there is a file;  path : of it, if opened
    kept : its content.  remark : why it could not be written, if so
    """

    fresh: bool = False
    on_disk: bool = True
    path: Path | None = None
    kept: dict[str, dict[str, Any]] = field(default_factory=lambda: empty())
    remark: Notice | None = None

    def open(self, experiment: Experiment) -> FitStore:
        """Read what is kept of an experiment, all of whose runs are opened."""
        if not self.on_disk:
            return self
        key = hashlib.sha256(f"{program_digest()} {experiment.digest}".encode()).hexdigest()[:32]
        try:
            self.path = cache_folder() / f"{key}.json"
        except RuntimeError:  # nobody knows the home folder
            return self
        if not self.fresh and self.path.is_file():
            self.kept = read(self.path)
        return self

    def save(self) -> None:
        """Write what is kept, whole or not at all; a folder that cannot be written to makes a remark, no failure."""
        if self.path is None:
            return
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            write_text(self.path, json.dumps(plain({"format": FORMAT, **self.kept})) + "\n")
            prune(self.path.parent)
        except (OSError, InputError) as e:
            reason = e.strerror if isinstance(e, OSError) else e.what
            what = f"what was found cannot be kept ({reason})"
            self.remark = Notice("W-CACHE", str(self.path.parent), what, "Set ROCKREF_CACHE to a folder of yours.")

    def note(self, problem: FitProblem) -> Callable[[FittedModel, Stage], None]:
        """Return what keeps refined hypotheses of a problem: of each set of effects the best at the longest memory."""

        def keep(h: FittedModel, stage: Stage) -> None:
            if stage.horizon is not None or stage.inflation != 1.0 or not np.isfinite(h.objective):
                return
            key = fit_key(problem, h.effects)
            known = self.kept["fits"].get(key)
            order = list(STAGES)
            if known is not None:
                there, here = order.index(known["stage"]), order.index(stage.name)
                if there > here or (there == here and known["objective"] <= h.objective):
                    return
            self.kept["fits"][key] = {"stage": stage.name, **written(problem, h)}

        return keep

    def start(self, problem: FitProblem, effects: tuple[str, ...]) -> tuple[FittedModel, Stage] | None:
        """Return the kept fit of a set of effects, and the stage at which it ended; None where there is none."""
        known = self.kept["fits"].get(fit_key(problem, effects))
        if known is None:
            return None
        if known["tone"] is not None:
            problem.tone = known["tone"]
        h = read_fit(problem, known, effects)
        return None if h is None else (h, STAGES[known["stage"]])

    def best(self) -> dict[str, Any] | None:
        """Return the kept fit with the least mean loss at the longest memory; None where nothing is kept."""
        order = list(STAGES)
        fits = self.kept["fits"].values()
        return min(fits, key=lambda f: (-order.index(f["stage"]), f["loss"]), default=None)


def empty() -> dict[str, dict[str, Any]]:
    """Return what a store begins with."""
    return {"fits": {}, "searches": {}, "diagnoses": {}}


def read(path: Path) -> dict[str, dict[str, Any]]:
    """Return the content of a file; what cannot be read counts as nothing kept."""
    try:
        found = json.loads(read_bytes(path, LARGEST))
    except (InputError, ValueError):
        return empty()
    if not isinstance(found, dict) or found.pop("format", None) != FORMAT or found.keys() != empty().keys():
        return empty()
    return found


def prune(folder: Path) -> None:
    """Remove the oldest files beyond those that are kept."""
    files = sorted(folder.glob("*.json"), key=lambda p: p.stat().st_mtime, reverse=True)
    for path in files[MOST:]:
        path.unlink(missing_ok=True)


def written(problem: FitProblem, h: FittedModel) -> dict[str, Any]:
    """Return a fit as plain values: its effects, objective, mean loss, and every number in prior deviations by name."""
    names = [p.name for p in problem.parameters(h.effects)]
    return {
        "effects": list(h.effects),
        "objective": float(h.objective),
        "loss": float(h.loss),
        "tone": problem.tone,
        "z": dict(zip(names, map(float, h.z), strict=True)),
        "start": None if h.start is None else dict(zip(names, map(float, h.start), strict=False)),
    }


def read_fit(
    problem: FitProblem, known: Mapping[str, Any], effects: tuple[str, ...] | None = None
) -> FittedModel | None:
    """Return a fit from plain values, its numbers in the order of `effects`; None where numbers are missing."""
    effects = tuple(known["effects"]) if effects is None else effects
    names = [p.name for p in problem.parameters(effects)]
    if not known["z"].keys() >= set(names):
        return None
    h = FittedModel(effects, np.array([known["z"][name] for name in names]))
    h.objective, h.loss = float(known["objective"]), float(known["loss"])
    if known["start"] is not None and known["start"].keys() >= set(names):
        h.start = np.array([known["start"][name] for name in names])
    return h


def fit_key(problem: FitProblem, effects: tuple[str, ...]) -> str:
    """Return the key of a fit: block and points of the baseline, seconds of each run, and the effects."""
    b = problem.base
    parts: list[object] = [b.mass, b.width, b.depth, b.height, b.g, b.points, b.foot_radius]
    parts += [None if b.inertia is None else b.inertia.tolist()]
    parts += [None if b.properties is None else sorted((k, np.asarray(v).tolist()) for k, v in b.properties.items())]
    parts += [None if b.custom_points is None else repr(vars(b.custom_points))]
    return digest_of([*parts, problem.listener.end, sorted(effects), source_of(effects)])


def source_of(effects: tuple[str, ...]) -> list[str]:
    """Return digests of the files of a user's own effects."""
    found = []
    for id in sorted(effects):
        kind = catalogue.OWN.get(id)
        if kind is not None and kind.file is not None:
            path = Path(kind.file.rpartition(":")[0])
            found.append(hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else kind.file)
    return found


def digest_of(parts: object) -> str:
    """Return a short SHA-256 of plain values."""
    return hashlib.sha256(json.dumps(plain({"": parts}), sort_keys=True, default=repr).encode()).hexdigest()[:24]


def options_key(base: Model, seed: int, end: float, own: Sequence[str]) -> str:
    """Return a digest of all but the data that a diagnosis depends on; own : a user's own effects that are tried."""
    effects = [(e.id, e.values()) for e in base.effects]
    plain_base = base.replace(uncertainty={}, origin={}, effects=())
    ids = (*own, *(e.id for e in base.effects))
    return digest_of([model_text(plain_base), effects, seed, end, *own, *source_of(ids)])


def model_text(model: Model) -> str:
    """Return a model as the text of its file."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.toml"
        model.save(path)
        return path.read_text(encoding="utf-8")


def model_from(text: str) -> Model:
    """Return the model that a text describes."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.toml"
        path.write_text(text, encoding="utf-8")
        return Model.load(path)
