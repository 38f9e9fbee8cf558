"""How the functions of this folder are compiled, said once.

No fastmath: the bits are those of the law. Division as in NumPy, so that lost numbers run on as NaN. Nothing is
allocated inside, so arrays need no reference counts (`_nrt`): counting them in the loop halves the speed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numba

_options: dict[str, Any] = {"error_model": "numpy", "_nrt": False}

#: A function whose text is put in place of its call.
inlined = numba.njit(inline="always", error_model="numpy")
#: A function that compiled code calls.
called = numba.njit(**_options)


def entered(function: Callable) -> Any:
    """Compile a function that Python calls: without its lock, and kept on disk.

    It must hold the fingerprint of the sources in a closure and no other compiled function, or the file on disk is
    never found again. The numbers in its closure become part of its name, and so of the file's: two variants of one
    text would share an index on disk, and two processes that compile at the same time would each give the other one's
    code its own variant's name (seen: the law ran in place of the effects, without a word).
    """
    held = [cell.cell_contents for cell in function.__closure__ or ()]
    variant = "_".join(str(int(value)) for value in held if isinstance(value, int))
    function.__qualname__ = f"{function.__qualname__}_{variant}"
    return numba.njit(nogil=True, cache=True, **_options)(function)
