"""The bar of long work: on a terminal, after two seconds, and gone with the work."""

from types import SimpleNamespace

import pytest

from rockref.commands import _progress
from rockref.commands._progress import COMPILING, PATIENCE, progress
from rockref.engines import compile_watchers
from tests.unit.commands import terminal


@pytest.fixture
def clock(monkeypatch):
    """Seconds that pass when they are told to."""
    made = SimpleNamespace(now=100.0)
    monkeypatch.setattr(_progress, "time", SimpleNamespace(monotonic=lambda: made.now))
    return made


def test_where_nobody_looks_nothing_is_reported(capsys):
    with progress("working") as report:
        assert report is None
    assert capsys.readouterr() == ("", "")


def test_who_wants_no_bar_has_none_on_a_terminal_either(monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with progress("working", wanted=False) as report:
        assert report is None
    assert seen.getvalue() == ""


def test_what_is_done_in_two_seconds_shows_no_bar(clock, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with progress("working") as report:
        clock.now += PATIENCE - 0.1
        report(0.9)
    assert seen.getvalue() == ""


def test_longer_work_shows_what_is_done_and_how_much_of_it(capsys, clock, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with progress("working") as report:
        clock.now += PATIENCE + 0.1
        report(0.25)
        report(0.5)
    assert "working" in seen.getvalue() and " 50 %" in seen.getvalue()
    assert capsys.readouterr().out == ""


def test_compiling_is_told_once_however_many_functions_are_compiled(monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    before = list(compile_watchers)
    with progress("working"):
        for tell in compile_watchers[len(before) :] * 3:
            tell()
    assert seen.getvalue().count(COMPILING) == 1


def test_work_that_fails_leaves_no_bar_and_nobody_who_watches(clock, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    before = list(compile_watchers)
    with pytest.raises(ZeroDivisionError), progress("working") as report:
        clock.now += PATIENCE + 0.1
        report(0.5)
        raise ZeroDivisionError
    # The cursor, which a bar hides, is shown again.
    assert seen.getvalue().rindex("\x1b[?25h") > seen.getvalue().rindex("\x1b[?25l")
    assert compile_watchers == before
