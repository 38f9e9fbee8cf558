"""Compiled functions that are kept on disk, where a folder for that can be written, and in memory alone elsewhere."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

#: Why compiled code is not kept on disk; said once by who talks to the user. Empty where it is kept.
not_kept: list[str] = []

REMARK = (
    "compiled code cannot be kept on disk here, and is made anew every time. "
    "Set NUMBA_CACHE_DIR to a folder that can be written. [W-CACHE]"
)


def on_disk(**options: Any) -> Callable[[Callable], Any]:
    """Return the decorator that compiles a function with numba's `options` and keeps it on disk if it can."""

    def compile_kept(function: Callable) -> Any:
        import numba

        try:
            return numba.njit(cache=True, **options)(function)
        except RuntimeError as error:
            # Neither the package's folder nor the user's cache can be written: numba has no locator for either.
            if "no locator" not in str(error):
                raise
        not_kept.append(REMARK)
        return numba.njit(**options)(function)

    return compile_kept
