"""The page of the cube: its files and sections, from made-up records; what is missing is said before the work."""

import json
from types import SimpleNamespace

import pytest

from rockref import Model
from rockref.model.errors import InputError
from rockref.report.html.page import MAX_BYTES
from rockref.workflows import reproduce_cube
from tests.tosses import stated
from tests.unit.report import toss_records as made
from tests.unit.report.page_checks import faults_of


@pytest.fixture
def asked(monkeypatch):
    """Engines that answer with records at once; what they were asked for comes back."""
    calls = []
    tosses = SimpleNamespace(tosses=range(20), copies=[1], sha256="0123abcd", notices=("toss 7 was left out",))

    def compare(tosses, models=None, names=None):
        calls.append(("compare", names))
        return SimpleNamespace(to_dict=lambda: made.comparison() | {"scatter": float("nan")})

    def diagnose(tosses, progress, **only):
        calls.append(("diagnose", only))
        return SimpleNamespace(to_dict=made.diagnosis, model=stated())

    monkeypatch.setattr(reproduce_cube, "load_tosses", lambda path: calls.append(("load", path.name)) or tosses)
    monkeypatch.setattr(reproduce_cube, "compare", compare)
    monkeypatch.setattr(reproduce_cube, "diagnose", diagnose)
    return calls


def test_the_story_is_a_folder_with_a_page_and_what_it_was_made_from(asked, tmp_path):
    said = []
    page = reproduce_cube.reproduce_cube(tmp_path / "out", tmp_path / "data", False, said.append)
    assert said[0] == "toss 7 was left out"
    text = page.read_text(encoding="utf-8")
    assert page == tmp_path / "out" / "index.html" and faults_of(text) == [] and len(text.encode()) < MAX_BYTES
    for word in ("Missing: mass_eccentricity", "Where the error grows", "copies set aside", "0123abcd"):
        assert word in text, word
    names = {p.name for p in page.parent.iterdir()}
    assert {"diagnosis.json", "comparison.json", "model.toml", "staircase.png", "stretches.png"} <= names
    assert json.loads((page.parent / "diagnosis.json").read_text()) == made.diagnosis()
    compared = json.loads((page.parent / "comparison.json").read_text(), parse_constant=pytest.fail)
    # What is not known is null: JSON has no word for what is no number.
    assert set(compared) == {"before", "after"} and compared["before"]["scatter"] is None
    assert Model.load(page.parent / "model.toml") == stated()
    assert asked == [("load", "data"), ("compare", None), ("diagnose", {}), ("compare", ["explained"])]


def test_quick_it_tries_one_effect_of_the_tosses_that_the_environment_names(asked, tmp_path, monkeypatch):
    monkeypatch.setenv(reproduce_cube.VARIABLE, str(tmp_path / "named"))
    reproduce_cube.reproduce_cube(tmp_path / "out", None, True, lambda line: None)
    assert asked[0] == ("load", "named")
    (only,) = [facts for name, facts in asked if name == "diagnose"]
    assert only["candidates"] == ("mass_eccentricity",) and max(n for _, n in only["stages"]) <= 2


def test_without_a_folder_of_tosses_it_says_where_to_get_them(asked, tmp_path, monkeypatch):
    monkeypatch.delenv(reproduce_cube.VARIABLE, raising=False)
    with pytest.raises(InputError, match="contact-nets") as error:
        reproduce_cube.reproduce_cube(tmp_path / "out", None, True, lambda line: None)
    assert error.value.code == "E-FOLDER" and asked == [] and not (tmp_path / "out").exists()
