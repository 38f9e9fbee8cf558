"""Sealed truths: written so that no one reads them by accident, with a digest that shows if they were changed."""

from __future__ import annotations

import base64
import hashlib
import json
import secrets
import zlib
from pathlib import Path
from typing import Any

from rockref.model.storage import write_text

SEALED, MANIFEST, OPENED = "truth.sealed.json", "MANIFEST.json", "truth.json"


def write_json(path: Path, content: Any) -> None:
    """Write JSON whole or not at all. Raises InputError (E-WRITE)."""
    write_text(path, json.dumps(content, indent=1) + "\n")


def read_json(path: Path) -> Any:
    """Return the content of a JSON file."""
    return json.loads(path.read_text(encoding="utf-8"))


def canonical(content: Any) -> bytes:
    """Return the one text of a truth that is digested."""
    return json.dumps(content, sort_keys=True, separators=(",", ":")).encode()


def digest(salt: str, text: bytes) -> str:
    """Return SHA-256 over salt and text: without the salt a truth cannot be found by trying seeds."""
    return hashlib.sha256(salt.encode() + b"\n" + text).hexdigest()


def seal(folder: Path, truth: Any, cases: dict[str, dict[str, str]], version: str) -> str:
    """Write truth.sealed.json and MANIFEST.json (digest of the truth, digests of every file a case shows)."""
    salt, text = secrets.token_hex(16), canonical(truth)
    found = digest(salt, text)
    packed = base64.b64encode(zlib.compress(text, 9)).decode()
    write_json(folder / SEALED, {"salt": salt, "encoding": "base64 of zlib of JSON", "truth": packed})
    write_json(folder / MANIFEST, {"truth_sha256": found, "rockref": version, "cases": cases})
    return found


def unseal(folder: Path) -> tuple[Any, bool]:
    """Return the truth of a sealed folder, and whether it is the one whose digest was published."""
    sealed = read_json(folder / SEALED)
    text = zlib.decompress(base64.b64decode(sealed["truth"]))
    published = read_json(folder / MANIFEST)["truth_sha256"]
    return json.loads(text), digest(sealed["salt"], text) == published


def digests(folder: Path) -> dict[str, str]:
    """Return SHA-256 of experiment.toml and the tables of a case."""
    names = ["experiment.toml", *sorted(path.name for path in folder.glob("run*.csv.gz"))]
    return {name: hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names}
