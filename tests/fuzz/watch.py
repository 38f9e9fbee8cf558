"""What a reader touches while it reads: files, other programs, the network, code. Seen by the interpreter's own audit.

A reader may open what lies in its folder, and what belongs to the installation. Everything else is noted.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

#: Events that change the disk without opening a file; all begin so.
CHANGES = (
    "os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.chmod", "os.chown", "os.link", "os.symlink", "os.truncate",
    "os.utime", "os.setxattr", "shutil.",
)  # fmt: skip
#: Events that run something, reach a network, or make objects that a file names.
DEEDS = ("subprocess.", "os.system", "os.exec", "os.posix_spawn", "os.spawn", "os.fork", "pty.", "socket.", "ctypes.dl",
         "pickle.find_class", "urllib.")  # fmt: skip
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
#: Modules are imported where they are first needed, also while a reader reads.
INSTALLED = (
    sys.prefix, sys.base_prefix, str(Path(__file__).resolve().parents[2] / "rockref"), "/proc/", "/sys/",
    "/dev/urandom", "/usr/share/zoneinfo", "/usr/lib",
)  # fmt: skip


class _Watch:
    """The folder of the reader that is watched at present, where it may write, and what it did beyond."""

    folder: str | None = None
    output: str = ""
    anywhere = False
    installed = False

    def __init__(self) -> None:
        self.seen: list[str] = []

    def hook(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Note what must not be. An audit hook stays until the interpreter ends; nobody watched, it does nothing."""
        if self.folder is None:
            return
        if event == "open":
            self._opened(*arguments)
        elif event.startswith(CHANGES):
            places = [os.fsdecode(a) for a in arguments if isinstance(a, str | bytes | os.PathLike)]
            if not self.output or not all(_within(place, self.output) for place in places):
                self.seen.append(f"{event} {places}")
        elif event.startswith(DEEDS):
            self.seen.append(f"{event} {arguments!r}"[:200])
        elif event == "exec" and _within(getattr(arguments[0], "co_filename", ""), self.folder):
            self.seen.append(f"ran {arguments[0].co_filename}")

    def _opened(self, path: Any, mode: str | None, flags: int) -> None:
        if not isinstance(path, str | bytes | os.PathLike):  # a descriptor that is open already
            return
        place = os.fsdecode(path)
        if flags & WRITING:
            if "__pycache__" not in place and not (self.output and _within(place, self.output)):
                self.seen.append(f"opened for writing {place[:200]}")
        elif not self.anywhere and not _within(place, self.folder or "", *INSTALLED):
            self.seen.append(f"opened {place[:200]}")


def _within(place: str, *folders: str) -> bool:
    try:
        real = os.path.realpath(place)
    except (OSError, ValueError):  # a name that no file can have: it will not be opened
        return True
    return any(real == folder.rstrip("/") or real.startswith(folder.rstrip("/") + "/") for folder in folders)


WATCH = _Watch()


class Touched(AssertionError):
    """A reader did more than read what lies in its folder."""


@contextmanager
def watched(folder: Path, output: Path | None = None, anywhere: bool = False) -> Iterator[None]:
    """Watch what is done; raises Touched at the end where it was more than reading in `folder`, writing in `output`.

    anywhere : whether it may read where it is told to, as a command line does.
    """
    if not WATCH.installed:
        sys.addaudithook(WATCH.hook)
        WATCH.installed = True
    WATCH.seen, WATCH.anywhere = [], anywhere
    WATCH.output = "" if output is None else os.path.realpath(output)
    WATCH.folder = os.path.realpath(folder)
    try:
        yield
    finally:
        WATCH.folder = None
    if WATCH.seen:
        raise Touched("; ".join(WATCH.seen))
