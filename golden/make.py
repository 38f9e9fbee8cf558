"""Make all golden files anew and say what differs: ``python -m golden.make`` (``make golden``).

The vectors of the conformance kit and the response of Table 3.1. Nothing differs on a machine with 64-bit mantissas in
longdouble and gcc; elsewhere the files that differ are named, and the exit code is 1. Ten minutes of processor time:
small 100 s, effects 45 s, base 5 s, runs 220 s, fingerprints 100 s, table_3_1 135 s (AMD EPYC; each can be named by
itself, for example ``python -m golden.make effects``).
"""

from __future__ import annotations

import hashlib
import sys
import tempfile
from pathlib import Path

import numpy as np

from golden import make_table_3_1, table_3_1_files
from golden.generator import make as vectors


def digests(folder: Path) -> dict[str, str]:
    """Return the digest of every file of a folder."""
    return {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in sorted(folder.iterdir()) if p.is_file()}


def table_3_1() -> list[str]:
    """Make the files of Table 3.1 beside the golden ones; names of those that differ."""
    with tempfile.TemporaryDirectory() as made:
        make_table_3_1.make(Path(made))
        new, old = digests(Path(made)), digests(table_3_1_files.FOLDER)
        return sorted(name for name in new.keys() | old.keys() if new.get(name) != old.get(name))


#: What can be made by itself.
PARTS = ("small", "effects", "base", "runs", "fingerprints", "table_3_1")
#: What is made in any case, where anything of the vectors is: digests and counts, after a change of the schema by hand.
ALONE = ("manifest",)


def main(parts: tuple[str, ...] = PARTS) -> int:
    """Make what is named, compare, and print what differs."""
    if unknown := [p for p in parts if p not in PARTS + ALONE]:
        print(f"{unknown[0]} is none of {', '.join(PARTS + ALONE)}", file=sys.stderr)
        return 2
    bits = np.finfo(np.longdouble).nmant + 1
    if bits < 64:
        print(f"longdouble has {bits} bits here: expected values of runs cannot be made on this machine")
        return 2
    own = tuple(p for p in parts if p != "table_3_1")
    differing = [f"vectors/v1/{name}" for name in (vectors.make(own) if own else [])]
    if "table_3_1" in parts:
        differing += [f"table_3_1/{name}" for name in table_3_1()]
    print("differs: " + ", ".join(differing) if differing else "every file has the same bytes")
    return 1 if differing else 0


if __name__ == "__main__":
    raise SystemExit(main(tuple(sys.argv[1:]) or PARTS))
