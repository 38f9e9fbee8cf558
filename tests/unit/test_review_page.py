"""The page for the physicist is what the sources say now."""

import re

import pytest

from rockref.conformance.rules import RULES
from tests.shipped import ROOT, program


@pytest.fixture(scope="module")
def maker():
    return program("docs/make_review.py")


@pytest.fixture(scope="module")
def page(maker):
    return maker.page()


def test_every_rule_has_its_section(page):
    assert [f"## {rule.id}: {rule.says}" for rule in RULES] == re.findall(r"^## \w+: .*$", page, re.MULTILINE)


def test_every_rule_has_its_equation_and_no_other_is_invented(maker):
    assert set(maker.EQUATIONS) == {rule.id for rule in RULES}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_every_rule_is_held_by_a_test_or_by_vectors(maker, rule):
    section = maker.section(rule)
    assert "Tests that call it:" in section or re.search(r"Vectors: \d+ in L", section)
    assert "```python\ndef " in section


def test_numbered_equations_agree_with_the_rule_table(maker):
    for rule in RULES:
        numbered = re.search(r"\\tag\{(3\.\d\w?)\}", maker.EQUATIONS[rule.id])
        if rule.equation.startswith("(3."):
            assert numbered and f"({numbered[1]})" == rule.equation, rule.id


def test_every_decision_of_the_code_is_on_the_page(page):
    """Wherever the law says "decided", the page has the words that follow."""
    for path in sorted((ROOT / "rockref/model").glob("*.py")):
        text = re.sub(r"\s*\n\s*(#:? ?)?", " ", path.read_text(encoding="utf-8"))
        for words in re.findall(r"\b[Dd]ecided: (\w+ \w+ \w+)", text):
            assert words.lower() in re.sub(r"\s+", " ", page).lower(), (path.name, words)
