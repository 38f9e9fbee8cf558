"""The stages of long work: a line each where they are wanted, the last one on a terminal, else nothing."""

import re

from rockref.commands._stages import WIDE, console, stages
from tests.unit.commands import terminal


def test_without_a_terminal_and_unasked_nothing_is_said(capsys):
    with stages("planning") as say:
        say("release 0.117")
    assert capsys.readouterr() == ("", "")


def test_every_stage_has_a_line_with_the_seconds_so_far_where_it_is_wanted(capsys):
    with stages("planning", every_line=True) as say:
        say("  release 0.117 \n")
        say("limits")
    out, err = capsys.readouterr()
    assert out == "" and re.fullmatch(r" +\d+ s  release 0\.117\n +\d+ s  limits\n", err)


def test_a_terminal_shows_the_last_stage(capsys, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with stages("planning") as say:
        say("release 0.117")
        say("limits [of all]")
    shown = seen.getvalue()
    assert "planning" in shown and shown.rindex("limits [of all]") > shown.rindex("planning")
    assert capsys.readouterr().out == ""


def test_who_wants_no_stages_has_none_on_a_terminal_either(monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with stages("planning", wanted=False) as say:
        say("limits")
    assert seen.getvalue() == ""


def test_tables_are_not_cut_where_no_terminal_sets_a_width(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "40")
    assert console().width == WIDE
