"""An ensemble in a folder: what it is, the blocks of runs that are done, and the table of all runs.

`ensemble.json` says what was run, with digests; `parts/` has a file a block, written when the block is done, from which
an interrupted ensemble goes on; `runs.csv` is the table, and `runs.parquet` too where pyarrow is installed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import json
import tempfile
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rockref.model.errors import InputError
from rockref.model.storage import read_bytes, write_bytes, write_text
from rockref.shake.ensemble import BLOCK, Ensemble

SCHEMA = "rockref-ensemble/2"
#: No part, and no description, is larger [bytes]. Decided: a row has less than a kilobyte.
LARGEST = 64 * 2**20


def description(ensemble: Ensemble) -> dict[str, Any]:
    """Return what an ensemble is, for `ensemble.json`: what decides the bits of a run, and nothing else."""
    with tempfile.TemporaryDirectory() as folder:
        ensemble.model.save(Path(folder) / "model.toml")
        model = (Path(folder) / "model.toml").read_bytes()
    motions = [
        {"name": m.name, "t_0_s": m.t_0, "dt_s": m.dt, "samples": len(m.a), "sha256": _digest(m.a.tobytes())}
        for m in ensemble.motions
    ]
    return {
        "schema": SCHEMA, "model_sha256": _digest(model), "motions": motions, "factors": list(ensemble.factors),
        "draws": asdict(ensemble.draws), "steps_s": ensemble.steps, "after_s": ensemble.after, "seed": ensemble.seed,
        "runs_a_part": BLOCK,
    }  # fmt: skip


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


class EnsembleFolder:
    """The folder of one ensemble; another ensemble's is refused (E-ENSEMBLE), before anything is written."""

    def __init__(self, path: Path, ensemble: Ensemble) -> None:
        """Open or make the folder. Raises InputError E-ENSEMBLE, E-WRITE."""
        self.path, self.parts = path, path / "parts"
        wanted = json.dumps(description(ensemble), indent=1) + "\n"
        there = path / "ensemble.json"
        if there.exists() and read_bytes(there, LARGEST).decode(errors="replace") != wanted:
            cure = "Name another folder, or give model, records, factors, draws, step and seed as they were."
            raise InputError("E-ENSEMBLE", str(path), "holds another ensemble", cure)
        try:
            self.parts.mkdir(parents=True, exist_ok=True)
        except OSError as e:
            raise InputError("E-WRITE", str(path), f"cannot be made ({e.strerror})", "Name another folder.") from e
        write_text(there, wanted)

    def part(self, block: int) -> Path:
        """Return the file of a block of runs."""
        return self.parts / f"{block:06d}.json"

    def keep(self, block: int, rows: list[dict[str, Any]]) -> None:
        """Write the rows of a block that is done; NaN, which JSON has no word for, as null."""
        plain = [{k: None if v != v else v for k, v in row.items()} for row in rows]
        write_text(self.part(block), json.dumps(plain) + "\n")

    def known(self, block: int, size: int) -> list[dict[str, Any]] | None:
        """Return the rows of a block that an earlier call has done; None where it has not, or for fewer runs."""
        if not self.part(block).exists():
            return None
        try:
            rows = json.loads(read_bytes(self.part(block), LARGEST))
            rows = [{k: float("nan") if v is None else v for k, v in row.items()} for row in rows]
        except (ValueError, AttributeError, TypeError):
            cure = "Delete the file: its runs are made again."
            raise InputError("E-ENSEMBLE", str(self.part(block)), "is no part of an ensemble", cure) from None
        return rows[:size] if len(rows) >= size else None

    def write_table(self, rows: list[dict[str, Any]]) -> list[Path]:
        """Write the table of all runs, each number with all its digits, and return the files."""
        import pandas

        table = pandas.DataFrame(rows)
        files = [self.path / "runs.csv"]
        write_bytes(files[0], table.to_csv(index=False).encode())
        if importlib.util.find_spec("pyarrow") is not None:
            files.append(self.path / "runs.parquet")
            write_bytes(files[1], table.to_parquet(index=False))
        return files
