"""The judge of the mutants: what counts as killed, what is a survivor, when the floor holds."""

import json

import pytest

from tests import mutation

NORM, PICK = "rockref.model.contact.x_norm__mutmut_", "rockref.model.response.xǁResponseǁcontacts__mutmut_"
VERDICTS = {f"{NORM}1": 1, f"{NORM}2": 36, f"{NORM}9": 0, f"{PICK}23": 0}
PAGE = "The floor is 50.00 % in `rockref/model`."
KNOWN = {"model.contact.norm 9", "model.contact.norm 29"}


def test_names_are_those_of_the_code():
    assert mutation.readable(f"{NORM}9") == "model.contact.norm 9"
    assert mutation.readable(f"{PICK}23") == "model.response.Response.contacts 23"
    assert mutation.readable("rockref.model.problem.x__stack__mutmut_3") == "model.problem._stack 3"


def test_a_run_without_end_is_killed_and_one_without_verdict_is_open():
    s = mutation.score({**VERDICTS, f"{NORM}3": None, f"{NORM}4": -11})
    assert (s.all, s.killed, s.timeouts) == (6, 2, 1)
    assert s.survivors == ["model.contact.norm 9", "model.response.Response.contacts 23"]
    assert s.undecided == ["model.contact.norm 3", "model.contact.norm 4"]
    assert s.percent == pytest.approx(200 / 6)
    assert mutation.score({}).percent == 0


def test_what_no_test_reaches_survives():
    assert mutation.score({f"{NORM}1": 33}).survivors == ["model.contact.norm 1"]


def test_survivors_that_are_not_in_the_table_are_named():
    text, _ = mutation.report({"rockref/model/contact.py": VERDICTS}, PAGE, KNOWN)
    assert "not in mutation_survivors.csv: model.response.Response.contacts 23\n" in text
    assert "not in mutation_survivors.csv: model.contact.norm 9" not in text
    assert "in mutation_survivors.csv, and no survivor: model.contact.norm 29\n" in text
    assert text.endswith("model: 2 of 4 mutants killed: 50.00 %, the floor is 50.00 %")


@pytest.mark.parametrize("floor, more, holds", [(50.0, {}, True), (50.1, {}, False), (10.0, {f"{NORM}3": None}, False)])
def test_the_floor(floor, more, holds):
    page = PAGE.replace("50.00", f"{floor:.2f}")
    assert mutation.report({"rockref/model/contact.py": {**VERDICTS, **more}}, page, KNOWN)[1] is holds


def test_a_row_of_the_table_tells_its_mutants():
    assert mutation.listed(["function,mutants,why", 'model.contact.norm,"9, 29",as before']) == KNOWN
    known = mutation.listed(mutation.KNOWN.read_text("utf-8").splitlines())
    assert len(known) > 200 and all(name.split(".")[0] in ("model", "effects", "measure") for name in known)


def test_the_page_states_its_floors():
    page = (mutation.ROOT / "docs" / "mutation.md").read_text("utf-8")
    floors = mutation.floors_of(page)
    assert set(floors) == {"model", "effects", "measure"} and all(0 < floor <= 100 for floor in floors.values())
    with pytest.raises(LookupError):
        mutation.floors_of("There is none.")


def test_each_folder_has_its_own_floor():
    """Three of four in one cannot make up for one of four in the other."""
    page = "The floor is 50.00 % in `rockref/model`, 70.00 % in `rockref/measure`.\n"
    low, high = {f"{NORM}{k}": int(k == 1) for k in range(4)}, {f"{NORM}{k}": int(k > 1) for k in range(4, 8)}
    assert not mutation.report({"rockref/model/a.py": low, "rockref/measure/a.py": high}, page, set())[1]
    assert mutation.report({"rockref/model/a.py": high, "rockref/measure/a.py": high}, page, set())[1]


def test_verdicts_are_read_file_by_file(tmp_path):
    (tmp_path / "rockref").mkdir()
    (tmp_path / "rockref" / "a.py.meta").write_text(json.dumps({"exit_code_by_key": VERDICTS}))
    (tmp_path / "rockref" / "empty.py.meta").write_text(json.dumps({"exit_code_by_key": {}}))
    assert mutation.found(tmp_path) == {"rockref/a.py": VERDICTS}
