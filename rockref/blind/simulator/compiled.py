"""Compile the simulator of the blind test where numba is installed; run it as plain Python where it is not."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

#: Whether the simulator is compiled. Where it is not it is as right, and some thousand times slower.
COMPILED = find_spec("numba") is not None


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return `function` compiled without fastmath, for calls by compiled code; unchanged where numba is missing."""
    return _compile(function, cache=False)


def kept(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile, and keep on disk. What it calls in other files is not watched: close it over their `fingerprint`."""
    return _compile(function, cache=True)


def fingerprint(*names: str) -> int:
    """Return a number that changes with the text of any of these modules of this folder."""
    here = Path(__file__).parent
    return int.from_bytes(hashlib.sha256(b"".join((here / f"{n}.py").read_bytes() for n in names)).digest()[:7], "big")


def _compile(function: Callable[..., Any], cache: bool) -> Callable[..., Any]:
    if not COMPILED:
        return function
    import numba

    options: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
    try:
        return numba.njit(cache=cache, **options)(function)
    except RuntimeError as error:
        # No folder for compiled code can be written: it is made anew every time.
        if "no locator" not in str(error):
            raise
        return numba.njit(**options)(function)
