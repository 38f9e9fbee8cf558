"""The pages of the documentation agree with the files that they describe."""

import datetime
import re
import tomllib

import numpy as np
import pytest

import rockref
from tests.golden.test_peers import recorded, relative_rms, simulated
from tests.shipped import ROOT, program

FILES_PAGE = (ROOT / "docs/reference/files.md").read_text(encoding="utf-8")
EXPERIMENTS = sorted((ROOT / "data/experiments").glob("*/experiment.toml"))


def keys_of(document):
    """Every key of an experiment, as (section, key); the section is empty at the top."""
    for key, value in document.items():
        if isinstance(value, dict):
            yield from ((key, inner) for inner in value)
        elif isinstance(value, list):
            yield from ((key, inner) for table in value for inner in table)
        else:
            yield "", key


def example_on_the_page():
    return tomllib.loads(re.search(r"```toml\n(.*?)```", FILES_PAGE, re.DOTALL).group(1))


@pytest.mark.parametrize("path", EXPERIMENTS, ids=lambda path: path.parent.name)
def test_example_on_the_page_has_the_keys_of_the_shipped_experiments(path):
    assert set(keys_of(tomllib.loads(path.read_text(encoding="utf-8")))) == set(keys_of(example_on_the_page()))


def test_every_key_is_explained():
    explained = set(re.findall(r"^\| `(\w+)` \|", FILES_PAGE, re.MULTILINE))
    assert {key for _, key in keys_of(example_on_the_page())} <= explained


@pytest.fixture(scope="module")
def figures():
    return program("docs/make_figures.py")


def test_the_pages_of_commands_and_names_have_all_of_them():
    reference = program("docs/make_reference.py")
    commands, names = reference.commands_page(), reference.api_page()
    assert all(f"## rockref {name}\n" in commands for name in reference.commands())
    assert all(name in names for name in rockref.__all__ if name != "__version__")


def test_the_table_of_blind_sets_has_a_line_for_each_and_counts_what_can_be():
    history = program("docs/make_blind_history.py")
    assert all(history.line(row) in history.text() for row in history.rows())
    for row in history.rows():
        for _, hits, n in history.SHARES:
            assert not row[hits] or not row[n] or int(row[hits]) <= int(row[n]), row["set"]


def test_the_table_of_the_judge_has_a_line_for_each_and_counts_what_can_be():
    judge = program("docs/make_judge_table.py")
    assert len(judge.table()) == 2 + sum(row["when"] != "first" for row in judge.rows())
    for row in judge.rows():
        assert all(int(row[k] or 0) <= int(row["asked"]) for k in ("detected", "named", "top_two")), row


def test_the_numbers_of_verdicts_are_those_of_the_calibration():
    """`python docs/make_verdict_numbers.py` writes them anew."""
    numbers = program("docs/make_verdict_numbers.py")
    text = numbers.PAGE.read_text(encoding="utf-8")
    assert numbers.table() in text
    assert numbers.page(text) == text


def test_the_tables_are_those_of_the_measured_figures(figures):
    """`python docs/make_figures.py` writes it anew."""
    text = figures.README.read_text(encoding="utf-8")
    assert figures.readme(text) == text


def test_the_page_of_figures_has_each_of_them_and_links_to_pages(figures):
    page = figures.page()
    assert all(row["what"].split("(")[0] in page for row in figures.read()["row"])
    assert "](docs/" not in page and "](benchmarks/" not in page


def test_the_page_of_the_zoo_counts_what_its_table_has():
    """The figure says the same."""
    zoo = program("docs/make_zoo.py")
    rows = len(zoo.SOURCE.read_text(encoding="utf-8").splitlines()) - 1
    text = zoo.text()
    assert len(re.findall(r"^\| [ZC]\d+ \|", text, re.MULTILINE)) == rows > 150
    assert "detected 139/139, attributed 136/139" in text and "controls rejected 0/17" in text


def test_every_figure_says_what_was_measured_how_when_and_on_what(figures):
    found = figures.read()
    for row in found["row"]:
        assert set(row) == {"what", "figure", "command", "date", "machine", "part", "readme"}, row["what"]
        assert row["part"] in found["parts"], row["what"]
        assert row["machine"] in found["machines"], row["what"]
        assert isinstance(row["date"], datetime.date), row["what"]


def figure(figures, beginning):
    """The text of the one figure whose subject begins so."""
    (text,) = [row["figure"] for row in figures.read()["row"] if row["what"].startswith(beginning)]
    return text


def in_words(value):
    """Two digits and a power of ten: 3.5·10⁻⁵."""
    digits, exponent = f"{value:.1e}".split("e")
    return f"{digits}·10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def test_the_figures_beside_lammps_are_those_of_its_records(figures):
    pytest.importorskip("numba")
    told = figure(figures, "against LAMMPS, body rates to 0.6 s")
    for name in ("four_sym_r1mm_dt1e-06", "base_r1mm_dt1e-06"):
        response, (_, W, *_) = simulated(name, 1e-5, 0.6, "numba"), recorded(name)
        assert in_words(relative_rms(response.W, W[: len(response.t)])) in told, name


def test_the_main_impacts_in_the_table(figures):
    pytest.importorskip("numba")
    impacts = rockref.simulate(rockref.Model.table_3_1(), duration=1.4, engine="numba").main_impacts()
    assert ", ".join(f"{t:.4f} s" for t in impacts) == figure(figures, "main impacts of Table 3.1")


@pytest.mark.slow
def test_the_compiled_engine_gives_the_bits_of_the_law_over_the_whole_response():
    pytest.importorskip("numba")
    law, compiled = (rockref.simulate(rockref.Model.table_3_1(), 1.4, engine=e) for e in ("numpy", "numba"))
    for key in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        assert np.array_equal(getattr(law, key), getattr(compiled, key)), key


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "examples/README.md"])
def test_links_of_pages_outside_of_the_site_lead_to_files_that_are_kept(page):
    """Sphinx looks after the others. What `make docs` makes is not kept."""
    kept = (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines()
    text = (ROOT / page).read_text(encoding="utf-8")
    for link in re.findall(r"\]\((?!https?:)([^)#\s]+)", text):
        target = (ROOT / page).parent.joinpath(link).resolve()
        assert target.exists() and str(target.relative_to(ROOT)) not in kept, link
