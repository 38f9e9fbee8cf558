"""How the functions of this folder are compiled, said once.

No fastmath: the bits are those of the law. Division as in NumPy, so that lost numbers run on as NaN. Nothing is
allocated inside, so arrays need no reference counts (`_nrt`): counting them in the loop halves the speed.
"""

from __future__ import annotations

from typing import Any

import numba

_options: dict[str, Any] = {"error_model": "numpy", "_nrt": False}

#: A function whose text is put in place of its call.
inlined = numba.njit(inline="always", error_model="numpy")
#: A function that compiled code calls.
called = numba.njit(**_options)
#: A function that Python calls: without its lock, and kept on disk. It must hold the fingerprint of the sources in a
#: closure and no other compiled function, or the file on disk is never found again.
entered = numba.njit(nogil=True, cache=True, **_options)
