"""What a fit moves of the law acts in the model; what states its points otherwise is left out, or refused."""

import json

import numpy as np
import pytest

from rockref import InputError, Model, cli
from rockref.discover.fit.baseline import baseline_parameters, moved_parameters
from rockref.effects.catalogue import parse
from rockref.identify.sensitivity import last_digits, significant_digits
from rockref.model.parameters import GENES_12, PROPERTIES
from tests.shipped import two_runs

TABLE = Model.table_3_1()
STATED = {key: getattr(TABLE.body()[1], key) for key in PROPERTIES}
MODELS = {
    "eight": TABLE,
    "four": Model.four_points(),
    "eight, properties": TABLE.replace(properties=STATED),
    "four, properties": Model.four_points().replace(properties=STATED),
    "custom": TABLE.replace(points="custom", custom_points=TABLE.body()[1]),
    "custom, properties": TABLE.replace(points="custom", custom_points=TABLE.body()[1], properties=STATED),
}
IDLE = ["four, properties", "custom", "custom, properties"]


def moved(model, name):
    """The model with one of the twelve a tenth larger."""
    if name.startswith("delta_long"):
        heights = [h * (1.1 if k == int(name[-1]) - 1 else 1.0) for k, h in enumerate(model.parameters.delta_long)]
        return model.replace(delta_long=tuple(heights))
    return model.replace(**{name: 1.1 * getattr(model.parameters, name)})


def released(model):
    """All that the engines see of a model."""
    problem = model.problem()
    q = [getattr(problem.points, key) for key in ("P", *PROPERTIES)]
    return np.concatenate([np.ravel(v) for v in (*q, problem.start.x, problem.start.Lambda, problem.block.mass)])


@pytest.mark.parametrize("name", MODELS)
def test_the_parameters_that_act_are_those_that_change_something(name):
    model = MODELS[name]
    acting = [g for g in GENES_12 if not np.array_equal(released(moved(model, g)), released(model))]
    assert model.acting_parameters() == tuple(acting)


@pytest.mark.parametrize("name", [n for n in MODELS if n not in IDLE])
def test_all_that_a_fit_moves_acts(name):
    model = MODELS[name]
    shared = baseline_parameters(model, 0, 1e-3)
    assert len(shared) == {"eight": 11, "four": 4, "eight, properties": 5}[name]
    for p in shared:
        assert np.array_equal(released(p.set(model, p.value(0.0))), released(model)), "the centre is the model"
        assert not np.array_equal(released(p.set(model, p.value(1.0))), released(model)), p.name


@pytest.mark.parametrize("name", IDLE)
def test_a_model_with_nothing_to_move_is_refused(name):
    with pytest.raises(InputError, match="E-MOOT"):
        moved_parameters(MODELS[name])
    with pytest.raises(InputError, match="E-MOOT"):
        baseline_parameters(MODELS[name], 2, 1e-3)


def said(capsys, *words):
    with pytest.raises(SystemExit) as end:
        cli.main([str(w) for w in words])
    return end.value.code, capsys.readouterr()


COMMANDS = [
    "fit EXPERIMENT",
    "diagnose EXPERIMENT",
    "add gyro_scale EXPERIMENT",
    "plan",
    "identify EXPERIMENT",
    "sensitivity",
]


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["four, properties", "custom"])
def test_every_command_that_moves_parameters_refuses_it_before_the_work(capsys, tmp_path, monkeypatch, command, name):
    MODELS[name].save(tmp_path / "stated.toml")
    two_runs(tmp_path / "EXPERIMENT")
    monkeypatch.chdir(tmp_path)
    code, told = said(capsys, *command.split(), "--model", "stated.toml")
    assert code == 2 and "[E-MOOT]" in told.err and told.out == ""


def test_identify_finds_properties_only_as_54(capsys, tmp_path, monkeypatch):
    MODELS["eight, properties"].save(tmp_path / "stated.toml")
    two_runs(tmp_path / "EXPERIMENT")
    monkeypatch.chdir(tmp_path)
    code, told = said(capsys, "identify", "EXPERIMENT", "--model", "stated.toml")
    assert code == 2 and "Use --genes 54" in told.err


def test_identify_does_not_search_eight_points_for_a_model_on_four(capsys, tmp_path, monkeypatch):
    two_runs(tmp_path / "EXPERIMENT")
    monkeypatch.chdir(tmp_path)
    code, told = said(capsys, "identify", "EXPERIMENT", "--model", "four_points")
    assert code == 2 and "stands on four points, and eight are searched" in told.err and "[E-MOOT]" in told.err


@pytest.mark.parametrize(
    "command, place",
    [
        ("fit EXPERIMENT", "rockref.discover.fit_baseline.fit_baseline"),
        ("diagnose EXPERIMENT", "rockref.discover.diagnose.diagnose"),
        ("add gyro_scale EXPERIMENT", "rockref.discover.add_effect.add_effect"),
        ("plan", "rockref.discover.plan.plan"),
    ],
)
def test_what_is_left_out_is_said(capsys, tmp_path, monkeypatch, command, place):
    def work(*given, **named):
        raise InputError("E-STOP", "here", "stop", "")

    two_runs(tmp_path / "EXPERIMENT")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(place, work)
    for name, remarks in (("eight, properties", 1), ("eight", 0), ("four", 0)):
        MODELS[name].save("m.toml")
        code, told = said(capsys, *command.split(), "--model", "m.toml")
        assert code == 2 and "[E-STOP]" in told.err and told.err.count("[W-MOOT]") == remarks, name
        feet = "delta_long_1, delta_long_2, delta_long_3, delta_long_4, delta_diag"
        assert ("m.toml: [properties]: states stiffness" in told.err and feet in told.err) == bool(remarks)


def test_identify_says_that_it_leaves_effects_out(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    TABLE.replace(effects=(parse("quadratic_drag:c=0.4"),)).save("dragged.toml")
    code, told = said(capsys, "identify", "anywhere", "--model", "dragged.toml")
    assert code == 2 and "dragged.toml: has quadratic_drag, and the law alone is searched" in told.err


@pytest.mark.slow
def test_a_fit_of_stated_properties_moves_the_feet_alone_and_says_so(capsys, tmp_path, monkeypatch):
    """A minute: the properties are those of another block, so the fit is not trusted, and that is said, too."""
    MODELS["eight, properties"].save(tmp_path / "stated.toml")
    two_runs(tmp_path / "EXPERIMENT")
    monkeypatch.chdir(tmp_path)
    words = ("fit", "EXPERIMENT", "--model", "stated.toml", "-o", "fitted.toml", "--no-gates", "--json")
    code, told = said(capsys, *words)
    assert code == 0
    assert "stated.toml: [properties]: states stiffness" in told.err and "[W-MOOT]" in told.err
    feet = {"delta_long_1", "delta_long_2", "delta_long_3", "delta_long_4", "delta_diag"}
    found = json.loads(told.out)["parameters"]
    assert {name for name in found if "[" not in name} == feet
    model = Model.load("fitted.toml")
    assert all(np.array_equal(model.properties[key], STATED[key]) for key in PROPERTIES)
    assert {name for name in model.uncertainty} == feet


@pytest.mark.parametrize("name", ["four", "eight, properties"])
def test_digits_are_those_of_what_acts(name):
    """Four even feet stay in their plane: about the other two axes nothing moves, which is no difference."""
    digits = significant_digits(MODELS[name], workers=1, most=4)
    assert tuple(d.name for d in digits) == MODELS[name].acting_parameters()
    assert (max(d.change_stated for d in digits) > 0.01) == (name != "four")
    f = last_digits(MODELS[name], seed=1, trials=1, duration=0.6, workers=1)
    assert not np.array_equal(f.crv[0], f.crv[1]), "what acts is varied"
