"""Whatever bytes a reader is given, it takes them or says why not; the fuzzer's functions, without the fuzzer."""

from __future__ import annotations

import signal
from contextlib import contextmanager

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.fuzz.readers import DECOY, READERS, tried
from tests.fuzz.seeds import SHIPPED, damaged, seeds, shipped_run
from tests.fuzz.watch import Touched, watched

#: Seconds that a reader may take for one piece of data. Decided: a thousand times what it takes.
PATIENCE = 30


@contextmanager
def in_time():
    """End what hangs."""

    def stop(number, frame):
        raise TimeoutError(f"not done after {PATIENCE} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, PATIENCE)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of a reader; beside it lies a good run that it must not read."""
    place = tmp_path_factory.mktemp("fuzz")
    (place / DECOY).write_bytes(shipped_run(SHIPPED / "mystery-02"))
    return place / "here"


@pytest.mark.parametrize("name", READERS)
def test_seeds_are_read(folder, name):
    for data in seeds(name):
        with in_time():
            tried(name, data, folder)


@pytest.mark.parametrize("name", READERS)
@given(data=st.data())
def test_damaged_data_is_read_or_refused(folder, name, data):
    with in_time():
        tried(name, data.draw(damaged(name)), folder)


def test_the_watch_sees_what_must_not_be(tmp_path):
    (tmp_path / "outside").write_text("x")
    (tmp_path / "in").mkdir()
    for deed in (
        lambda: (tmp_path / "outside").read_text(),
        lambda: (tmp_path / "in" / "new").write_text("x"),
        lambda: (tmp_path / "outside").unlink(),
        lambda: __import__("pickle").loads(b"cbuiltins\nlen\n."),
        lambda: __import__("subprocess").run(["true"]),
    ):
        with pytest.raises(Touched), watched(tmp_path / "in"):
            deed()
