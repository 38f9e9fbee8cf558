"""Effects by name: from words and tables, a user's own from his files, and who may have a file run."""

import os
from pathlib import Path

import pytest

from rockref.effects import catalogue
from rockref.effects.catalogue import EFFECTS, OF_TOSSES, SHOWN, file_beside, find, from_table, named, parse, to_table
from tests.refusal import refusal

MINE = """
from dataclasses import dataclass
from rockref.effects.base import Effect, Quantity

@dataclass(frozen=True)
class Mine(Effect):
    id = "mine"
    quantities = {"c": Quantity("rad/s", 0.0, 0.1, 10.0, 1.5), "d": Quantity("1", 1.0, 0.5, 2.0, 1.25)}
    c: float = 0.0
    d: float = 1.0
    def sensor(self, t, crv):
        return crv + self.c
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    """A current folder with a user's effect, in a process that has been told of none."""
    (tmp_path / "mine.py").write_text(MINE, encoding="utf-8")
    (tmp_path / "models").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(catalogue, "OWN", {})
    monkeypatch.setattr(catalogue, "NAMED", set())
    return tmp_path


def test_words_and_paths_are_cut_where_they_say_least():
    """Words at their end, a path at its beginning: eighty characters are shown whole."""
    words = "".join(chr(ord("a") + i % 26) for i in range(200))
    assert catalogue.short(words[:SHOWN]) == catalogue.short_path(words[:SHOWN]) == words[:80]
    assert catalogue.short(words) == words[:77] + "..." and catalogue.short_path(words) == "..." + words[-77:]


def test_an_id_finds_its_effect_and_a_strange_one_its_neighbour():
    assert find("adhesion") is EFFECTS["adhesion"] and find("tag_frame") is OF_TOSSES["tag_frame"]
    said = ("E-EFFECT", "effect", "there is no effect 'Adhesio'", "Did you mean 'adhesion'?")
    assert refusal(find, "Adhesio") == said
    said = ("E-EFFECT", "effect", "there is no effect 'rolling'", "Did you mean 'rolling_resistance'?")
    assert refusal(find, "rolling") == said
    # Four are named, more are not; of near ones the nearest.
    assert refusal(find, "uneven")[3] == (
        "Did you mean 'uneven_foot_stiffness' or 'uneven_foot_damping' or 'uneven_foot_friction' or "
        "'uneven_contact_normals'?"
    )
    assert refusal(find, "gyro")[3] == "`rockref effects` lists them."
    assert refusal(find, "uneven_foot_frictio")[3] == "Did you mean 'uneven_foot_friction'?"
    said = ("E-EFFECT", "here", "there is no effect 'wind'", "`rockref effects` lists them.")
    assert refusal(find, "wind", "here") == refusal(named, "wind", "here") == said
    assert refusal(named, "wind")[1] == "effect"
    said = ("E-EFFECT", "here", "'none' is what holds where no effect is named", "Leave it out.")
    assert refusal(find, "none", "here") == said


def test_a_file_is_run_for_the_user_who_names_it_and_its_id_known_from_then_on(folder):
    assert refusal(find, "mine")[0] == "E-EFFECT"
    kind = named(" mine.py:Mine ")
    assert kind.id == "mine" and find("mine") is kind and named("mine") is kind
    assert {os.path.realpath(folder / "mine.py")} == catalogue.NAMED
    assert (
        refusal(named, " mine.py ")[0] == "E-EFFECT"
        and refusal(named, "mine.py")[2] == "names a file, but no class in it"
    )


@pytest.mark.parametrize("id", ["plate_tilt", "tag_frame"])
def test_a_users_own_has_an_id_of_its_own(folder, id):
    (folder / "mine.py").write_text(MINE.replace('"mine"', f'"{id}"'), encoding="utf-8")
    said = ("E-EFFECT", "mine.py:Mine", f"the id '{id}' is that of a built-in effect", "Choose another id.")
    assert refusal(named, "mine.py:Mine") == said and catalogue.OWN == {}


def test_words_name_an_effect_and_its_numbers():
    assert parse(" gyro_scale : x = 1.02 , y=0.98, ") == EFFECTS["gyro_scale"](1.02, 0.98)
    assert parse("gyro_scale") == EFFECTS["gyro_scale"].typical()
    assert parse("mine.py:Mine:c=2").values() == {"c": 2.0, "d": 1.0}
    assert parse("mine.py:Mine").values() == {"c": 1.5, "d": 1.25} == parse("mine").values()
    assert refusal(parse, "mine.py:Mine:c=other.py:1")[2] == "'other.py:1' is no number"
    assert parse("mine.py:Mine:d=0.75,c=0.5").values() == {"c": 0.5, "d": 0.75}


GIVE = "Write gyro_scale:name=number, with commas between."


@pytest.mark.parametrize(
    "words, code, what, cure",
    [
        ("x=1,x=2", "E-KEY", "'x' is given twice", "Give each parameter once."),
        ("1.02", "E-TYPE", "'1.02' is no parameter", GIVE),
        ("x=much", "E-TYPE", "'much' is no number", GIVE),
        ("02", "E-TYPE", "'02' is no parameter", GIVE),
        ("x=1,02", "E-TYPE", "'02' is no parameter", "The decimal mark is a point: write x=1.02."),
        ("x=1=2", "E-TYPE", "'1=2' is no number", GIVE),
        ("x=1:2", "E-TYPE", "'1:2' is no number", GIVE),
        ("X=1", "E-KEY", "gyro_scale has no parameter 'X'", "Did you mean 'x'?"),
    ],
)
def test_words_that_cannot_be_read_are_told(words, code, what, cure):
    assert refusal(parse, f"gyro_scale:{words}") == (code, f"--effect gyro_scale:{words}", what, cure)
    assert refusal(parse, f"gyro_scale:{words}", "here")[1] == f"here gyro_scale:{words}"


def test_the_place_of_words_is_theirs_too_where_the_numbers_are_wrong():
    code, where, *_ = refusal(parse, "gyro_saturation:range=-1", "here")
    assert (code, where) == ("E-RANGE", "here gyro_saturation:range=-1: gyro_saturation range")
    assert refusal(parse, "mine.py:Mine:c=2:3", "here")[2] == "'2:3' is no number"
    assert refusal(parse, "wind")[1] == "--effect" and refusal(parse, "wind", "here")[1] == "here"
    long = "gyro_scale:x=" + "much" * 50
    assert refusal(parse, long)[1:3] == (f"--effect {long[:77]}...", f"{long[13:90]!r}"[:-1] + "...' is no number")


def test_a_table_brings_back_what_was_written():
    effects = (EFFECTS["adhesion"](3.0, 1e-5), EFFECTS["cable_restraint"](0.5, 0.25), parse("mine.py:Mine:c=2"))
    table = to_table(effects, Path("models"))
    assert table == {
        "adhesion": {"force": 3.0, "range": 1e-5},
        "cable_restraint": {"k": 0.5, "c": 0.25, "stiffening": 0.0, "reference": 0.08},
        "mine": {"file": "../mine.py:Mine", "c": 2.0, "d": 1.0},
    }  # fmt: skip
    back = from_table("model.toml", table, Path("models"))
    assert [(e.id, e.values()) for e in back] == [(e.id, e.values()) for e in effects]
    assert table["mine"]["file"] == "../mine.py:Mine" and to_table(effects)["mine"]["file"] == "mine.py:Mine"
    assert from_table("model.toml", {"mine": {}})[0].values() == {"c": 1.5, "d": 1.25}
    assert from_table("model.toml", {}) == ()


@pytest.mark.parametrize(
    "table, code, where, what, cure",
    [
        ([], "E-TYPE", "m: effects", "is not a table", "Write [effects.quadratic_drag] and c = 0.4."),
        ({"adhesion": 2}, "E-TYPE", "m: [effects.adhesion]", "is 2",
         "Write [effects.adhesion] and its parameters below."),
        ({"adhesion": "a" * 99}, "E-TYPE", "m: [effects.adhesion]", "is '" + "a" * 76,
         "Write [effects.adhesion] and its parameters below."),
        ({"wind": {}}, "E-EFFECT", "m: [effects.wind]", "there is no effect 'wind'", "`rockref effects` lists them."),
        ({"adhesion": {"rang": 1.0}}, "E-KEY", "m: [effects.adhesion]", "adhesion has no parameter 'rang'",
         "Did you mean 'range'?"),
        ({"mine": {"file": 3}}, "E-TYPE", "m: [effects.mine] file", "is 3", 'Write file = "path/to/file.py:Class".'),
        ({"mine": {"file": [9] * 99}}, "E-TYPE", "m: [effects.mine] file", "is [" + "9, " * 25 + "9",
         'Write file = "path/to/file.py:Class".'),
        ({"mine": {"file": "no.py:Mine"}}, "E-FILE", "m: [effects.mine]", "names 'no.py', which is no file",
         "Check the path."),
    ],
)  # fmt: skip
def test_a_table_that_cannot_be_read_is_told(table, code, where, what, cure):
    assert refusal(from_table, "m", table) == (code, where, what, cure)


def test_a_file_whose_effect_is_another_is_told():
    named("mine.py:Mine")
    said = ("E-EFFECT", "m: [effects.other]", "but the effect in mine.py:Mine is 'mine'", "Write [effects.mine].")
    assert refusal(from_table, "m", {"other": {"file": "mine.py:Mine"}}) == said


def test_no_file_is_run_that_the_user_has_not_named(folder):
    """The message gives the words to type, quoted for a shell, from the current folder."""
    marker = folder / "was_run"
    program = f"open({str(marker)!r}, 'w').close()\n" + MINE
    (folder / "models/a b.py").write_text(program, encoding="utf-8")
    table = {"mine": {"file": "a b.py:Mine"}}
    code, where, what, cure = refusal(from_table, "m", table, Path("models"))
    assert (code, where) == ("E-TRUST", "m: [effects.mine]") and not marker.exists()
    assert what == "names 'models/a b.py:Mine', a program, which nothing runs unless you name it, too"
    assert cure == "If you trust it, add --effect 'models/a b.py:Mine'; in Python, Model.load(path, effects=[...])."
    (folder / "models/ab.py").write_text(program, encoding="utf-8")
    cure = refusal(from_table, "m", {"mine": {"file": "ab.py:Mine"}}, Path("models"))[3]
    assert cure.startswith("If you trust it, add --effect models/ab.py:Mine;") and not marker.exists()
    cure = refusal(from_table, "m", {"mine": {"file": "../mine.py:Mine"}}, Path("models"))[3]
    assert cure.startswith("If you trust it, add --effect mine.py:Mine;")
    named("models/a b.py:Mine")
    assert marker.exists() and from_table("m", table, Path("models"))[0].values() == {"c": 1.5, "d": 1.25}


def test_a_name_that_no_terminal_shows_is_written_out(folder):
    (folder / "a\tb.py").write_text(MINE, encoding="utf-8")
    _, _, what, cure = refusal(from_table, "m", {"mine": {"file": "a\tb.py:Mine"}})
    assert "names 'a\\tb.py:Mine', a program" in what and "--effect 'a\\tb.py:Mine';" in cure


def test_a_file_is_looked_for_beside_the_model_first_and_then_in_the_current_folder(folder):
    named("mine.py:Mine")
    table = {"mine": {"file": "mine.py:Mine"}}
    assert from_table("m", table, Path("models"))[0].file == "mine.py:Mine"
    (folder / "models/mine.py").write_text(MINE.replace("1.5", "2.5"), encoding="utf-8")
    assert refusal(from_table, "m", table, Path("models"))[0] == "E-TRUST"
    named("models/mine.py:Mine")
    (beside,) = from_table("m", table, Path("models"))
    assert beside.file == "models/mine.py:Mine" and beside.values()["c"] == 2.5
    assert from_table("m", table)[0].values()["c"] == 1.5
    assert refusal(from_table, "m", {"mine": {"file": "none.py:Mine"}}, Path("models"))[2] == (
        "names 'models/none.py', which is no file"
    )
    assert refusal(from_table, "m", {"mine": {"file": "Mine"}}, Path("models"))[1] == "Mine"


def test_a_file_is_written_as_it_is_found_from_the_models_folder(folder, monkeypatch):
    assert file_beside("mine.py:Mine", Path("models")) == "../mine.py:Mine"
    assert file_beside("mine.py:Mine", None) == "mine.py:Mine"
    assert file_beside("/else/where.py:Mine", Path("models")) == "/else/where.py:Mine"
    os.symlink(folder / "models", folder / "linked")
    monkeypatch.chdir(folder / "models")
    assert file_beside("../mine.py:Mine", folder / "linked") == "../mine.py:Mine"
    assert file_beside("a:b/../mine.py:Mine", folder) == "models/mine.py:Mine"


def test_a_file_on_another_drive_is_written_with_its_whole_path(folder, monkeypatch):
    """As Windows has them: from one to the other there is no way."""

    def no_way(path, start):
        raise ValueError("path is on mount 'C:', start on mount 'D:'")

    with monkeypatch.context() as windows:
        windows.setattr(os.path, "relpath", no_way)
        found = file_beside("mine.py:Mine", Path("models"))
    assert found == f"{os.path.realpath(folder)}/mine.py:Mine"


class TestOfReleases:
    """What a user may ask of records of a gyroscope."""

    def test_ids_and_own_files_in_their_order(self):
        kinds = catalogue.of_releases(("quadratic_drag", "mine.py:Mine"))
        assert [kind.id for kind in kinds] == ["quadratic_drag", "mine"]
        assert catalogue.of_releases(()) == ()

    def test_one_that_is_given_twice(self):
        code, where, what, cure = refusal(catalogue.of_releases, ("gyro_scale", "quadratic_drag", "gyro_scale"))
        assert (code, where) == ("E-EFFECT", "--effect")
        assert what == "gyro_scale, quadratic_drag, gyro_scale: one is given twice"
        assert cure == "Give each once."

    @pytest.mark.parametrize("id", sorted(OF_TOSSES))
    def test_one_that_only_tosses_show(self, id):
        code, where, what, cure = refusal(catalogue.of_releases, ("gyro_scale", id), "--candidates")
        assert (code, where) == ("E-EFFECT", "--candidates")
        assert what == f"{id} is how the poses of tosses are read, and no gyroscope shows it"
        assert cure == "Leave it out; `rockref effects` says which are of tosses only."

    def test_one_that_nobody_knows_is_told_from_there(self):
        assert refusal(catalogue.of_releases, ("no_such",))[0] == "E-EFFECT"
