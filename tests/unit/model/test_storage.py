"""Files appear whole or not at all."""

import os

import pytest

from rockref.model import storage
from rockref.model.errors import InputError


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
    with pytest.raises(InputError) as refused:
        storage.write_text(path, "new")
    assert refused.value.code == "E-WRITE"
    assert "No space left" in str(refused.value)
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
    with pytest.raises(InputError) as refused:
        storage.write_text(tmp_path / "nowhere" / "a.txt", "x")
    assert refused.value.code == "E-WRITE"
    assert "nowhere" in refused.value.where


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
