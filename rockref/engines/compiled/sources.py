"""One number for the text of the compiled step.

numba keeps compiled code on disk and looks only at the file of each function for changes; a function that holds this
number is compiled anew when any file of this folder changes whose text is compiled.
"""

from __future__ import annotations

import hashlib
from pathlib import Path

#: Files of this folder of which nothing is compiled.
PYTHON_ONLY = frozenset(("ahead.py", "batch.py", "engine.py", "pack.py"))


def fingerprint() -> int:
    """Return 63 bits of the SHA-256 of this folder's Python files, but for those of PYTHON_ONLY."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        if path.name not in PYTHON_ONLY:
            digest.update(path.name.encode() + path.read_bytes())
    return int.from_bytes(digest.digest()[:8], "big") >> 1


FINGERPRINT = fingerprint()
