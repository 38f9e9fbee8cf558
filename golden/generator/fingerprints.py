"""The fingerprints of the zoo: how every mistake shows in short runs and windows, for whoever shows `simulate` only."""

from __future__ import annotations

import gzip

from rockref.conformance.faults.mistakes import MISTAKES
from rockref.conformance.judge.causes.fingerprints import code, fingerprint


def file() -> bytes:
    """Return gzipped CSV: a row per mistake, id and numbers."""
    lines = [",".join([m.id, *map(str, code(fingerprint(m.backend())).tolist())]) for m in MISTAKES]
    return gzip.compress(("\n".join(lines) + "\n").encode(), 9, mtime=0)
