"""Files from strangers: size, packing and encoding are checked before anything is believed."""

import gzip
import os
import zlib

import pytest

from rockref.measure.reading.rawfile import read_bytes, read_text
from rockref.model.errors import InputError

TEXT = b"t_s,wx_deg_s\n0,1\n"


def refused(path, code, *words, **limits):
    with pytest.raises(InputError) as caught:
        read_text(path, **limits)
    assert caught.value.code == code
    assert str(path) in caught.value.where
    for word in words:
        assert word in str(caught.value)
    return caught.value


@pytest.mark.parametrize(
    ("content", "code", "words"),
    [
        (b"", "E-EMPTY", ["empty"]),
        (b" \n\t\r\n", "E-EMPTY", ["empty"]),
        (b"t_s\n0\xff\n", "E-ENCODING", ["line 2", "0xff"]),
        ("t_s,ω\n".encode("iso-8859-7"), "E-ENCODING", ["line 1"]),
        ("t_s\n0\n".encode("utf-16"), "E-ENCODING", ["UTF-16"]),
        (b"t_s\n0\n1\x00\n", "E-ENCODING", ["line 3", "zero byte"]),
        (gzip.compress(TEXT, mtime=0)[:-3], "E-GZIP", ["cut off"]),
        (gzip.compress(TEXT * 999, mtime=0)[:40], "E-GZIP", ["cut off"]),
        (gzip.compress(TEXT, mtime=0)[:-8] + b"\0" * 8, "E-GZIP", ["damaged"]),
        (b"\x1f\x8b" + b"\x07" * 30, "E-GZIP", ["damaged"]),
        (gzip.compress(TEXT, mtime=0) + b"rubbish", "E-GZIP", ["damaged"]),
        (gzip.compress(b"", mtime=0), "E-EMPTY", ["empty"]),
    ],
)
def test_unusable_content_is_refused_with_its_place(tmp_path, content, code, words):
    path = tmp_path / "run.csv"
    path.write_bytes(content)
    refused(path, code, *words)


def test_name_says_gzip_and_content_does_not(tmp_path):
    path = tmp_path / "run.csv.gz"
    path.write_bytes(TEXT)
    refused(path, "E-GZIP", "not gzip")


def test_packed_and_plain_text_read_alike(tmp_path):
    plain, packed = tmp_path / "a.csv", tmp_path / "b.csv.gz"
    plain.write_bytes(TEXT)
    packed.write_bytes(gzip.compress(TEXT[:8], mtime=0) + gzip.compress(TEXT[8:], mtime=0))
    assert read_text(plain).text == read_text(packed).text == TEXT.decode()


def test_bomb_is_noticed_before_it_is_unpacked(tmp_path):
    packer = zlib.compressobj(9, zlib.DEFLATED, 31)
    zeros = b"0" * 2**20
    path = tmp_path / "bomb.csv.gz"
    path.write_bytes(b"".join(packer.compress(zeros) for _ in range(80)) + packer.flush())
    assert path.stat().st_size < 2**20
    assert "64 MiB" in refused(path, "E-SIZE").what


def test_large_file_is_not_read_whole(tmp_path):
    path = tmp_path / "large.csv"
    with path.open("wb") as stream:
        stream.truncate(2**40)
    refused(path, "E-SIZE", "64 MiB")


@pytest.mark.parametrize("size", [15, 16, 17])
def test_limits_are_inclusive(tmp_path, size):
    path = tmp_path / "a.csv"
    path.write_bytes(b"1" * size)
    if size <= 16:
        assert read_text(path, max_packed=16, max_text=16).text == "1" * size
    else:
        refused(path, "E-SIZE", max_packed=16, max_text=99)
        refused(path, "E-SIZE", max_packed=99, max_text=16)


def test_missing_file_folder_and_pipe(tmp_path):
    refused(tmp_path / "no.csv", "E-FILE", "No such file")
    refused(tmp_path, "E-FILE")
    pipe = tmp_path / "pipe.csv"
    os.mkfifo(pipe)
    # Without care this waits for ever for somebody to write.
    refused(pipe, "E-FILE", "not a regular file")


def test_device_is_refused(tmp_path):
    with pytest.raises(InputError, match="E-FILE]"):
        read_bytes(tmp_path.__class__("/dev/zero"), 10)


def test_byte_order_mark_is_dropped_and_said(tmp_path):
    path = tmp_path / "a.csv"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT)
    raw = read_text(path)
    assert raw.text == TEXT.decode()
    assert [n.code for n in raw.notices] == ["W-BOM"]


@pytest.mark.parametrize(
    ("content", "codes"),
    [
        (b"a\nb\nc\n", []),
        (b"a\r\nb\r\nc\r\n", []),
        (b"a\rb\rc\r", []),
        (b"a\r\nb\nc\n", ["W-LINE-ENDS"]),
        (b"a\nb\rc\n", ["W-LINE-ENDS"]),
    ],
)
def test_line_ends_become_one_kind(tmp_path, content, codes):
    path = tmp_path / "a.csv"
    path.write_bytes(content)
    raw = read_text(path)
    assert raw.text == "a\nb\nc\n"
    assert [n.code for n in raw.notices] == codes


def test_digest_is_that_of_the_bytes_on_disk(tmp_path):
    import hashlib

    path = tmp_path / "a.csv.gz"
    path.write_bytes(gzip.compress(TEXT, mtime=0))
    assert read_text(path).sha256 == hashlib.sha256(path.read_bytes()).hexdigest()
