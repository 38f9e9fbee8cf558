"""The tutorial backend in C, compiled for the making of bars: in longdouble, in float, and with random rounding; as it
is, for the tests.

It is another text of the law, in another language; the values that it gives in longdouble are held to `exact`.
"""

from __future__ import annotations

import subprocess
import tempfile
from functools import lru_cache
from pathlib import Path
from typing import Any

from golden.generator.bounds import ways
from rockref.conformance.backends.executable import Executable

SOURCE = Path(__file__).resolve().parents[3] / "examples/backend_c/backend.c"
ROUNDING = Path(__file__).with_name("rounding.c")
#: Never contracted to fused multiply-adds, so that the bytes do not depend on the processor.
COMMON = ["gcc", "-O2", "-std=gnu11", "-ffp-contract=off"]
BUILDS: dict[str, list[str]] = {
    "double": [str(SOURCE)],
    "long": ["-DREAL=long double", str(SOURCE)],
    "single": ["-DREAL=float", str(SOURCE)],
    "rounding": ["-frounding-math", "-finstrument-functions", str(SOURCE), str(ROUNDING)],
}


@lru_cache
def folder() -> tempfile.TemporaryDirectory[str]:
    """Return where the programs are built; gone when Python ends."""
    return tempfile.TemporaryDirectory(prefix="rockref-")


@lru_cache
def built(name: str) -> Path:
    """Return one of `BUILDS`, or one of `ways.WAYS` or `ways.SCHEMES` in double precision, compiled."""
    path = Path(folder().name) / name
    subprocess.run([*COMMON, *(BUILDS[name] if name in BUILDS else [str(written(name))]), "-o", str(path), "-lm"],
                   check=True)  # fmt: skip
    return path


def written(name: str) -> Path:
    """Return the source of another way to write the law, or of another integrator."""
    text = SOURCE.read_text()
    path = Path(folder().name) / f"{name}.c"
    path.write_text(ways.changed(text, ways.WAYS[name]) if name in ways.WAYS else ways.with_scheme(text, name))
    return path


def program(name: str, seed: int = 0) -> Executable:
    """Return a running program; the seed is for "rounding"."""
    return Executable(["env", f"SEED={seed}", str(built(name))], long=7200.0)


def answer(name: str, problems: list[Any], seed: int = 0) -> list[dict[str, Any]]:
    """Return the runs of a program."""
    running = program(name, seed)
    try:
        return [running.simulate(p) for p in problems]
    finally:
        running.close()
