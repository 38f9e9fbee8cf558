"""What tests look at of what ships: the control experiment, and programs that are no part of the package."""

from __future__ import annotations

import importlib.util
import re
import shutil
from pathlib import Path
from types import ModuleType

ROOT = Path(__file__).resolve().parents[1]
CONTROL = ROOT / "data/experiments/mystery-08"


def program(path: str) -> ModuleType:
    """A program of docs/ or examples/ as a module, from its path in the project."""
    spec = importlib.util.spec_from_file_location(Path(path).stem, ROOT / path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def two_runs(folder: Path) -> Path:
    """A folder with a fit run and a holdout run of the control experiment, so that work on it is quick."""
    folder.mkdir(exist_ok=True)
    head, *runs = (CONTROL / "experiment.toml").read_text(encoding="utf-8").split("[[run]]")
    kept = [r for r in runs if re.search(r'id = "0[13]"', r)]
    (folder / "experiment.toml").write_text("[[run]]".join([head, *kept]), encoding="utf-8")
    for k in ("01", "03"):
        shutil.copy(CONTROL / f"run{k}.csv.gz", folder)
    return folder
