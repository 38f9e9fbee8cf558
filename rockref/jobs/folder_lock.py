"""One process at a time in a folder of checkpoints: two would mix their results, each of them whole."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rockref.model.errors import InputError


@contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Hold a folder that is there for this process, until it is done or dies; no file is left of it.

    Where the system cannot lock a folder (Windows, some network disks), nothing is held.

    Raises InputError (E-BUSY) where another process holds it.
    """
    try:
        import fcntl
    except ImportError:
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)  # workers are spawned, and do not inherit it
    try:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError as e:
            cure = "Wait until it is done, or name another folder."
            raise InputError("E-BUSY", str(folder), "another rockref is at work there", cure) from e
        except OSError:
            pass  # a disk that knows no locks
        yield
    finally:
        os.close(descriptor)
