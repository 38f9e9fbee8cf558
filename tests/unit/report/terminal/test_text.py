"""Words on the terminal: few lines, the answer last, nothing broken within a word; tables where they are asked for."""

from dataclasses import replace

import pytest

from rockref.discover.diagnosis_record import plain
from rockref.report.html.page import Page
from rockref.report.tables.table import Table
from rockref.report.terminal.addition_text import print_addition
from rockref.report.terminal.comparison_text import print_comparison
from rockref.report.terminal.diagnosis_text import MEANINGS, print_diagnosis
from rockref.report.terminal.fit_text import print_fit
from rockref.report.terminal.identification_text import print_identification
from rockref.report.terminal.plan_text import print_plan
from rockref.report.terminal.text import print_table, say_command
from rockref.workflows.demo import Story, the_error, the_missing_effect
from rockref.workflows.story import Journey
from tests.printed import printed
from tests.unit.discover import fakes
from tests.unit.report.made_up import IDENTIFICATION


def in_full(show):
    return lambda console, what: show(console, what, full=True)


SHOWN = {
    "compare": (print_comparison, None), "fit": (print_fit, fakes.fitted), "add": (print_addition, fakes.addition),
    "plan": (print_plan, fakes.planned), "identify": (print_identification, lambda: IDENTIFICATION),
    "diagnose": (print_diagnosis, lambda: plain(fakes.diagnosis("named").to_dict())),
}  # fmt: skip


@pytest.mark.parametrize("name", SHOWN)
def test_nothing_is_broken_within_a_word(name, short):
    """In a pipe every word is whole; on a terminal of any width the same words stand there."""
    show, make = SHOWN[name]
    what = short if make is None else make()
    for one in (show, in_full(show)):
        lines = printed(one, what).splitlines()
        # A table that is a list names its columns at each row, and not where it has none.
        heads = [k for k, line in enumerate(lines[1:]) if set(line.strip()) == {"─"}]
        words = {w for k, line in enumerate(lines) if k not in heads for w in line.split() if set(w) != {"─"}}
        for width in (40, 80, 120):
            shown = printed(one, what, width=width, terminal=True)
            assert words <= set(shown.split()), width
            assert all(len(line.rstrip()) <= width or " " not in line.strip() for line in shown.splitlines()), width


@pytest.mark.parametrize("name", SHOWN)
def test_few_lines_are_enough(name, short):
    show, make = SHOWN[name]
    # A file and the next command follow, which makes twelve.
    assert len(printed(show, short if make is None else make()).splitlines()) <= 10


@pytest.mark.parametrize("verdict", MEANINGS)
def test_a_verdict_is_in_the_last_line(verdict):
    lines = printed(print_diagnosis, plain(fakes.diagnosis(verdict).to_dict())).splitlines()
    assert lines[-1].startswith(verdict.upper().replace("_", " ")) and len(lines) <= 10
    assert ("Its size is 0.41 N m s² (90 %: 0.38 to 0.44)" in lines[-1]) is (verdict == "named")


def test_a_command_that_is_wider_than_the_terminal_can_still_be_pasted():
    command = "rockref compare data/experiments/mystery-05 --model model.toml"
    shown = printed(say_command, command, width=40, terminal=True)
    assert shown.splitlines() == [
        "Next:", "  rockref compare \\", "  data/experiments/mystery-05 --model \\", "  model.toml",
    ]  # fmt: skip
    assert printed(say_command, command) == f"Next: {command}\n"


def test_a_table_wider_than_the_terminal_is_a_list():
    table = Table("Numbers", ("run", "a_long_name", "another_long_name"), [["01", "1.5", ""], ["02", "2.5", "x"]])
    assert printed(print_table, table, width=20, terminal=True).split("\n")[:6] == [
        "Numbers", "01", "  a_long_name: 1.5", "02", "  a_long_name: 2.5", "  another_long_name:",
    ]  # fmt: skip


def test_held_out_runs_have_a_table_where_there_are_some(short):
    assert printed(in_full(print_comparison), short).count("holdout runs") > 0
    fit = short.of("fit")
    alone = replace(
        short,
        measured=tuple(short.measured[k] for k in fit),
        results=tuple(tuple(runs[k] for k in fit) for runs in short.results),
    )
    text = printed(in_full(print_comparison), alone)
    assert "fit runs" in text and "holdout runs" not in text
    # The number that counts is the last one, for the runs that there are.
    assert "held-out runs: its error over" in printed(print_comparison, short).splitlines()[-1]
    assert "% on the fit runs: its error over the measured rates, up to the second" in text.splitlines()[-1]


@pytest.mark.parametrize("gates", [True, False])
def test_gates_that_nobody_asked_for_are_not_printed(gates):
    found = fakes.fitted("not_trustworthy")
    found = found if gates else replace(found, gates=[], outcome="not_checked")
    text = printed(lambda console, f: print_fit(console, f, full=True), found)
    assert ("Not trustworthy" in text) is gates and ("FAILED" in text) is gates and "5.900e+07" in text


def test_a_demonstration_tells_the_verdict_the_size_and_both_errors(tmp_path):
    d = fakes.diagnosis("named")
    story = Story(Journey(d, fakes.addition(d.experiment), None), tmp_path, "auto", Page("A story"))
    the_missing_effect(story)
    the_error(story)
    verdict, size, fit, held_out = story.lines
    assert verdict == "synthetic: quadratic_drag is missing."
    assert size == "Size of quadratic_drag: c 0.41 N m s² (90 %: 0.38 to 0.44)."
    assert fit.startswith("Fit runs: error 0.2500 to 0.0700") and held_out.startswith("Held-out runs: error 0.3500 to")
    assert [s.title for s in story.page.sections] == ["The missing effect", "The error falls"]


def test_a_demonstration_without_an_effect_adds_nothing(tmp_path):
    story = Story(Journey(fakes.diagnosis("none"), None, None), tmp_path, "auto", Page("A story"))
    the_missing_effect(story)
    the_error(story)
    assert story.lines == ["synthetic: A sentence."] and len(story.page.sections) == 1
