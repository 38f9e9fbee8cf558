"""Compile the simulator of the blind test where numba is installed; run it as plain Python where it is not."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

try:
    import numba
except ImportError:  # the simulator is then right, and some thousand times slower
    numba = None

#: Whether the simulator is compiled.
COMPILED = numba is not None


def compiled(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return `function` compiled without fastmath and kept on disk; unchanged where numba is missing."""
    return function if numba is None else numba.njit(cache=True, nogil=True, error_model="numpy")(function)
