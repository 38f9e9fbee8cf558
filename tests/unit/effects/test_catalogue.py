"""The catalogue: ids, what each effect says of itself, effects from words and tables."""

import ast
import inspect
import re
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import rockref.effects
from rockref import InputError, Model
from rockref.effects import catalogue
from rockref.effects.base import HOOKS, UNDO_HOOKS, Effect, Quantity, limits
from rockref.effects.catalogue import EFFECTS, NONE, QUESTIONS
from rockref.effects.nothing_added import TrackedAsDrawn
from rockref.effects.user import check_class
from tests.refusal import refused

TABLE = {
    "contact": "hertzian_contact hunt_crossley_contact hysteretic_contact adhesion uneven_foot_stiffness "
    "uneven_foot_damping",
    "friction": "stribeck_friction viscous_friction load_dependent_friction spin_friction rolling_resistance "
    "uneven_foot_friction",
    "shape": "foot_defects rounded_feet uneven_contact_normals mass_eccentricity inertia_deviation dimension_deviation",
    "loads": "quadratic_drag cable_restraint lingering_wire_pull base_vibration plate_tilt",
    "support": "compliant_support",
    "release": "release_velocity",
    "sensor": "gyro_misalignment gyro_scale gyro_drift gyro_bandwidth gyro_saturation clock_error",
}
EVERY = list(EFFECTS.values())
FOLDER = Path(rockref.effects.__file__).parent


def test_the_ids_are_those_that_files_and_verdicts_know():
    """They are fixed: a saved model or verdict names them."""
    assert {q: {e.id for e in answers} - {"none"} for q, answers in QUESTIONS.items()} == {
        q: set(ids.split()) for q, ids in TABLE.items()
    }


def test_a_folder_per_question_a_file_per_answer():
    for question, ids in TABLE.items():
        for id in ids.split():
            assert (FOLDER / question / f"{id}.py").is_file(), f"{question}/{id}"
        assert QUESTIONS[question][0] is NONE[question]
        assert NONE[question].question == question and NONE[question].sentence and NONE[question].equation
    assert {path.name for path in FOLDER.iterdir() if (path / "__init__.py").is_file()} == {*TABLE, "tracking"}
    assert TrackedAsDrawn.question == "tracking" and TrackedAsDrawn().is_absent()


@pytest.mark.parametrize("kind", EVERY, ids=lambda kind: kind.id)
def test_every_effect_says_what_a_reader_needs(kind):
    check_class(kind, kind.id)
    assert inspect.getfile(kind) == str(FOLDER / kind.question / f"{kind.id}.py")
    assert 40 < len(kind.sentence) < 140 and kind.sentence.endswith(".")
    assert len(kind.equation) > 5 and len(kind.experiment) > 30 and len(kind.source) > 20
    assert re.search(r"doi:10|no DOI", kind.source), "a source has a DOI, or says why it has none"
    for doi in re.findall(r"doi:\s*(\S+)", kind.source):
        assert re.match(r"10\.\d{4}/\S+[\w)]", doi.rstrip(",;"))
    assert kind.confounder in EFFECTS and kind.confounder != kind.id
    for quantity in kind.quantities.values():
        assert quantity.unit in {
            "1", "m", "N", "N/m", "N s/m", "N s2/m2", "N m s2", "s", "s/m", "m/s", "m/s2", "kg", "Hz", "rad", "rad/s",
            "rad/s2", "1/s",
        }  # fmt: skip
        assert quantity.meaning and quantity.sign in ("+", "any")
        assert quantity.least <= quantity.low < quantity.high <= quantity.most
        assert quantity.typical is None or quantity.low <= quantity.typical <= quantity.high


@pytest.mark.parametrize("kind", EVERY, ids=lambda kind: kind.id)
def test_defaults_are_absent_and_typical_is_not(kind):
    absent, typical = kind(), kind.typical()
    assert absent.is_absent() and not typical.is_absent()
    assert absent.values() == {name: quantity.absent for name, quantity in kind.quantities.items()}
    absent.check("here")
    typical.check("here")
    # A parameter may be typically none (a product of inertia), if others of the effect are not.
    for name in (
        n for n in kind.switches or kind.quantities if kind.quantities[n].typical != kind.quantities[n].absent
    ):
        alone = kind(**{name: kind.quantities[name].typical})
        assert not alone.is_absent(), name
    for name in set(kind.quantities) - set(kind.switches or kind.quantities):
        if kind.quantities[name].typical is not None:
            assert kind(**{name: kind.quantities[name].typical}).is_absent(), name


@pytest.mark.parametrize(
    "id, other, own, others",
    [
        ("uneven_foot_stiffness", "uneven_foot_friction", "pitch", "pull"),
        ("uneven_foot_damping", "uneven_foot_stiffness", "ringing die", "pitch"),
        ("uneven_foot_friction", "uneven_foot_stiffness", "pull", "pitch"),
        ("release_velocity", "lingering_wire_pull", "moves from the first picture", "begin at rest"),
        ("lingering_wire_pull", "release_velocity", "begins at rest", "moves from the first picture"),
    ],
)
def test_the_experiment_shows_what_the_one_does_and_the_other_does_not(id, other, own, others):
    """What belongs to a foot turns with the block, whatever it is: turning alone does not tell one from the other."""
    assert EFFECTS[id].confounder == other
    assert own in EFFECTS[id].experiment and others in EFFECTS[id].experiment


def test_effects_are_short():
    """Ten to sixty lines each of what an effect says and does: imports, docstrings and empty lines are not counted."""
    for question, ids in TABLE.items():
        for id in ids.split():
            text = (FOLDER / question / f"{id}.py").read_text(encoding="utf-8")
            (kind,) = (node for node in ast.parse(text).body if isinstance(node, ast.ClassDef))
            own = text.splitlines()[kind.body[0].end_lineno : kind.end_lineno]
            assert 10 <= len([line for line in own if line.strip()]) <= 60, id


@pytest.mark.parametrize(
    "text, code, said",
    [
        ("quadratic_drg:c=1", "E-EFFECT", "Did you mean 'quadratic_drag'"),
        ("gyro_scale:factor=1", "E-KEY", "It has x, y, z"),
        ("quadratic_drag:c=-1", "E-RANGE", "of at least 0 N m s2; plausible is 0.002 to 5 N m s2"),
        ("quadratic_drag:c=nan", "E-TYPE", "in N m s2"),
        ("quadratic_drag:c=inf", "E-RANGE", "plausible"),
        ("adhesion:force=1,range=0", "E-RANGE", "above 0"),
        ("", "E-EFFECT", "there is no effect ''"),
        ("quadratic_drag:c=0.4, c =0.4", "E-KEY", "'c' is given twice"),
        ("tag_fram", "E-EFFECT", "Did you mean 'tag_frame'"),
    ],
)
def test_parse_says_what_is_wrong(text, code, said):
    error = refused(catalogue.parse, text)
    assert error.code == code
    assert said in str(error)


@pytest.mark.parametrize(
    "id, shape, brought_in",
    [
        (
            "cable_restraint",
            {"height": 0.1},
            {"k": 5.0, "c": 0.3, "height": 0.1, "stiffening": 0.0, "reference": 0.08},
        ),
        ("lingering_wire_pull", {"tau": 0.2}, {"force": 3.0, "tau": 0.2, "evenness": 0.0}),
        ("quadratic_drag", {}, {"c": 0.4, "c_v": 1.0}),
    ],
)
def test_an_effect_that_is_named_is_there(id, shape, brought_in):
    """By words and in a file alike: what brings it in is typical where only its shape, or nothing, is given."""
    words = ",".join(f"{key}={value}" for key, value in shape.items())
    assert catalogue.parse(f"{id}:{words}").values() == brought_in
    (effect,) = catalogue.from_table("model.toml", {id: shape})
    assert effect.values() == brought_in


def test_an_effect_at_its_absent_value_is_absent():
    """Who writes the value gets it: a model that is saved with an absent effect comes back as it was."""
    assert catalogue.parse("cable_restraint:k=0").is_absent()
    assert catalogue.from_table("model.toml", {"cable_restraint": {"k": 0.0, "c": 0.0}})[0].is_absent()


@pytest.mark.parametrize(
    "table, code, said",
    [
        ({"quadratic_drag": {"c": "0.4"}}, "E-TYPE", "is '0.4'"),
        ({"quadratic_drag": {"c": True}}, "E-TYPE", "is True"),
        ({"quadratic_drag": {"c": [0.4]}}, "E-TYPE", "is [0.4]"),
        ({"quadratic_drag": {"c": 10**400}}, "E-RANGE", "is inf N m s2"),
        ({"plate_tilt": {"x": -(10**400)}}, "E-RANGE", "is -inf rad"),
    ],
)
def test_from_table_says_what_is_wrong(table, code, said):
    error = refused(catalogue.from_table, "model.toml", table)
    assert error.code == code
    assert said in str(error)


def test_effects_stand_in_step_order_however_given():
    mixed = [EFFECTS[i].typical() for i in ("clock_error", "gyro_scale", "hysteretic_contact", "hertzian_contact")]
    ordered = catalogue.in_step_order(mixed)
    assert [e.id for e in ordered] == ["hertzian_contact", "hysteretic_contact", "gyro_scale", "clock_error"]
    model = Model.table_3_1().replace(effects=tuple(mixed))
    assert model.active_effects() == ordered
    with pytest.raises(InputError, match="given twice"):
        catalogue.in_step_order([*mixed, EFFECTS["gyro_scale"]()])


def test_model_file_keeps_every_effect(tmp_path):
    """Infinity (no bandwidth limit), None (the top) and every number come back as they were."""
    for effects in (
        tuple(kind.typical() for kind in EVERY if kind.id != "foot_defects"),
        tuple(kind() for kind in EVERY),
        (EFFECTS["cable_restraint"](k=0.1, height=0.2), EFFECTS["gyro_bandwidth"](1 / 3)),
    ):
        Model.table_3_1().replace(effects=effects).save(tmp_path / "model.toml")
        back = Model.load(tmp_path / "model.toml").effects
        assert {e.id: e for e in back} == {e.id: e for e in effects}


def test_numpy_numbers_are_numbers():
    effect = EFFECTS["quadratic_drag"](np.float64(0.3))
    effect.check("here")
    assert catalogue.to_table([effect]) == {"quadratic_drag": {"c": 0.3, "c_v": 0.0}}


def test_limits_in_words():
    assert limits(Quantity("m", 0.0, 1.0, 2.0, 1.5)) == "a number that is finite; plausible is 1 to 2 m"
    assert limits(Quantity("1", 0.0, 1.0, 2.0, 1.5, least=0.0, most=3.0)) == (
        "a number of at least 0 and of at most 3; plausible is 1 to 2"
    )


def test_hooks_are_the_methods_of_the_base():
    methods = {n for n, f in vars(Effect).items() if inspect.isfunction(f)} - {"values", "is_absent", "check", "within"}
    methods = {m for m in methods if not m.startswith("__")}
    assert methods == set(HOOKS | UNDO_HOOKS)
    for name, arguments in (HOOKS | UNDO_HOOKS).items():
        assert tuple(inspect.signature(getattr(Effect, name)).parameters)[1:] == arguments
    assert not fields(Effect)


@pytest.mark.parametrize(
    "words", ["x" * 5000, "quadratic_drag:" + "c" * 5000 + "=1", "quadratic_drag:c=" + "\udcff" * 5000, "a\0.py:Mine"]
)
def test_messages_about_long_or_strange_words_can_be_read(words):
    error = refused(catalogue.parse, words)
    assert len(str(error)) < 1000


def test_a_long_id_in_a_model_file_is_cut_in_the_message():
    error = refused(catalogue.from_table, "model.toml", {"x" * 5000: {}})
    assert len(str(error)) < 1000
