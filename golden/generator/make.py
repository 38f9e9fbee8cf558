"""Making all vectors: `make golden` runs it and says what differs from what is there."""

from __future__ import annotations

import hashlib
import json
import platform
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from golden.generator import base_motion, effects, fingerprints, small_layers, trajectories
from rockref.conformance.faults.mistakes import MISTAKES
from rockref.conformance.vectors import SCHEMA
from rockref.model.storage import write_bytes

FOLDER = Path(__file__).resolve().parents[2] / "rockref/conformance/vectors/v1"


def sha256(data: bytes) -> str:
    """Return digest of a file's bytes."""
    return hashlib.sha256(data).hexdigest()


def put(name: str, data: bytes) -> None:
    """Write a file of the vectors, whole or not at all."""
    path = FOLDER / name
    path.parent.mkdir(parents=True, exist_ok=True)
    write_bytes(path, data)


def resolving_power(documents: dict[str, Any]) -> dict[str, Any]:
    """Return by rule: vectors, mistakes hunted, and the smallest deviation [bars] that a hunted mistake makes."""
    table: dict[str, dict[str, Any]] = {}
    for document in documents.values():
        for entry in document["vectors"]:
            row = table.setdefault(entry["rule"], {"vectors": 0, "hunts": set(), "worst_bars": small_hunt(entry)})
            row["vectors"] += 1
            row["hunts"] |= set(entry["hunts"])
            row["worst_bars"] = min(row["worst_bars"], small_hunt(entry))
    return {rule: row | {"hunts": sorted(row["hunts"])} for rule, row in sorted(table.items())}


def small_hunt(entry: dict[str, Any]) -> float:
    """Return the smallest deviation of an entry's mistakes."""
    return min(entry["resolving"].values())


def environment() -> dict[str, str]:
    """Return what the vectors were made with."""
    bits = np.finfo(np.longdouble).nmant + 1
    packages = {name: version(name) for name in ("rockref", "numpy", "mpmath")}
    return {
        "python": platform.python_version(),
        **packages,
        "machine": platform.machine(),
        "longdouble_bits": str(bits),
    }


def manifest(documents: dict[str, Any], runs: list[str], windows: list[str]) -> dict[str, Any]:
    """Return schema, versions, counts, resolving power, digests of all other files."""
    files = sorted(p for p in FOLDER.rglob("*") if p.is_file() and p.name != "MANIFEST.json")
    names = [p.relative_to(FOLDER).as_posix() for p in files]
    return {
        "schema": SCHEMA,
        "version": "v1",
        "made_with": environment(),
        "counts": {layer: len(document["vectors"]) for layer, document in documents.items()},
        "trajectories": runs,
        "windows": windows,
        "mistakes": {m.id: {"rule": m.rule, "says": m.says} for m in MISTAKES},
        "resolving_power": resolving_power(documents),
        "files": {
            n: {"sha256": sha256(p.read_bytes()), "bytes": p.stat().st_size} for n, p in zip(names, files, strict=True)
        },
    }


def differing(before: dict[str, str]) -> list[str]:
    """Return files whose bytes are not those of before, by digest."""
    after = digests()
    return sorted(name for name in before.keys() | after.keys() if before.get(name) != after.get(name))


def digests() -> dict[str, str]:
    """Return digest of every file of the vectors."""
    return {p.relative_to(FOLDER).as_posix(): sha256(p.read_bytes()) for p in FOLDER.rglob("*") if p.is_file()}


def make(parts: tuple[str, ...] = ("small", "effects", "base", "runs", "fingerprints")) -> list[str]:
    """Make the vectors anew; returns the names of the files that differ from what was there."""
    before = digests()
    if "small" in parts:
        for layer in small_layers.LAYERS:
            refused: list[str] = []
            document = small_layers.document(layer, refused)
            put(f"{layer}.json", small_layers.written(document))
            say(f"{layer}: {len(document['vectors'])} vectors; not admitted: {len(refused)}")
            for line in refused:
                say(f"  {line}")
    if "effects" in parts:
        put("LE.json", effects.document(say))
    if "base" in parts:
        put("LB.json", small_layers.written(base_motion.document()))
    runs, windows = trajectories.names()
    if "runs" in parts:
        for name, data in trajectories.files(say):
            put(name, data)
    documents = {layer: json.loads((FOLDER / f"{layer}.json").read_bytes()) for layer in small_layers.LAYERS}
    put("MANIFEST.json", small_layers.written(manifest(documents, runs, windows)))
    if "fingerprints" in parts:
        put("fingerprints.csv.gz", fingerprints.file())
        put("MANIFEST.json", small_layers.written(manifest(documents, runs, windows)))
    return differing(before)


def say(line: str) -> None:
    """Print a line of progress."""
    print(line, file=sys.stderr, flush=True)
