"""One number for the text of the compiled step.

numba keeps compiled code on disk and looks only at the file of each function for changes; a function that holds this
number is compiled anew when any file of this folder changes.
"""

from __future__ import annotations

import hashlib
from pathlib import Path


def fingerprint() -> int:
    """63 bits of the SHA-256 of this folder's Python files."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.name.encode() + path.read_bytes())
    return int.from_bytes(digest.digest()[:8], "big") >> 1


FINGERPRINT = fingerprint()
