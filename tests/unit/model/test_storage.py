"""Files appear whole or not at all."""

import gzip
import io
import os
import re

import pytest

from rockref.model import storage
from rockref.model.errors import InputError
from tests.refusal import refused


def test_writes_and_replaces(tmp_path):
    path = tmp_path / "a.txt"
    storage.write_text(path, "ξ = 1\n")
    assert path.read_bytes() == "ξ = 1\n".encode()
    storage.write_bytes(path, b"two")
    assert path.read_bytes() == b"two"
    assert os.listdir(tmp_path) == ["a.txt"]
    assert path.stat().st_mode & 0o777 == 0o644


def test_an_interrupted_write_leaves_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "a.txt"
    storage.write_text(path, "old")

    def fails(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fails)
    error = refused(storage.write_text, path, "new")
    assert error.code == "E-WRITE"
    assert "No space left" in str(error)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_until_it_is_whole_the_file_lies_hidden_beside_its_place(tmp_path, monkeypatch):
    """In the same folder, so that the rename never crosses a disk."""
    seen = []
    monkeypatch.setattr(os, "fsync", lambda _: seen.extend(os.listdir(tmp_path)))
    storage.write_text(tmp_path / "a.txt", "new")
    assert len(seen) == 1
    assert seen[0].startswith(".a.txt.")


def test_a_missing_folder_is_named(tmp_path):
    error = refused(storage.write_text, tmp_path / "nowhere" / "a.txt", "x")
    assert error.code == "E-WRITE"
    assert "nowhere" in error.where


def test_pieces_are_asked_for_one_by_one_and_an_interruption_leaves_nothing(tmp_path):
    path = tmp_path / "a.txt"
    storage.write_pieces(path, iter([b"one ", b"two"]))
    assert path.read_bytes() == b"one two"

    def interrupted():
        yield b"three"
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        storage.write_pieces(path, interrupted())
    assert path.read_bytes() == b"one two"
    assert os.listdir(tmp_path) == ["a.txt"]


CHECK, CUT = "Check the name and the permissions.", "Cut the file to what belongs to it."


def told(error: pytest.ExceptionInfo) -> str:
    return str(error.value)


class TestReading:
    @pytest.mark.parametrize("size", [0, 4, 5])
    def test_as_many_bytes_as_there_may_be(self, tmp_path, size):
        (tmp_path / "a").write_bytes(bytes(size))
        assert storage.read_bytes(tmp_path / "a", 5) == bytes(size)

    @pytest.mark.parametrize(
        ("limit", "words"),
        [(5, "5 bytes"), (2**20 - 1, "1048575 bytes"), (2**20, "1 MiB"), (3 * 2**20 + 1, "3 MiB")],
    )
    def test_more_is_refused_and_not_read(self, tmp_path, limit, words):
        with (tmp_path / "a").open("wb") as f:
            f.truncate(2**40)  # a file without content, which no memory would hold
        with pytest.raises(InputError) as refused:
            storage.read_bytes(tmp_path / "a", limit)
        assert told(refused) == f"{tmp_path / 'a'}: holds more than {words}. {CUT} [E-SIZE]"

    def test_what_cannot_be_opened_is_named(self, tmp_path):
        with pytest.raises(InputError) as refused:
            storage.read_bytes(tmp_path / "none", 5)
        reason = "No such file or directory"
        assert told(refused) == f"{tmp_path / 'none'}: cannot be opened ({reason}). {CHECK} [E-FILE]"
        with pytest.raises(InputError) as refused:
            storage.read_bytes(tmp_path / "a\0b", 5)  # each Python has words of its own
        assert "cannot be opened (" in told(refused) and "embedded null" in told(refused)

    @pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
    def test_what_is_no_file_is_not_waited_for_and_is_closed(self, tmp_path, monkeypatch, make):
        make(tmp_path / "a")
        opened, closed = [], []
        real_open, real_close = os.open, os.close
        monkeypatch.setattr(os, "open", lambda *given: opened.append(real_open(*given)) or opened[-1])
        monkeypatch.setattr(os, "close", lambda descriptor: closed.append(descriptor) or real_close(descriptor))
        with pytest.raises(InputError) as refused:
            storage.read_bytes(tmp_path / "a", 5)
        cure = "Name a file that holds the data."
        assert told(refused) == f"{tmp_path / 'a'}: is not a regular file. {cure} [E-FILE]"
        assert opened and closed == opened

    def test_a_disk_that_fails_is_told(self, tmp_path, monkeypatch):
        (tmp_path / "a").write_bytes(b"1")

        class Failing(io.BytesIO):
            def read(self, size=-1):
                raise OSError(5, "Input/output error")

        real = os.fdopen
        monkeypatch.setattr(os, "fdopen", lambda descriptor, mode: real(descriptor, mode).close() or Failing())
        with pytest.raises(InputError) as refused:
            storage.read_bytes(tmp_path / "a", 5)
        assert told(refused) == f"{tmp_path / 'a'}: cannot be read (Input/output error). {CHECK} [E-FILE]"


class TestUnpacking:
    @pytest.mark.parametrize("size", [0, 1, 2**20, 2**20 + 1, 5 * 2**19])
    def test_what_was_packed_comes_out(self, size):
        text = bytes(i % 251 for i in range(1000)) * (size // 1000 + 1)
        assert storage.unpacked(gzip.compress(text[:size], mtime=0), "a.gz", size) == text[:size]

    def test_a_bomb_is_noticed_before_it_is_in_memory(self):
        with pytest.raises(InputError) as refused:
            storage.unpacked(gzip.compress(bytes(3_000_000), mtime=0), "a.gz", 2 * 2**20)
        assert told(refused) == f"a.gz: holds more than 2 MiB. {CUT} [E-SIZE]"

    @pytest.mark.parametrize("size", [60_000, 3_000_000])
    def test_what_is_cut_off_is_told_with_its_size(self, size):
        """Not packed at all (level 0): all that is left but ten bytes of head, and five for each of its pieces."""
        packed = gzip.compress(os.urandom(100) * (size // 100), 0, mtime=0)
        with pytest.raises(InputError) as refused:
            storage.unpacked(packed[: size // 2], "a.gz", 9_000_000)
        words = r"a\.gz: the gzip stream is cut off after (\d+) bytes of text\. Copy the file again\. \[E-GZIP\]"
        said = re.fullmatch(words, told(refused))
        # pieces have 64 kB at most, and 16 kB at least
        assert said and size // 2 - 10 - 5 * (size // 2**15 + 1) <= int(said[1]) <= size // 2 - 15

    @pytest.mark.parametrize("damage", [lambda raw: raw[:-8] + bytes(8), lambda raw: raw[:10] + b"\xff" * 9])
    def test_what_is_damaged_is_told(self, damage):
        with pytest.raises(InputError) as refused:
            storage.unpacked(damage(gzip.compress(b"text", mtime=0)), "a.gz", 100)
        words = told(refused)
        assert words.startswith("a.gz: the gzip stream is damaged (") and words.endswith(
            "). Copy the file again. [E-GZIP]"
        )
