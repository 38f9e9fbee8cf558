"""Ways in: an engine by its name, or a file with one function `run`."""

from __future__ import annotations

import importlib
import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING
from rockref.conformance.backends.load import from_file
from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start
from rockref.model.errors import InputError

#: Adapters of the package: the name on the command line, and the module in `adapters`.
KNOWN = {
    "rockref": "rockref_law",
    "rockref4": "rockref_four",
    "mujoco": "mujoco_engine",
    "pybullet": "pybullet_engine",
    "drake": "drake_engine",
    "dart": "dart_engine",
    "rapier": "rapier_engine",
    "physx": "physx_engine",
    "lammps": "lammps_engine",
}
SHAPES = {"x": (3,), "R": (3, 3), "v": (3,), "omega": (3,)}


class Lost(Exception):
    """The engine returned numbers that are not finite, or raised an error."""


class Adapter:
    """A module with `run(scene, start, times, gravity)`, and what it says about itself.

    Optional names in the module: NAME, SETTINGS {"default": {...}, "careful": {...}}, KNOBS {cause: words},
    PASSPORT {name: settings}, REQUIRES (a module to import), INSTALL (how), facts() -> version, precision, integrator.
    """

    def __init__(self, module: ModuleType, target: str):
        self.target = target
        self.run = module.run
        self.name: str = getattr(module, "NAME", target)
        self.settings: dict[str, dict[str, Any]] = getattr(module, "SETTINGS", {"default": {}})
        self.knobs: dict[str, str] = getattr(module, "KNOBS", {})
        self.passport: dict[str, dict[str, Any]] = getattr(module, "PASSPORT", {})
        self._module = module

    def absence(self) -> str | None:
        """Return why the engine cannot run here, in words; None where it can."""
        wanted = getattr(self._module, "REQUIRES", None)
        if wanted is None:
            return None
        try:
            importlib.import_module(wanted)
        except ANYTHING as error:
            found = importlib.util.find_spec(wanted.partition(".")[0]) is not None
            why = f"cannot be imported ({type(error).__name__}: {error})" if found else "is not installed"
            return f"{wanted} {why}; {getattr(self._module, 'INSTALL', 'install it')}"
        return None

    def facts(self) -> dict[str, str]:
        """Return what the adapter says about its engine; precision is "float64" unless it says otherwise."""
        return {"precision": "float64", **getattr(self._module, "facts", dict)()}


class Engine:
    """An adapter with one of its settings: what the checks run.

    The setting "step" [s] is the engine's step; 1 ms where the settings name none.
    """

    def __init__(self, adapter: Adapter, setting: str, knobs: dict[str, Any] | None = None):
        self.adapter, self.setting = adapter, setting
        self.knobs = adapter.settings[setting] if knobs is None else knobs
        self.step = float(self.knobs.get("step", 1e-3))
        self.double = adapter.facts()["precision"] != "float32"

    def run(self, scene: Scene, start: Start, times: np.ndarray, gravity: Gravity, finer: int = 1) -> Motion:
        """Return the motion of a scene, with the step divided by `finer`.

        Raises
        ------
        Lost
            the engine raised an error, or its numbers are not finite.
        InputError
            E-SHAPE, the adapter does not return four arrays, a row an instant.
        """
        times = np.asarray(times, float)
        scene = scene.replace(step=self.step / finer, settings=self.knobs)
        try:
            found = self.adapter.run(scene, start, times, gravity)
        except InputError:
            raise
        except ANYTHING as error:
            raise Lost(f"the engine stopped: {type(error).__name__}: {error}") from error
        return checked(found, len(times), self.adapter.name)


def checked(found: Any, rows: int, name: str) -> Motion:
    """Return what an adapter gave as a Motion. Raises InputError (E-SHAPE) and Lost."""
    if not isinstance(found, (tuple, list)) or len(found) != 4:
        raise InputError("E-SHAPE", f"{name}: run", "does not return four arrays", "Return x, R, v, omega.")
    arrays = [np.asarray(a, float) for a in found]
    for (key, core), array in zip(SHAPES.items(), arrays, strict=True):
        if array.shape != (rows, *core):
            what = f"has the shape {array.shape} for {rows} instants"
            raise InputError("E-SHAPE", f"{name}: {key}", what, f"Return the shape {(rows, *core)}.")
        if not np.all(np.isfinite(array)):
            row = int(np.argwhere(~np.isfinite(array))[0][0])
            raise Lost(f"{key} is not finite from instant {row + 1} of {rows} on")
    return Motion(*arrays)


def load(target: str) -> Adapter:
    """Return the adapter of an engine: a name of `KNOWN`, or path/to/file.py.

    Raises
    ------
    InputError
        E-BACKEND, where there is none, or the file has no function `run`.
    """
    if target in KNOWN:
        return Adapter(importlib.import_module(f"rockref.conformance.physics.adapters.{KNOWN[target]}"), target)
    if not target.endswith(".py"):
        cure = f"Use one of {', '.join(KNOWN)}, or path/to/file.py with a function run."
        raise InputError("E-BACKEND", target, "is no physics engine that rockref has an adapter for", cure)
    module = from_file(Path(target))
    if not callable(getattr(module, "run", None)):
        raise InputError("E-BACKEND", target, "has no function run", "Write run(scene, start, times, gravity).")
    return Adapter(module, target)
