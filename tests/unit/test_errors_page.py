"""Every code that rockref may say is on the page, with what to do."""

import re

import pytest

from rockref import Model
from tests.refusal import refused
from tests.shipped import ROOT, program


@pytest.fixture(scope="module")
def maker():
    return program("docs/make_errors.py")


@pytest.fixture(scope="module")
def sections(maker):
    """Code -> its part of the page."""
    parts = re.split(r"^## (\S+)$", maker.page(), flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def codes_in_the_code():
    """Codes anywhere in the sources, found without the maker."""
    text = "\n".join(path.read_text(encoding="utf-8") for path in (ROOT / "rockref").rglob("*.py"))
    quoted = set(re.findall(r"[\"']([EW](?:-[A-Z]+)+)[\"']", text))
    # the command line says what the system says, in one text
    return quoted | set(re.findall(r"\. \[(E(?:-[A-Z]+)+)\]", text))


def test_every_code_is_on_the_page_and_no_other(sections):
    assert set(sections) == codes_in_the_code()


def test_every_code_says_what_to_do(sections):
    for code, text in sections.items():
        cures = [line.split(" | ")[1] for line in text.splitlines() if line.startswith("| ") and "---" not in line][1:]
        assert any(len(cure) > 5 for cure in cures), code


def test_what_an_error_says_is_what_the_page_says(sections):
    error = refused(Model().replace(mass=-1).check)
    assert error.cure == "Give a finite number, above 0."
    assert "Give a finite number, {limit}." in sections[error.code]
    error = refused(Model(points="six").check)
    assert "Use one of {" in sections[error.code]


@pytest.mark.parametrize(
    "source, text",
    [
        ('E("E-A", where, "what", "cure")', ("E-A", "what", "cure")),
        ('E("E-A-B", where, f"is {x!r}, no {n}", "cure")', ("E-A-B", "is {x}, no {n}", "cure")),
        ('what = "wrong"\ncure = "mend"\nE("E-A", where, what, cure)\nwhat = "later"', ("E-A", "wrong", "mend")),
        ('refuse("E-A", "what", "cure")', ("E-A", "what", "cure")),
        ('return "E-A", where, f"is {x}"[:80], "a" + b', ("E-A", "is {x}", "a{…}")),
    ],
)
def test_the_maker_reads_calls(maker, tmp_path, monkeypatch, source, text):
    monkeypatch.setattr(maker, "ROOT", tmp_path)
    path = tmp_path / "file.py"
    path.write_text("def f(where, x, n, b):\n    " + source.replace("\n", "\n    "))
    said = maker.said_in(path)
    assert [(s.code, s.what, s.cure) for s in said] == [text]
