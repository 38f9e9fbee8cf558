"""How the functions of this folder are compiled, said once.

No fastmath: the bits are those of the law. Division as in NumPy, so that lost numbers run on as NaN. Nothing is
allocated inside, so arrays need no reference counts (`_nrt`): counting them in the loop halves the speed.
"""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any

import numba
from numba.core import event

from rockref.engines.on_disk import on_disk
from rockref.engines.watchers import compile_watchers

_options: dict[str, Any] = {"error_model": "numpy", "_nrt": False}

#: A function whose machine code is put in place of its call. Where each variant has its own, it is `marked` first.
inlined = numba.njit(forceinline=True, **_options)
#: A function that compiled code calls; marked in the same way.
called = numba.njit(**_options)


def marked(function: Any, *marks: Any) -> Any:
    """Return the function with these marks in its name, and so in the symbols of its machine code.

    Loops that were compiled in different processes and kept on disk may come together in one. Symbols of one name are
    then one function, the first that came (seen: the first force evaluation of another variant, with forces off by
    tens of newtons, without a word): https://github.com/numba/numba/issues/10486 tells of the same.
    """
    function.__qualname__ = "_".join([function.__qualname__, *map(str, marks)])
    return function


def entered(function: Callable, **variant: Any) -> Any:
    """Compile a function that Python calls: without its lock, and kept on disk.

    `variant` holds the compiled functions that this variant of the text calls, by the names by which it calls them.
    They may not stand in its closure: numba would make them part of the key of the file on disk, with a name that is
    another in every process, and the file would never be found again.

    The closure must hold the fingerprint of the sources and the number of the variant. They become part of the
    function's name, and so of the file's: two variants of one text would share an index on disk, and two processes
    that compile at the same time would each give the other one's code its own variant's name (seen: the law ran in
    place of the effects, without a word).
    """
    text: Any = FunctionType(function.__code__, {**function.__globals__, **variant}, closure=function.__closure__)
    held = [cell.cell_contents for cell in function.__closure__ or ()]
    return on_disk(nogil=True, **_options)(marked(text, *held))


class _Told(event.Listener):
    """Tells those who watch that machine code is being made; nothing where it is loaded from disk."""

    def on_start(self, event: Any) -> None:
        for tell in tuple(compile_watchers):
            tell()

    def on_end(self, event: Any) -> None:
        pass


event.register("numba:compile", _Told())
