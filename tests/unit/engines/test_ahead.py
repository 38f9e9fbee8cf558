"""What the compiled engine has not kept on disk is compiled beside other work, by a process of its own."""

import os
import subprocess
import sys

import pytest

from rockref import engines

pytest.importorskip("numba", reason="the compiled engine is the extra `fast`")

from rockref.engines.compiled import abreast, ahead, slots


class Process:
    """A process that only notes what is done to it."""

    def __init__(self, command, **streams):
        self.command, self.streams, self.ended = command, streams, []

    def terminate(self):
        self.ended.append("told to end")

    def wait(self):
        self.ended.append("waited for")


@pytest.fixture
def begun(monkeypatch):
    """The processes that are begun, none of which really is."""
    found = []
    monkeypatch.setattr(subprocess, "Popen", lambda *a, **k: found.append(Process(*a, **k)) or found[-1])
    monkeypatch.setattr(os, "cpu_count", lambda: 2)
    return found


def test_a_process_compiles_what_is_missing_while_the_block_runs(monkeypatch, begun):
    monkeypatch.setattr(ahead, "missing", lambda: [slots.LOADS])
    with pytest.raises(KeyboardInterrupt), engines.compiled_ahead():
        (process,) = begun
        assert process.command == [sys.executable, "-m", "rockref.engines.compiled.ahead"] and not process.ended
        # What a command prints may be read by a program: nothing may come between.
        assert process.streams["stdout"] == process.streams["stderr"] == subprocess.DEVNULL
        raise KeyboardInterrupt
    assert process.ended == ["told to end", "waited for"]


@pytest.mark.parametrize("cores, missing, numba", [(2, [], True), (1, [slots.LOADS], True), (2, [slots.LOADS], False)])
def test_none_is_begun_where_there_is_nothing_to_do_or_nobody_to_do_it(monkeypatch, begun, cores, missing, numba):
    monkeypatch.setattr(ahead, "missing", lambda: missing)
    monkeypatch.setattr(os, "cpu_count", lambda: cores)
    monkeypatch.setattr(engines, "has_numba", lambda: numba)
    with engines.compiled_ahead():
        assert not begun


def test_every_variant_but_the_law_is_compiled_ahead():
    assert set(ahead.ORDER) | {0} == set(abreast.LOOPS)


@pytest.mark.parametrize("groups", ahead.ORDER)
def test_what_is_made_is_the_variant_that_was_asked_for(monkeypatch, groups):
    called = []
    monkeypatch.setattr(abreast, "LOOPS", {g: (lambda *a, g=g: called.append(g)) for g in abreast.LOOPS})
    ahead.make(groups)
    assert called == [groups]


# It compiles a variant in a folder of its own, some ten seconds.
@pytest.mark.slow
def test_what_numba_has_kept_is_not_missing(tmp_path):
    """In an empty folder all are missing; once a variant has been made there it is not."""
    script = """
from rockref.engines.compiled import ahead, slots
before = ahead.missing()
ahead.make(slots.LOADS)
print(before == list(ahead.ORDER), [g for g in ahead.ORDER if g not in ahead.missing()] == [slots.LOADS])
"""
    surroundings = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", script], env=surroundings, capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "True"]
