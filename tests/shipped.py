"""What tests look at of what ships: the control experiment, and programs that are no part of the package."""

from __future__ import annotations

import gzip
import importlib.util
import math
import re
from collections.abc import Sequence
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
    return shortened(folder, CONTROL, ("01", "03"))


def shortened(folder: Path, experiment: Path, ids: Sequence[str], seconds: float = math.inf) -> Path:
    """A folder with some runs of a shipped experiment, up to an instant [s]."""
    folder.mkdir(exist_ok=True)
    head, *runs = (experiment / "experiment.toml").read_text(encoding="utf-8").split("[[run]]")
    kept = [r for r in runs if re.search(rf'id = "({"|".join(ids)})"', r)]
    (folder / "experiment.toml").write_text("[[run]]".join([head, *kept]), encoding="utf-8")
    for id in ids:
        header, *rows = gzip.decompress((experiment / f"run{id}.csv.gz").read_bytes()).decode().splitlines()
        rows = [row for row in rows if float(row.partition(",")[0]) < seconds]
        (folder / f"run{id}.csv.gz").write_bytes(gzip.compress("\n".join([header, *rows, ""]).encode(), mtime=0))
    return folder
