"""The source's stated facts: each is held against the law, and the only one that fails is the one that must."""

import pytest

import rockref
from rockref.studies.source_facts import LONG, facts


def test_facts_of_table_3_1(table_3_1):
    pytest.importorskip("numba")
    found = {f.what: f for f in facts(rockref.simulate(table_3_1, duration=LONG, engine="numba"))}
    assert len(found) == 16
    # The first impact comes 4 % early, with the height that had to be decided.
    assert [what for what, f in found.items() if f.agrees is False] == ["first main impact"]
    assert "0.5104" in found["first main impact"].ours


def test_another_release_does_not_agree(table_3_1):
    """From 0.09 rad the impacts come earlier, and the window of the ninth to eleventh is missed."""
    pytest.importorskip("numba")
    other = table_3_1.replace(theta_0=0.09)
    found = {f.what: f for f in facts(rockref.simulate(other, duration=LONG, engine="numba"))}
    assert found["first main impact"].agrees is False
    assert found["ninth to eleventh main impact"].agrees is False
