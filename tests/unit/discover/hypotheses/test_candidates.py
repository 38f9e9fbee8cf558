"""Effects as numbers that a fit moves: absent at zero, typical at one, and back."""

from itertools import product
from pathlib import Path

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.discover import plan as planning
from rockref.discover.fit_baseline import known_effects
from rockref.discover.hypotheses import candidates
from rockref.discover.hypotheses.candidates import (
    LEFT_OUT,
    PRIORS,
    kinds,
    parameters_of,
    within_base,
)
from rockref.effects import catalogue
from rockref.effects.prior import TYPICALLY_NONE
from rockref.effects.scale import prior_of, to_scale
from tests.unit.discover.hypotheses.counted import PARAMETERS

TABLE = Model.table_3_1()
#: Numbers that shape an effect but do not bring it in, and those that are typically none.
SHAPES = {key for key, p in PRIORS.items() if p.role == "shape"}
SELDOM = {key: p.spread for key, p in PRIORS.items() if p.role in ("size", "form") and p.deviation == TYPICALLY_NONE}
PLAIN = [kind for kind in catalogue.IN_STEP_ORDER if kind.id != "base_vibration"]


@pytest.fixture(autouse=True)
def no_others(monkeypatch):
    """What a test tells the process about effects of its own is forgotten after it."""
    monkeypatch.setattr(catalogue, "OWN", {})


def put(kind, z: float) -> Model:
    """The model with every number of the effect at z, shapes at their typical value."""
    model = TABLE
    for p in parameters_of(kind, 1):
        shape = tuple(p.name.split(".")) in SHAPES
        model = p.set(model, p.value(0.0 if shape else z))
    return model


def test_what_the_effects_declare_is_what_fits_have_counted():
    """To the last bit."""
    parameters = [p for kind in catalogue.IN_STEP_ORDER for p in parameters_of(kind, 1)]
    found = {p.name: (p.centre, p.spread, p.prior, p.low, p.high, p.log) for p in parameters}
    assert found == PARAMETERS and len(found) == len(parameters)
    for p in parameters:
        id, key = p.name.split(".")
        of_run = key in ("cosine[0]", "sine[0]")
        q = catalogue.find(id).quantities["amplitude" if of_run else key]
        assert (p.unit, p.run, p.step) == (q.unit, 0 if of_run else None, 0.1 if of_run else 0.05), p.name


def test_the_tables_are_read_from_the_effects():
    assert LEFT_OUT == ("base_vibration", "gyro_saturation")
    assert len(SHAPES) == 16
    forms = {key: p.spread for key, p in PRIORS.items() if p.role == "form"}
    assert set(forms.values()) == {1.0} and len(forms) == 10
    seldom = {("quadratic_drag", "c_v"): 20.0}
    seldom |= {("inertia_deviation", axes): 0.02 for axes in ("xy", "xz", "yz")}
    seldom |= {("gyro_misalignment", axes): 0.005 for axes in ("xy", "xz", "yz")}
    assert forms | seldom == SELDOM


def test_no_effect_is_named_where_its_numbers_are_read():
    text = Path(candidates.__file__).read_text(encoding="utf-8")
    assert [id for id in catalogue.EFFECTS if id in text] == []


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_zero_is_absence(kind):
    assert put(kind, 0.0).active_effects() == ()


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_one_is_there_and_of_typical_size(kind):
    (effect,) = put(kind, 1.0).active_effects()
    assert effect.id == kind.id
    for name, q in kind.quantities.items():
        value = getattr(effect, name)
        prior = prior_of(kind, name)
        if prior.role == "fixed" or (prior.role, prior.scale) == ("size", "log"):
            continue
        plain = q.sign == "+" or (kind.id, name) in SHAPES or not np.isfinite(q.absent)
        sized = q.typical if plain else q.absent + abs(q.typical - q.absent)
        if (kind.id, name) in SELDOM:
            sized = q.absent + SELDOM[kind.id, name]
        if prior.centre == 0.5:  # between two laws
            sized = (q.least + q.most) / 2
        assert value == pytest.approx(sized, rel=1e-9), name


def z_in(parameters, kind, model: Model) -> list[float]:
    """Where a model's effect stands on the scale of each number."""
    (effect,) = (e for e in model.effects if e.id == kind.id)
    values = [to_scale(kind, p.name.partition(".")[2], getattr(effect, p.name.partition(".")[2])) for p in parameters]
    pairs = zip(parameters, values, strict=True)
    return [(np.log(v / p.centre) if p.log else v - p.centre) / p.spread for p, v in pairs]


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_z_comes_back_from_a_model(kind):
    parameters = parameters_of(kind, 2)
    model = TABLE
    # Half a size: inside every hard limit, and not at the centre.
    for p in parameters:
        model = p.set(model, p.value(0.5))
    np.testing.assert_allclose(z_in(parameters, kind, model), 0.5, atol=1e-9)


@pytest.mark.parametrize("baseline", ["eight_points", "four_points"])
def test_wherever_a_fit_goes_there_is_a_model(baseline):
    """Steps of a search add up: on a blind case an inner point came to the other side of the base, and no verdict."""
    block = TABLE if baseline == "eight_points" else Model.four_points()
    for kind, model in product(kinds(baseline), (block, block.replace(width=0.025, depth=0.025))):
        parameters = tuple(within_base(p, model) for p in parameters_of(kind, 1))
        for far in parameters:
            for z in (-30.0, 30.0):
                at = model
                for p in parameters:
                    at = p.set(at, p.value(z if p is far else 1.0))
                assert at.body()[1].n == (8 if kind.id == "foot_defects" else model.body()[1].n)


def test_foot_defects_are_no_candidate_where_the_baseline_has_them():
    eight, four = ({kind.id for kind in kinds(b)} for b in ("eight_points", "four_points"))
    assert four - eight == {"foot_defects"} and {kind.id for kind in kinds("custom")} == eight
    assert "gyro_scale" not in {kind.id for kind in kinds("four_points", ["gyro_scale"])}


def test_each_run_of_a_shaking_base_has_its_own_phase():
    kind = catalogue.find("base_vibration")
    parameters = parameters_of(kind, 3, frequency=16.4)
    shared = [p for p in parameters if p.run is None]
    forms = ["harmonic_cosine", "harmonic_sine"]
    assert [p.name for p in shared] == [f"base_vibration.{key}" for key in (*forms, "frequency", "direction")]
    assert shared[2].value(0.0) == 16.4
    model = TABLE
    for p in parameters:
        if p.run in (None, 1):
            model = p.set(model, p.value(1.0 if p.run is None or "cosine" in p.name else -1.0))
    (effect,) = model.active_effects()
    size = kind.quantities["amplitude"].typical
    assert effect.amplitude == pytest.approx(np.sqrt(2) * size) and effect.phase == pytest.approx(-np.pi / 4)
    # The second harmonic is shared, and turns with the run's own phase.
    assert (effect.harmonic_cosine, effect.harmonic_sine) == (1.0, 1.0)
    assert effect.wave(0.0) == pytest.approx(np.cos(np.pi / 4) - 1.0)


EXAMPLE = Path(__file__).resolve().parents[4] / "examples/my_effect.py"
OWN = """
import math
from dataclasses import dataclass
from rockref.effects.base import Effect, Quantity

@dataclass(frozen=True)
class Mine(Effect):
    id = "mine"
    quantities = {
        "range": Quantity("rad/s", math.inf, 0.1, 10.0, 0.5),
        "push": Quantity("N", 0.0, -2.0, 2.0, 0.0),
        "shape": Quantity("1", 2.0, 1.0, 4.0, 3.0),
    }
    switches = ("range", "push")
    range: float = math.inf
    push: float = 0.0
    shape: float = 2.0

    def sensor(self, t, crv):
        return crv / (1 + abs(crv / self.range) ** self.shape) + self.push
"""


def test_a_users_own_effect_is_a_candidate_like_any_other():
    """Named by its file once, it is known by its id: what fit, add and plan ask for."""
    (id,) = known_effects((f"{EXAMPLE}:EddyBrake",))
    kind = catalogue.find(id)
    (p,) = parameters_of(kind, 6)
    assert (id, p.name, p.unit, p.low) == ("eddy_brake", "eddy_brake.c", "N m s", 0.0)
    assert put(kind, 0.0).active_effects() == ()
    assert put(kind, 1.0).active_effects() == (kind(0.05),)
    assert z_in((p,), kind, put(kind, 0.5)) == pytest.approx([0.5])
    with pytest.raises(InputError, match="given twice"):
        known_effects((id, f"{EXAMPLE}:EddyBrake"))
    with pytest.raises(InputError, match="poses of tosses"):
        known_effects(("tag_frame",))


def test_numbers_of_a_users_own_that_are_infinite_none_or_only_shape(tmp_path):
    """Found as an inverse; in quarters of the range; not moved, but typical."""
    (tmp_path / "mine.py").write_text(OWN, encoding="utf-8")
    kind = catalogue.named(f"{tmp_path / 'mine.py'}:Mine")
    parameters = parameters_of(kind, 1)
    assert [p.name for p in parameters] == ["mine.range", "mine.push"]
    assert put(kind, 0.0).active_effects() == ()
    assert put(kind, 0.5).active_effects() == (kind(range=1.0, push=0.5, shape=3.0),)
    np.testing.assert_allclose(z_in(parameters, kind, put(kind, 0.5)), [0.5, 0.5])


def test_one_who_fits_or_plans_may_name_a_file(monkeypatch):
    """`plan` asks every release about the class that the file has."""
    asked = []

    class Enough(Exception):
        pass

    def says(model, release, effects, *rest, **more):
        asked.append([kind.id for kind in effects])
        raise Enough

    monkeypatch.setattr(planning, "says", says)
    with pytest.raises(Enough):
        planning.plan(TABLE, [planning.Release(0.117)], [f"{EXAMPLE}:EddyBrake", "quadratic_drag"])
    assert asked == [["eddy_brake", "quadratic_drag"]]


def test_a_shaking_base_that_does_not_shake_is_not_there():
    *_, frequency, direction, cosine, sine = parameters_of(catalogue.find("base_vibration"), 1, 12.0)
    assert (frequency.centre, direction.run, cosine.run) == (12.0, None, 0)
    assert cosine.set(TABLE, 0.0) is TABLE
    model = sine.set(cosine.set(TABLE, 0.03), 0.04)
    (effect,) = model.active_effects()
    assert effect.amplitude == pytest.approx(0.05) and effect.phase == pytest.approx(np.arctan2(0.04, 0.03))
    # One part taken away leaves the other one.
    (effect,) = cosine.set(model, 0.0).active_effects()
    assert effect.amplitude == pytest.approx(0.04) and frequency.set(model, 7.0).active_effects()[0].frequency == 7.0
