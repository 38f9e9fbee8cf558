"""Effects as numbers that a fit moves: absent at zero, typical at one, and back."""

import numpy as np
import pytest

from rockref import Model
from rockref.discover.candidates import FACTORS, FIXED, SELDOM, SHAPES, kinds, parameters_of, value_of
from rockref.discover.fit import baseline_parameters
from rockref.discover.fitted import start_from, z_of
from rockref.effects import catalogue

TABLE = Model.table_3_1()
PLAIN = [kind for kind in catalogue.IN_STEP_ORDER if kind.id != "base_vibration"]


def put(kind, z: float) -> Model:
    """The model with every number of the effect at z, shapes at their typical value."""
    model = TABLE
    for p in parameters_of(kind, 1):
        shape = tuple(p.name.split(".")) in SHAPES
        model = p.set(model, p.value(0.0 if shape else z))
    return model


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_zero_is_absence(kind):
    assert put(kind, 0.0).active_effects() == ()


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_one_is_there_and_of_typical_size(kind):
    (effect,) = put(kind, 1.0).active_effects()
    assert effect.id == kind.id
    for name, q in kind.quantities.items():
        value = getattr(effect, name)
        if (kind.id, name) in FIXED or kind.id in FACTORS and (kind.id, name) not in SHAPES:
            continue
        plain = q.sign == "+" or (kind.id, name) in SHAPES or not np.isfinite(q.absent)
        sized = q.typical if plain else q.absent + SELDOM.get((kind.id, name), abs(q.typical - q.absent))
        assert value == pytest.approx(sized, rel=1e-9), name


@pytest.mark.parametrize("kind", PLAIN, ids=lambda kind: kind.id)
def test_z_comes_back_from_a_model(kind):
    parameters = (*baseline_parameters(TABLE, 2, 0.0014), *parameters_of(kind, 2))
    z = np.zeros(len(parameters))
    # Half a size: inside every hard limit, and not at the centre.
    z[[p.name.startswith(kind.id + ".") for p in parameters]] = 0.5
    model = TABLE
    for p, zi in zip(parameters, z, strict=True):
        if p.run is None:
            model = p.set(model, p.value(zi))
    np.testing.assert_allclose(start_from(parameters, model), z, atol=1e-9)


def test_value_and_z_are_inverse():
    for p in baseline_parameters(TABLE, 1, 0.0014):
        assert z_of(p, p.value(0.7)) == pytest.approx(0.7, abs=1e-12)
        assert value_of(p, 0.7) == p.value(0.7)


def test_foot_defects_are_no_candidate_where_the_baseline_has_them():
    eight, four = ({kind.id for kind in kinds(b)} for b in ("eight_points", "four_points"))
    assert four - eight == {"foot_defects"}
    assert "gyro_scale" not in {kind.id for kind in kinds("four_points", ["gyro_scale"])}


def test_each_run_of_a_shaking_base_has_its_own_phase():
    kind = catalogue.find("base_vibration")
    parameters = parameters_of(kind, 3, frequency=16.4)
    shared = [p for p in parameters if p.run is None]
    assert [p.name for p in shared] == ["base_vibration.frequency", "base_vibration.direction"]
    assert shared[0].value(0.0) == 16.4
    model = TABLE
    for p in parameters:
        if p.run in (None, 1):
            model = p.set(model, p.value(1.0 if p.run is None or "cosine" in p.name else -1.0))
    (effect,) = model.active_effects()
    size = kind.quantities["amplitude"].typical
    assert effect.amplitude == pytest.approx(np.sqrt(2) * size) and effect.phase == pytest.approx(-np.pi / 4)
