"""What a terminal cannot show is replaced, and what it can stays."""

import io
import subprocess
import sys

import pytest

from rockref.commands._terminal import show_what_can_be_shown

SAID = "0.5–0.7 ± ∞, 3° √2 Λ 试"


@pytest.mark.parametrize(
    ("encoding", "shown"),
    [
        ("utf-8", SAID),
        ("latin-1", "0.5-0.7 ± inf, 3° sqrt2 Lambda ?"),
        ("ascii", "0.5-0.7 +- inf, 3 deg sqrt2 Lambda ?"),
        ("koi8-r", "0.5-0.7 +- inf, 3° √2 Lambda ?"),
    ],
)
def test_signs_are_replaced_where_an_alphabet_has_none(monkeypatch, encoding, shown):
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding=encoding, write_through=True))
    show_what_can_be_shown()
    print(SAID, end="")
    assert raw.getvalue().decode(encoding) == shown


def test_a_stream_that_is_none_of_a_terminal_stays(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(sys, "stdout", stream)
    show_what_can_be_shown()
    print(SAID, end="")
    assert stream.getvalue() == SAID


def test_without_a_folder_for_compiled_code_it_is_compiled_all_the_same(tmp_path):
    """A numba without a place for its files, as on a disk that is read only under a user without a home."""
    program = (
        "import numba.core.caching as c; c.CacheImpl._locator_classes = []\n"
        "c.CodeLibraryCacheImpl._locator_classes = []\n"
        "from rockref.engines import on_disk\n"
        "f = on_disk.on_disk(nogil=True)(lambda x: 2.0 * x)\n"
        "print(f(1.5), len(on_disk.not_kept))\n"
    )
    done = subprocess.run([sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, check=False)
    assert (done.stdout.strip(), done.stderr) == ("3.0 1", "")
