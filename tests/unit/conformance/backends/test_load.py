"""Where a backend comes from: an engine, a file, a package, an entry point; and what answers may be made of."""

from collections import namedtuple
from dataclasses import dataclass
from importlib.metadata import EntryPoint
from types import SimpleNamespace

import numpy as np
import pytest

from rockref.conformance.backends import examples
from rockref.conformance.backends import load as backends
from rockref.conformance.backends.call import as_mapping
from rockref.conformance.backends.law import NumpyEngine
from rockref.conformance.backends.load import load
from rockref.conformance.faults.controls import CONTROLS
from rockref.conformance.judge.findings import LAYERS, chosen_layers, judge
from rockref.model.errors import InputError


@pytest.fixture
def registered(monkeypatch):
    """Register a backend as another package would; it is looked for in the group of rockref alone."""

    def register(value):
        def entry_points(group):
            assert group == "rockref.backends"
            return [EntryPoint("theirs", value, group)]

        monkeypatch.setattr(backends, "entry_points", entry_points)

    return register


def refused(target):
    with pytest.raises(InputError) as e:
        load(target)
    assert e.value.code in ("E-BACKEND", "E-ENGINE")
    return str(e.value)


def test_a_class_and_a_thing_may_be_registered(registered):
    registered("rockref.conformance.backends.law:NumpyEngine")
    assert isinstance(load("theirs"), NumpyEngine)
    registered("rockref.conformance.faults.controls:CONTROLS")
    assert load("theirs") is CONTROLS


def test_a_registered_backend_that_cannot_be_imported_is_named_with_where_it_should_be(registered):
    registered("rockref.no_such_module:Backend")
    told = refused("theirs")
    assert "theirs" in told and "rockref.no_such_module:Backend" in told and "ModuleNotFoundError" in told


def test_what_is_registered_is_offered_where_a_name_is_wrong(registered):
    registered("rockref.conformance.backends.law:NumpyEngine")
    assert "theirs" in refused("their")


def test_a_file_may_hold_a_class_or_a_thing(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(
        "from rockref.conformance.backends.law import NumpyEngine\n"
        "class Needs(NumpyEngine):\n"
        "    def __init__(self, step):\n"
        "        pass\n"
        "made = NumpyEngine()\n"
    )
    assert load(f"{path}:made").name == "rockref numpy"
    assert "cannot be made without arguments (TypeError" in refused(f"{path}:Needs")
    assert "There is: NumpyEngine, Needs" in refused(f"{path}:Nobody")


def test_a_package_is_loaded_by_its_name():
    assert isinstance(load("rockref.conformance.backends.law:NumpyEngine"), NumpyEngine)
    assert "no class with simulate" in refused("rockref.conformance.rules:Nobody")


def test_without_numba_its_engine_is_refused_with_what_to_install(monkeypatch):
    monkeypatch.setattr("rockref.engines.has_numba", lambda: False)
    told = refused("numba")
    assert "is not installed" in told and "rockref[fast]" in told


def test_an_installation_without_its_examples_says_so(monkeypatch, tmp_path):
    monkeypatch.setattr(examples, "PLACES", (tmp_path,))
    with pytest.raises(InputError, match="is not in this installation"):
        examples.source("c")


@dataclass
class Turned:
    Lambda: np.ndarray


class Answering:
    """Turns as the law does, and answers in a form of its own."""

    def __init__(self, form):
        self.form, self.law = form, NumpyEngine()

    def simulate(self, problem):
        raise NotImplementedError

    def rotate(self, Theta):
        return self.form(self.law.rotate(Theta)["Lambda"])


FORMS = {
    "dict": lambda Lambda: {"Lambda": Lambda},
    "named tuple": namedtuple("Tuple", ["Lambda"]),
    "dataclass": Turned,
    "object": lambda Lambda: SimpleNamespace(Lambda=Lambda),
}


@pytest.mark.parametrize("form", FORMS)
def test_answers_of_every_form_are_weighed_alike(form):
    asked = [c for c in judge(Answering(FORMS[form]), ["L3"]).checks if c.grade != "not shown"]
    assert asked and {c.grade for c in asked} <= {"bitwise", "inside"}


def test_of_a_run_what_an_object_does_not_have_is_not_shown():
    found = as_mapping(SimpleNamespace(W=1, other=2), "simulate")
    assert found["W"] == 1 and found["F"] is None and "other" not in found


def test_layers_are_taken_in_their_order_and_all_by_default():
    assert chosen_layers(None) == LAYERS
    assert chosen_layers(["L7", "LE", "L0"]) == ("L0", "L7", "LE")


@pytest.mark.parametrize(
    "text, cure",
    [
        ("class Mine:\n    pass\nclass Other(Mine):\n    pass\n", "Write {0}:Mine or {0}:Other."),
        ("raise SystemExit\n", "There is no class in it; write one with simulate(problem)."),
        (None, "The file is not there; give path/to/file.py:Class."),
    ],
)
def test_a_file_without_a_class_is_told_which_there_are_and_is_not_run(tmp_path, text, cure):
    path = tmp_path / "mine.py"
    if text is not None:
        path.write_text(text)
    with pytest.raises(InputError) as refused:
        load(str(path))
    assert (refused.value.code, refused.value.cure) == ("E-BACKEND", cure.format(path))


def test_a_program_is_told_how_programs_are_judged(tmp_path):
    path = tmp_path / "mine"
    path.write_bytes(b"\x7fELF")
    assert f"rockref conform exe {path}" in refused(str(path))
