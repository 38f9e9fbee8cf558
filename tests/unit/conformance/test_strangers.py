"""The mistakes of strangers are still mistakes of the tutorial backend, and the judge still names them."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "benchmarks"))
from strangers import registry
from strangers.judging import OF_SCHEMES, Runs, of_mistake, seen
from strangers.list_01 import HARMLESS, MISTAKES
from strangers.planting import made, planted, with_step
from strangers.report import counted

from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from rockref.conformance.rules import BY_ID


def test_every_mistake_is_planted_in_one_place_and_of_a_rule():
    for mistake in MISTAKES + HARMLESS:
        assert hasattr(planted(mistake), "simulate"), mistake.says
        assert mistake.rules and set(mistake.rules) <= set(BY_ID), mistake.says
    assert len({m.says for m in MISTAKES}) == len(MISTAKES) > 56
    assert {rule for m in MISTAKES for rule in m.rules} >= set(BY_ID) - {"R1", "B1"}, "the tutorial shows neither"


def test_every_list_of_the_folder_is_found_and_planted_whole():
    assert list(registry.LISTS) == [str(n + 1) for n in range(len(registry.LISTS))] and len(registry.LISTS) > 20
    for number, mistakes in registry.LISTS.items():
        assert len({m.says for m in mistakes}) == len(mistakes), number
        assert all(hasattr(planted(m), "simulate") for m in mistakes), number
    assert set(registry.WITH_SCHEMES) < set(registry.LISTS)
    assert all(planted(*pair) for asked in OF_SCHEMES.values() for pair in asked())


@pytest.mark.parametrize("mistake", MISTAKES[::9], ids=lambda m: m.says)
def test_with_pieces_a_mistake_is_named(mistake):
    found = seen(planted(mistake), mistake)
    assert found["detected"] and found["named"], found


@pytest.mark.parametrize("mistake", HARMLESS, ids=lambda m: m.says)
def test_what_nothing_follows_from_passes(mistake):
    ways = of_mistake(mistake)["ways"]
    assert len(ways) == 3 and not any(a["detected"] for a in ways.values())


@pytest.mark.parametrize("scheme", ["quaternion and Euler", "implicit midpoint"])
def test_integrators_that_do_not_turn_by_the_exponential_or_look_within_a_step_pass(scheme):
    backend = Runs(made(with_step(scheme), scheme), {}, ("F", "anchored"))
    found = verdict(judge(backend, ["L5s", "LS"], "scheme"))
    assert found.passed, found.check


def test_ways_are_counted_apart():
    right = {"detected": True, "named": True, "top two": True, "alike": True}
    wrong = {"detected": True, "named": False, "top two": True, "alike": True}
    found = [{"ways": {"pieces": right}}, {"ways": {"pieces": wrong, "runs": wrong}}]
    table = counted(found)
    assert table["pieces"] == {"asked": 2, "detected": 2, "named": 1, "top two": 2, "alike": 2}
    assert table["runs"] == {"asked": 1, "detected": 1, "named": 0, "top two": 1, "alike": 1}
