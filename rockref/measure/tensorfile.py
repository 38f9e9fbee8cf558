"""Tensors out of ``.pt`` files without PyTorch, and without running anything that a file says.

Both forms of the file are read: the zip archive (torch 1.6 and later) and the older run of pickles. The unpickler knows
the few names of which a tensor is made and refuses all others. Source: PyTorch, torch/serialization.py (BSD 3-Clause).
"""

from __future__ import annotations

import io
import pickle
import struct
import zipfile
from collections import OrderedDict
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from rockref.model.errors import InputError

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


def rebuild(storage: Any, offset: Any, shape: Any, strides: Any, *rest: Any) -> Strided:
    """Stands for torch._utils._rebuild_tensor_v2."""
    if not isinstance(storage, Storage):
        raise pickle.UnpicklingError("a tensor without storage")
    return Strided(storage, int(offset), tuple(map(int, shape)), tuple(map(int, strides)))


class Careful(pickle.Unpickler):
    """An unpickler that knows tensors and nothing else."""

    def find_class(self, module: str, name: str) -> Any:
        """The stand-in of an allowed name; all others are refused."""
        if (module, name) in (("torch._utils", "_rebuild_tensor_v2"), ("torch._utils", "_rebuild_tensor")):
            return rebuild
        if (module, name) == ("collections", "OrderedDict"):
            return OrderedDict
        if module in ("torch", "torch.storage") and name in STORAGES:
            return name
        raise pickle.UnpicklingError(f"{module}.{name} is not part of a tensor")

    def persistent_load(self, pid: Any) -> Storage:
        """Where the numbers of a storage stand."""
        if not isinstance(pid, tuple) or len(pid) < 5 or pid[0] != "storage" or pid[1] not in STORAGES:
            raise pickle.UnpicklingError("an unknown kind of storage")
        return Storage(str(pid[2]), STORAGES[pid[1]])


def read_tensor(path: Path) -> np.ndarray:
    """The tensor in a ``.pt`` file, float64.

    Raises
    ------
    InputError
        E-FILE, where it is not such a file, holds more than a tensor, or anything that would have to be run.
    """
    try:
        raw = path.read_bytes()
        if len(raw) > LARGEST:
            raise ValueError("it is too large for a toss")
        tensor, numbers = _from_archive(raw) if zipfile.is_zipfile(io.BytesIO(raw)) else _from_pickles(raw)
        return _array(tensor, numbers[tensor.storage.key])
    except InputError:
        raise
    except Exception as e:  # noqa: BLE001 - a broken pickle may raise anything
        raise InputError(
            "E-FILE", str(path), f"is no tensor that can be read ({str(e)[:100]})", "Give the .pt files of the clone."
        ) from e


def _from_archive(raw: bytes) -> tuple[Strided, dict[str, bytes]]:
    with zipfile.ZipFile(io.BytesIO(raw)) as archive:
        names = {name.split("/", 1)[-1]: name for name in archive.namelist()}
        if sum(info.file_size for info in archive.infolist()) > LARGEST:
            raise ValueError("it is too large for a toss")
        tensor = _only(Careful(io.BytesIO(archive.read(names["data.pkl"]))).load())
        key = tensor.storage.key
        return tensor, {key: archive.read(names[f"data/{key}"])}


def _from_pickles(raw: bytes) -> tuple[Strided, dict[str, bytes]]:
    stream = io.BytesIO(raw)
    if Careful(stream).load() != MAGIC:
        raise ValueError("it does not begin as a tensor file")
    Careful(stream).load()  # version of the protocol
    Careful(stream).load()  # byte order and sizes of the machine
    tensor = _only(Careful(stream).load())
    keys = Careful(stream).load()
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
    if min(tensor.shape, default=1) < 1 or min(tensor.strides, default=0) < 0 or not 0 <= last < len(flat):
        raise ValueError("its shape reaches out of its numbers")
    size = flat.dtype.itemsize
    view = np.lib.stride_tricks.as_strided(
        flat[tensor.offset :], tensor.shape, tuple(size * s for s in tensor.strides), writeable=False
    )
    return np.array(view, np.float64)
