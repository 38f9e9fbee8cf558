"""What a search says after every generation: lines where they are wanted, a bar on a terminal, else nothing."""

import numpy as np

from rockref import Model
from rockref.commands._searching import searching
from rockref.identify.genes import chromosome, space_12
from rockref.identify.search import Progress
from tests.unit.commands import terminal

SPACE = space_12(Model.table_3_1())
#: The chromosome of Table 3.1, which has K_N = 6.0e7 N/m.
KNOWN = chromosome(SPACE, Model.table_3_1().parameters)


def generation(number, cost=0.5, u=KNOWN):
    return Progress(number, 250, cost, u, 61.6)


def test_every_generation_has_a_line_where_it_is_wanted(capsys):
    with searching(every_line=True) as say:
        say(SPACE, "search", generation(1))
        say(SPACE, "search", generation(2, cost=0.25))
    out, err = capsys.readouterr()
    first, second = err.splitlines()
    assert out == "" and first.startswith("search cost 0.5000  K_N 6e+07, ") and first.endswith(", ..  62 s left")
    assert second.startswith("search cost 0.2500 ") and first.count(", ") == 4


def test_beside_the_genes_a_chromosome_may_hold_release_angles_which_are_not_shown(capsys):
    with searching(every_line=True) as say:
        say(SPACE, "search", generation(1))
        say(SPACE, "search", generation(1, u=np.append(KNOWN, [0.3, 0.7])))
    first, second = capsys.readouterr().err.splitlines()
    assert first == second


def test_before_there_is_a_best_chromosome_none_is_shown(capsys):
    with searching(every_line=True) as say:
        say(SPACE, "search", generation(1, u=np.zeros(0)))
    assert capsys.readouterr().err.split() == ["search", "cost", "0.5000", "62", "s", "left"]


def test_without_a_terminal_and_unasked_nothing_is_said(capsys):
    with searching() as say:
        say(SPACE, "search", generation(1))
    assert capsys.readouterr() == ("", "")


def test_on_a_terminal_every_stage_has_a_bar_that_goes_on(capsys, monkeypatch):
    seen = terminal.put_in_place(monkeypatch)
    with searching() as say:
        say(SPACE, "search", generation(1))
        say(SPACE, "search", generation(200))
        say(SPACE, "signals", generation(17, cost=0.125))
    # What is drawn last, from where its first line was erased.
    last = seen.getvalue()[seen.getvalue().rindex("\x1b[2Ksearch") :]
    assert last.count("search") == 1 and "200/250" in last and "cost 0.5000  K_N 6e+07" in last
    assert "signals" in last and " 17/250" in last and "cost 0.1250" in last
    assert capsys.readouterr().out == ""
