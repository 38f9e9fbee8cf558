"""Compute all golden files anew: ``python -m tests.golden.make [table_3_1] [vectors]``, or `make golden` for both.

Table 3.1 takes three minutes, the vectors half an hour. Files are replaced whole; what differs is printed, and is to be
explained before it is committed: golden files are never edited by hand.
"""

from __future__ import annotations

import sys
from collections.abc import Callable

from rockref.conformance.maker import make as vectors
from tests.golden import make_table_3_1
from tests.golden import table_3_1_files as files


def table_3_1() -> list[str]:
    """Make the files of Table 3.1; names of those that differ from what was there."""
    before = {path.name: path.read_bytes() for path in files.FOLDER.glob("*")}
    make_table_3_1.make(files.FOLDER)
    return sorted(path.name for path in files.FOLDER.iterdir() if before.get(path.name) != path.read_bytes())


PARTS: dict[str, Callable[[], list[str]]] = {"table_3_1": table_3_1, "vectors": vectors.make}


def main(wanted: list[str]) -> int:
    """Make the parts that are asked for, all of them where none is."""
    unknown = [name for name in wanted if name not in PARTS]
    if unknown:
        print(f"{unknown[0]} is none of {', '.join(PARTS)}", file=sys.stderr)
        return 2
    for name in wanted or PARTS:
        differing = PARTS[name]()
        print(f"{name}: " + (f"differ: {', '.join(differing)}" if differing else "the same bytes as before"))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
