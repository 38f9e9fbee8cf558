"""The examples of docstrings are run: each says what it prints."""

import ast
import doctest
from importlib import import_module

import pytest

import rockref
from rockref.effects.base import Effect
from tests.shipped import ROOT


def with_examples():
    """The modules that show any, by their text."""
    paths = [p for p in sorted((ROOT / "rockref").rglob("*.py")) if ">>> " in p.read_text(encoding="utf-8")]
    return [".".join(path.relative_to(ROOT).with_suffix("").parts) for path in paths]


@pytest.mark.parametrize("name", with_examples())
def test_examples_print_what_they_say(name):
    found = doctest.testmod(import_module(name), globs={})
    assert found.attempted > 0 and found.failed == 0


@pytest.mark.parametrize("thing", [rockref.Model, rockref.Response, rockref.simulate, Effect])
def test_what_a_user_meets_first_has_one(thing):
    (path,) = [ROOT / f"{thing.__module__.replace('.', '/')}.py"]
    named = [n for n in ast.parse(path.read_text(encoding="utf-8")).body if getattr(n, "name", "") == thing.__name__]
    assert ">>> " in ast.get_docstring(named[0])
