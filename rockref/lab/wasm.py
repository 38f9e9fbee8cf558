"""The law in WebAssembly, run from Python by wasmtime: for the judge, and for tests of what the page computes."""

from __future__ import annotations

from importlib import resources
from typing import Any

import numpy as np

from rockref.model.errors import InputError

BINARY = "law.wasm"


def binary() -> bytes:
    """Return the bytes of the compiled law that is shipped."""
    return (resources.files("rockref.lab") / BINARY).read_bytes()


class Module:
    """The compiled law in a machine of its own. Arrays are copied in and out of its memory.

    Raises InputError E-WASM where wasmtime is not installed.
    """

    def __init__(self, data: bytes | None = None):
        try:
            import wasmtime
        except ImportError as error:
            cure = "pip install wasmtime."
            raise InputError("E-WASM", "wasmtime", "is not installed, and runs WebAssembly", cure) from error
        self._store = wasmtime.Store()
        module = wasmtime.Module(self._store.engine, binary() if data is None else data)
        self._exports: Any = wasmtime.Instance(self._store, module, []).exports(self._store)
        self._memory: Any = self._exports["memory"]

    def call(self, name: str, *arguments: Any) -> Any:
        """Call an export by name; numbers are passed on, arrays are copied in and, changed in place, copied back.

        Arrays are float64 or int32 and contiguous; None is no array.
        """
        given, held = [], []
        for argument in arguments:
            if argument is None:
                given.append(0)
            elif isinstance(argument, np.ndarray):
                place = self._exports["take"](self._store, max(argument.nbytes, 8))
                self._memory.write(self._store, argument.tobytes(), place)
                held.append((argument, place))
                given.append(place)
            else:
                given.append(argument)
        result = self._exports[name](self._store, *given)
        for argument, place in held:
            raw = self._memory.read(self._store, place, place + argument.nbytes)
            if argument.flags.writeable:
                argument[...] = np.frombuffer(raw, argument.dtype).reshape(argument.shape)
            self._exports["give_back"](self._store, place)
        return result
