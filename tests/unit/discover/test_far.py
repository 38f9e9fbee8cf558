"""Where candidates begin when the baseline is far from the runs."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.candidates import parameters_of
from rockref.discover.far import BEGUN_AT, RINGING, sizes
from rockref.effects import catalogue

N = 4


def trial(id: str, step=None):
    """A trial of an effect on top of N parameters, whose first step along the effect was `step` (None: none)."""
    parameters = parameters_of(catalogue.find(id), 1)
    z = np.zeros(N) if step is None else np.concatenate([np.zeros(N), step])
    return SimpleNamespace(
        effects=(id,), fit=SimpleNamespace(parameters=(None,) * N + parameters), point=SimpleNamespace(z=z)
    )


def test_one_sided_effect_begins_on_its_side():
    (z,) = sizes(trial("spin_friction", [-0.3]), N)
    assert z == pytest.approx([BEGUN_AT])


def test_two_sided_effect_begins_along_its_step():
    (z,) = sizes(trial("mass_eccentricity", [0.1, -0.4, 0.0]), N)
    np.testing.assert_allclose(z, np.array([0.25, -1.0, 0.0]) * BEGUN_AT)


def test_effect_without_a_step_begins_at_a_size():
    (z,) = sizes(trial("quadratic_drag"), N)
    assert z == pytest.approx([BEGUN_AT])


def test_shapes_begin_at_their_typical_value():
    (z,) = sizes(trial("stribeck_friction", [0.2, 0.9]), N)
    assert z == pytest.approx([BEGUN_AT, 0.0])


def test_plate_begins_at_several_frequencies():
    kind = catalogue.find("compliant_support")
    begun = sizes(trial("compliant_support", [0.1, 0.0, 0.0]), N)
    assert [z[0] for z in begun] == list(RINGING) and all(np.all(z[1:] == 0) for z in begun)
    typical = kind.quantities["frequency"].typical
    # 40 to 120 Hz, each within the half of the next one's.
    found = [typical / np.sqrt(z[0]) for z in begun]
    assert max(found) == pytest.approx(120) and min(found) == pytest.approx(40)
