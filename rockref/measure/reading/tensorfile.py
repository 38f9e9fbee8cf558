"""Tensors out of ``.pt`` files without PyTorch, and without running anything that a file says.

Both forms of the file are read: the zip archive (torch 1.6 and later) and the older run of pickles. Nothing is
unpickled: the few opcodes and names of which a tensor is made are read here, and all others are refused. Source:
PyTorch, torch/serialization.py (BSD 3-Clause).
"""

from __future__ import annotations

import io
import math
import pickletools
import struct
import zipfile
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

import numpy as np

from rockref.model.errors import InputError
from rockref.model.storage import read_bytes

#: First number of the older form.
MAGIC = 0x1950A86A20F9469CFC6C
#: Decided: a recorded toss is some tens of kilobytes.
LARGEST = 64_000_000
STORAGES = {
    "FloatStorage": "<f4", "DoubleStorage": "<f8", "HalfStorage": "<f2", "LongStorage": "<i8", "IntStorage": "<i4",
    "ShortStorage": "<i2", "CharStorage": "<i1", "ByteStorage": "<u1", "BoolStorage": "?",
}  # fmt: skip


class Storage(NamedTuple):
    """Numbers of a tensor that are read later: their key in the file and their type."""

    key: str
    dtype: str


class Strided(NamedTuple):
    """A tensor as the file says it: storage, first number, shape, strides."""

    storage: Storage
    offset: int
    shape: tuple[int, ...]
    strides: tuple[int, ...]


class Name(NamedTuple):
    """A name in a pickle, as it is written there."""

    module: str
    name: str


#: The names of which a tensor is made.
REBUILD = (("torch._utils", "_rebuild_tensor_v2"), ("torch._utils", "_rebuild_tensor"))
ORDERED, STORED_IN = ("collections", "OrderedDict"), ("torch", "torch.storage")
#: Opcodes: with a plain argument, without one, that make a container, and the sizes of tuples.
PLAIN = ("BININT", "BININT1", "BININT2", "LONG1", "BINUNICODE", "BINFLOAT")
MARK = object()
CONSTANTS = {"NONE": None, "NEWTRUE": True, "NEWFALSE": False, "MARK": MARK}
MADE = {"EMPTY_TUPLE": tuple, "EMPTY_LIST": list, "EMPTY_DICT": dict}
SIZES = {"TUPLE1": 1, "TUPLE2": 2, "TUPLE3": 3}
#: Decided: a tensor is written with some fifty.
MOST_OPCODES = 10_000


def read_pickle(stream: BinaryIO) -> Any:
    """Return the plain values and tensors that a pickle writes down, up to its end, read opcode by opcode.

    Nothing is unpickled: names stay names, and of these only a tensor's are known.

    Raises ValueError for any other name or opcode, and for a pickle that is longer than a tensor's.
    """
    stack: list[Any] = []
    memo: dict[Any, Any] = {}
    for count, (opcode, argument, _) in enumerate(pickletools.genops(stream)):
        name = opcode.name
        if count > MOST_OPCODES:
            raise ValueError("it is too long for a tensor")
        if name in PLAIN:
            stack.append(argument)
        elif name in CONSTANTS:
            stack.append(CONSTANTS[name])
        elif name in MADE:
            stack.append(MADE[name]())
        elif name in ("GLOBAL", "BINPERSID", "REDUCE"):
            stack.append(_of_a_tensor(name, argument, stack))
        elif name in ("BINPUT", "LONG_BINPUT"):
            memo[argument] = stack[-1]
        elif name in ("BINGET", "LONG_BINGET"):
            stack.append(memo[argument])
        elif name in SIZES or name == "TUPLE":
            items = _since_mark(stack) if name == "TUPLE" else [stack.pop() for _ in range(SIZES[name])][::-1]
            stack.append(tuple(items))
        elif name in ("APPEND", "APPENDS", "SETITEM", "SETITEMS"):
            _fill(name, stack)
        elif name == "STOP":
            return stack.pop()
        elif name != "PROTO":
            raise ValueError(f"{name} is not part of a tensor")
    raise ValueError("it has no end")


def _of_a_tensor(name: str, argument: Any, stack: list[Any]) -> Any:
    """Return what stands for a name, for the numbers of a storage, and for the call of a name."""
    if name == "GLOBAL":
        module, _, what = argument.partition(" ")
        if (module, what) in REBUILD or (module, what) == ORDERED or (module in STORED_IN and what in STORAGES):
            return Name(module, what)
        raise ValueError(f"{module}.{what} is not part of a tensor")
    given = stack.pop()
    if name == "BINPERSID":
        kind = given[1] if isinstance(given, tuple) and len(given) >= 5 and given[0] == "storage" else None
        if not isinstance(kind, Name) or kind.name not in STORAGES:
            raise ValueError("an unknown kind of storage")
        return Storage(str(given[2]), STORAGES[kind.name])
    called = stack.pop()
    if called == ORDERED and not given:
        return {}
    if called in REBUILD and len(given) >= 4 and isinstance(given[0], Storage):
        storage, offset, shape, strides = given[:4]
        return Strided(storage, int(offset), tuple(map(int, shape)), tuple(map(int, strides)))
    raise ValueError("a call that makes no tensor")


def _since_mark(stack: list[Any]) -> list[Any]:
    """Take the values above the last mark, and the mark, from the stack."""
    place = max(i for i, thing in enumerate(stack) if thing is MARK)
    items = stack[place + 1 :]
    del stack[place:]
    return items


def _fill(name: str, stack: list[Any]) -> None:
    """Put values of the stack into the list or the dictionary below them."""
    size = {"APPEND": 1, "SETITEM": 2}.get(name)
    items = _since_mark(stack) if size is None else [stack.pop() for _ in range(size)][::-1]
    if name.startswith("APPEND") and isinstance(stack[-1], list):
        stack[-1].extend(items)
    elif name.startswith("SET") and isinstance(stack[-1], dict):
        stack[-1].update(zip(items[::2], items[1::2], strict=True))
    else:
        raise ValueError("a list or a dictionary is missing")


def read_tensor(path: Path) -> np.ndarray:
    """Return the tensor in a ``.pt`` file, float64.

    Raises InputError: E-FILE, where it is not such a file, holds more than a tensor, or anything that would have to be
    run.
    """
    try:
        raw = read_bytes(path, LARGEST)
        tensor, numbers = _from_archive(raw) if zipfile.is_zipfile(io.BytesIO(raw)) else _from_pickles(raw)
        return _array(tensor, numbers[tensor.storage.key])
    except InputError:
        raise
    except Exception as e:  # noqa: BLE001 - a broken archive may raise anything
        raise InputError(
            "E-FILE", str(path), f"is no tensor that can be read ({str(e)[:100]})", "Give the .pt files of the clone."
        ) from e


def _from_archive(raw: bytes) -> tuple[Strided, dict[str, bytes]]:
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        names = {name.split("/", 1)[-1]: name for name in archive.namelist()}
        if sum(info.file_size for info in archive.infolist()) > LARGEST:
            raise ValueError("it is too large for a toss")
        tensor = _only(read_pickle(io.BytesIO(archive.read(names["data.pkl"]))))
        key = tensor.storage.key
        return tensor, {key: archive.read(names[f"data/{key}"])}


def _from_pickles(raw: bytes) -> tuple[Strided, dict[str, bytes]]:
    stream = io.BytesIO(raw)
    if read_pickle(stream) != MAGIC:
        raise ValueError("it does not begin as a tensor file")
    read_pickle(stream)  # version of the protocol
    read_pickle(stream)  # byte order and sizes of the machine
    tensor = _only(read_pickle(stream))
    keys = read_pickle(stream)
    numbers = {}
    for key in keys:
        (count,) = struct.unpack("<q", stream.read(8))
        if str(key) != tensor.storage.key or not 0 <= count <= LARGEST:
            raise ValueError("it holds more than one tensor")
        numbers[str(key)] = stream.read(count * np.dtype(tensor.storage.dtype).itemsize)
    return tensor, numbers


def _only(found: Any) -> Strided:
    if isinstance(found, dict) and len(found) == 1:
        found = next(iter(found.values()))
    if not isinstance(found, Strided):
        raise ValueError("it holds something else than one tensor")
    return found


def _array(tensor: Strided, raw: bytes) -> np.ndarray:
    flat = np.frombuffer(raw, np.dtype(tensor.storage.dtype))
    last = tensor.offset + sum((n - 1) * s for n, s in zip(tensor.shape, tensor.strides, strict=True))
    if math.prod(tensor.shape) > len(flat):  # numbers that stand at many places
        raise ValueError("its shape has more numbers than it holds")
    if min(tensor.shape, default=1) < 1 or min(tensor.strides, default=0) < 0 or not 0 <= last < len(flat):
        raise ValueError("its shape reaches out of its numbers")
    size = flat.dtype.itemsize
    view = np.lib.stride_tricks.as_strided(
        flat[tensor.offset :], tensor.shape, tuple(size * s for s in tensor.strides), writeable=False
    )
    return np.array(view, np.float64)
