"""A text file from a stranger, read without trusting its name, size, packing or encoding."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from rockref.measure.records.notice import Notice
from rockref.model.errors import InputError
from rockref.model.storage import read_bytes, too_large, unpacked

# decided: ten minutes at 2 kHz with four columns of ten characters make 50 MB; a bigger file is not a run. Text in
# memory can need four bytes a character and is copied twice, so this also keeps reading below 1 GiB.
MAX_PACKED_BYTES = 64 * 2**20
MAX_TEXT_BYTES = 64 * 2**20


@dataclass(frozen=True)
class RawText:
    """The text of a file with uniform line ends, and the digest of the bytes on disk."""

    text: str
    sha256: str
    notices: tuple[Notice, ...]


def read_text(
    path: Path,
    *,
    max_packed: int = MAX_PACKED_BYTES,
    max_text: int = MAX_TEXT_BYTES,
    if_empty: str = "Export the run again.",
) -> RawText:
    """Read a UTF-8 text file, packed with gzip or not; `if_empty` is what to do where there is nothing in it.

    Line ends become ``\\n``, a byte order mark is dropped; both are said in the notices.
    Raises InputError: E-FILE (missing, not a regular file, unreadable), E-SIZE, E-GZIP, E-ENCODING, E-EMPTY.
    """
    packed = read_bytes(path, max_packed)
    data = unpacked(packed, path, max_text) if packed[:2] == b"\x1f\x8b" else packed
    if data is packed and path.suffix == ".gz":
        raise InputError("E-GZIP", str(path), "the name ends in .gz but the content is not gzip", "Pack or rename it.")
    if len(data) > max_text:
        raise too_large(path, max_text)
    text, notices = _decode(data, path)
    if not text.strip():
        raise InputError("E-EMPTY", str(path), "the file is empty", if_empty)
    return RawText(text, hashlib.sha256(packed).hexdigest(), notices)


def _decode(data: bytes, path: Path) -> tuple[str, tuple[Notice, ...]]:
    where, cure = str(path), "Save it as UTF-8 text."
    notices: list[Notice] = []
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise InputError("E-ENCODING", where, "is UTF-16 text", cure)
    if data.startswith(b"\xef\xbb\xbf"):
        data = data[3:]
        notices.append(Notice("W-BOM", where, "starts with a byte order mark", "It was dropped."))
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        what = f"byte {data[error.start]:#04x} is not UTF-8"
        raise InputError("E-ENCODING", f"{where}, line {line}", what, cure) from None
    if "\0" in text:
        line = text.count("\n", 0, text.index("\0")) + 1
        raise InputError("E-ENCODING", f"{where}, line {line}", "a zero byte: the file is not text", cure)
    return _one_line_end(text, where, notices)


def _one_line_end(text: str, where: str, notices: list[Notice]) -> tuple[str, tuple[Notice, ...]]:
    if "\r" in text:
        pairs, feeds, returns = text.count("\r\n"), text.count("\n"), text.count("\r")
        if not (pairs == feeds == returns or feeds == 0):
            what = f"mixed line ends ({pairs} CRLF, {feeds - pairs} LF, {returns - pairs} CR)"
            notices.append(Notice("W-LINE-ENDS", where, what, "Each was taken as the end of a line."))
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    return text, tuple(notices)
