"""How far long work is: a bar for a fraction, one line for stages on a terminal, a line a stage elsewhere."""

import re
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.commands import _progress
from rockref.commands._progress import COMPILING, PATIENCE, of_search, progress, stages
from rockref.discover.progress import StageReport
from rockref.engines.watchers import compile_watchers
from rockref.identify.genes import chromosome, space_12
from rockref.identify.search import Progress
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


def report(step=3, line="", left=None, best=""):
    return StageReport(step, 6, f"stage {step}", best, left, line)


def test_without_a_terminal_each_stage_has_one_line_and_the_optimiser_none(capsys):
    with stages("diagnosing") as say:
        for one in (
            report(1),
            report(1, "loss 3.1"),
            report(1, best="adhesion"),
            report(3, left=41.0, best="adhesion"),
        ):
            say(one)
    assert capsys.readouterr() == (
        "", "1/6 stage 1\n3/6 stage 3 · best so far: adhesion · about 40 s left\n",
    )  # fmt: skip


def test_lines_of_the_optimiser_are_shown_where_they_are_wanted_with_the_seconds_so_far(capsys):
    with stages("diagnosing", verbose=True) as say:
        say(report(1)), say(report(1, "loss 3.1"))
    out, err = capsys.readouterr()
    assert out == "" and re.fullmatch(r" +\d+ s  1/6 stage 1\n +\d+ s      loss 3\.1\n", err)


def test_a_study_may_say_its_stages_in_words(capsys):
    with stages("cube") as say:
        say("the way down"), say("  without drag: 3.1"), say("the way down")
    assert capsys.readouterr().err == "the way down\n"


def test_a_terminal_shows_the_present_stage_alone_in_one_line(capsys, clock, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    monkeypatch.setenv("COLUMNS", "60")
    with stages("diagnosing") as say:
        say(report(1)), say(report(1, "an optimiser's line"))
        say(report(3, left=41.0, best="adhesion_of_a_very_long_name [of all]"))
    shown = seen.getvalue()
    last = shown.rindex("3/6 stage 3 · best so far: adhesion")
    assert "an optimiser's line" not in shown and last > shown.rindex("diagnosing")
    assert "…" in shown[shown.rindex("3/6") :] and capsys.readouterr().out == ""


def test_the_seconds_left_go_down_between_two_reports(clock, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with stages("diagnosing") as say:
        say(report(3, left=60.0))
        clock.now += 20.0
    assert "about 40 s left" in seen.getvalue()


def test_who_wants_no_stages_has_none_on_a_terminal_either(monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with stages("planning", wanted=False) as say:
        say(report())
    assert seen.getvalue() == ""


SPACE = space_12(Model.table_3_1())
#: The chromosome of Table 3.1, which has K_N = 6.0e7 N/m, and two release angles behind its genes.
KNOWN = np.append(chromosome(SPACE, Model.table_3_1().parameters), [0.3, 0.7])


def test_a_search_is_told_as_a_stage_and_each_generation_as_a_line(capsys):
    for verbose in (False, True):
        with stages("identifying", verbose=verbose) as say:
            tell = of_search(say)
            tell(SPACE, "search", Progress(1, 250, 0.5, KNOWN, 61.6))
            tell(SPACE, "search", Progress(2, 250, 0.25, np.zeros(0), 61.6))
            tell(SPACE, "signals_1", Progress(1, 60, 0.125, KNOWN, 20.0))
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith("searching on features of the runs · best so far: cost 0.5000 at generation 1 of 250")
    assert lines[1].startswith("searching on the signals, round 1") and len(lines) == 2 + 5
    first, second = lines[3], lines[4]
    assert "search cost 0.5000  K_N 6e+07, " in first and first.endswith(", ..  62 s left") and first.count(", ") == 4
    assert second.split()[2:] == ["search", "cost", "0.2500", "62", "s", "left"]
